#pragma once

#include "hiac/order/visibility_order.hpp"

namespace hiac {

/// Returns the cells by the depth of their centroids (the mean of a cell's corners), nearest first,
/// cells of equal depth by number. This is a heuristic for previews, which P. Williams, N. Max, C.
/// Stein, "A High Accuracy Volume Renderer for Unstructured Data", 1998, section 9, name as one to
/// investigate. Nothing is guaranteed: a large cell next to small ones may be out of order, and
/// cycles are not found. Runs in parallel; the result does not depend on the number of threads.
VisibilityOrder centroid_order(const ZooMesh& mesh, const View& view);

}  // namespace hiac
