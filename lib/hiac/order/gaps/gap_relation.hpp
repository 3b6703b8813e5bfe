#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hiac/geometry/view.hpp"
#include "hiac/order/order_basis.hpp"

namespace hiac {

/// An arrow of the behind-relation between cells that share no face.
struct GapArrow {
  CellId front, behind;
};

/// Arrows across gaps by the cell in front: those of cell c lead to behind[start[c]] ...
/// behind[start[c + 1] - 1], each once, in ascending order. `start` is empty if there are no
/// arrows.
struct GapRelation {
  std::vector<std::uint64_t> start;
  std::vector<CellId> behind;
  std::uint64_t candidate_pairs = 0;  ///< pairs of faces that were tested

  [[nodiscard]] std::span<const CellId> behind_cell(CellId cell) const {
    if (start.empty()) return {};
    return std::span(behind).subspan(start[cell], start[cell + 1] - start[cell]);
  }
};

/// Returns the relation of arrows in any order, which may be repeated.
GapRelation sorted_by_cell(std::size_t cells, std::span<const GapArrow> arrows);

/// Returns the arrows across gaps, sliding interfaces and hanging nodes (source 2 of
/// docs/visibility-order.md): a viewing ray leaves cell P through an unmatched face F and later
/// enters cell Q through an unmatched face G.
///
/// Candidates are pairs of faces whose bounding boxes share a tile of a grid over the screen. Exact
/// determinants of input coordinates decide each pair, like the paper's Obstructs sequence (section
/// 6): the projections overlap unless a plane through the eye and an edge of either separates them;
/// then planes, crossing edges or contained corners decide which face is in front. A face that is
/// not planar is replaced by its hull (bent_face.hpp), and an arrow is set unless certainly none is
/// needed. Faces that touch to within `planarity` of their size count as touching: a ray that
/// leaves one there enters the other.
///
/// The relation also has the arrows, both ways, between the cells of basis.overlaps.
///
/// Together with shared_face_relation, these arrows order all cells along every ray: two
/// consecutive cells on a ray either share a face or are joined by an arrow from here.
GapRelation gap_relation(const OrderBasis& basis, const View& view, double planarity);

}  // namespace hiac
