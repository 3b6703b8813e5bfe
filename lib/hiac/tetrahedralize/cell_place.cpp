#include "hiac/tetrahedralize/cell_place.hpp"

#include <algorithm>

#include "hiac/mesh/shape_functions.hpp"

namespace hiac {

std::array<double, 3> reference_center(CellKind kind) {
  std::array<double, 3> center{};
  const auto reference = reference_nodes(kind);
  const std::size_t count = corner_count(kind);
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t a = 0; a < 3; ++a) center[a] += reference[k][a] / static_cast<double>(count);
  return center;
}

CellPlace center_of(const ZooMesh& mesh, CellId cell) {
  return {cell, CellPlace::kNoNode, reference_center(mesh.kinds[cell])};
}

void evaluate(const ZooMesh& mesh, const NodeValues& values, const CellPlace& place,
              std::span<double> tuple) {
  const auto tuple_of = [&](std::size_t node) {
    const std::size_t entry = mesh.elems[place.cell] + node;
    const std::size_t number =
        values.location == FieldLocation::corner ? entry : std::size_t{mesh.nodes[entry]};
    return values.values.subspan(number * values.width, values.width);
  };
  if (place.node != CellPlace::kNoNode) {
    std::ranges::copy(tuple_of(place.node), tuple.begin());
    return;
  }
  const CellKind kind = mesh.kinds[place.cell];
  std::array<double, kMaxNodesPerCell> shape;
  shape_functions<double>(kind, place.xi, shape);
  std::ranges::fill(tuple, 0.0);
  for (std::size_t n = 0; n < node_count(kind); ++n) {
    const auto of_node = tuple_of(n);
    for (std::size_t c = 0; c < values.width; ++c) tuple[c] += shape[n] * of_node[c];
  }
}

std::array<double, 3> position_of(const ZooMesh& mesh, const CellPlace& place) {
  std::array<double, 3> position{};
  evaluate(mesh, {mesh.xyz.view(), 3, FieldLocation::node}, place, position);
  return position;
}

}  // namespace hiac
