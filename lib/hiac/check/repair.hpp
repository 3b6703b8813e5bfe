#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// The changes that repair() made.
struct RepairCounts {
  std::uint64_t merged_nodes = 0;  ///< nodes at the place of another
  /// Not merged: their fields have different values, or a cell has both nodes.
  std::uint64_t unmerged_nodes = 0;
  std::uint64_t dropped_cells = 0;     ///< cells without volume
  std::uint64_t reoriented_cells = 0;  ///< cells numbered in mirror image

  [[nodiscard]] bool nothing() const {
    return merged_nodes == 0 && dropped_cells == 0 && reoriented_cells == 0;
  }
};

struct Repaired {
  ZooMesh mesh;
  RepairCounts counts;
};

/// Drops cells without volume (zero_volume), renumbers left-handed cells so that every cell is
/// right-handed, and makes cells use the first of all nodes at the same place. Nodes keep their
/// numbers and values; those that no cell uses any more stay. Nodes are merged only if all of their
/// fields have the same values, and never two of one cell. Values of cells and of cell corners
/// follow their cells. The adjacency is omitted and must be computed again.
///
/// Cells whose Jacobian changes its sign, and cells that overlap, stay as they are, as their
/// intended form is unknown.
Repaired repair(const ZooMesh& mesh);

/// Returns the order in which a cell's nodes are those of its mirror image of the same kind: node k
/// of the mirrored cell is node mirrored_order(kind)[k] of the cell. It is its own inverse.
std::array<std::uint8_t, 32> mirrored_order(CellKind kind);

}  // namespace hiac
