#pragma once

#include <optional>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/tetrahedralize/surface.hpp"

namespace hiac {

struct SurfaceMeshing {
  /// Bound of a tetrahedron's circumradius over its shortest edge, at least 1; none: no points are
  /// added for shape's sake.
  std::optional<double> quality;
  std::optional<double> max_volume;  ///< of every tetrahedron, world units cubed
  /// Adds no points on the surface.
  bool preserve_surface = false;
};

/// Tetrahedra that fill what a surface encloses, by TetGen (H. Si, "TetGen, a Delaunay-Based
/// Quality Tetrahedral Mesh Generator", 2015; AGPL, see LICENSES-OF-BINARIES.md). Positively
/// oriented; with a cell field "region" where the surface has regions. Throws JudgementError when
/// TetGen finds that the surface intersects itself or encloses nothing, or breaks down over it; it
/// runs in a child process, which takes what it prints and its crashes with it. InputError when
/// there are more points or facets than it can count.
ZooMesh mesh_surface(const Surface& surface, const SurfaceMeshing& how);

}  // namespace hiac
