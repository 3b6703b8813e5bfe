#include "hiac/render/tetrahedra/tetrahedron_kernel.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <type_traits>
#include <vector>

#include <hwy/cache_control.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hiac/render/tetrahedra/tetrahedron_kernel.cpp"
#include <hwy/foreach_target.h>
// must come after foreach_target.h
#include <hwy/highway.h>

#include "hiac/render/integrate/isosurface_shading-inl.hpp"
#include "hiac/render/integrate/shading-inl.hpp"
#include "hiac/render/pixels/segment_sink-inl.hpp"
#include "hiac/render/tetrahedra/face_lines-inl.hpp"
#include "hiac/render/tetrahedra/scan_conversion-inl.hpp"
#include "hiac/render/tetrahedra/tetrahedron_cuts-inl.hpp"
#include "hiac/render/tetrahedra/tetrahedron_describe-inl.hpp"
#include "hiac/render/tetrahedra/tetrahedron_ends-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Renders one kind of scene; the template arguments are what the inner loop must not test at run
// time.
template <bool kSeparateFields, class Rule>
class TetrahedronRenderer {
 public:
  explicit TetrahedronRenderer(const TileTarget& to)
      : frame_(to.frame),
        tile_(to.tile),
        buffer_(to.buffer),
        counts_(to.counts),
        perspective_(frame_.projector.perspective()),
        clipped_(frame_.projector.near() > (perspective_ ? 0.0 : -hwy::HighestValue<double>()) ||
                 frame_.projector.far() < hwy::HighestValue<double>()),
        sink_(to),
        describer_(to) {}

  HWY_INLINE void render(CellId cell) {
    CellScalars scalars;
    if (!load(cell, scalars)) return;
    if (!scan_faces(corners_, tile_, runs_)) return;
    set_face_planes(corners_, kSeparateFields, planes_);
    set_per_column(planes_, planes_.depth, face_lines_.depth);
    set_per_column(planes_, planes_.extinction, face_lines_.extinction);
    if constexpr (kSeparateFields) set_per_column(planes_, planes_.color, face_lines_.color);
    sides_ = face_sides(corners_);
    set_cuts(cell);
    if (HWY_UNLIKELY(frame_.with_details)) describer_.enter(cell);
    const auto [nearest, farthest] =
        std::minmax({corners_.depth[0], corners_.depth[1], corners_.depth[2], corners_.depth[3]});
    const int lanes = static_cast<int>(hn::Lanes(D()));
    for (int row = runs_.row_begin; row < runs_.row_end; ++row) {
      const auto r = static_cast<std::size_t>(row - runs_.row_begin);
      const int first = static_cast<int>(runs_.span_first[r]);
      const int last = static_cast<int>(runs_.span_last[r]);
      set_row<kSeparateFields>(planes_, runs_, row, face_lines_);
      if (HWY_UNLIKELY(!cuts_.empty()) && cut_box_.meets(row))
        for (TetrahedronCut& cut : cuts_) set_at_first(face_lines_, cut.offset, cut.line);
      std::size_t at = tile_.index(first, row);
      for (int x = first; x < last; x += lanes, at += hn::Lanes(D()))
        render_pixels(scalars, row, x, last, at, nearest, farthest);
    }
  }

 private:
  using D = hn::CappedTag<double, 8>;
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;

  // Ray parameters.
  struct RayEnds {
    V front, back;
  };

  static HWY_INLINE std::size_t lanes() { return hn::Lanes(D()); }

  HWY_INLINE bool load(CellId cell, CellScalars& scalars) {
    const std::uint64_t first_entry = frame_.mesh.elems[cell];
    const NodeId* nodes = frame_.mesh.nodes.data() + first_entry;
    const auto corner = ascending_corners(nodes);
    scalars.extinction =
        load_field(frame_.extinction, cell, first_entry, nodes, corner, corners_.extinction,
                   scalars.least_extinction, scalars.most_extinction);
    scalars.color = scalars.extinction;
    if constexpr (kSeparateFields)
      scalars.color = load_field(frame_.color_field(), cell, first_entry, nodes, corner,
                                 corners_.color, scalars.least_color, scalars.most_color);
    empty_ = is_empty_space(frame_.optics, scalars.color, scalars.extinction);
    if (empty_ && frame_.isosurfaces.in(cell).empty()) return false;
    for (std::size_t k = 0; k < 4; ++k) {
      const ProjectedNode& node = frame_.nodes[nodes[corner[k]]];
      corners_.x[k] = node.x;
      corners_.y[k] = node.y;
      corners_.depth[k] = node.depth;
    }
    if (perspective_) {
      scalars.base_extinction = scale_by_depth(corners_, corners_.extinction);
      if constexpr (kSeparateFields) scalars.base_color = scale_by_depth(corners_, corners_.color);
    }
    return true;
  }

