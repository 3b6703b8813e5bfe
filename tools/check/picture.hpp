#pragma once

#include <string>
#include <vector>

#include "hiac/check/defect.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/scene/scene.hpp"
#include "tools/common/tool.hpp"

namespace hiac::tools {

/// Draws a mesh with the cells of its findings, through the renderer: its boundary as a thin skin,
/// darker where it turns away from the eye; the edges at which that bends in dark; cells that make
/// the mesh invalid in red, cells of warnings in orange, all with their edges, so that those
/// without volume are seen as well. Curved cells are drawn straight between their corners.
/// `path`: as write_image takes it.
void write_defect_picture(Tool& tool, const ZooMesh& mesh, const FaceAdjacency& adjacency,
                          const std::vector<Finding>& findings, ImageSize size,
                          const std::string& path);

}  // namespace hiac::tools
