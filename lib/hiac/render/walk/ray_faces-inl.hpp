// The faces by which rays enter and leave tetrahedra, compiled once for every instruction set.
// Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_RAY_FACES_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_RAY_FACES_INL
#    undef HIAC_RENDER_RAY_FACES_INL
#  else
#    define HIAC_RENDER_RAY_FACES_INL
#  endif

#  include <algorithm>
#  include <array>
#  include <cmath>
#  include <cstddef>
#  include <cstdint>
#  include <utility>

#  include <hwy/cache_control.h>
#  include <hwy/highway.h>

#  include "hiac/render/walk/ray_scene.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// So many rays that one waits for memory while others go on, and so few that what is kept of them
// fits the first cache.
inline constexpr std::size_t kRays = 64;

// A number of every ray.
using RayNumbers = std::array<double, kRays>;

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
  const auto mean = [](V w0, V w1, V w2, const V(&value)[3]) HWY_ATTR {
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

// Where rays are, each in one cell: in front of the face by which it has entered, whose corners
// turn counter-clockwise around it (is_left). A corner's weight is (q - p) x (r - p), q and r being
// the two other corners.
class RayFaces {
 public:
  using D = hn::CappedTag<double, 8>;
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;

  explicit RayFaces(const RayScene& scene)
      : scene_(scene), perspective_(scene.frame.projector.perspective()) {}

  // The centre of the ray's pixel.
  void set_pixel(std::size_t ray, double x, double y) {
    x_[ray] = x;
    y_[ray] = y;
  }

  // Enters a cell by a face of the boundary.
  HWY_NOINLINE FacePoint<double> enter(std::size_t ray, std::array<NodeId, 3> nodes) {
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
    return {hn::GetLane(at.t), hn::GetLane(at.field)};
  }

  // Takes the node of the ray's cell that it has not met yet.
  HWY_INLINE void find_apex(std::size_t ray, const WalkableMesh::Cell& cell, OppositeFace entered) {
    const NodeId apex = cell.nodes[entered.opposite()];
    apex_.node[ray] = apex;
    hwy::Prefetch(&scene_.nodes[apex]);
  }

  HWY_INLINE void place_apex(std::size_t ray) { put(apex_.node[ray], ray, apex_); }

  // Finds the faces by which rays leave their cells, and the points there. Seen from the ray, the
  // apex lies opposite the side of the entered triangle over which it leaves: the corner that this
  // side lacks is replaced by the apex. Rays that are not followed are in no cell.
  HWY_INLINE FacePoint<V> leave(std::size_t ray, M followed) {
    const D d;
    V side[3];
    find_sides(ray, followed, side);
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
      const auto replace = [&](const RayNumbers& of_apex, RayNumbers& of_corner) HWY_ATTR {
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
    return face_point(d, weight, depth, field, perspective_);
  }

  // Makes the face by which the ray leaves the one by which it enters the next cell. Returns the
  // number of the node opposite it in the cell that it leaves.
  HWY_INLINE std::size_t settle(std::size_t ray, const WalkableMesh::Cell& cell) {
    NodeId& replaced = corner_[replaced_of(ray)].node[ray];
    const std::size_t opposite = WalkableMesh::number_of(replaced, cell.nodes);
    replaced = apex_.node[ray];
    return opposite;
  }

  // The corners of the face by which the ray has entered its cell and, once that is found, of the
  // one by which it leaves.
  [[nodiscard]] std::array<NodeId, 3> entered(std::size_t ray) const {
    return {corner_[0].node[ray], corner_[1].node[ray], corner_[2].node[ray]};
  }
  [[nodiscard]] std::array<NodeId, 3> left(std::size_t ray) const {
    std::array<NodeId, 3> corners = entered(ray);
    corners[replaced_of(ray)] = apex_.node[ray];
    return corners;
  }

 private:
  // The least weight: of corners on whose edge the ray lies.
  static constexpr double kLeastWeight = 1e-200;

  struct Corner {
    HWY_ALIGN RayNumbers x{}, y{}, depth{}, field{};  // places less the pixel's centre
    std::array<NodeId, kRays> node{};
  };

  [[nodiscard]] HWY_INLINE std::size_t replaced_of(std::size_t ray) const {
    return static_cast<std::size_t>(static_cast<std::int64_t>(replaced_[ray]));
  }

  HWY_INLINE void put(NodeId node, std::size_t ray, Corner& corner) const {
    const RayNode& at = scene_.nodes[node];
    corner.x[ray] = at.x - x_[ray];
    corner.y[ray] = at.y - y_[ray];
    corner.depth[ray] = at.depth;
    corner.field[ray] = at.field;
    corner.node[ray] = node;
  }

  // (corner - p) x (apex - p), with exact signs.
  HWY_INLINE void find_sides(std::size_t ray, M followed, V (&side)[3]) {
    const D d;
    const V x = hn::Load(d, apex_.x.data() + ray), y = hn::Load(d, apex_.y.data() + ray);
    const V error = hn::Set(d, kSideError), least = hn::Set(d, kLeastSide);
    M doubt[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const V one = hn::Mul(hn::Load(d, corner_[k].x.data() + ray), y);
      const V two = hn::Mul(hn::Load(d, corner_[k].y.data() + ray), x);
      side[k] = hn::Sub(one, two);
      const V size = hn::Add(hn::Abs(one), hn::Abs(two));
      doubt[k] = hn::And(followed, hn::Le(hn::Abs(side[k]), hn::MulAdd(error, size, least)));
    }
    if (HWY_LIKELY(hn::AllFalse(d, hn::Or(hn::Or(doubt[0], doubt[1]), doubt[2])))) return;
    for (std::size_t k = 0; k < 3; ++k) {
      HWY_ALIGN double sides[8], in_doubt[8];
      hn::Store(side[k], d, sides);
      hn::Store(hn::IfThenElseZero(doubt[k], hn::Set(d, 1.0)), d, in_doubt);
      for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane)
        if (in_doubt[lane] != 0) sides[lane] = side_in_doubt(k, ray + lane, sides[lane]);
      side[k] = hn::Load(d, sides);
    }
  }

  HWY_NOINLINE double side_in_doubt(std::size_t k, std::size_t ray, double side) const {
    const NodeId corner = corner_[k].node[ray], apex = apex_.node[ray];
    const bool left =
        is_left(scene_.nodes[corner], corner, scene_.nodes[apex], apex, x_[ray], y_[ray]);
    const double size = std::max(std::abs(side), kLeastWeight);
    return left ? size : -size;
  }

  const RayScene& scene_;
  bool perspective_;
  HWY_ALIGN RayNumbers x_{}, y_{};
  std::array<Corner, 3> corner_;  // of the face by which a ray has entered
  HWY_ALIGN std::array<RayNumbers, 3> weight_{};
  Corner apex_;                      // the cell's fourth node
  HWY_ALIGN RayNumbers replaced_{};  // the corner that it has replaced
};

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
