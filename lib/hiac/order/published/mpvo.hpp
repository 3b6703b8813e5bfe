#pragma once

#include "hiac/order/visibility_order.hpp"

namespace hiac {

/// Returns the order of P. Williams, "Visibility Ordering Meshed Polyhedra", 1992 (MPVO): the
/// relation across shared faces is a directed graph, and a depth-first search outputs a cell after
/// all cells behind it. Linear time. For meshes that are not convex it uses his heuristic MPVONC:
/// the search starts from the cells that have an outer face towards the eye, farthest face first
/// (by the distance of its centroid, or its depth in a parallel view).
///
/// Exact for convex meshes whose neighbours share faces. Where a ray leaves the mesh and enters it
/// again (notches, holes, cavities, separate or sliding parts) nothing is guaranteed; exact_order
/// and stein_order are right there. The cells of a visibility cycle across faces become a group.
/// `planarity` and the exceptions are those of exact_order.
VisibilityOrder mpvo_order(const OrderBasis& basis, const View& view, double planarity);

/// Computes the basis as well: for a single view.
VisibilityOrder mpvo_order(const ZooMesh& mesh, const FaceAdjacency& adjacency, const View& view,
                           double planarity);

}  // namespace hiac
