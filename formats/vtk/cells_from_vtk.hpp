#pragma once

#include <string>
#include <vector>

#include "formats/common/cells/cell_collector.hpp"
#include "formats/common/mesh/format.hpp"

class vtkDataSet;

namespace hiac::formats::vtk {

/// Converts the volume cells: bricks with repeated nodes become their true kind, ghost and hidden
/// cells, surfaces and lines are left out, each with a note. Throws InputError(subject, ...) when a
/// cell names no point, and when a volume cell is none of the zoo's kinds and is not to be skipped.
ConvertedCells convert_cells(vtkDataSet& dataset, const ReadOptions& options,
                             const std::string& subject, std::vector<std::string>& notes);

/// The dataset's cells counted by type, and what becomes of them.
std::vector<CellCount> count_cells(vtkDataSet& dataset, const std::string& subject);

}  // namespace hiac::formats::vtk
