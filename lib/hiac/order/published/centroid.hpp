#pragma once

#include "hiac/order/visibility_order.hpp"

namespace hiac {

/// The cells by depth of their centroids (the mean of a cell's corners), nearest first, those of
/// one depth by number: a heuristic for previews, which P. Williams, N. Max, C. Stein, "A High
/// Accuracy Volume Renderer for Unstructured Data", 1998, section 9, name as one to investigate.
/// Nothing is guaranteed: large cells next to small ones come in the wrong order, and no cycle is
/// found. In parallel; the result does not depend on the number of threads.
VisibilityOrder centroid_order(const ZooMesh& mesh, const View& view);

}  // namespace hiac
