#pragma once

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

/// Throws InputError, naming what it is and where it is first met, when the scene or the mesh holds
/// something that the engine does not draw: nothing is approximated or left out in silence.
///
/// Of the scene: interpolation other than the default. Of the mesh: curved edges (edge_deviation
/// above scene.render.planarity); quadrilateral faces that deviate from a plane by more than
/// scene.render.planarity of their size (quadrilateral_deviation); cells that are not convex or
/// turned inside out in part (corners of the cell or of a face turn different ways); values that
/// are not finite in a field that is used, at a place that some cell uses. UsageError, as from
/// scalar_field, when a field does not exist.
void check_renderable(const ZooMesh& mesh, const Scene& scene);

}  // namespace hiac
