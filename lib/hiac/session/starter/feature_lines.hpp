#pragma once

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac::starter {

/// The length on the screen, in pixels, of the edges that a scene draws, hidden or not, each
/// straight between its ends. `camera`: in perspective, with the whole mesh before the eye.
double line_length(const ZooMesh& mesh, const Edges& edges, const Camera& camera,
                   const ImageSize& size);

}  // namespace hiac::starter