  // `at`: the first pixel's index into the tile's planes.
  HWY_INLINE void render_pixels(const CellScalars& scalars, int row, int x, int last,
                                std::size_t at, double nearest, double farthest) {
    const D d;
    const V pixel = hn::Iota(d, x);
    EntryAndExit<V> e = entry_and_exit<kSeparateFields>(d, face_lines_, sides_, pixel);
    const V behind = hn::LoadU(d, buffer_.transparency.data() + at);
    M active = hn::Gt(hn::IfThenElseZero(hn::Lt(pixel, hn::Set(d, last)), behind),
                      hn::Set(d, frame_.least_transparency));
    if (hn::AllFalse(d, active)) return;
    // clamp to the corners' depths: rounding may be large on faces seen edge-on
    e.front = hn::Min(hn::Max(e.front, hn::Set(d, nearest)), hn::Set(d, farthest));
    e.back = hn::Min(hn::Max(e.back, hn::Set(d, nearest)), hn::Set(d, farthest));
    if (perspective_) to_ray_parameter<kSeparateFields>(d, scalars, e);
    clamp_fields<kSeparateFields>(d, scalars, e);
    const RayEnds whole{e.front, e.back};
    if (HWY_UNLIKELY(clipped_)) {
      const EntryAndExit<V> unclipped = e;
      e = clipped(d, frame_.projector, unclipped, active);
      active = hn::And(active, hn::Lt(e.front, e.back));
    }
    V length = hn::Sub(e.back, e.front);
    if (perspective_) length = hn::Mul(length, hn::LoadU(d, buffer_.ray_scale.data() + at));
    length = hn::IfThenElseZero(active, length);
    counts_.segments += hn::CountTrue(d, active);

    const bool cut = HWY_UNLIKELY(!cuts_.empty()) &&
                     cut_box_.meets(row, x, std::min(last, x + static_cast<int>(lanes())));
    // Arguments of functions that are not inlined are copied: the compiler keeps no variable in a
    // register whose address has been passed on.
    Radiance<V> radiance;
    if (HWY_LIKELY(!cut)) {
      radiance = integrate(d, scalars, length, e, active);
    } else {
      const EntryAndExit<V> ends = e;
      radiance =
          integrate_between_surfaces(d, scalars, row, pixel, at, whole, length, ends, active);
    }
    if (HWY_UNLIKELY(frame_.with_details)) {
      const EntryAndExit<V> ends = e;
      const Radiance<V> light = radiance;
      describer_.describe(d, {row, x, at, cut, empty_}, length, ends, light, active);
    }
    sink_.add(d, {at, e.front, e.back, radiance, active, behind});
  }

  HWY_INLINE void set_cuts(CellId cell) {
    cuts_.clear();
    const auto surfaces = frame_.isosurfaces.in(cell);
    if (HWY_LIKELY(surfaces.empty())) return;
    cut_box_ = {};
    const auto corner = ascending_corners(frame_.mesh.nodes.data() + frame_.mesh.elems[cell]);
    for (const IsosurfaceCut& cut : surfaces)
      cuts_.push_back(make_cut(frame_, cell, cut, corner, corners_, planes_, cut_box_));
    cut_places_.resize(2 * cuts_.size() * lanes());
  }

  // The radiance of segments of which some pass a breakpoint. Neither this nor
  // integrate_beside_surfaces is inlined: their code takes the compiler longest, and would be
  // repeated wherever segments are integrated.
  HWY_NOINLINE Radiance<V> integrate_across(D d, const CellScalars& scalars, V length,
                                            const EntryAndExit<V>& e, M active) const {
    if constexpr (!std::is_same_v<Rule, ExactChromaticity> && !std::is_same_v<Rule, ExactEmission>)
      if (frame_.optics.unsliced)
        return unsliced_radiance<Rule>(d, frame_.optics, scalars.color, scalars.extinction, length,
                                       e.front_color, e.back_color, e.front_extinction,
                                       e.back_extinction);
    if constexpr (kSeparateFields)
      return walked_radiance<Rule>(d, frame_.optics, scalars.color, scalars.extinction, length,
                                   e.front_color, e.back_color, e.front_extinction,
                                   e.back_extinction, active);
    else
      return sliced_radiance<Rule>(d, frame_.optics, scalars.extinction, length, e.front_extinction,
                                   e.back_extinction, active);
  }

