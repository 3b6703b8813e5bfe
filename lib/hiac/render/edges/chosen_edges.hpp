#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hiac/geometry/face_form.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

/// The edges of a mesh that a scene draws, each once, by ascending end nodes.
///
/// `boundary`: a bit for each face of every cell, set on the boundary (boundary_faces.hpp). A
/// feature is an edge of the boundary with two faces beside it, whose planes are at an angle above
/// `wanted.angle`, or with any other number of faces. The planes are those of the faces' corners.
/// Faces that pass the edge in the same direction count as turned to one side all the same: no
/// orientation of cells matters.
std::vector<EdgeNodes> chosen_edges(const ZooMesh& mesh, const Edges& wanted,
                                    std::span<const std::uint8_t> boundary);

}  // namespace hiac
