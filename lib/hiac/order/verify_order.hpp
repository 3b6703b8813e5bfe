#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "hiac/order/order_basis.hpp"
#include "hiac/order/visibility_order.hpp"

namespace hiac {

/// What was checked of an order, and what was found wrong.
struct OrderCheck {
  std::uint64_t pairs = 0;     ///< of cells that were asked about (verify_pairs)
  std::uint64_t left_out = 0;  ///< cells without an inside, or not convex (verify_pairs)
  /// Cells with curved or warped faces, near which nothing was asked (verify_pairs).
  std::uint64_t in_part = 0;
  std::uint64_t arrows = 0;  ///< of the relation that were followed (verify_arrows)
  std::uint64_t groups = 0;  ///< of several cells that were judged (verify_arrows)

  /// (a, b): the order has a in an earlier group than b, and a ray meets b before a.
  std::vector<std::pair<CellId, CellId>> wrong;  ///< the first few, by a's place in the order
  std::uint64_t wrong_count = 0;                 ///< all
  /// Groups that are no visibility cycle: some cell of theirs is not in front of some other, not
  /// even by way of the rest.
  std::vector<CellGroup> loose;

  [[nodiscard]] bool right() const { return wrong_count == 0 && loose.empty(); }
};

/// How many of the wrong pairs are named.
inline constexpr std::size_t kMostWrongPairs = 16;

/// Asks of every two cells whether a ray meets them in the other order (met_first), by brute force:
/// O(n^2). It proves an order right along every ray, up to what is nearer to a face than 2
/// `planarity` times its cell's size; where faces are warped or curved, than twice what they
/// deviate from a plane besides. Cells of which nothing is left then are left out. The answer rests
/// on the coordinates alone: not on the adjacency, nor on anything that exact_order computes.
OrderCheck verify_pairs(const ZooMesh& mesh, const View& view, const VisibilityOrder& order,
                        double planarity);

/// Follows every arrow of the relation that exact_order rests on, across shared faces and gaps:
/// each has to lead to the same or a later group, and those inside a group have to lead from each
/// of its cells to every other. Linear in cells, faces and arrows, given the relation; a relation
/// that lacks an arrow is not noticed.
OrderCheck verify_arrows(const OrderBasis& basis, const View& view, const VisibilityOrder& order,
                         double planarity);

/// Above this number of cells verify_order follows arrows alone: it would take more than seconds.
inline constexpr std::size_t kMostCellsForPairs = 4096;

/// Pairs where there are few cells, and arrows of those cells that pairs leave out; else arrows.
/// Groups by arrows.
OrderCheck verify_order(const OrderBasis& basis, const View& view, const VisibilityOrder& order,
                        double planarity);

}  // namespace hiac
