#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// What repair() changed.
struct RepairCounts {
  std::uint64_t merged_nodes = 0;  ///< that were at the place of another
  /// Left as they are: their fields have other values there, or a cell has both of them.
  std::uint64_t unmerged_nodes = 0;
  std::uint64_t dropped_cells = 0;     ///< without volume
  std::uint64_t reoriented_cells = 0;  ///< numbered in the mirror

  [[nodiscard]] bool nothing() const {
    return merged_nodes == 0 && dropped_cells == 0 && reoriented_cells == 0;
  }
};

struct Repaired {
  ZooMesh mesh;
  RepairCounts counts;
};

/// Drops cells without volume (zero_volume), numbers left-handed cells anew so that every cell is
/// right-handed, and lets cells use the first of all nodes at one place. Nodes keep their numbers
/// and values: those that no cell uses any more stay, unused. Nodes are merged only where all of
/// their fields have the same values, and never two of one cell. Values of cells and of cell
/// corners follow their cells. The adjacency is left out: it has to be made anew.
///
/// Cells whose Jacobian changes its sign, and cells that overlap, stay as they are: there is no
/// telling what they should have been.
Repaired repair(const ZooMesh& mesh);

/// The order in which a cell's nodes are those of its mirror image of the same kind: node k of the
/// mirrored cell is node mirrored_order(kind)[k] of the cell. Its own inverse.
std::array<std::uint8_t, 32> mirrored_order(CellKind kind);

}  // namespace hiac
