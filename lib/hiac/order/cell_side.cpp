#include "hiac/order/cell_side.hpp"

#include <algorithm>

namespace hiac {

int side_of_cell(const ZooMesh& mesh, CellId cell, const ShapeFace& face) {
  const auto nodes = mesh.cell_nodes(cell);
  const auto corner = [&](std::size_t k) { return mesh.position(nodes[face.corners[k]]); };
  for (std::size_t k = 0; k < corner_count(mesh.kinds[cell]); ++k) {
    const auto on_face = face.corners.begin() + face.corner_count;
    if (std::find(face.corners.begin(), on_face, k) != on_face) continue;
    const int side = orientation(corner(0), corner(1), corner(2), mesh.position(nodes[k]));
    if (side != 0) return side;
  }
  return 0;
}

}  // namespace hiac
