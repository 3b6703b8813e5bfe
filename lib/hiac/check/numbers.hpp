#pragma once

#include <vector>

#include "hiac/check/defect.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// Defects of a mesh's numbers: nodes that are not there (node_index), coordinates that are not
/// finite (coordinate). The mesh's arrays have to fit each other (as read_zoo_file sees to); with
/// any of these findings nothing else can be asked of the mesh.
std::vector<Finding> judge_numbers(const ZooMesh& mesh);

/// For every node the lowest-numbered one at the same place, exactly (0 and -0 are one place):
/// itself, where there is none.
std::vector<NodeId> first_at_place(const ZooMesh& mesh);

/// Nodes at the place of another (duplicate_node), of no cell (unused_node); cells with one node
/// twice (repeated_node). The mesh's numbers have to be right.
std::vector<Finding> judge_nodes(const ZooMesh& mesh);

}  // namespace hiac
