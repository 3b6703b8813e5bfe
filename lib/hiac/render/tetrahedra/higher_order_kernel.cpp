#include "hiac/render/tetrahedra/higher_order_kernel.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hiac/render/tetrahedra/higher_order_kernel.cpp"
#include <hwy/foreach_target.h>
// must come after foreach_target.h
#include <hwy/highway.h>

#include "hiac/frame/tolerance_shares.hpp"
#include "hiac/render/integrate/higher_order_shading-inl.hpp"
#include "hiac/render/pixels/segment_sink-inl.hpp"
#include "hiac/render/tetrahedra/higher_order_details.hpp"
#include "hiac/render/tetrahedra/scan_conversion-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Rounding error of the coefficients of fields, by order, relative to their size.
inline constexpr double kCoefficientRounding[] = {0, 0, 0x1p-49, 0x1p-46};

// One field in one cell, minus its value at the first corner; corners are in ascending order of
// their nodes.
template <std::size_t kOrder>
struct HigherOrderField {
  double base;
  double low, high;  // relative to the base
  IntervalRange intervals;
  PolarForm<kOrder> form;

  template <std::size_t N>
  HWY_INLINE void load(const FrameField& field, const TransferTable<N>& table, CellId cell,
                       std::uint64_t first_entry, const NodeId* nodes,
                       const std::array<std::size_t, 4>& corner) {
    const auto value = [&](std::size_t k) {
      return field.values[field.index(cell, first_entry + k, nodes[k])];
    };
    base = value(corner[0]);
    std::array<double, PolarForm<kOrder>::kNodes> values;
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = value(k) - base;
    const auto [least, most] = form.set(values, corner);
    // a constant field keeps its exact value
    const double rounding =
        most > least ? kCoefficientRounding[kOrder] * (std::abs(base) + most - least) : 0;
    low = least - rounding;
    high = most + rounding;
    intervals = {classify_value(base + low, table).low, classify_value(base + high, table).high};
  }
};

// Renders one kind of scene.
template <bool kEmission, std::size_t kOrder>
class HigherOrderRenderer {
 public:
  explicit HigherOrderRenderer(const TileTarget& to)
      : to_(to),
        frame_(to.frame),
        buffer_(to.buffer),
        perspective_(frame_.projector.perspective()),
        sink_(to) {
    if (frame_.with_details) details_.emplace(frame_, to.tile);
  }

  HWY_INLINE void render(CellId cell) {
    if (!load(cell) || !scan_faces(corners_, to_.tile, runs_)) return;
    set_face_planes(corners_, false, planes_);
    set_weights();
    if (HWY_UNLIKELY(details_.has_value())) details_->enter(cell);
    sides_ = face_sides(corners_);
    Walk walk(frame_.optics, {color_.intervals, color_.base},
              {extinction_.intervals, extinction_.base});
    const int lanes = static_cast<int>(hn::Lanes(D()));
    for (int row = runs_.row_begin; row < runs_.row_end; ++row) {
      const auto r = static_cast<std::size_t>(row - runs_.row_begin);
      const int first = static_cast<int>(runs_.span_first[r]);
      const int last = static_cast<int>(runs_.span_last[r]);
      set_face_row(planes_, runs_, row, face_row_);
      for (int x = first; x < last; x += lanes) render_pixels(walk, row, x, last);
    }
  }

 private:
  using D = hn::CappedTag<double, 8>;
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;
  using Walk = HigherOrderWalk<kEmission, kOrder>;

  HWY_INLINE bool load(CellId cell) {
    const std::uint64_t first_entry = frame_.mesh.elems[cell];
    const NodeId* nodes = frame_.mesh.nodes.data() + first_entry;
    const auto corner = ascending_corners(nodes);
    const OpticsTables& optics = frame_.optics;
    extinction_.load(frame_.extinction, optics.extinction, cell, first_entry, nodes, corner);
    if (optics.same_field)
      color_ = extinction_;
    else
      color_.load(frame_.color, optics.color, cell, first_entry, nodes, corner);
    if (is_empty_space(optics, color_.intervals, extinction_.intervals)) return false;
    for (std::size_t k = 0; k < 4; ++k) {
      const ProjectedNode& node = frame_.nodes[nodes[corner[k]]];
      corners_.x[k] = node.x;
      corners_.y[k] = node.y;
      corners_.depth[k] = node.depth;
      corners_.extinction[k] = 0;
    }
    const auto [nearest, farthest] =
        std::minmax({corners_.depth[0], corners_.depth[1], corners_.depth[2], corners_.depth[3]});
    nearest_ = nearest;
    farthest_ = farthest;
    const auto parameter = [&](double depth) { return perspective_ ? -1 / depth : depth; };
    clipped_ = !(parameter(nearest) >= frame_.projector.near() &&
                 parameter(farthest) <= frame_.projector.far());
    return true;
  }

