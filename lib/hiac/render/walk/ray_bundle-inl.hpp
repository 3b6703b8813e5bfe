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
#  include <cmath>
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
#  include "hiac/render/walk/ray_scene.hpp"
#  include "hiac/render/walk/ray_starts.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// So many rays that one waits for memory while others go on, and that those in one interval of the
// transfer functions fill vectors.
inline constexpr std::size_t kRays = 128;

// Where a ray passes a face: the ray parameter, and the field.
template <class V>
struct FacePoint {
  V t, field;
};

// The point of a face where its corners have these weights, none of which is negative; not outside
// the corners' values. In perspective fields are not affine on the screen, but fields times 1/t
// are.
template <class D, class V = hn::Vec<D>>
HWY_INLINE FacePoint<V> face_point(D d, const V (&weight)[3], const V (&depth)[3],
                                   const V (&field)[3], bool perspective) {
  const auto mean = [d](V w0, V w1, V w2, const V(&value)[3]) HWY_ATTR {
    const V rise =
        hn::MulAdd(w0, hn::Sub(value[0], value[2]), hn::Mul(w1, hn::Sub(value[1], value[2])));
    const V at = hn::Add(value[2], hn::Div(rise, hn::Add(hn::Add(w0, w1), w2)));
    return hn::Min(hn::Max(at, hn::Min(hn::Min(value[0], value[1]), value[2])),
                   hn::Max(hn::Max(value[0], value[1]), value[2]));
  };
  const V at = mean(weight[0], weight[1], weight[2], depth);
  if (!perspective) return {at, mean(weight[0], weight[1], weight[2], field)};
  return {hn::Div(hn::Set(d, -1.0), at),
          mean(hn::Mul(weight[0], hn::Neg(depth[0])), hn::Mul(weight[1], hn::Neg(depth[1])),
               hn::Mul(weight[2], hn::Neg(depth[2])), field)};
}

// The rays of a tile's pixels, some of them at a time, each of them in one cell. A ray is in front
// of the face by which it has entered the cell, whose corners turn counter-clockwise around it
// (is_left); a corner's weight is (q - p) x (r - p), q and r being the two other corners.
class RayBundle {
 public:
  RayBundle(const RayScene& scene, const RayStarts& starts, const TileTarget& to, TileEdges& edges)
      : scene_(scene),
        starts_(starts),
        to_(to),
        tile_(to.tile),
        edges_(edges),
        perspective_(scene.frame.projector.perspective()),
        next_x_(tile_.x0),
        next_y_(tile_.y0) {
    for (std::size_t ray = 0; ray < kRays; ++ray) start(ray);
  }

