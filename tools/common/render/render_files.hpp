#pragma once

#include <vector>

#include "tools/common/render/render_options.hpp"
#include "tools/common/render/shots.hpp"
#include "tools/common/tool.hpp"

namespace hiac::tools {

/// Claims the files that are read and those that are written (Tool::claim), of which `pictures` are
/// known; none: of the output alone.
void claim_render_files(Tool& tool, const RenderOptions& options,
                        const std::vector<Shot>& pictures = {});

}  // namespace hiac::tools
