// Where rays of a row of pixels enter and leave a linear tetrahedron, compiled once for every
// instruction set. Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_FACE_LINES_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_FACE_LINES_INL
#    undef HIAC_RENDER_FACE_LINES_INL
#  else
#    define HIAC_RENDER_FACE_LINES_INL
#  endif

#  include <cstddef>

#  include <hwy/highway.h>

#  include "hiac/render/tetrahedra/scan_conversion-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// FacePlanes along a row of pixels (index: face): a quantity starts with its value at the first
// pixel of the face's run and changes by `per_column` from pixel to pixel. On the run it stays
// within the face's values, so that no cancellation occurs however steep the face is.
struct FaceLines {
  HWY_ALIGN double first[4], last[4];  // columns: the run's first pixel and its last
  HWY_ALIGN double m[4], s[4];         // barycentric coordinates of the first pixel
  struct Quantity {
    HWY_ALIGN double at_first[4], per_column[4];
  };
  Quantity depth, color, extinction;
};

// Sets the change per column of a quantity, which all rows of a cell share.
HWY_INLINE void set_per_column(const FacePlanes& planes, const FacePlanes::Quantity& q,
                               FaceLines::Quantity& line) {
  const hn::CappedTag<double, 4> d;
  for (std::size_t f = 0; f < 4; f += hn::Lanes(d)) {
    const auto s = hn::Load(d, planes.cx + f);
    const auto m = hn::NegMulAdd(hn::Load(d, planes.h + f), s, hn::Load(d, planes.gx + f));
    hn::Store(hn::MulAdd(s, hn::Load(d, q.qs + f), hn::Mul(m, hn::Load(d, q.qm + f))), d,
              line.per_column + f);
  }
}

// Sets the value of one quantity at the first pixels of a row. `lines`: those of this row.
HWY_INLINE void set_at_first(const FaceLines& lines, const FacePlanes::Quantity& q,
                             FaceLines::Quantity& line) {
  const hn::CappedTag<double, 4> d;
  for (std::size_t f = 0; f < 4; f += hn::Lanes(d)) {
    const auto m = hn::Load(d, lines.m + f), s = hn::Load(d, lines.s + f);
    hn::Store(hn::MulAdd(s, hn::Load(d, q.qs + f),
                         hn::MulAdd(m, hn::Load(d, q.qm + f), hn::Load(d, q.q0 + f))),
              d, line.at_first + f);
  }
}

// Sets all quantities of one row.
template <bool kSeparateFields>
HWY_INLINE void set_row(const FacePlanes& planes, const FaceRuns& runs, int row, FaceLines& lines) {
  const hn::CappedTag<double, 4> d;
  const auto r = static_cast<std::size_t>(row - runs.row_begin);
  const auto y = hn::Set(d, pixel_center(row)), half = hn::Set(d, 0.5), one = hn::Set(d, 1.0);
  for (std::size_t f = 0; f < 4; f += hn::Lanes(d)) {
    const auto first = hn::Load(d, runs.first[r] + f);
    const auto dx = hn::Sub(hn::Add(first, half), hn::Load(d, planes.base_x + f));
    const auto dy = hn::Sub(y, hn::Load(d, planes.base_y + f));
    const auto s =
        hn::MulAdd(dx, hn::Load(d, planes.cx + f), hn::Mul(dy, hn::Load(d, planes.cy + f)));
    const auto m = hn::NegMulAdd(
        hn::Load(d, planes.h + f), s,
        hn::MulAdd(dx, hn::Load(d, planes.gx + f), hn::Mul(dy, hn::Load(d, planes.gy + f))));
    hn::Store(first, d, lines.first + f);
    hn::Store(hn::Sub(hn::Load(d, runs.last[r] + f), one), d, lines.last + f);
    hn::Store(m, d, lines.m + f);
    hn::Store(s, d, lines.s + f);
  }
  set_at_first(lines, planes.depth, lines.depth);
  set_at_first(lines, planes.extinction, lines.extinction);
  if constexpr (kSeparateFields) set_at_first(lines, planes.color, lines.color);
}

// The number of columns from the first pixel of a face's run.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V columns_from_first(D d, const FaceLines& lines, std::size_t f, V pixel) {
  return hn::Sub(pixel, hn::Set(d, lines.first[f]));
}

// Whether a pixel lies in a face's run. `dx`: columns_from_first.
template <class D, class V = hn::Vec<D>>
HWY_INLINE hn::Mask<D> in_run(D d, const FaceLines& lines, std::size_t f, V pixel, V dx) {
  return hn::Ge(hn::Min(dx, hn::Sub(hn::Set(d, lines.last[f]), pixel)), hn::Zero(d));
}

// The value of a quantity `dx` columns from the first pixel of the face's run.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V on_line(D d, const FaceLines::Quantity& line, std::size_t f, V dx) {
  return hn::MulAdd(dx, hn::Set(d, line.per_column[f]), hn::Set(d, line.at_first[f]));
}

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
