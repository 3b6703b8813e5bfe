#pragma once

#include <cstdint>
#include <string>

#include "hiac/mesh/zoo_mesh.hpp"
#include "tools/common/tool.hpp"

namespace hiac::tools {

/// What becomes of cells that are partly turned inside out.
enum class InvalidCellsFate : std::uint8_t { refuse, skip, cut };

/// Refuses the mesh if it has such cells (InputError naming `subject`), or leaves them out, or cuts
/// them into tetrahedra; says how many there are and what that changes.
void treat_invalid_cells(Tool& tool, InvalidCellsFate fate, const std::string& subject,
                         ZooMesh& mesh);

}  // namespace hiac::tools
