#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/format.hpp"

class vtkDataSet;

namespace hiac::formats::vtk {

/// The cells of a VTK dataset that go into a zoo mesh; nodes are still the dataset's points.
struct ConvertedCells {
  std::vector<CellKind> kinds;
  std::vector<std::uint64_t> elems;
  std::vector<NodeId> nodes;
  bool all_kept = true;
  std::vector<CellId> kept;  ///< the dataset's cell of every cell; empty when all were kept
};

/// Converts the volume cells: bricks with repeated nodes become their true kind, ghost and hidden
/// cells, surfaces and lines are left out, each with a note. Throws InputError(subject, ...) when a
/// cell names no point, and when a volume cell is none of the zoo's kinds and is not to be skipped.
ConvertedCells convert_cells(vtkDataSet& dataset, const ReadOptions& options,
                             const std::string& subject, std::vector<std::string>& notes);

/// The dataset's cells counted by type, and what becomes of them.
std::vector<CellCount> count_cells(vtkDataSet& dataset, const std::string& subject);

}  // namespace hiac::formats::vtk
