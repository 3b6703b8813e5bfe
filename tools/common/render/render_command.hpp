#pragma once

#include <functional>

#include "hiac/cluster/communicator.hpp"
#include "hiac/frame/tiles/tile_crew.hpp"
#include "tools/common/tool.hpp"

namespace hiac::tools {

struct RenderOptions;

/// What a program that makes pictures of a mesh is among others that make them with it.
struct RenderRole {
  Communicator* all = nullptr;     ///< the processes that share the pictures; null: this one alone
  const TileCrew* crew = nullptr;  ///< the same ones, as those that share a picture
  bool writes = true;              ///< false: another process writes and reports
  /// Makes pictures of a mesh in parts, or its colour bar alone where -o is not given. The options
  /// that do not fit have been refused. A role without this function puts the parts together.
  std::function<void(Tool& tool, RenderOptions& options)> draw_parts = {};
};

/// The command that makes pictures of a mesh, as hiac-render has it: adds its options to the tool
/// and runs it.
int render_command(Tool& tool, int argc, char** argv, const RenderRole& role);

}  // namespace hiac::tools