  HWY_INLINE Radiance<V> integrate(D d, const CellScalars& scalars, V length,
                                   const EntryAndExit<V>& e, M active) const {
    IntervalRange color = scalars.color, extinction = scalars.extinction;
    bool uniform = scalars.uniform();
    if constexpr (!kSeparateFields) {
      uniform = uniform || within_one_interval(d, frame_.optics.extinction, e.front_extinction,
                                               e.back_extinction, active, extinction);
      color = extinction;
    }
    if (uniform)
      return uniform_radiance<Rule>(d, frame_.optics, color.low, extinction.low, length,
                                    e.front_color, e.back_color, e.front_extinction,
                                    e.back_extinction);
    // a copy, as in render_pixels
    const EntryAndExit<V> ends = e;
    const Radiance<V> sum = integrate_across(d, scalars, length, ends, active);
    return sum;
  }

  // The same as integrate, for the few segments that isosurfaces may cross.
  HWY_NOINLINE Radiance<V> integrate_beside_surfaces(D d, const CellScalars& scalars, V length,
                                                     const EntryAndExit<V>& e, M active) const {
    return integrate(d, scalars, length, e, active);
  }

  // Stores for every cut the fraction of the segment at which it is crossed, 2 if it is not.
  // Returns the smallest of these.
  HWY_INLINE V place_cuts(D d, int row, V pixel, const RayEnds& whole, const EntryAndExit<V>& e) {
    CutScan(frame_, face_lines_, sides_, cuts_).find(d, row, pixel, cut_places_.data());
    if (HWY_UNLIKELY(frame_.with_details)) describer_.set_ends(cuts_.size(), cut_places_);
    const V zero = hn::Zero(d), one = hn::Set(d, 1.0), never = hn::Set(d, 2.0);
    V first = never;
    for (std::size_t k = 0; k < cuts_.size(); ++k) {
      double* ends = cut_places_.data() + 2 * k * hn::Lanes(d);
      const V front = hn::LoadU(d, ends), back = hn::LoadU(d, ends + hn::Lanes(d));
      M crossed = hn::Xor(hn::Ge(front, zero), hn::Ge(back, zero));
      V u = hn::Min(hn::Div(front, hn::Sub(front, back)), one);
      if (clipped_) {
        const V t = hn::MulAdd(hn::Sub(whole.back, whole.front), u, whole.front);
        crossed = hn::And(crossed, hn::And(hn::Ge(t, hn::Set(d, frame_.projector.near())),
                                           hn::Le(t, hn::Set(d, frame_.projector.far()))));
        const V part = hn::Div(hn::Sub(t, e.front), hn::Sub(e.back, e.front));
        u = hn::Min(hn::Max(part, zero), one);
      }
      const V place = hn::IfThenElse(crossed, u, never);
      hn::StoreU(place, d, cut_places_.data() + k * lanes());
      first = hn::Min(first, place);
    }
    return first;
  }

  // Integrates a cell that isosurfaces cross, from surface to surface, front to back. Each lane has
  // its own order of surfaces.
  HWY_NOINLINE Radiance<V> integrate_between_surfaces(D d, const CellScalars& scalars, int row,
                                                      V pixel, std::size_t at, const RayEnds& whole,
                                                      V length, const EntryAndExit<V>& e,
                                                      M active) {
    const V zero = hn::Zero(d), one = hn::Set(d, 1.0), never = hn::Set(d, 2.0);
    Radiance<V> sum{zero, zero, zero, one};
    const V first = place_cuts(d, row, pixel, whole, e);
    if (HWY_UNLIKELY(frame_.with_details))
      describer_.set_places(cut_places_, lanes());
    else if (hn::AllTrue(d, hn::Or(hn::Eq(first, never), hn::Not(active))))
      return empty_ ? sum : integrate_beside_surfaces(d, scalars, length, e, active);
    V from = zero;
    for (;;) {
      V next = never, which = zero;
      for (std::size_t k = 0; k < cuts_.size(); ++k) {
        const V u = hn::LoadU(d, cut_places_.data() + k * lanes());
        const M nearer = hn::Lt(u, next);
        next = hn::IfThenElse(nearer, u, next);
        which = hn::IfThenElse(nearer, hn::Set(d, static_cast<double>(k)), which);
      }
      const V to = hn::Min(next, one);
      const M some = hn::And(active, hn::Lt(from, to));
      if (!empty_ && !hn::AllFalse(d, some)) {
        const V before = sum.transparency;
        add_behind(integrate_beside_surfaces(d, scalars, hn::Mul(length, hn::Sub(to, from)),
                                             part_of(d, e, from, to), some),
                   some, sum);
        if (HWY_UNLIKELY(frame_.with_details))
          describer_.add_depth(d, hn::Mul(hn::Add(from, to), hn::Set(d, 0.5)),
                               hn::Sub(before, sum.transparency));
      }
      const M crossed = hn::And(active, hn::Lt(next, never));
      if (hn::AllFalse(d, crossed)) {
        // discards what shading computed in lanes without a ray
        for (V* plane : {&sum.red, &sum.green, &sum.blue})
          *plane = hn::IfThenElseZero(active, *plane);
        return sum;
      }
      V ray[3];
      set_rays(d, frame_.projector, row, pixel, buffer_.ray_scale.data() + at, ray);
      for (std::size_t k = 0; k < cuts_.size(); ++k) {
        const M here = hn::And(crossed, hn::Eq(which, hn::Set(d, static_cast<double>(k))));
        if (hn::AllFalse(d, here)) continue;
        const auto& n = cuts_[k].normal;
        const V normal[3] = {hn::Set(d, n[0]), hn::Set(d, n[1]), hn::Set(d, n[2])};
        const auto [rgb, transparency] =
            shade(d, *cuts_[k].surface, frame_.isosurfaces.lights, normal, ray);
        const V before = sum.transparency;
        add_behind(Radiance<V>{rgb[0], rgb[1], rgb[2], transparency}, here, sum);
        if (HWY_UNLIKELY(frame_.with_details))
          describer_.add_depth(d, to, hn::Sub(before, sum.transparency));
        double* place = cut_places_.data() + k * lanes();
        hn::StoreU(hn::IfThenElse(here, never, hn::LoadU(d, place)), d, place);
      }
      from = to;
    }
  }

