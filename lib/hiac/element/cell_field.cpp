#include "hiac/element/cell_field.hpp"

#include <algorithm>
#include <span>

namespace hiac {
namespace {

// Relative to the cell's size: larger than the rounding of edge midpoints.
constexpr double kStraight = 1e-14;

// Whether a cell is a tetrahedron with straight edges, whose isoparametric interpolant is the
// polynomial.
bool is_straight_tetrahedron(const ZooMesh& mesh, CellId cell) {
  const CellKind kind = mesh.kinds[cell];
  return shape_of(kind) == CellShape::tetrahedron &&
         edge_deviation(kind, cell_positions(mesh, cell)) <= kStraight;
}

}  // namespace

CellField cell_field(const ZooMesh& mesh, CellId cell, const FieldValues& field, double level) {
  const auto nodes = mesh.cell_nodes(cell);
  CellField result;
  for (std::size_t k = 0; k < nodes.size(); ++k)
    result.values[k] = field.values[field.index(cell, mesh.elems[cell] + k, nodes[k])] - level;
  const auto [low, high] = std::ranges::minmax(std::span(result.values).first(nodes.size()));
  if (field.polynomial && low < high && !is_straight_tetrahedron(mesh, cell)) {
    if (const auto found = WorldPolynomial::through(mesh, cell, result.values))
      result.polynomial = std::make_shared<const WorldPolynomial>(*found);
    result.least = result.polynomial ? result.polynomial->least() : low;
    result.most = result.polynomial ? result.polynomial->most() : low;
    return result;
  }
  const ValueRange range = interpolant_range(mesh.kinds[cell], result.values);
  result.least = range.least;
  result.most = range.most;
  return result;
}

std::array<CellMap::Point, CellMap::kMostNodes> cell_positions(const ZooMesh& mesh, CellId cell) {
  const auto nodes = mesh.cell_nodes(cell);
  std::array<CellMap::Point, CellMap::kMostNodes> positions;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const auto p = mesh.position(nodes[k]);
    positions[k] = {p[0], p[1], p[2]};
  }
  return positions;
}

}  // namespace hiac
