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

unsigned plane_start(const ZooMesh& mesh, CellId cell, const ShapeFace& face) {
  if (face.corner_count == 3) return 0;
  const auto& c = face.corners;
  const auto nodes = mesh.cell_nodes(cell);
  const auto lowest = std::ranges::min_element(c, {}, [&](std::uint8_t k) { return nodes[k]; });
  const auto middle = static_cast<std::size_t>(lowest - c.begin());
  // measured from the corner itself, so that rounding is the same in the other order
  const auto area_at = [&](std::size_t k) {
    return doubled_area(mesh.position(nodes[c[k % 4]]), mesh.position(nodes[c[(k + 3) % 4]]),
                        mesh.position(nodes[c[(k + 1) % 4]]));
  };
  const bool in_line = area_at(middle) < kNearlyInLine * area_at(middle + 2);
  return static_cast<unsigned>((in_line ? middle + 1 : middle + 3) % 4);
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
