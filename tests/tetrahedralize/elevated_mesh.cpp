#include "tests/tetrahedralize/elevated_mesh.hpp"

#include <algorithm>
#include <map>
#include <vector>

#include "hiac/mesh/shape_functions.hpp"
#include "tests/support/meshes.hpp"

namespace hiac::test {

ZooMesh elevated(const ZooMesh& linear, CellOrder order) {
  std::vector<Position> positions = positions_of(linear);
  std::vector<Cell> cells = cells_of(linear);
  // a node by the corners that it lies between: each as often as its weight says
  std::map<std::vector<NodeId>, NodeId> known;
  const auto n = static_cast<std::size_t>(order);
  for (Cell& cell : cells) {
    const std::vector<NodeId> corners = cell.nodes;
    cell.kind = kind_of(shape_of(cell.kind), order);
    const auto node_between = [&](std::vector<NodeId> key) {
      std::ranges::sort(key);
      const auto [at, is_new] = known.try_emplace(key, static_cast<NodeId>(positions.size()));
      if (is_new) {
        Position p{};
        for (const NodeId node : key)
          for (std::size_t c = 0; c < 3; ++c)
            p[c] += positions[node][c] / static_cast<double>(key.size());
        positions.push_back(p);
      }
      cell.nodes.push_back(at->second);
    };
    for (const auto& [a, b] : topology_of(cell.kind).edges)
      for (std::size_t k = 1; k < n; ++k) {
        std::vector<NodeId> key(n - k, corners[a]);
        key.insert(key.end(), k, corners[b]);
        node_between(key);
      }
    if (cell.kind == CellKind::tetrahedron20)
      for (const ShapeFace& face : topology_of(cell.kind).faces)
        node_between(
            {corners[face.corners[0]], corners[face.corners[1]], corners[face.corners[2]]});
  }
  return make_mesh(positions, cells);
}

}  // namespace hiac::test
