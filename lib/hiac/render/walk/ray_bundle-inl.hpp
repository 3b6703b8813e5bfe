// Rays that are followed side by side, compiled once for every instruction set.
// Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_RAY_BUNDLE_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_RAY_BUNDLE_INL
#    undef HIAC_RENDER_RAY_BUNDLE_INL
#  else
#    define HIAC_RENDER_RAY_BUNDLE_INL
#  endif

#  include <algorithm>
#  include <array>
#  include <cstddef>
#  include <cstdint>
#  include <limits>
#  include <stdexcept>
#  include <vector>

#  include <hwy/cache_control.h>
#  include <hwy/highway.h>

#  include "hiac/render/edges/edge_place.hpp"
#  include "hiac/render/edges/tile_edges.hpp"
#  include "hiac/render/pixels/compositor-inl.hpp"
#  include "hiac/render/walk/ray_faces-inl.hpp"
#  include "hiac/render/walk/ray_scene.hpp"
#  include "hiac/render/walk/ray_starts.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The rays of a tile's pixels, some of them at a time, each of them in one cell.
class RayBundle {
 public:
  using D = RayFaces::D;
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;

  RayBundle(const RayScene& scene, const RayStarts& starts, const TileTarget& to, TileEdges& edges)
      : scene_(scene),
        starts_(starts),
        to_(to),
        tile_(to.tile),
        edges_(edges),
        faces_(scene),
        next_x_(tile_.x0),
        next_y_(tile_.y0) {
    for (std::size_t ray = 0; ray < kRays; ++ray) start(ray);
  }

  // Makes the segments of all rays in their cells; false if no ray is left.
  HWY_INLINE bool advance() {
    if (followed_ == 0) return false;
    for (std::size_t ray = 0; ray < kRays; ++ray)
      if (is_followed(ray)) faces_.find_apex(ray, cell_of(ray), entered_[ray]);
    for (std::size_t ray = 0; ray < kRays; ++ray)
      if (is_followed(ray)) faces_.place_apex(ray);
    const D d;
    for (std::size_t ray = 0; ray < kRays; ray += hn::Lanes(d)) {
      const M there = followed(ray);
      if (!hn::AllFalse(d, there)) add_segment(ray, faces_.leave(ray, there), there);
    }
    if (HWY_UNLIKELY(with_edges_ > 0))
      for (std::size_t ray = 0; ray < kRays; ++ray)
        if (meets_edges(ray)) take_edges_in_front(ray);
    return true;
  }

  // Takes the rays into the next cells once their segments are composited. Rays that end make room
  // for others.
  HWY_INLINE void settle() {
    for (std::size_t ray = 0; ray < kRays; ++ray)
      if (is_followed(ray)) settle(ray);
  }

  [[nodiscard]] HWY_INLINE bool is_followed(std::size_t ray) const {
    return entered_[ray].exists();
  }

  // Which of consecutive rays are followed.
  [[nodiscard]] HWY_INLINE M followed(std::size_t first) const {
    const D d;
    return hn::Ne(hn::Load(d, is_there_.data() + first), hn::Zero(d));
  }

