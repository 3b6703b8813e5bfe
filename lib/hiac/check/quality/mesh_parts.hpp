#pragma once

#include <cstdint>
#include <optional>

#include "hiac/check/cells.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// What a mesh consists of, told by its shared faces.
struct MeshParts {
  std::uint64_t components = 0;  ///< sets of cells that are joined by shared faces
  std::uint64_t boundary_faces = 0;
  /// Closed surfaces (shells, surface loops) of the boundary. Where more than two boundary faces
  /// meet at an edge, two of them belong together if no cell is between them. Shells may touch at
  /// nodes.
  std::uint64_t shells = 0;
  /// Shells that enclose emptiness: those whose enclosed volume is negative, by exact arithmetic.
  std::uint64_t cavities = 0;
  /// Holes through the mesh (the sum of the shells' genera): 1 for a ring. None if some edges are
  /// `tangled`.
  std::optional<std::int64_t> tunnels;
  std::uint64_t branching_edges = 0;  ///< with more than two boundary faces
  /// Edges whose boundary faces do not alternate between the beginning and the end of cells around
  /// it, as where cells overlap or three share a face: all faces there are joined.
  std::uint64_t tangled_edges = 0;
};

/// Counts the parts of a mesh whose cells are not folded onto one another. Faces that lie on one
/// another without being shared (interfaces) count as boundary. Polygons of the corners stand for
/// curved faces; exact determinants decide.
///
/// Take the edges at which parts of the mesh touch as a little thicker, and its bodies apart where
/// they touch at nodes alone. Then the shells are closed surfaces without common points, and each
/// bounded region of emptiness is inside exactly one of those that bound it, with the mesh outside:
/// that one's volume, by normals out of the mesh, is negative, and so is no other's. The genera
/// follow from Euler's formula (faces - edges + corners = 2 - 2 genus).
///
/// Linear in the number of cells, parallel; n log n in that of boundary faces. Throws Cancelled.
MeshParts mesh_parts(const ZooMesh& mesh, const FaceAdjacency& adjacency, const CellShapes& shapes);

}  // namespace hiac
