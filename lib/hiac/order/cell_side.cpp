#include "hiac/order/cell_side.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace hiac {
namespace {

// Three corners are nearly in line when their triangle is smaller than this part of the one around
// the opposite corner.
constexpr double kNearlyInLine = 1.0 / 16;

double doubled_area(Point3 a, Point3 b, Point3 c) {
  const std::array<double, 3> u{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  const std::array<double, 3> v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  return std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                    u[0] * v[1] - u[1] * v[0]);
}

}  // namespace

std::array<std::uint8_t, 4> plane_corners(const ZooMesh& mesh, CellId cell, const ShapeFace& face) {
  const auto& c = face.corners;
  if (face.corner_count == 3) return {c[0], c[1], c[2], c[2]};
  const auto nodes = mesh.cell_nodes(cell);
  const auto lowest = std::ranges::min_element(c, {}, [&](std::uint8_t k) { return nodes[k]; });
  const auto middle = static_cast<std::size_t>(lowest - c.begin());
  // the corners from the one before `middle` on; measured from `middle`, so that rounding is the
  // same in the other order
  const auto from = [&](std::size_t start) {
    return std::array{c[(start + 3) % 4], c[start % 4], c[(start + 1) % 4], c[(start + 2) % 4]};
  };
  const auto area = [&](const std::array<std::uint8_t, 4>& k) {
    return doubled_area(mesh.position(nodes[k[1]]), mesh.position(nodes[k[0]]),
                        mesh.position(nodes[k[2]]));
  };
  const auto corners = from(middle), opposite = from(middle + 2);
  return area(corners) < kNearlyInLine * area(opposite) ? opposite : corners;
}

int side_of_cell(const ZooMesh& mesh, CellId cell, const ShapeFace& face) {
  const auto nodes = mesh.cell_nodes(cell);
  const auto plane = plane_corners(mesh, cell, face);
  const auto on_plane = [&](std::size_t k) { return mesh.position(nodes[plane[k]]); };
  for (std::size_t k = 0; k < corner_count(mesh.kinds[cell]); ++k) {
    if (std::ranges::find(plane, k) != plane.end()) continue;
    const int side = orientation(on_plane(0), on_plane(1), on_plane(2), mesh.position(nodes[k]));
    if (side != 0) return side;
  }
  return 0;
}

}  // namespace hiac