  // Sets up the barycentric coordinates as affine functions on the screen, in perspective times the
  // depth.
  HWY_INLINE void set_weights() {
    const hn::CappedTag<double, 4> d;
    for (std::size_t k = 0; k < 3; ++k) {
      HWY_ALIGN double at_corner[4] = {0, 0, 0, 0};
      at_corner[k + 1] = perspective_ ? corners_.depth[k + 1] : 1;
      for (std::size_t f = 0; f < 4; f += hn::Lanes(d))
        set_quantity(d, at_corner, f, face_edges(d, corners_, f).swapped(), weights_[k]);
    }
  }

  // The points where rays meet the cell's surface.
  struct Place {
    V depth;
    V corner[3];  // barycentric coordinates of the last three corners
  };

  HWY_INLINE Place place_on(D d, V pixel, std::size_t f) const {
    const auto on = place_on_face(d, planes_, face_row_, f, pixel);
    return {on_face(d, planes_.depth, f, on),
            {on_face(d, weights_[0], f, on), on_face(d, weights_[1], f, on),
             on_face(d, weights_[2], f, on)}};
  }

  // The points on those of the faces [begin, end) of sides_ that cover the pixels from x to `last`.
  HWY_INLINE Place meet(D d, V pixel, int x, int last, std::size_t begin, std::size_t end) const {
    const auto covers_all = [&](std::size_t k) {
      const std::size_t f = sides_.face[k];
      return face_row_.first[f] <= x && last <= face_row_.last[f];
    };
    // usually one face covers all
    std::size_t first = begin;
    while (first + 1 < end && !covers_all(first)) ++first;
    const bool one = covers_all(first);
    Place place = place_on(d, pixel, sides_.face[one ? first : begin]);
    for (std::size_t k = begin + 1; k < end && !one; ++k) {
      const std::size_t f = sides_.face[k];
      const M covered = covered_by_face(d, face_row_, f, pixel);
      const Place here = place_on(d, pixel, f);
      place.depth = hn::IfThenElse(covered, here.depth, place.depth);
      for (std::size_t c = 0; c < 3; ++c)
        place.corner[c] = hn::IfThenElse(covered, here.corner[c], place.corner[c]);
    }
    if (perspective_) {
      const V inverse = hn::Div(hn::Set(d, 1.0), place.depth);
      for (V& c : place.corner) c = hn::Mul(c, inverse);
    }
    return place;
  }

  // The ray parameter of a depth, which is clamped to the corners' depths against rounding.
  HWY_INLINE V ray_parameter(D d, V depth) const {
    depth = hn::Min(hn::Max(depth, hn::Set(d, nearest_)), hn::Set(d, farthest_));
    return perspective_ ? hn::Div(hn::Set(d, -1.0), depth) : depth;
  }

  static HWY_INLINE BernsteinScalar<V, kOrder> scalar_between(D d,
                                                              const HigherOrderField<kOrder>& field,
                                                              const Place& p, const Place& q) {
    BernsteinScalar<V, kOrder> s = field.form.between(d, p.corner, q.corner);
    const V low = hn::Set(d, field.low), high = hn::Set(d, field.high);
    for (V& c : s.c) c = hn::Min(hn::Max(c, low), high);
    return s;
  }

