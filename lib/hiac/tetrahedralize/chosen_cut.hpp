#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/tetrahedralize/cell_cut.hpp"

namespace hiac {

/// A cell's cut, and how its tetrahedra turn, by their corners.
struct ChosenCut {
  CellCut cut;
  std::array<int, 12> signs{};  ///< of their volumes, exactly

  /// How many tetrahedra turn otherwise than most, and how many are flat.
  [[nodiscard]] std::pair<std::size_t, std::size_t> bad() const;
};

/// The cut of a cell whose quadrilateral faces are cut as `other` says, corners being named by
/// their places (x, then y, then z; then the node's number): from the least one if no tetrahedron
/// is bad then; else any that has none bad; else the better of that and the one around the centre.
ChosenCut choose_cut(const ZooMesh& mesh, CellId cell, OtherDiagonals other);

/// The centre of a cell in its reference cell: the mean of the corners.
std::array<double, 3> reference_center(CellKind kind);

}  // namespace hiac
