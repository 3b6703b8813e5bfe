#pragma once

#include <string>
#include <vector>

#include "formats/common/cells/cell_collector.hpp"
#include "formats/common/mesh/format.hpp"

class vtkDataSet;

namespace hiac::formats::vtk {

/// Converts the volume cells: bricks with repeated nodes become their true kind; ghost and hidden
/// cells, surfaces and lines are left out, each with a note. Throws InputError(subject, ...) when a
/// cell refers to a point that does not exist, and when the zoo has no kind for a volume cell that
/// is not to be skipped.
ConvertedCells convert_cells(vtkDataSet& dataset, const ReadOptions& options,
                             const std::string& subject, std::vector<std::string>& notes);

/// The counts of the dataset's cells by type, and how each type is converted.
std::vector<CellCount> count_cells(vtkDataSet& dataset, const std::string& subject);

}  // namespace hiac::formats::vtk