  // Makes the segments of all rays in their cells; false if no ray is left.
  HWY_INLINE bool advance() {
    if (followed_ == 0) return false;
    for (std::size_t ray = 0; ray < kRays; ++ray)
      if (is_followed(ray)) find_apex(ray);
    for (std::size_t ray = 0; ray < kRays; ++ray)
      if (is_followed(ray)) put(apex_.node[ray], ray, apex_);
    for (std::size_t ray = 0; ray < kRays; ray += hn::Lanes(D())) cross(ray);
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

  [[nodiscard]] HWY_INLINE bool is_followed(std::size_t ray) const { return cell_[ray] != kNoCell; }

  // Counts a ray's segment, unless it is hidden or belongs to a cell of empty space.
  HWY_INLINE void count(std::size_t ray, bool empty_segment) {
    if (HWY_UNLIKELY(!is_seen(ray) || (empty_segment && is_empty_cell(ray)))) return;
    is_met_[ray] = true;
    ++to_.counts.segments;
  }

  // of every ray's segment
  HWY_ALIGN std::array<double, kRays> length{}, front_field{}, back_field{};
  // of every ray so far
  HWY_ALIGN std::array<double, kRays> red{}, green{}, blue{}, transparency{};

 private:
  using D = hn::CappedTag<double, 8>;
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;
  using Numbers = std::array<double, kRays>;
  // The least weight: of corners on whose edge the ray lies.
  static constexpr double kLeastWeight = 1e-200;

  struct Corner {
    HWY_ALIGN Numbers x{}, y{}, depth{}, field{};  // places less the pixel's centre
    std::array<NodeId, kRays> node{};
  };

  HWY_INLINE void put(NodeId node, std::size_t ray, Corner& corner) const {
    const RayNode& at = scene_.nodes[node];
    corner.x[ray] = at.x - x_[ray];
    corner.y[ray] = at.y - y_[ray];
    corner.depth[ray] = at.depth;
    corner.field[ray] = at.field;
    corner.node[ray] = node;
  }

  // The node of the cell that the ray has not met yet, by exclusive or.
  HWY_INLINE void find_apex(std::size_t ray) {
    const auto& [a, b, c, d] = scene_.mesh[cell_[ray]].nodes;
    const NodeId apex =
        a ^ b ^ c ^ d ^ corner_[0].node[ray] ^ corner_[1].node[ray] ^ corner_[2].node[ray];
    apex_.node[ray] = apex;
    hwy::Prefetch(&scene_.nodes[apex]);
  }

  // Finds the faces by which rays leave. Seen from the ray, the apex lies opposite the side of the
  // entered triangle over which it leaves: the corner that this side lacks is replaced by the apex.
  HWY_INLINE void cross(std::size_t ray) {
    const D d;
    V side[3];
    find_sides(ray, side);
    const V zero = hn::Zero(d);
    const M left[3] = {hn::Gt(side[0], zero), hn::Gt(side[1], zero), hn::Gt(side[2], zero)};
    M lacks[3];
    for (std::size_t k = 0; k < 3; ++k) lacks[k] = hn::AndNot(left[(k + 1) % 3], left[(k + 2) % 3]);
    hn::Store(
        hn::IfThenElse(lacks[1], hn::Set(d, 1.0), hn::IfThenElseZero(lacks[2], hn::Set(d, 2.0))), d,
        replaced_.data() + ray);
    V weight[3], depth[3], field[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3, last = (k + 2) % 3;
      const M here = lacks[k];
      const auto replace = [&](const Numbers& of_apex, Numbers& of_corner) HWY_ATTR {
        const V value = hn::IfThenElse(here, hn::Load(d, of_apex.data() + ray),
                                       hn::Load(d, of_corner.data() + ray));
        hn::Store(value, d, of_corner.data() + ray);
        return value;
      };
      replace(apex_.x, corner_[k].x);
      replace(apex_.y, corner_[k].y);
      depth[k] = replace(apex_.depth, corner_[k].depth);
      field[k] = replace(apex_.field, corner_[k].field);
      double* const place = weight_[k].data() + ray;
      weight[k] = hn::IfThenElse(here, hn::Load(d, place),
                                 hn::IfThenElse(lacks[last], side[next], hn::Neg(side[last])));
      hn::Store(weight[k], d, place);
    }
    add_segment(ray, face_point(d, weight, depth, field, perspective_));
  }

  // (corner - p) x (apex - p), with exact signs.
  HWY_INLINE void find_sides(std::size_t ray, V (&side)[3]) {
    const D d;
    const V x = hn::Load(d, apex_.x.data() + ray), y = hn::Load(d, apex_.y.data() + ray);
    const V error = hn::Set(d, kSideError), least = hn::Set(d, kLeastSide);
    M doubt[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const V one = hn::Mul(hn::Load(d, corner_[k].x.data() + ray), y);
      const V two = hn::Mul(hn::Load(d, corner_[k].y.data() + ray), x);
      side[k] = hn::Sub(one, two);
      doubt[k] =
          hn::Le(hn::Abs(side[k]), hn::MulAdd(error, hn::Add(hn::Abs(one), hn::Abs(two)), least));
    }
    if (HWY_LIKELY(hn::AllFalse(d, hn::Or(hn::Or(doubt[0], doubt[1]), doubt[2])))) return;
    for (std::size_t k = 0; k < 3; ++k) {
      HWY_ALIGN double sides[8], in_doubt[8];
      hn::Store(side[k], d, sides);
      hn::Store(hn::IfThenElseZero(doubt[k], hn::Set(d, 1.0)), d, in_doubt);
      for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane)
        if (in_doubt[lane] != 0 && is_followed(ray + lane))
          sides[lane] = side_in_doubt(k, ray + lane, sides[lane]);
      side[k] = hn::Load(d, sides);
    }
  }

