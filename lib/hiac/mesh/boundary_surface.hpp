#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// The boundary of a mesh as triangles: the faces of cells that no other cell has.
struct BoundarySurface {
  std::vector<double> xyz;  ///< x y z of every point, world units
  /// Indices of points, counter-clockwise as seen from outside the cell, whichever way that is
  /// oriented.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /// FieldLocation::node: one tuple for every point; FieldLocation::cell: one for every triangle.
  std::vector<Field> fields;
  /// Names of the fields on cell corners: their values at points are means over the faces there.
  std::vector<std::string> averaged;
};

inline constexpr unsigned kMostBoundaryLevels = 6;

/// How often the edges of a mesh's faces are halved unless stated otherwise: not if all cells are
/// linear, and twice if faces may be curved.
unsigned default_boundary_levels(const ZooMesh& mesh);

/// Returns the boundary of a mesh. The edges of every face are halved `levels` times, so that it
/// becomes 4^levels triangles, or 2 * 4^levels if it is a quadrilateral; these are cut by the
/// diagonal from their corner of least node number.
///
/// New points are images under the cells' isoparametric maps of evenly spaced points of the
/// reference faces. Cells that share an edge share its points: the surface is closed. Node fields
/// are interpolated by the shape functions, cell fields belong to the triangles of the cell.
///
/// Requires a mesh that satisfies validate() and levels <= kMostBoundaryLevels. Throws InputError
/// if there are more than 2^32 - 1 points.
BoundarySurface boundary_surface(const ZooMesh& mesh, unsigned levels);

}  // namespace hiac
