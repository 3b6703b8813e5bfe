#pragma once

#include <string>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac::formats {

/// Makes every cell of higher order the linear cell of its conventional nodes; nodes that no cell
/// uses any more go, and with them their data (Williams, Max, Stein 1998, Fig. 8: "the data at the
/// interior nodes neglected"). Notes say how many. A linear mesh stays as it is.
void keep_corners(ZooMesh& mesh, std::vector<std::string>& notes);

}  // namespace hiac::formats
