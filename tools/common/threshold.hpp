#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "hiac/mesh/zoo_mesh.hpp"
#include "tools/common/tool.hpp"

namespace hiac::tools {

/// Adds --threshold.
void add_threshold(CLI::App& app, std::string& request);

/// Leaves out the cells that --threshold does not keep, FIELD=[LOW],[HIGH], and tells how many it
/// keeps; an empty request keeps all. Returns whether any is left out. Throws UsageError naming the
/// option for a wrong request, InputError if it keeps no cell.
bool apply_threshold(Tool& tool, ZooMesh& mesh, const std::string& request);

}  // namespace hiac::tools
