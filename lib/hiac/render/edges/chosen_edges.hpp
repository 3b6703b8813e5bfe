#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "hiac/geometry/face_form.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

/// An edge of a boundary face.
struct EdgeSide {
  EdgeNodes edge;
  std::array<double, 3> normal;  ///< of the face, on either side
  bool ascending;                ///< whether the face passes the edge from its lower end
};

/// The nodes at an edge's ends, ascending.
std::pair<NodeId, NodeId> ends_of(const EdgeNodes& edge);
/// The edges of all faces of a boundary, by ascending end nodes. `boundary`: as below.
std::vector<EdgeSide> boundary_sides(const ZooMesh& mesh, std::span<const std::uint8_t> boundary);
/// Whether the boundary bends by more than an angle with this cosine between the sides of one edge.
bool is_feature(std::span<const EdgeSide> sides, double cosine);
/// All edges of all cells, each once, by ascending end nodes.
std::vector<EdgeNodes> all_edges(const ZooMesh& mesh);
/// The cosine of Edges::angle.
double cosine_of(const Edges& wanted);

/// The edges of a mesh that a scene draws, each once, by ascending end nodes.
///
/// `boundary`: a bit for each face of every cell, set on the boundary (boundary_faces.hpp). A
/// feature is an edge of the boundary with two faces beside it, whose planes are at an angle above
/// `wanted.angle`, or with any other number of faces. The planes are those of the faces' corners.
/// Faces that pass the edge in the same direction count as turned to one side all the same: no
/// orientation of cells matters.
std::vector<EdgeNodes> chosen_edges(const ZooMesh& mesh, const Edges& wanted,
                                    std::span<const std::uint8_t> boundary);

/// What ScreenEdges takes of a mesh, for many pictures.
struct MeshEdges {
  std::vector<std::uint8_t> boundary;  ///< boundary_faces
  std::vector<EdgeNodes> edges;        ///< chosen_edges
};
MeshEdges mesh_edges(const ZooMesh& mesh, const Edges& wanted);

}  // namespace hiac
