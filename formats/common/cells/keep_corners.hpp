#pragma once

#include <string>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac::formats {

/// Replaces every cell of higher order by the linear cell of its conventional nodes. Nodes that no
/// cell uses any more are removed with their data (Williams, Max, Stein 1998, Fig. 8: "neglecting
/// the data at the interior nodes"). Notes say how many. A linear mesh stays unchanged.
void keep_corners(ZooMesh& mesh, std::vector<std::string>& notes);

}  // namespace hiac::formats
