#pragma once

#include <string>
#include <vector>

#include "hiac/check/defect.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/scene/scene.hpp"
#include "tools/common/tool.hpp"

namespace hiac::tools {

/// Draws a mesh with the cells of its findings by the accurate engine: the boundary as a skin of
/// glass with its feature edges, and over it the cells that make the mesh invalid in red, or else
/// those of warnings in orange, as opaque solids with all of their edges, so that those without
/// volume are seen as well, and what hides them does not. `path`: as write_image takes it.
///
/// Both are groups of cells that the engine sorts along every ray: tangled cells have no order. The
/// cells of findings are drawn straight between their corners.
void write_defect_picture(Tool& tool, const ZooMesh& mesh, const FaceAdjacency& adjacency,
                          const std::vector<Finding>& findings, ImageSize size,
                          const std::string& path);

}  // namespace hiac::tools