  // Whether the ray's cell lies in empty space.
  HWY_NOINLINE bool is_empty_cell(std::size_t ray) const {
    const std::array<NodeId, 4>& nodes = scene_.mesh[cell_[ray]].nodes;
    IntervalRange range{~std::size_t{0}, 0};
    for (std::size_t k = 0; k < 4; ++k) {
      const ScalarIntervals at = scene_.frame.extinction.intervals[nodes[k]];
      range.low = std::min<std::size_t>(range.low, at.low);
      range.high = std::max<std::size_t>(range.high, at.high);
    }
    return is_empty_space(scene_.frame.optics, range, range);
  }

  HWY_NOINLINE double side_in_doubt(std::size_t k, std::size_t ray, double side) const {
    const NodeId corner = corner_[k].node[ray], apex = apex_.node[ray];
    const bool left =
        is_left(scene_.nodes[corner], corner, scene_.nodes[apex], apex, x_[ray], y_[ray]);
    const double size = std::max(std::abs(side), kLeastWeight);
    return left ? size : -size;
  }

  // The segments from where rays have entered to where they leave. Depths may go back in a mesh
  // that is folded, or by rounding.
  HWY_INLINE void add_segment(std::size_t ray, const FacePoint<V>& leave) {
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
    const M followed = hn::Ne(hn::Load(d, is_there_.data() + ray), hn::Zero(d));
    const V last = hn::Load(d, last_.data() + ray);
    to_.counts.violations +=
        count_out_of_order(d, front, back, last, followed, scene_.frame.witness_tolerance);
    hn::Store(hn::Max(last, back), d, last_.data() + ray);
  }

  HWY_INLINE void settle(std::size_t ray) {
    if (HWY_UNLIKELY(meets_edges(ray))) take_edges_behind(ray);
    Corner& changed = corner_[static_cast<std::size_t>(replaced_[ray])];
    const CellId cell = cell_[ray];
    const WalkableMesh::Cell& left = scene_.mesh[cell];
    const NodeId behind = changed.node[ray];  // opposite the face by which the ray leaves
    const unsigned opposite = (left.nodes[1] == behind ? 1U : 0U) +
                              (left.nodes[2] == behind ? 2U : 0U) +
                              (left.nodes[3] == behind ? 3U : 0U);
    changed.node[ray] = apex_.node[ray];
    cell_[ray] = left.across[opposite];
    if (HWY_UNLIKELY(!is_seen(ray))) return end(ray);
    if (HWY_LIKELY(is_followed(ray))) return hwy::Prefetch(&scene_.mesh[cell_[ray]]);
    leave_mesh(ray, {cell, static_cast<std::uint8_t>(opposite)});
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
    std::array<NodeId, 3> nodes = corners;
    if (!is_left(scene_.nodes[nodes[0]], nodes[0], scene_.nodes[nodes[1]], nodes[1], x_[ray],
                 y_[ray]))
      std::swap(nodes[0], nodes[1]);
    for (std::size_t k = 0; k < 3; ++k) put(nodes[k], ray, corner_[k]);
    using One = hn::CappedTag<double, 1>;
    hn::Vec<One> weight[3], depth[3], field[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const Corner &q = corner_[(k + 1) % 3], &r = corner_[(k + 2) % 3];
      weight_[k][ray] = std::max(std::abs(q.x[ray] * r.y[ray] - q.y[ray] * r.x[ray]), kLeastWeight);
      weight[k] = hn::Set(One(), weight_[k][ray]);
      depth[k] = hn::Set(One(), corner_[k].depth[ray]);
      field[k] = hn::Set(One(), corner_[k].field[ray]);
    }
    const auto at = face_point(One(), weight, depth, field, perspective_);
    t_[ray] = hn::GetLane(at.t);
    field_[ray] = hn::GetLane(at.field);
    cell_[ray] = face.cell;
    return true;
  }

