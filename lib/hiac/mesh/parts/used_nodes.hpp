#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// Returns for each of `count` nodes 1 if it occurs in `nodes`, otherwise 0.
std::vector<std::uint8_t> mark_used_nodes(std::span<const NodeId> nodes, std::size_t count);

/// Numbers the nodes that occur in `nodes`, of `count` in all, without gaps and in their order, and
/// gives them these numbers there. Returns the former number of each, ascending.
std::vector<NodeId> renumber_used_nodes(std::span<NodeId> nodes, std::size_t count);

}  // namespace hiac
