#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hiac/cluster/communicator.hpp"
#include "hiac/cluster/part_boundary.hpp"

namespace hiac {

/// For each of this process's parts the boundary of the whole mesh, as boundary_faces has it: for
/// every cell a bit for each of its faces that no other cell of any part has, or that more than two
/// cells have.
///
/// Only faces with all corners on the boundaries of parts (nodes_on_boundary) are told, each to the
/// process that its nodes' numbers choose, which compares them. The result depends neither on the
/// number of processes nor on who has which part.
std::vector<std::vector<std::uint8_t>> whole_boundary(Communicator& all,
                                                      std::span<const NumberedPart> own);

}  // namespace hiac
