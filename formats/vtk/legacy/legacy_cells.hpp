#pragma once

#include <string>

#include "formats/vtk/legacy/legacy_words.hpp"

namespace hiac::formats::vtk {

/// The cells of a legacy unstructured grid, not yet decoded: up to version 4 one list in which each
/// cell is its node count and its nodes; from version 5 offsets and connectivity.
struct LegacyCells {
  std::size_t count = 0;    ///< of cells
  std::size_t entries = 0;  ///< numbers in the list (up to 4) or in the connectivity (from 5)
  bool has_offsets = false;
  NumberType offset_type{};
  NumberType entry_type{};
  std::size_t offsets_at = 0;
  std::size_t entries_at = 0;
  std::size_t types_at = 0;
};

/// Checks that the cells fill their list, name points below `points` and have a VTK type, and that
/// the face lists of polyhedra are complete. Throws InputError through `words`.
void check_legacy_cells(const LegacyWords& words, const LegacyCells& cells, std::size_t points);

}  // namespace hiac::formats::vtk
