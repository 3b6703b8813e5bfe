#pragma once

#include <optional>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/tetrahedralize/surface.hpp"

namespace hiac {

struct SurfaceMeshing {
  /// Bounds a tetrahedron's circumradius divided by its shortest edge, at least 1; none: no points
  /// are added to improve shapes.
  std::optional<double> quality;
  std::optional<double> max_volume;  ///< of every tetrahedron, world units cubed
  /// Adds no points on the surface.
  bool preserve_surface = false;
};

/// Fills the space that a surface encloses with tetrahedra, by TetGen (H. Si, "TetGen, a
/// Delaunay-Based Quality Tetrahedral Mesh Generator", 2015; AGPL, see LICENSES-OF-BINARIES.md).
/// They are positively oriented. All space that the surface encloses is filled, whichever way it is
/// oriented, but for the parts that have one of its holes. The cell field "region" has the number
/// of each tetrahedron's part (number_parts) or, if the surface has regions, TetGen's: the
/// attributes of the regions, and further numbers for parts without one. Throws JudgementError if
/// TetGen finds that the surface intersects itself or encloses nothing, or if TetGen crashes; it
/// runs in a child process, which discards its output and contains its crashes. Throws InputError
/// if there are more points or facets than it can count.
ZooMesh mesh_surface(const Surface& surface, const SurfaceMeshing& how);

}  // namespace hiac
