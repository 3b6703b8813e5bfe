#pragma once

#include <cstdint>

#include "hiac/order/visibility_order.hpp"

namespace hiac {

/// How the window is divided into tiles.
struct TilingOptions {
  /// The number of tiles in x and in y; 0 means n^(1/6) for n cells, which is the paper's default.
  std::uint32_t columns = 0, rows = 0;
  /// Whether the columns, and the rows of each column, hold equal numbers of cells instead of
  /// having equal sizes. (The paper's own way to balance them was never published.)
  bool balanced = false;
};

/// Returns the order of stein_order, found by the multitiled sort of P. Williams, N. Max, C. Stein,
/// "A High Accuracy Volume Renderer for Unstructured Data", 1998, section 6.2: only cells that
/// share a tile of the view-plane window are tested against each other. Everything in stein.hpp
/// applies; the order is the same cell by cell, whatever the tiles and the number of threads.
VisibilityOrder multitiled_order(const ZooMesh& mesh, const View& view, double planarity,
                                 const TilingOptions& tiling = {});

}  // namespace hiac
