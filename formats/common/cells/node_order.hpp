#pragma once

#include <string>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac::formats {

// The expected place of an edge node of a higher-order cell is on the straight edge: at the middle,
// or in cubic cells at the thirds. Lengths are in units of that edge's length.
//
// A circular edge of arc angle a has its middle tan(a/4)/2 off the chord's middle: 0.21 for a
// quarter of a circle, 0.29 for a third, 1/2 for a half, so truly curved cells pass, and so do
// quarter-point nodes of crack tips (0.25). In the regular cells every other edge's middle is 1/2
// or more away, so a permuted order fails; in a stretched cell it fails at the short edges.

/// A node is misplaced when it is farther than this from its place,
inline constexpr double kFarFromPlace = 0.5;
/// or farther than this and nearer to another edge node's place.
inline constexpr double kFarAndNearerToAnother = 0.3;
/// A misplaced node is exchanged when it is this close to another edge node's place, in lengths of
/// that node's edge: in cells with straight edges a permuted order puts it there exactly.
inline constexpr double kInAnothersPlace = 0.01;
/// Meshes that are tangled or extremely curved have some cells with misplaced nodes; a wrong node
/// order misplaces nodes in nearly all cells of the kind.
inline constexpr double kMostMisplacedCells = 0.05;

/// Throws InputError(subject, ...) when the edge nodes of higher-order cells are not in the
/// expected order: when any node is exchanged, or when more than kMostMisplacedCells of the cells
/// of a kind have misplaced nodes. If fewer do, a note says so. Parallel; the same for any number
/// of threads.
void check_edge_nodes(const ZooMesh& mesh, const std::string& subject,
                      std::vector<std::string>& notes);

}  // namespace hiac::formats
