#include "hiac/cluster/part_boundary.hpp"

#include "hiac/frame/surfaces/boundary_faces.hpp"

namespace hiac {

std::vector<bool> nodes_on_boundary(const ZooMesh& part) {
  const std::vector<std::uint8_t> boundary = boundary_faces(part);
  std::vector<bool> on_boundary(part.node_count(), false);
  for (CellId cell = 0; cell < part.cell_count(); ++cell)
    if (boundary[cell] != 0)
      for (const NodeId node : part.cell_nodes(cell)) on_boundary[node] = true;
  return on_boundary;
}

}  // namespace hiac
