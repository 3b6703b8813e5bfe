#pragma once

#include <span>

#include "hiac/order/behind_relation.hpp"
#include "hiac/order/gaps/gap_relation.hpp"
#include "hiac/order/visibility_order.hpp"

namespace hiac {

/// Returns a topological order of the strongly connected components of a relation, front to back.
///
/// Cells that no cycle precedes are removed one by one by in-degree (A. B. Kahn, "Topological
/// Sorting of Large Networks", 1962); the cells in and behind cycles go through R. Tarjan,
/// "Depth-First Search and Linear Graph Algorithms", 1972. Linear in cells, faces and arrows.
///
/// `numbering` and `neighbors` belong to the adjacency from which the relation was computed; `gaps`
/// are further arrows.
VisibilityOrder order_of_components(const BehindRelation& relation, const FaceNumbering& numbering,
                                    std::span<const CellId> neighbors, const GapRelation& gaps);

}  // namespace hiac
