// The ends of segments of rays in linear tetrahedra, and the fields there, compiled once for every
// instruction set. Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_TETRAHEDRON_ENDS_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_TETRAHEDRON_ENDS_INL
#    undef HIAC_RENDER_TETRAHEDRON_ENDS_INL
#  else
#    define HIAC_RENDER_TETRAHEDRON_ENDS_INL
#  endif

#  include <algorithm>
#  include <array>
#  include <cstddef>
#  include <cstdint>

#  include <hwy/highway.h>

#  include "hiac/frame/frame.hpp"
#  include "hiac/frame/interval_range.hpp"
#  include "hiac/render/tetrahedra/face_lines-inl.hpp"
#  include "hiac/render/tetrahedra/scan_conversion-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The data of one cell beyond its geometry.
struct CellScalars {
  IntervalRange color, extinction;
  double least_color, most_color, least_extinction, most_extinction;
  double base_color = 0, base_extinction = 0;  // scale_by_depth

  [[nodiscard]] bool uniform() const {
    return color.low == color.high && extinction.low == extinction.high;
  }
};

// Loads the corner values of one field and returns the range of intervals that they span.
HWY_INLINE IntervalRange load_field(const FrameField& field, CellId cell, std::uint64_t first_entry,
                                    const NodeId* nodes, const std::array<std::size_t, 4>& corner,
                                    double* values, double& least, double& most) {
  IntervalRange range{~std::size_t{0}, 0};
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t at = field.index(cell, first_entry + corner[k], nodes[corner[k]]);
    values[k] = field.values[at];
    range.low = std::min<std::size_t>(range.low, field.intervals[at].low);
    range.high = std::max<std::size_t>(range.high, field.intervals[at].high);
  }
  least = std::min(std::min(values[0], values[1]), std::min(values[2], values[3]));
  most = std::max(std::max(values[0], values[1]), std::max(values[2], values[3]));
  return range;
}

// Subtracts the first corner's value, multiplies the differences by 1/t and returns that value.
// Fields times 1/t are affine on the screen, fields are not; the subtraction preserves the digits
// of fields far from zero.
HWY_INLINE double scale_by_depth(const ProjectedTetrahedron& corners, double* values) {
  const double base = values[0];
  for (std::size_t k = 0; k < 4; ++k) values[k] = (values[k] - base) * corners.depth[k];
  return base;
}

// Where the rays of a row of pixels enter and leave the cell, and the fields there.
template <class V>
struct EntryAndExit {
  V front, back;  // depth
  V front_color, back_color, front_extinction, back_extinction;
};

// Computes the depth and the fields of each pixel on the face, among [begin, end) of `sides`, that
// covers it. Exactly one face of either side covers a pixel of the cell, so the first face is the
// default and needs no test.
template <bool kSeparateFields, class D, class V = hn::Vec<D>>
HWY_INLINE void meet_faces(D d, const FaceLines& lines, V pixel, const FaceSides& sides,
                           std::size_t begin, std::size_t end, V& depth, V& color, V& extinction) {
  const std::size_t first = sides.face[begin];
  const V from_first = columns_from_first(d, lines, first, pixel);
  depth = on_line(d, lines.depth, first, from_first);
  extinction = on_line(d, lines.extinction, first, from_first);
  color = extinction;
  if constexpr (kSeparateFields) color = on_line(d, lines.color, first, from_first);
  for (std::size_t k = begin + 1; k < end; ++k) {
    const std::size_t f = sides.face[k];
    const V dx = columns_from_first(d, lines, f, pixel);
    const auto covered = in_run(d, lines, f, pixel, dx);
    depth = hn::IfThenElse(covered, on_line(d, lines.depth, f, dx), depth);
    extinction = hn::IfThenElse(covered, on_line(d, lines.extinction, f, dx), extinction);
    if constexpr (kSeparateFields)
      color = hn::IfThenElse(covered, on_line(d, lines.color, f, dx), color);
  }
}

// The ends of the segments of pixels in the row's span; other pixels get meaningless numbers.
template <bool kSeparateFields, class D, class V = hn::Vec<D>>
HWY_INLINE EntryAndExit<V> entry_and_exit(D d, const FaceLines& lines, const FaceSides& sides,
                                          V pixel) {
  EntryAndExit<V> e;
  V in, out;
  meet_faces<kSeparateFields>(d, lines, pixel, sides, 0, sides.entered, in, e.front_color,
                              e.front_extinction);
  meet_faces<kSeparateFields>(d, lines, pixel, sides, sides.entered, 4, out, e.back_color,
                              e.back_extinction);
  // rounding may exchange the two in a thin cell
  e.front = hn::Min(in, out);
  e.back = hn::Max(in, out);
  return e;
}

