#pragma once

#include <cstdint>
#include <span>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// A mesh in which some cells were cut into tetrahedra.
struct CutMesh {
  ZooMesh mesh;
  std::uint64_t tetrahedra = 0;  ///< that replace the cut cells
  std::uint64_t vanished = 0;    ///< cut cells that no tetrahedron replaces
  /// The sum over the cut cells of how much the volume of their tetrahedra differs from the cell's
  /// (signed_volume; the magnitudes of both).
  double volume_change = 0;
  double volume = 0;  ///< the sum of the magnitudes of the signed volumes of all given cells
};

/// Replaces the given cells (ascending) by linear tetrahedra of positive volume between their
/// corners, and if necessary their centre. Tetrahedra that are flat, or turned the other way than
/// the cell as a whole, are left out: a cell that is turned inside out in part loses that part. Of
/// the cuts under which neighbours agree about their faces (possible_cuts), each cell gets the one
/// that leaves out the least volume. Nodes between the corners of cut cells of higher order are not
/// used.
///
/// Node and corner fields are interpolated at the centre by the cell's shape functions; cell fields
/// are copied. Other cells stay as they are, in their order. Metadata is kept, adjacency is not.
/// Requires a mesh that satisfies validate().
CutMesh cut_cells(const ZooMesh& mesh, std::span<const CellId> cells);

}  // namespace hiac
