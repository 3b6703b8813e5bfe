#pragma once

#include <span>
#include <string>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac::formats {

/// Which nodes of several pieces are one node of the mesh.
struct CommonNodes {
  std::vector<NodeId> first;       ///< for every node the first one that it is one with, or itself
  std::string by;                  ///< what tells: "their GlobalNodeId"
  std::vector<std::string> notes;  ///< for the user, one sentence each
};

/// Nodes of different pieces are one
/// - by their numbers, where a field of the nodes has numbers of the whole mesh: `numbers`, or one
///   with a name that VTK's programs use (GlobalNodeId, GlobalPointIds). These have to be whole and
///   different within every piece, and nodes of one number have to lie at one place, give or take
///   the rounding of a file with few digits. Where they do not, a note says so, and the places
///   count. Nodes of one number whose values differ by more than such rounding stay apart.
/// - otherwise by their places: equal coordinates and equal values of every field, except where a
///   piece itself has several nodes at that place, as along a crack.
/// `mesh` holds the pieces one after the other, whose first nodes are `offsets`, followed by the
/// number of nodes.
CommonNodes common_nodes(const ZooMesh& mesh, std::span<const std::size_t> offsets,
                         const std::string& numbers);

}  // namespace hiac::formats
