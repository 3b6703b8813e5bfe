#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hiac/geometry/view.hpp"
#include "hiac/order/order_basis.hpp"

namespace hiac {

/// What puts a cell before the next one of a cycle.
enum class CycleStep : std::uint8_t {
  face,       ///< a shared face that all rays cross from this cell into the next
  both_ways,  ///< a shared face that rays cross either way (it is not planar, or nobody can tell)
  gap         ///< a ray leaves this cell through a free face and later enters the next
};

/// One cell of a cycle.
struct CycleCell {
  CellId cell;
  CycleStep step;  ///< to the next one, from the last to the first
  /// The middle of the shared face: the ray through it crosses from this cell into the next one.
  /// Of a gap: the cell's own middle.
  std::array<double, 3> witness;
};

/// A group of cells that no order can put one after the other, and a shortest cycle among those
/// through its first cell: each cell is in part in front of the next.
struct VisibilityGroup {
  std::vector<CellId> cells;  ///< ascending
  std::vector<CycleCell> cycle;
};

/// The groups of several cells of the exact visibility order for a view (exact_order), and what
/// makes them cycles.
std::vector<VisibilityGroup> find_cycles(const OrderBasis& basis, const View& view,
                                         double planarity);

/// `count` directions of parallel views, spread evenly over all directions: a Fibonacci lattice of
/// the sphere (A. Gonzalez, "Measurement of Areas on a Sphere Using Fibonacci and
/// Latitude-Longitude Lattices", 2010).
std::vector<View> spread_views(std::size_t count);

}  // namespace hiac
