#pragma once

#include "hiac/mesh/cell_kind.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac::formats {

/// The volume inside a cell's faces, each in triangles from its first corner.
inline double volume_of(const ZooMesh& mesh, CellId cell) {
  double six = 0;
  for (const ShapeFace& face : topology_of(mesh.kinds[cell]).faces)
    for (std::size_t i = 1; i + 1 < face.corner_count; ++i) {
      const auto a = mesh.position(mesh.cell_nodes(cell)[face.corners[0]]);
      const auto b = mesh.position(mesh.cell_nodes(cell)[face.corners[i]]);
      const auto c = mesh.position(mesh.cell_nodes(cell)[face.corners[i + 1]]);
      six += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
             a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
  return six / 6;
}

/// Of all cells.
inline double volume_of(const ZooMesh& mesh) {
  double sum = 0;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) sum += volume_of(mesh, cell);
  return sum;
}

}  // namespace hiac::formats
