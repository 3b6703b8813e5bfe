#pragma once

#include <string>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac::tools {

/// A first image specification for a mesh: every node of its cells in sight from a raised corner,
/// the first field that has values, coloured over its range, and an extinction that grows with it
/// such that the optical depth is about 1 in the mean over the pixels that the mesh covers.
/// Throws InputError(subject, ...) for a mesh without cells or without such a field.
Scene starter_view(const ZooMesh& mesh, const std::string& subject);

}  // namespace hiac::tools