  // Takes the tile's next pixel whose ray meets the mesh, if there is one.
  HWY_NOINLINE void start(std::size_t ray) {
    cell_[ray] = kNoCell;
    is_there_[ray] = 0;
    for (; next_y_ < tile_.y1; ++next_y_, next_x_ = tile_.x0)
      while (next_x_ < tile_.x1) {
        const int x = next_x_++;
        const auto hits = starts_.of(x, next_y_);
        if (hits.empty()) continue;
        column_[ray] = x;
        row_[ray] = next_y_;
        x_[ray] = pixel_center(x);
        y_[ray] = pixel_center(next_y_);
        scale_[ray] = to_.buffer.ray_scale[tile_.index(x, next_y_)];
        has_edges_[ray] = edges_.left().holds(x - tile_.x0, next_y_ - tile_.y0);
        with_edges_ += has_edges_[ray] ? 1 : 0;
        red[ray] = green[ray] = blue[ray] = 0;
        transparency[ray] = 1;
        last_[ray] = -std::numeric_limits<double>::infinity();
        is_met_[ray] = false;
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
    if (is_met_[ray]) buffer.last[at] = last_[ray];
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
    return has_edges_[ray] && is_followed(ray) && scene_.edges.may_touch(cell_[ray]);
  }

  // Whether a place on an edge lies on the face by which the ray has entered its cell, or on the
  // one by which it leaves.
  [[nodiscard]] bool lies_on_entered(std::size_t ray, const TileEdges::Place& place) const {
    return lies_on(
        {corner_[0].node[ray], corner_[1].node[ray], corner_[2].node[ray], corner_[0].node[ray]},
        place);
  }
  [[nodiscard]] bool lies_on_left(std::size_t ray, const TileEdges::Place& place) const {
    std::array<NodeId, 4> corners{corner_[0].node[ray], corner_[1].node[ray], corner_[2].node[ray],
                                  0};
    corners[static_cast<std::size_t>(replaced_[ray])] = apex_.node[ray];
    corners[3] = corners[0];
    return lies_on(corners, place);
  }
  static bool lies_on(const std::array<NodeId, 4>& corners, const TileEdges::Place& place) {
    return lies_on_face<NodeId>(corners, {place.piece->edge, place.along, place.node});
  }

  HWY_NOINLINE void take_edges_in_front(std::size_t ray) {
    const double middle = 0.5 * (front_[ray] + back_[ray]);
    take_edges(ray, front_[ray], true, [&](const TileEdges::Place& place) {
      return lies_on_entered(ray, place) || (place.t < middle && !lies_on_left(ray, place));
    });
  }
  HWY_NOINLINE void take_edges_behind(std::size_t ray) {
    take_edges(ray, back_[ray], false,
               [&](const TileEdges::Place& place) { return lies_on_left(ray, place); });
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
  bool perspective_;
  int next_x_, next_y_;         // of the next pixel
  std::size_t followed_ = 0;    // how many rays are
  std::size_t with_edges_ = 0;  // how many of these have edges on their pixels
  // of every ray
  HWY_ALIGN Numbers x_{}, y_{};         // the pixel's centre
  HWY_ALIGN Numbers scale_{};           // world length per unit of the ray parameter
  HWY_ALIGN Numbers t_{}, field_{};     // where it has entered its cell
  HWY_ALIGN Numbers front_{}, back_{};  // of its segment
  HWY_ALIGN Numbers last_{};            // the largest ray parameter so far
  HWY_ALIGN Numbers is_there_{};        // 1 of rays that are followed
  HWY_ALIGN Numbers replaced_{};        // the corner that the cell's apex has replaced
  std::array<Corner, 3> corner_;        // of the face by which it has entered
  HWY_ALIGN std::array<Numbers, 3> weight_{};
  Corner apex_;
  std::array<CellId, kRays> cell_{};
  std::array<bool, kRays> has_edges_{};
  std::array<bool, kRays> is_met_{};  // a cell that is not empty has been
  std::array<int, kRays> column_{}, row_{};
  std::array<std::vector<char>, kRays> passed_;  // of its hits
};

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
