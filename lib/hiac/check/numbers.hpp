#pragma once

#include <vector>

#include "hiac/check/defect.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// Finds defects of a mesh's numbers: nodes that do not exist (node_index) and coordinates that are
/// not finite (coordinate). The mesh's arrays must be consistent (read_zoo_file guarantees that). A
/// mesh with any of these findings cannot be checked further.
std::vector<Finding> judge_numbers(const ZooMesh& mesh);

/// Returns, for every node, the lowest-numbered node at exactly the same place (0 and -0 are
/// equal), which is the node itself if there is no other.
std::vector<NodeId> first_at_place(const ZooMesh& mesh);

/// Finds nodes at the place of another (duplicate_node) or of no cell (unused_node), and cells with
/// a node twice (repeated_node). The mesh's numbers must be valid (judge_numbers).
std::vector<Finding> judge_nodes(const ZooMesh& mesh);

}  // namespace hiac
