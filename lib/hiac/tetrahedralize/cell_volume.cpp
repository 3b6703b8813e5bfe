#include "hiac/tetrahedralize/cell_volume.hpp"

#include <array>
#include <span>

#include "hiac/mesh/shape_functions.hpp"
#include "hiac/optics/gauss_legendre.hpp"

namespace hiac {
namespace {

using Point = std::array<double, 3>;

// The place in the reference cell of a point of the unit cube, and the map's Jacobian there.
struct Place {
  Point xi;
  double jacobian;
};

Place collapsed(CellShape shape, const Point& u) {
  const auto [x, y, z] = u;
  switch (shape) {
    case CellShape::tetrahedron:
      return {{x * (1 - y) * (1 - z), y * (1 - z), z}, (1 - y) * (1 - z) * (1 - z)};
    case CellShape::pyramid:
      return {{x * (1 - z), y * (1 - z), z}, (1 - z) * (1 - z)};
    case CellShape::prism:
      return {{x * (1 - y), y, z}, 1 - y};
    case CellShape::wedge:
      return {{x * (2 - y - z), y, z}, 2 - y - z};
    case CellShape::brick:
      break;
  }
  return {u, 1};
}

// Exact for the determinant's degree along each axis of the cube, that of the collapse included.
std::size_t points_along(CellKind kind) {
  if (kind == CellKind::brick8) return 2;
  constexpr std::array<std::size_t, 3> kPoints{3, 5, 6};
  return kPoints[static_cast<std::size_t>(order_of(kind)) - 1];
}

double determinant(const ZooMesh& mesh, CellId cell, const Point& xi) {
  std::array<Point, kMaxNodesPerCell> gradients;
  shape_gradients<double>(mesh.kinds[cell], xi, gradients);
  std::array<Point, 3> j{};
  const auto nodes = mesh.cell_nodes(cell);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c) j[r][c] += mesh.position(nodes[i])[r] * gradients[i][c];
  return j[0][0] * (j[1][1] * j[2][2] - j[1][2] * j[2][1]) -
         j[0][1] * (j[1][0] * j[2][2] - j[1][2] * j[2][0]) +
         j[0][2] * (j[1][0] * j[2][1] - j[1][1] * j[2][0]);
}

}  // namespace

double signed_volume(const ZooMesh& mesh, CellId cell) {
  const CellKind kind = mesh.kinds[cell];
  const GaussRule rule = gauss_legendre(points_along(kind));
  double volume = 0;
  for (std::size_t a = 0; a < rule.nodes.size(); ++a)
    for (std::size_t b = 0; b < rule.nodes.size(); ++b)
      for (std::size_t c = 0; c < rule.nodes.size(); ++c) {
        const Place place =
            collapsed(shape_of(kind),
                      {(1 + rule.nodes[a]) / 2, (1 + rule.nodes[b]) / 2, (1 + rule.nodes[c]) / 2});
        const double weight = rule.weights[a] * rule.weights[b] * rule.weights[c] / 8;
        volume += weight * place.jacobian * determinant(mesh, cell, place.xi);
      }
  return volume;
}

}  // namespace hiac
