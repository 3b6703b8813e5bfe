#pragma once

#include "hiac/order/visibility_order.hpp"

namespace hiac {

/// The visibility order of C. Stein, B. Becker, N. Max, "Sorting and Hardware Assisted Rendering
/// for Volume Visualization", 1994, with the correction of P. Williams, N. Max, C. Stein, "A High
/// Accuracy Volume Renderer for Unstructured Data", 1998, sections 6 and 6.1: a rough sort by
/// rearmost depth, fine-tuned by asking of pairs of cells whether one obstructs the other
/// (cell_obstruction.hpp). Cells are any convex polyhedra; they may belong to meshes that do not
/// fit together or lie apart. O(n^2) in the worst case.
///
/// Right along every ray for cells with planar faces that do not overlap. A quadrilateral that is
/// not planar stands for the paper's approximate plane where planes are asked, so that cells with
/// much warped faces may come in an order that is wrong near those faces. `planarity` is as in
/// exact_order.
///
/// Rays come from everywhere around the eye: it may lie in the mesh, in a cell, on a face, edge or
/// node, and no cell lies behind it. Cells that overlap are put in some order or other, or are
/// reported as a cycle.
///
/// Throws VisibilityCycle when the cells have no order, as the paper's algorithm reports.
VisibilityOrder stein_order(const ZooMesh& mesh, const View& view, double planarity);

}  // namespace hiac
