#pragma once

#include "hiac/order/visibility_order.hpp"

namespace hiac {

/// Returns the visibility order of C. Stein, B. Becker, N. Max, "Sorting and Hardware Assisted
/// Rendering for Volume Visualization", 1994, with the correction of P. Williams, N. Max, C. Stein,
/// "A High Accuracy Volume Renderer for Unstructured Data", 1998, sections 6 and 6.1: a rough sort
/// by rearmost depth, refined by testing pairs of cells for whether one obstructs the other
/// (cell_obstruction.hpp). Cells are any convex polyhedra; they may belong to meshes that do not
/// fit together or are disjoint. O(n^2) in the worst case.
///
/// The order is right along every ray for cells with planar faces that do not overlap. The paper's
/// approximate plane replaces a quadrilateral that is not planar, so that cells with strongly
/// warped faces may be out of order near those faces. `planarity` is as in exact_order.
///
/// Rays leave the eye in all directions: it may lie in the mesh, in a cell, on a face, edge or
/// node, and no cell lies behind it. Cells that overlap get an arbitrary order, or are reported as
/// a cycle.
///
/// Throws VisibilityCycle when the cells have no order, which the paper's algorithm reports.
VisibilityOrder stein_order(const ZooMesh& mesh, const View& view, double planarity);

}  // namespace hiac
