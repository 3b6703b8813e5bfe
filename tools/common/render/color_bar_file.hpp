#pragma once

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/scene/specification.hpp"
#include "tools/common/render/render_options.hpp"
#include "tools/common/tool.hpp"

namespace hiac::tools {

/// Whether --colorbar is given and this process is the one that writes.
bool writes_color_bar(const RenderOptions& options);

/// Writes the file of --colorbar and notes its length: that of --colorbar-length, or a round one
/// near a tenth of the mesh's `diagonal`. `mesh` names the fields and their units: the mesh or a
/// part of it. Throws InputError for what cannot be drawn or written.
void write_color_bar(Tool& tool, const RenderOptions& options, const ZooMesh& mesh, double diagonal,
                     const ParsedScene& view);

}  // namespace hiac::tools
