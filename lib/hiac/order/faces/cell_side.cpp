#include "hiac/order/faces/cell_side.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "hiac/geometry/vector.hpp"
#include "hiac/mesh/corner_fan.hpp"
#include "hiac/mesh/shape_functions.hpp"

namespace hiac {
namespace {

// Three corners are nearly in line when their triangle's area is less than this fraction of the
// area of the triangle around the opposite corner.
constexpr double kNearlyInLine = 1.0 / 16;

double doubled_area(Point3 a, Point3 b, Point3 c) {
  const std::array<double, 3> u{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  const std::array<double, 3> v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  return std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                    u[0] * v[1] - u[1] * v[0]);
}

}  // namespace

unsigned plane_start(const ZooMesh& mesh, CellId cell, const ShapeFace& face) {
  if (face.corner_count == 3) return 0;
  const auto& c = face.corners;
  const auto nodes = mesh.cell_nodes(cell);
  const auto lowest = std::ranges::min_element(c, {}, [&](std::uint8_t k) { return nodes[k]; });
  const auto middle = static_cast<std::size_t>(lowest - c.begin());
  // measured from the corner itself, so that both orders of the corners round alike
  const auto area_at = [&](std::size_t k) {
    return doubled_area(mesh.position(nodes[c[k % 4]]), mesh.position(nodes[c[(k + 3) % 4]]),
                        mesh.position(nodes[c[(k + 1) % 4]]));
  };
  const bool in_line = area_at(middle) < kNearlyInLine * area_at(middle + 2);
  return static_cast<unsigned>((in_line ? middle + 1 : middle + 3) % 4);
}

int side_of_all_faces(const ZooMesh& mesh, CellId cell) {
  const CellShape shape = shape_of(mesh.kinds[cell]);
  const auto nodes = mesh.cell_nodes(cell);
  const auto at = [&](std::size_t k) { return mesh.position(nodes[k]); };
  bool positive = false, negative = false;
  for (std::size_t corner = 0; corner < topology_of(shape).corner_count; ++corner) {
    const CornerFan& fan = corner_fan(shape, corner);
    const auto next = [&](std::size_t k) { return at(fan.neighbors[k % fan.count]); };
    for (std::size_t k = 0; k < (fan.count == 3 ? 1 : fan.count); ++k) {
      const int turn = orientation(at(corner), next(k), next(k + 1), next(k + 2));
      positive = positive || turn > 0;
      negative = negative || turn < 0;
    }
  }
  return static_cast<int>(positive) - static_cast<int>(negative);
}

int side_by_jacobian(const ZooMesh& mesh, CellId cell) {
  constexpr double kFarFromZero = 1e-6;
  const CellKind kind = mesh.kinds[cell];
  const auto nodes = mesh.cell_nodes(cell);
  const std::size_t corners = corner_count(kind);
  std::array<double, 3> middle{};
  for (std::size_t k = 0; k < corners; ++k)
    for (std::size_t c = 0; c < 3; ++c)
      middle[c] += reference_nodes(kind)[k][c] / static_cast<double>(corners);
  std::array<std::array<double, 3>, kMaxNodesPerCell> gradients;
  shape_gradients<double>(kind, middle, gradients);
  std::array<Vector, 3> columns{};
  for (std::size_t k = 1; k < nodes.size(); ++k) {
    const Vector from = minus(mesh.position(nodes[k]), mesh.position(nodes[0]));
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t c = 0; c < 3; ++c) columns[a][c] += gradients[k][a] * from[c];
  }
  const double determinant = dot(columns[0], cross(columns[1], columns[2]));
  const double size = length(columns[0]) * length(columns[1]) * length(columns[2]);
  if (!(std::abs(determinant) > kFarFromZero * size)) return 0;
  return determinant > 0 ? -1 : 1;
}

int side_of_cell(const ZooMesh& mesh, CellId cell, const std::array<std::uint8_t, 4>& plane) {
  const auto nodes = mesh.cell_nodes(cell);
  const auto on_plane = [&](std::size_t k) { return mesh.position(nodes[plane[k]]); };
  for (std::size_t k = 0; k < corner_count(mesh.kinds[cell]); ++k) {
    if (std::ranges::find(plane, k) != plane.end()) continue;
    const int side = orientation(on_plane(0), on_plane(1), on_plane(2), mesh.position(nodes[k]));
    if (side != 0) return side;
  }
  return 0;
}

}  // namespace hiac
