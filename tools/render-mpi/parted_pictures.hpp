#pragma once

#include "hiac/cluster/communicator.hpp"
#include "tools/common/render/render_options.hpp"
#include "tools/common/tool.hpp"

namespace hiac::tools {

/// Makes pictures of a mesh in parts, or their colour bar alone: every process reads its own parts
/// alone, in turn, and rank 0 writes. Throws UsageError for what is not drawn of parts, InputError
/// where a part is missing or another than the index says.
void draw_parted_pictures(Communicator& all, Tool& tool, RenderOptions& options);

}  // namespace hiac::tools