  const Frame& frame_;
  const TileRect& tile_;
  TileBuffer& buffer_;
  TileCounts& counts_;
  bool perspective_, clipped_;
  SegmentSink sink_;
  ProjectedTetrahedron corners_;
  FacePlanes planes_;
  FaceRuns runs_;
  FaceSides sides_;
  FaceLines face_lines_;  // of the current row
  // of the current cell
  bool empty_ = false;  // the volume neither absorbs nor shines
  std::vector<TetrahedronCut> cuts_;
  ScreenBox cut_box_;               // of all cuts
  std::vector<double> cut_places_;  // of one vector of pixels
  SegmentDescriber describer_;      // used if details are requested
};

// Prefetches the data of the next cells, whose order in memory differs from that in space: far
// ahead the ids of their nodes, nearer ahead the frame's data of these nodes.
HWY_INLINE void prefetch(const Frame& frame, std::span<const CellId> cells, std::size_t i) {
  constexpr std::size_t kElementsAhead = 16, kIdsAhead = 8, kNodesAhead = 4;
  if (i + kElementsAhead < cells.size())
    hwy::Prefetch(&frame.mesh.elems[cells[i + kElementsAhead]]);
  if (i + kIdsAhead < cells.size())
    hwy::Prefetch(frame.mesh.nodes.data() + frame.mesh.elems[cells[i + kIdsAhead]]);
  if (i + kNodesAhead >= cells.size()) return;
  const CellId cell = cells[i + kNodesAhead];
  const std::uint64_t first_entry = frame.mesh.elems[cell];
  for (std::uint64_t entry = first_entry; entry < first_entry + 4; ++entry) {
    const NodeId node = frame.mesh.nodes[entry];
    hwy::Prefetch(&frame.nodes[node]);
    const std::size_t at = frame.extinction.index(cell, entry, node);
    hwy::Prefetch(&frame.extinction.values[at]);
    hwy::Prefetch(&frame.extinction.intervals[at]);
  }
}

template <bool kSeparateFields, class Rule>
HWY_NOINLINE void render_all(const TileTarget& to, std::span<const CellId> cells) {
  TetrahedronRenderer<kSeparateFields, Rule> renderer(to);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    prefetch(to.frame, cells, i);
    renderer.render(cells[i]);
  }
}

void render_tetrahedra_here(const TileTarget& to, std::span<const CellId> cells) {
  const OpticsTables& optics = to.frame.optics;
  auto render = render_all<true, AnyRule>;
  if (optics.rule == PieceRule::exact && !optics.emission)
    render = optics.same_field ? render_all<false, ExactChromaticity>
                               : render_all<true, ExactChromaticity>;
  else if (optics.rule == PieceRule::exact)
    render = optics.same_field ? render_all<false, ExactEmission> : render_all<true, ExactEmission>;
  else if (optics.rule == PieceRule::mean_color && !optics.emission)
    render = optics.same_field ? render_all<false, MeanChromaticity>
                               : render_all<true, MeanChromaticity>;
  render(to, cells);
}

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hiac {

HWY_EXPORT(render_tetrahedra_here);

void render_tetrahedra(const TileTarget& to, std::span<const CellId> cells) {
  HWY_DYNAMIC_DISPATCH(render_tetrahedra_here)(to, cells);
}

}  // namespace hiac
#endif
