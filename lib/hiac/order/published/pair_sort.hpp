#pragma once

#include "hiac/order/published/multitiled.hpp"

namespace hiac {

/// The sort that stein_order and multitiled_order share, which is the latter's with more than one
/// tile. See those for what holds. Throws VisibilityCycle.
std::vector<CellId> sort_pairs(const ZooMesh& mesh, const View& view, double planarity,
                               const TilingOptions& tiling);

}  // namespace hiac
