#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hiac/geometry/view.hpp"
#include "hiac/order/order_basis.hpp"

namespace hiac {

/// An arrow of the behind-relation that no shared face tells of.
struct GapArrow {
  CellId front, behind;
};

/// Arrows across gaps by the cell in front: those of cell c lead to behind[start[c]] ...
/// behind[start[c + 1] - 1], each once, in ascending order. Without any, `start` is empty.
struct GapRelation {
  std::vector<std::uint64_t> start;
  std::vector<CellId> behind;
  std::uint64_t candidate_pairs = 0;  ///< pairs of faces that were decided

  [[nodiscard]] std::span<const CellId> behind_cell(CellId cell) const {
    if (start.empty()) return {};
    return std::span(behind).subspan(start[cell], start[cell + 1] - start[cell]);
  }
};

/// The same from arrows in any order, any number of times each.
GapRelation sorted_by_cell(std::size_t cells, std::span<const GapArrow> arrows);

/// Arrows across gaps, sliding interfaces and hanging nodes (design: source 2): a viewing ray
/// leaves cell P through an unmatched face F and later enters cell Q through an unmatched face G.
///
/// Candidates are pairs of faces whose bounding boxes share a tile of a grid over the screen. Each
/// pair is decided by exact determinants of input coordinates, in the spirit of the paper's
/// Obstructs sequence (section 6): the projections overlap unless a plane through the eye and an
/// edge of either separates them, and then planes, crossing edges or contained corners tell which
/// is in front. A face that is not planar is asked as the hull that it lies in (bent_face.hpp), and
/// an arrow put unless it is certain that none is needed. Faces that touch to within `planarity` of
/// their size count as touching: a ray that leaves one there enters the other.
///
/// Besides, both ways, those between the cells of basis.overlaps.
///
/// With those of shared_face_relation these arrows order all cells along every ray: consecutive
/// cells on a ray either share a face or are joined by an arrow from here.
GapRelation gap_relation(const OrderBasis& basis, const View& view, double planarity);

}  // namespace hiac