  // Counts the segments of consecutive rays, those of a mask, unless they are hidden or belong to
  // cells of empty space. `is_empty`: segments in empty space.
  HWY_INLINE void count(std::size_t first, M where, M is_empty) {
    const D d;
    const V least = hn::Set(d, scene_.frame.least_transparency);
    where = hn::And(where, hn::Gt(hn::Load(d, transparency.data() + first), least));
    is_empty = hn::And(where, is_empty);
    if (HWY_UNLIKELY(!hn::AllFalse(d, is_empty))) {
      std::uint8_t bits[8] = {};
      hn::StoreMaskBits(d, is_empty, bits);
      for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane)
        if ((bits[0] >> lane & 1U) != 0 && is_empty_cell(first + lane)) bits[0] ^= 1U << lane;
      where = hn::And(where, hn::Or(hn::Not(is_empty), hn::LoadMaskBits(d, bits)));
    }
    hn::Store(hn::IfThenElse(where, hn::Set(d, 1.0), hn::Load(d, is_met_.data() + first)), d,
              is_met_.data() + first);
    to_.counts.segments += hn::CountTrue(d, where);
  }

  // of every ray's segment
  HWY_ALIGN RayNumbers length{}, front_field{}, back_field{};
  // of every ray so far
  HWY_ALIGN RayNumbers red{}, green{}, blue{}, transparency{};

 private:
  [[nodiscard]] HWY_INLINE const WalkableMesh::Cell& cell_of(std::size_t ray) const {
    return scene_.mesh[entered_[ray].cell()];
  }

  // Whether the ray's cell lies in empty space.
  HWY_NOINLINE bool is_empty_cell(std::size_t ray) const {
    const std::array<NodeId, 4>& nodes = cell_of(ray).nodes;
    IntervalRange range{~std::size_t{0}, 0};
    for (std::size_t k = 0; k < 4; ++k) {
      const ScalarIntervals at =
          scene_.frame.extinction.intervals[scene_.mesh.node_of_mesh(nodes[k])];
      range.low = std::min<std::size_t>(range.low, at.low);
      range.high = std::max<std::size_t>(range.high, at.high);
    }
    return is_empty_space(scene_.frame.optics, range, range);
  }

  // The segments from where rays have entered to where they leave. Depths may go back in a mesh
  // that is folded, or by rounding.
  HWY_INLINE void add_segment(std::size_t ray, const FacePoint<V>& leave, M followed) {
    const D d;
    const V entered = hn::Load(d, t_.data() + ray), field = hn::Load(d, field_.data() + ray);
    const V front = hn::Min(entered, leave.t), back = hn::Max(entered, leave.t);
    const M forward = hn::Ge(leave.t, entered);
    hn::Store(hn::IfThenElse(forward, field, leave.field), d, front_field.data() + ray);
    hn::Store(hn::IfThenElse(forward, leave.field, field), d, back_field.data() + ray);
    hn::Store(hn::Mul(hn::Sub(back, front), hn::Load(d, scale_.data() + ray)), d,
              length.data() + ray);
    hn::Store(front, d, front_.data() + ray);
    hn::Store(back, d, back_.data() + ray);
    hn::Store(leave.t, d, t_.data() + ray);
    hn::Store(leave.field, d, field_.data() + ray);
    const V last = hn::Load(d, last_.data() + ray);
    to_.counts.violations +=
        count_out_of_order(d, front, back, last, followed, scene_.frame.witness_tolerance);
    hn::Store(hn::Max(last, back), d, last_.data() + ray);
  }

  HWY_INLINE void settle(std::size_t ray) {
    if (HWY_UNLIKELY(meets_edges(ray))) take_edges_behind(ray);
    const WalkableMesh::Cell& cell = cell_of(ray);
    const OppositeFace left{entered_[ray].cell(), faces_.settle(ray, cell)};
    entered_[ray] = cell.across[left.opposite()];
    if (HWY_UNLIKELY(!is_seen(ray))) return end(ray);
    if (HWY_LIKELY(is_followed(ray))) return hwy::Prefetch(&cell_of(ray));
    leave_mesh(ray, left);
    if (!enter_mesh(ray)) end(ray);
  }

  HWY_NOINLINE void leave_mesh(std::size_t ray, OppositeFace face) {
    const auto hits = starts_.of(column_[ray], row_[ray]);
    for (std::size_t n = 0; n < hits.size(); ++n)
      if (scene_.mesh.boundary()[hits[n].face].face == face) {
        passed_[ray][n] = true;
        return;
      }
    throw std::logic_error("a ray leaves a mesh by a face that it does not meet");
  }

  // Enters the mesh by the nearest face that the ray has not passed; false if it has passed all.
  HWY_NOINLINE bool enter_mesh(std::size_t ray) {
    const auto hits = starts_.of(column_[ray], row_[ray]);
    std::size_t n = 0;
    while (n < hits.size() && passed_[ray][n]) ++n;
    if (n == hits.size()) return false;
    passed_[ray][n] = true;
    const auto& [face, corners] = scene_.mesh.boundary()[hits[n].face];
    const FacePoint<double> at = faces_.enter(ray, corners);
    t_[ray] = at.t;
    field_[ray] = at.field;
    entered_[ray] = face;
    return true;
  }

  // Takes the tile's next pixel whose ray meets the mesh, if there is one.
  HWY_NOINLINE void start(std::size_t ray) {
    entered_[ray] = {};
    is_there_[ray] = 0;
    for (; next_y_ < tile_.y1; ++next_y_, next_x_ = tile_.x0)
      while (next_x_ < tile_.x1) {
        const int x = next_x_++;
        const auto hits = starts_.of(x, next_y_);
        if (hits.empty()) continue;
        column_[ray] = x;
        row_[ray] = next_y_;
        faces_.set_pixel(ray, pixel_center(x), pixel_center(next_y_));
        scale_[ray] = to_.buffer.ray_scale[tile_.index(x, next_y_)];
        has_edges_[ray] = edges_.left().holds(x - tile_.x0, next_y_ - tile_.y0);
        with_edges_ += has_edges_[ray] ? 1 : 0;
        red[ray] = green[ray] = blue[ray] = 0;
        transparency[ray] = 1;
        last_[ray] = -std::numeric_limits<double>::infinity();
        is_met_[ray] = 0;
        passed_[ray].assign(hits.size(), false);
        enter_mesh(ray);
        is_there_[ray] = 1;
        ++followed_;
        return;
      }
  }

  HWY_NOINLINE void end(std::size_t ray) {
    store(ray);
    with_edges_ -= has_edges_[ray] ? 1 : 0;
    has_edges_[ray] = false;
    --followed_;
    start(ray);
  }

  // Puts a ray's light into its pixel, and takes it from there.
  void store(std::size_t ray) {
    const std::size_t at = tile_.index(column_[ray], row_[ray]);
    TileBuffer& buffer = to_.buffer;
    buffer.red[at] = red[ray];
    buffer.green[at] = green[ray];
    buffer.blue[at] = blue[ray];
    buffer.transparency[at] = transparency[ray];
    if (is_met_[ray] != 0) buffer.last[at] = last_[ray];
  }
  void load(std::size_t ray) {
    const std::size_t at = tile_.index(column_[ray], row_[ray]);
    const TileBuffer& buffer = to_.buffer;
    red[ray] = buffer.red[at];
    green[ray] = buffer.green[at];
    blue[ray] = buffer.blue[at];
    transparency[ray] = buffer.transparency[at];
    last_[ray] = std::max(last_[ray], buffer.last[at]);
  }

  // Whether anything behind the ray's segments so far is visible.
  [[nodiscard]] HWY_INLINE bool is_seen(std::size_t ray) const {
    return transparency[ray] > scene_.frame.least_transparency;
  }

  // Whether edges that are yet to be drawn may lie on the ray's cell.
  [[nodiscard]] HWY_INLINE bool meets_edges(std::size_t ray) const {
    return has_edges_[ray] && is_followed(ray) &&
           scene_.edges.may_touch(scene_.mesh.cell_of_mesh(entered_[ray].cell()));
  }

  [[nodiscard]] bool lies_on(const std::array<NodeId, 3>& corners,
                             const TileEdges::Place& place) const {
    const auto node = [&](std::size_t k) { return scene_.mesh.node_of_mesh(corners[k]); };
    return lies_on_face<NodeId>({node(0), node(1), node(2), node(0)},
                                {place.piece->edge, place.along, place.node});
  }

  HWY_NOINLINE void take_edges_in_front(std::size_t ray) {
    const double middle = 0.5 * (front_[ray] + back_[ray]);
    take_edges(ray, front_[ray], true, [&](const TileEdges::Place& place) {
      return lies_on(faces_.entered(ray), place) ||
             (place.t < middle && !lies_on(faces_.left(ray), place));
    });
  }
  HWY_NOINLINE void take_edges_behind(std::size_t ray) {
    take_edges(ray, back_[ray], false,
               [&](const TileEdges::Place& place) { return lies_on(faces_.left(ray), place); });
  }
  template <typename LiesHere>
  void take_edges(std::size_t ray, double t, bool or_nearer, const LiesHere& lies_here) {
    store(ray);
    edges_.take(to_, tile_.index(column_[ray], row_[ray]), t, or_nearer, lies_here);
    load(ray);
  }

  const RayScene& scene_;
  const RayStarts& starts_;
  const TileTarget& to_;
  const TileRect& tile_;
  TileEdges& edges_;
  RayFaces faces_;
  int next_x_, next_y_;         // of the next pixel
  std::size_t followed_ = 0;    // how many rays are
  std::size_t with_edges_ = 0;  // how many of these have edges on their pixels
  // of every ray
  HWY_ALIGN RayNumbers scale_{};               // world length per unit of the ray parameter
  HWY_ALIGN RayNumbers t_{}, field_{};         // where it has entered its cell
  HWY_ALIGN RayNumbers front_{}, back_{};      // of its segment
  HWY_ALIGN RayNumbers last_{};                // the largest ray parameter so far
  HWY_ALIGN RayNumbers is_there_{};            // 1 if it is followed
  HWY_ALIGN RayNumbers is_met_{};              // 1 if a cell that is not empty has been
  std::array<OppositeFace, kRays> entered_{};  // by which it has entered its cell
  std::array<bool, kRays> has_edges_{};
  std::array<int, kRays> column_{}, row_{};
  std::array<std::vector<char>, kRays> passed_;  // of its hits
};

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
