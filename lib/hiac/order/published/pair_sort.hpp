#pragma once

#include "hiac/order/published/multitiled.hpp"

namespace hiac {

/// Returns the cells front to back, sorted as stein_order does (one tile) or multitiled_order
/// (several); those headers state the guarantees. Throws VisibilityCycle.
std::vector<CellId> sort_pairs(const ZooMesh& mesh, const View& view, double planarity,
                               const TilingOptions& tiling);

}  // namespace hiac
