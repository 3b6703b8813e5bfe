#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/tetrahedralize/cell_cut.hpp"

namespace hiac {

/// A cell's cut, and the orientations of its tetrahedra's corners.
struct ChosenCut {
  CellCut cut;
  std::array<int, 12> signs{};  ///< of their volumes, exact

  /// Returns how many tetrahedra have the less frequent orientation, and how many are flat.
  [[nodiscard]] std::pair<std::size_t, std::size_t> bad() const;
};

/// Returns the cut of a cell whose quadrilateral faces are cut as `other` says; corners are ordered
/// by position (x, then y, then z; then the node's number). The cut from the least corner is
/// preferred if it has no bad tetrahedra; then any other cut without bad ones; then the better of
/// the first cut and the one around the centre.
ChosenCut choose_cut(const ZooMesh& mesh, CellId cell, OtherDiagonals other);

/// Returns the cuts of a cell that can be chosen from, its faces cut in one way: that of
/// choose_cut, those from every corner from which there is one, and the one around the centre.
std::vector<ChosenCut> possible_cuts(const ZooMesh& mesh, CellId cell);

}  // namespace hiac
