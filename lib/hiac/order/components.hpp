#pragma once

#include <span>

#include "hiac/order/behind_relation.hpp"
#include "hiac/order/gaps/gap_relation.hpp"
#include "hiac/order/visibility_order.hpp"

namespace hiac {

/// Topological order of the strongly connected components of a relation, front to back.
///
/// Cells outside and upstream of cycles are peeled off by in-degree (A. B. Kahn, "Topological
/// Sorting of Large Networks", 1962); what a cycle holds back goes through R. Tarjan, "Depth-First
/// Search and Linear Graph Algorithms", 1972. Linear in cells, faces and arrows.
///
/// `numbering` and `neighbors` are those of the adjacency that the relation was made of; `gaps` are
/// further arrows.
VisibilityOrder order_of_components(const BehindRelation& relation, const FaceNumbering& numbering,
                                    std::span<const CellId> neighbors, const GapRelation& gaps);

}  // namespace hiac
