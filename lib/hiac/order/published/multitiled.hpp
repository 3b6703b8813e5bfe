#pragma once

#include <cstdint>

#include "hiac/order/visibility_order.hpp"

namespace hiac {

/// How the window is divided.
struct TilingOptions {
  /// Number of tiles side by side and one above the other; 0: n^(1/6) of either for n cells, as the
  /// paper has it by default.
  std::uint32_t columns = 0, rows = 0;
  /// Columns, and in each column rows, that hold equally many cells, instead of equally large ones.
  /// (The paper's own way to balance them was never published.)
  bool balanced = false;
};

/// The order of stein_order, found by the multitiled sort of P. Williams, N. Max, C. Stein, "A High
/// Accuracy Volume Renderer for Unstructured Data", 1998, section 6.2: only cells that share a tile
/// of the view-plane window are asked whether one obstructs the other. All that stein.hpp says
/// holds; the order is the same cell by cell, whatever the tiles and the number of threads.
VisibilityOrder multitiled_order(const ZooMesh& mesh, const View& view, double planarity,
                                 const TilingOptions& tiling = {});

}  // namespace hiac
