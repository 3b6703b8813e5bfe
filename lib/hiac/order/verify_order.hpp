#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "hiac/order/order_basis.hpp"
#include "hiac/order/visibility_order.hpp"

namespace hiac {

/// What was checked in an order, and what was found wrong.
struct OrderCheck {
  std::uint64_t pairs = 0;     ///< pairs of cells that were tested (verify_pairs)
  std::uint64_t left_out = 0;  ///< cells without an inside, or not convex (verify_pairs)
  /// Cells with curved or warped faces, near which nothing was tested (verify_pairs).
  std::uint64_t in_part = 0;
  std::uint64_t arrows = 0;  ///< arrows of the relation that were followed (verify_arrows)
  std::uint64_t groups = 0;  ///< groups of several cells that were tested (verify_arrows)

  /// (a, b): the order has a in an earlier group than b, and a ray meets b before a.
  std::vector<std::pair<CellId, CellId>> wrong;  ///< the first few, in the order of a's group
  std::uint64_t wrong_count = 0;                 ///< the number of all
  /// Groups that are no visibility cycle: some cell is not in front of some other cell of the
  /// group, not even indirectly.
  std::vector<CellGroup> loose;

  [[nodiscard]] bool right() const { return wrong_count == 0 && loose.empty(); }
};

/// At most this many wrong pairs are listed.
inline constexpr std::size_t kMostWrongPairs = 16;

/// Tests by brute force, for every two cells, whether a ray meets them in the opposite order
/// (met_first): O(n^2). It proves an order right along every ray, except within 2 `planarity` times
/// a cell's size of a face and, where faces are warped or curved, within that plus twice their
/// deviation from a plane. Cells of which nothing remains then are left out. The answer depends on
/// the coordinates alone: not on the adjacency, nor on anything that exact_order computes.
OrderCheck verify_pairs(const ZooMesh& mesh, const View& view, const VisibilityOrder& order,
                        double planarity);

/// Follows every arrow of the relation that exact_order uses, across shared faces and gaps. Each
/// must lead to the same or a later group, and the arrows inside a group must connect each of its
/// cells to every other. Linear in cells, faces and arrows, given the relation. An arrow that the
/// relation lacks goes unnoticed.
OrderCheck verify_arrows(const OrderBasis& basis, const View& view, const VisibilityOrder& order,
                         double planarity);

/// Above this number of cells, verify_order only follows arrows: pairs would take more than
/// seconds.
inline constexpr std::size_t kMostCellsForPairs = 4096;

/// Runs verify_pairs on small meshes, and verify_arrows for the cells that it leaves out; on
/// others, verify_arrows. Groups are always tested by arrows.
OrderCheck verify_order(const OrderBasis& basis, const View& view, const VisibilityOrder& order,
                        double planarity);

}  // namespace hiac
