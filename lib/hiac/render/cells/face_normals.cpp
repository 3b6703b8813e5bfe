#include "hiac/render/cells/face_normals.hpp"

#include "hiac/frame/tiles/tile.hpp"
#include "hiac/geometry/vector.hpp"
#include "hiac/mesh/shape_functions.hpp"

namespace hiac {

std::array<double, 3> ray_through(const Projector& projector, double x, double y) {
  return ray_through(projector, x, y, projector.ray_scale(x, y));
}

std::array<double, 3> ray_through(const Projector& projector, double x, double y, double scale) {
  if (!projector.perspective()) return {0, 0, 1};
  const auto [right, up] = projector.slopes(x, y);
  return {right / scale, up / scale, 1 / scale};
}

std::array<double, 3> normal_between(const Projector& projector, const ExtendedVector& a,
                                     const ExtendedVector& b) {
  const ExtendedVector normal = cross(a, b);
  if (!(length(normal) > 0)) return {0, 0, 1};
  return rounded(projector.extended_camera_vector(unit(normal)));
}

// Between the images of two directions in the reference cell's face.
std::array<double, 3> normal_at(const Projector& projector, const MappedCell& cell,
                                std::size_t face, const std::array<double, 3>& reference) {
  const ShapeFace& shape = topology_of(cell.kind).faces[face];
  const auto corners = reference_nodes(cell.kind);
  const auto& origin = corners[shape.corners[0]];
  const Vector a = minus(corners[shape.corners[1]], origin),
               b = minus(corners[shape.corners[shape.corner_count - 1U]], origin);
  std::array<Vector, kMaxNodesPerCell> gradients;
  shape_gradients<double>(cell.kind, reference, gradients);
  ExtendedVector along_a{}, along_b{};
  for (std::size_t k = 0; k < node_count(cell.kind); ++k) {
    const double by_a = dot(gradients[k], a), by_b = dot(gradients[k], b);
    for (std::size_t c = 0; c < 3; ++c) {
      const double edge = cell.nodes[k][c] - cell.nodes[0][c];
      along_a[c] += static_cast<long double>(by_a) * edge;
      along_b[c] += static_cast<long double>(by_b) * edge;
    }
  }
  return normal_between(projector, along_a, along_b);
}

// The way is looked at in the middles of equal parts: what lies at its very ends, where a crossing
// or an edge touches the outline of the face, does not count.
bool is_one_side(const Projector& projector, const MappedCell& cell, std::size_t face,
                 const std::array<double, 3>& from, const std::array<double, 3>& to, int x, int y) {
  constexpr int kParts = 8;
  const Vector ray = ray_through(projector, pixel_center(x), pixel_center(y));
  double side = 0;
  for (int k = 0; k < kParts; ++k) {
    const double s = (k + 0.5) / kParts;
    Vector point;
    for (std::size_t c = 0; c < 3; ++c) point[c] = from[c] + s * (to[c] - from[c]);
    const double facing = dot(normal_at(projector, cell, face, point), ray);
    if (facing * side < 0) return false;
    if (facing != 0) side = facing;
  }
  return true;
}

}  // namespace hiac
