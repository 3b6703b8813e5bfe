#pragma once

#include <optional>

#include "hiac/scene/specification.hpp"
#include "tools/common/picture/picture_command.hpp"
#include "tools/common/tool.hpp"

namespace hiac::tools {

/// The specification of a command whose --view is a file of ParaView. Tells what was found in it,
/// and warns of what is not drawn; with --strict that throws JudgementError. Where no mesh is given
/// and none comes through a pipe, the data that the state shows become the command's input. The
/// camera of a .pvcc file goes into the command's overrides, and is of a starter view: none is
/// returned.
std::optional<ParsedScene> paraview_specification(Tool& tool, PictureCommand& command);

}  // namespace hiac::tools
