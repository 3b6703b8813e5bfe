#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac::formats {

/// The points that cells use, renumbered without gaps.
struct UsedPoints {
  bool all = true;
  std::vector<std::uint32_t> chosen;  ///< the used points' numbers; empty when all are used
};

/// Finds the used points and, unless all are used, renumbers `nodes`; a note counts the unused
/// ones.
UsedPoints use_points(std::vector<NodeId>& nodes, std::size_t point_count,
                      std::vector<std::string>& notes);

}  // namespace hiac::formats
