#include "formats/vtk/cells_from_vtk.hpp"

#include <map>

#include <fmt/format.h>

#include "formats/vtk/cell_types.hpp"
#include "formats/vtk/dataset_cells.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats::vtk {
namespace {

void check_size(const DatasetCells& cells, const std::string& subject) {
  if (cells.count() >= kNoCell || cells.point_count() > std::size_t{kNoCell} + 1)
    throw InputError(subject, fmt::format("too large (at most {} cells and {} points expected, {} "
                                          "and {} found)",
                                          kNoCell - 1, std::size_t{kNoCell} + 1, cells.count(),
                                          cells.point_count()));
}

}  // namespace

ConvertedCells convert_cells(vtkDataSet& dataset, const ReadOptions& options,
                             const std::string& subject, std::vector<std::string>& notes) {
  DatasetCells cells(dataset, subject);
  check_size(cells, subject);
  CellCollector collector(options, subject, cell_type_name);
  collector.reserve(cells.count(), cells.entry_count());
  std::size_t ghosts = 0;
  std::vector<NodeId> nodes;
  for (std::size_t i = 0; i < cells.count(); ++i) {
    const StoredCell cell = cells.cell(i);
    if (cells.is_ghost(i) || cells.has_hidden_point(cell.points)) {
      ++ghosts;
      continue;
    }
    nodes.assign(cell.points.begin(), cell.points.end());
    collector.add(i, cell.type, nodes, conversion_of(cell.type, nodes.size()));
  }
  ConvertedCells result = collector.finish(cells.count(), notes);
  if (ghosts > 0) notes.push_back(fmt::format("dropped {} ghost or hidden cells", ghosts));
  return result;
}

std::vector<CellCount> count_cells(vtkDataSet& dataset, const std::string& subject) {
  DatasetCells cells(dataset, subject);
  TrueKinds true_kinds;
  std::vector<NodeId> nodes;
  std::map<std::pair<std::string, std::string>, std::size_t> counts;
  for (std::size_t i = 0; i < cells.count(); ++i) {
    const StoredCell cell = cells.cell(i);
    const CellConversion conversion = conversion_of(cell.type, cell.points.size());
    std::string name = cell_type_name(cell.type);
    if (conversion.fate == CellFate::wrong)
      throw InputError(
          subject, fmt::format("cell {}: a {} cannot have {} nodes", i, name, cell.points.size()));
    if (conversion.fate == CellFate::unsupported && !cell.points.empty())
      name = fmt::format("{} of {} nodes", name, cell.points.size());
    nodes.assign(cell.points.begin(), cell.points.end());
    std::string fate = cell.type == VTK_POLYHEDRON ? "what its faces make it"
                                                   : fate_of(conversion, nodes, true_kinds);
    if (cells.is_ghost(i) || cells.has_hidden_point(cell.points)) fate = "dropped (ghost)";
    ++counts[{std::move(name), std::move(fate)}];
  }
  std::vector<CellCount> result;
  for (const auto& [key, count] : counts) result.push_back({key.first, count, key.second});
  return result;
}

}  // namespace hiac::formats::vtk
