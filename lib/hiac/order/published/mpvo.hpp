#pragma once

#include "hiac/order/visibility_order.hpp"

namespace hiac {

/// P. Williams, "Visibility Ordering Meshed Polyhedra", 1992 (MPVO): the relation across shared
/// faces as a directed graph, and a depth-first search that puts out a cell once all cells behind
/// it are out. Linear time. For meshes that are not convex his heuristic MPVONC: the search starts
/// from the cells that have an outer face towards the eye, farthest face first (by the distance of
/// its centroid, or its depth in a parallel view).
///
/// Exact for convex meshes whose neighbours share faces. Where a ray leaves the mesh and enters it
/// again (notches, holes, cavities, separate or sliding parts) nothing is guaranteed: exact_order
/// and stein_order are. Cells of a visibility cycle across faces become a group. `planarity` is as
/// in exact_order, and so are the errors thrown.
VisibilityOrder mpvo_order(const OrderBasis& basis, const View& view, double planarity);

/// The same for a single view.
VisibilityOrder mpvo_order(const ZooMesh& mesh, const FaceAdjacency& adjacency, const View& view,
                           double planarity);

}  // namespace hiac
