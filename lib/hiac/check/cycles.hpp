#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hiac/geometry/view.hpp"
#include "hiac/order/order_basis.hpp"

namespace hiac {

/// Why a cell comes before the next one of a cycle.
enum class CycleStep : std::uint8_t {
  face,       ///< a shared face that all rays cross from this cell into the next
  both_ways,  ///< a shared face that rays cross both ways (not planar, or undecidable)
  gap         ///< a ray leaves this cell through a free face and later enters the next
};

/// One cell of a cycle.
struct CycleCell {
  CellId cell;
  CycleStep step;  ///< to the next one, from the last to the first
  /// For a shared face, its middle: the ray through it crosses from this cell into the next one.
  /// For a gap, the cell's own middle.
  std::array<double, 3> witness;
};

/// A group of cells that have no order, and a shortest one of the cycles through its first cell:
/// each cell is partly in front of the next.
struct VisibilityGroup {
  std::vector<CellId> cells;  ///< ascending
  std::vector<CycleCell> cycle;
};

/// Returns the groups of several cells in the exact visibility order for a view (exact_order), each
/// with a cycle.
std::vector<VisibilityGroup> find_cycles(const OrderBasis& basis, const View& view,
                                         double planarity);

/// Returns `count` directions of parallel views, spread evenly over the sphere as a Fibonacci
/// lattice (A. Gonzalez, "Measurement of Areas on a Sphere Using Fibonacci and Latitude-Longitude
/// Lattices", 2010).
std::vector<View> spread_views(std::size_t count);

}  // namespace hiac