// Converts depths, and fields times depths, to ray parameters and fields, in perspective.
template <bool kSeparateFields, class D, class V = hn::Vec<D>>
HWY_INLINE void to_ray_parameter(D d, const CellScalars& s, EntryAndExit<V>& e) {
  const V minus_one = hn::Set(d, -1.0);
  const V front = hn::Div(minus_one, e.front), back = hn::Div(minus_one, e.back);
  const V base = hn::Set(d, s.base_extinction);
  e.front_extinction = hn::NegMulAdd(e.front_extinction, front, base);
  e.back_extinction = hn::NegMulAdd(e.back_extinction, back, base);
  if constexpr (kSeparateFields) {
    const V base_color = hn::Set(d, s.base_color);
    e.front_color = hn::NegMulAdd(e.front_color, front, base_color);
    e.back_color = hn::NegMulAdd(e.back_color, back, base_color);
  }
  e.front = front;
  e.back = back;
}

// Clamps fields to the range of their corners' values.
template <bool kSeparateFields, class D, class V = hn::Vec<D>>
HWY_INLINE void clamp_fields(D d, const CellScalars& s, EntryAndExit<V>& e) {
  const auto clamped = [d](V v, double low, double high) HWY_ATTR {
    return hn::Min(hn::Max(v, hn::Set(d, low)), hn::Set(d, high));
  };
  e.front_extinction = clamped(e.front_extinction, s.least_extinction, s.most_extinction);
  e.back_extinction = clamped(e.back_extinction, s.least_extinction, s.most_extinction);
  if constexpr (kSeparateFields) {
    e.front_color = clamped(e.front_color, s.least_color, s.most_color);
    e.back_color = clamped(e.back_color, s.least_color, s.most_color);
  } else {
    e.front_color = e.front_extinction;
    e.back_color = e.back_extinction;
  }
}

// z-clipping: the segment is restricted to the slab pixel by pixel (section 5.1, scissoring).
template <class D, class V = hn::Vec<D>>
HWY_NOINLINE EntryAndExit<V> clipped(D d, const Projector& projector, const EntryAndExit<V>& e,
                                     hn::Mask<D> active) {
  const V front = hn::Max(e.front, hn::Set(d, projector.near()));
  const V back = hn::Min(e.back, hn::Set(d, projector.far()));
  const auto some = hn::And(active, hn::Lt(front, back));
  const V length = hn::Sub(e.back, e.front);
  const auto at = [&](V t, V front_value, V back_value) {
    const V u = hn::Div(hn::Sub(t, e.front), length);
    const V between = hn::MulAdd(hn::Sub(back_value, front_value), u, front_value);
    const auto cut = hn::And(some, hn::Ne(t, e.front));
    return hn::IfThenElse(cut, hn::IfThenElse(hn::Eq(t, e.back), back_value, between), front_value);
  };
  return {front,
          back,
          at(front, e.front_color, e.back_color),
          at(back, e.front_color, e.back_color),
          at(front, e.front_extinction, e.back_extinction),
          at(back, e.front_extinction, e.back_extinction)};
}

// Computes the unit vectors along the rays of a row's pixels: right, up, forward. `scale`: their
// world length per unit of the ray parameter.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void set_rays(D d, const Projector& projector, int row, V pixel, const double* scale,
                         V (&ray)[3]) {
  ray[0] = ray[1] = hn::Zero(d);
  ray[2] = hn::Set(d, 1.0);
  if (!projector.perspective()) return;
  HWY_ALIGN double x[8], right[8];
  hn::Store(pixel, d, x);
  double up = 0;
  for (std::size_t k = 0; k < hn::Lanes(d); ++k) {
    const auto slopes = projector.slopes(pixel_center(x[k]), pixel_center(row));
    right[k] = slopes[0];
    up = slopes[1];
  }
  ray[2] = hn::Div(ray[2], hn::LoadU(d, scale));
  ray[0] = hn::Mul(hn::Load(d, right), ray[2]);
  ray[1] = hn::Mul(hn::Set(d, up), ray[2]);
}

// The part of a segment from u0 to u1.
template <class D, class V = hn::Vec<D>>
HWY_INLINE EntryAndExit<V> part_of(D d, const EntryAndExit<V>& e, V u0, V u1) {
  const auto at = [d](V u, V front, V back) HWY_ATTR {
    return hn::IfThenElse(hn::Ge(u, hn::Set(d, 1.0)), back,
                          hn::MulAdd(hn::Sub(back, front), u, front));
  };
  return {e.front,
          e.back,
          at(u0, e.front_color, e.back_color),
          at(u1, e.front_color, e.back_color),
          at(u0, e.front_extinction, e.back_extinction),
          at(u1, e.front_extinction, e.back_extinction)};
}

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