  HWY_INLINE void render_pixels(Walk& walk, int row, int x, int last) {
    const D d;
    const V pixel = hn::Iota(d, x), one = hn::Set(d, 1.0);
    const std::size_t at = to_.tile.index(x, row);
    const V behind = hn::LoadU(d, buffer_.transparency.data() + at);
    M active = hn::And(hn::Lt(pixel, hn::Set(d, last)),
                       hn::Gt(behind, hn::Set(d, frame_.least_transparency)));
    if (hn::AllFalse(d, active)) return;
    const int end = std::min(x + static_cast<int>(hn::Lanes(d)), last);
    const Place in = meet(d, pixel, x, end, 0, sides_.entered);
    const Place out = meet(d, pixel, x, end, sides_.entered, 4);
    const V whole_front = ray_parameter(d, in.depth), whole_back = ray_parameter(d, out.depth);
    const V depth = hn::Sub(whole_back, whole_front);
    V front = whole_front, back = whole_back;
    HigherOrderSegments<V, kOrder> s;
    s.whole = !clipped_;
    s.begin = hn::Neg(one);
    s.end = one;
    if (clipped_) {
      front = hn::Max(front, hn::Set(d, frame_.projector.near()));
      back = hn::Min(back, hn::Set(d, frame_.projector.far()));
      const auto part = [&](V t) {
        const V share = hn::Div(hn::Sub(t, whole_front), depth);
        return hn::Min(hn::Max(hn::MulSub(hn::Set(d, 2.0), share, one), s.begin), one);
      };
      s.begin = part(front);
      s.end = hn::IfThenElse(hn::Eq(back, whole_back), one, part(back));
    }
    active = hn::And(active, hn::Lt(front, back));
    to_.counts.segments += hn::CountTrue(d, active);
    s.extinction = scalar_between(d, extinction_, in, out);
    s.color = frame_.optics.same_field ? s.extinction : scalar_between(d, color_, in, out);
    s.length =
        hn::IfThenElseZero(active, hn::Mul(depth, hn::LoadU(d, buffer_.ray_scale.data() + at)));
    constexpr double kShare = tolerance_shares(static_cast<CellOrder>(kOrder)).integration;
    const V allowed = hn::Mul(hn::Set(d, kShare * frame_.tolerance / frame_.depth), depth);
    s.weight = hn::Div(to_.group == nullptr ? behind : one, allowed);
    const Radiance<V> radiance = walk.run(d, s, active);
    if (HWY_UNLIKELY(details_.has_value())) {
      const Radiance<V> light = radiance;
      describe(d, at, front, back, light, active);
    }
    sink_.add(d, {at, front, back, radiance, active, behind});
  }

  // Adds the details of segments, before they are composited, to their pixels or to the group's
  // list.
  HWY_NOINLINE void describe(D d, std::size_t at, V front, V back, const Radiance<V>& light,
                             M active) {
    SegmentLanes lanes;
    lanes.store(d, front, back, light, active);
    for (std::size_t k = 0; k < hn::Lanes(d); ++k, ++at)
      if (lanes.is_active(k))
        hiac::describe(to_, at,
                       details_->describe({to_.tile.column(at), to_.tile.row(at), lanes.front(k),
                                           lanes.back(k), buffer_.ray_scale[at],
                                           to_.group == nullptr ? buffer_.transparency[at] : 1,
                                           lanes.light(k)}));
  }

  TileTarget to_;
  const Frame& frame_;
  TileBuffer& buffer_;
  bool perspective_;
  SegmentSink sink_;
  // of the current cell
  HigherOrderField<kOrder> extinction_, color_;
  ProjectedTetrahedron corners_;
  double nearest_ = 0, farthest_ = 0;  // depths
  bool clipped_ = false;               // the view clips the cell in depth
  FacePlanes planes_;
  std::array<FacePlanes::Quantity, 3> weights_;
  FaceRuns runs_;
  FaceSides sides_;
  FaceRow face_row_;
  std::optional<HigherOrderDetails> details_;  // if details are requested
};

template <bool kEmission, std::size_t kOrder>
HWY_NOINLINE void render_all(const TileTarget& to, std::span<const CellId> cells) {
  HigherOrderRenderer<kEmission, kOrder> renderer(to);
  for (const CellId cell : cells) renderer.render(cell);
}

template <std::size_t kOrder>
void render_order(const TileTarget& to, std::span<const CellId> cells) {
  (to.frame.optics.emission ? render_all<true, kOrder> : render_all<false, kOrder>)(to, cells);
}

void render_quadratic_here(const TileTarget& to, std::span<const CellId> cells) {
  render_order<2>(to, cells);
}
void render_cubic_here(const TileTarget& to, std::span<const CellId> cells) {
  render_order<3>(to, cells);
}

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hiac {

HWY_EXPORT(render_quadratic_here);
HWY_EXPORT(render_cubic_here);

bool for_higher_order_kernel(const Frame& frame, CellId cell) {
  return frame.optics.rule == PieceRule::exact && frame.isosurfaces.in(cell).empty();
}

void render_quadratic_tetrahedra(const TileTarget& to, std::span<const CellId> cells) {
  HWY_DYNAMIC_DISPATCH(render_quadratic_here)(to, cells);
}

void render_cubic_tetrahedra(const TileTarget& to, std::span<const CellId> cells) {
  HWY_DYNAMIC_DISPATCH(render_cubic_here)(to, cells);
}

}  // namespace hiac
#endif
