#pragma once

#include <string>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"
#include "tools/common/tool.hpp"

namespace hiac::tools {

/// What is done to a mesh between reading and writing it, in this order.
struct Edits {
  std::vector<std::string> derivations;  ///< NAME=EXPRESSION, of fields that are read or derived
  std::string warp;                      ///< FIELD[:SCALE]
  std::string threshold;                 ///< FIELD=[LOW],[HIGH]

  void add_options(CLI::App& app);
};

/// Edits the mesh and tells what was done. Throws UsageError naming the option.
void edit(Tool& tool, ZooMesh& mesh, const Edits& edits);

}  // namespace hiac::tools
