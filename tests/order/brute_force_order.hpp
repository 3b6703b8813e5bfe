#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/order/visibility_order.hpp"

namespace hiac::test {

/// Arrows of a directed graph: the first cell comes before the second.
using Arrows = std::vector<std::pair<CellId, CellId>>;

/// Whether an order is a sequence of all cells, with groups as they have to be.
testing::AssertionResult is_sequence_of_groups(const VisibilityOrder& order, std::size_t cells);

/// The place of every cell's group in the sequence of groups.
std::vector<std::uint32_t> group_ranks(const VisibilityOrder& order);

/// Whether the groups are exactly the strongly connected components of the graph (found by
/// reachability between all pairs of cells) and no arrow leads from a later group to an earlier
/// one. For up to kMostCells cells.
testing::AssertionResult is_order_of(const Arrows& arrows, std::size_t cells,
                                     const VisibilityOrder& order);
inline constexpr std::size_t kMostCells = 2048;

/// The arrows across the shared faces of a mesh of tetrahedra in general or special position, each
/// found by comparing all faces and decided in rational arithmetic. Cells without volume take part
/// in none.
Arrows rational_arrows(const ZooMesh& tetrahedra, const View& view);

/// Whether no ray meets cells against the order. The rays go through `count` random points of
/// random cells; every one is cut with every cell, a convex polyhedron with planar faces, in long
/// double. Pieces shorter than 1e-9 of the mesh's size do not count.
testing::AssertionResult holds_along_rays(const ZooMesh& mesh, const View& view,
                                          const VisibilityOrder& order, std::size_t count,
                                          std::uint64_t seed);

}  // namespace hiac::test
