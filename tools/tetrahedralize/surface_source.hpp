#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "hiac/mesh/zoo_container.hpp"
#include "hiac/tetrahedralize/meshing/surface_meshing.hpp"
#include "tools/common/tool.hpp"

namespace hiac::tools {

/// What the options for surfaces say.
struct SurfaceOptions {
  SurfaceMeshing meshing;
  std::optional<double> weld;
  std::vector<std::string> holes;  ///< X,Y,Z each
  std::size_t max_ids = 20;
};

/// Fills the surface of a file with tetrahedra, and reports on what it encloses. Throws
/// JudgementError if it is not closed or intersects itself.
ZooFile mesh_of_surface(Tool& tool, const std::string& input, const SurfaceOptions& options);

}  // namespace hiac::tools
