#include "formats/vtk/from_vtk.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vtkCellArray.h>
#include <vtkDataSet.h>
#include <vtkPointSet.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

#include "formats/common/mesh/assemble.hpp"
#include "formats/common/mesh/gate.hpp"
#include "formats/vtk/cells_from_vtk.hpp"
#include "formats/vtk/fields_from_vtk.hpp"
#include "formats/vtk/foreign_from_vtk.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats::vtk {
namespace {

SharedArray<double> coordinates_of(vtkDataSet& dataset, const TupleChoice& choice) {
  auto* point_set = vtkPointSet::SafeDownCast(&dataset);
  if (point_set != nullptr && point_set->GetPoints() != nullptr)
    return values_of(point_set->GetPoints()->GetData(), choice);
  // images and rectilinear grids compute their points
  const auto count =
      choice.all ? static_cast<std::size_t>(dataset.GetNumberOfPoints()) : choice.chosen.size();
  std::vector<double> xyz(3 * count);
  for (std::size_t i = 0; i < count; ++i)
    dataset.GetPoint(static_cast<vtkIdType>(choice.all ? i : choice.chosen[i]), &xyz[3 * i]);
  return xyz;
}

/// Frees the cells of an unstructured grid; its points and data are kept.
void release_cells(vtkDataSet& dataset) {
  auto* grid = vtkUnstructuredGrid::SafeDownCast(&dataset);
  if (grid != nullptr && grid->GetCells() != nullptr) grid->GetCells()->Initialize();
}

}  // namespace

Reading mesh_from_vtk(const vtkSmartPointer<vtkDataSet>& dataset, const ReadOptions& options,
                      const std::string& subject) {
  check_step(options, times_of(*dataset->GetFieldData()), subject);
  if (has_cells_beyond_the_zoo(*dataset, subject)) {
    ReadOptions others = options;
    others.time.reset();
    return assemble_piece(foreign_from_vtk(*dataset, subject), others, subject);
  }
  Reading reading;
  ConvertedCells cells = convert_cells(*dataset, options, subject, reading.notes);
  const auto point_count = static_cast<std::size_t>(dataset->GetNumberOfPoints());
  const auto cell_count = static_cast<std::size_t>(dataset->GetNumberOfCells());
  release_cells(*dataset);
  const UsedPoints used = use_points(cells.nodes, point_count, reading.notes);
  ZooMesh& mesh = reading.mesh;
  mesh.kinds = std::move(cells.kinds);
  mesh.elems = std::move(cells.elems);
  mesh.nodes = std::move(cells.nodes);
  const TupleChoice point_choice{point_count, used.all, used.chosen};
  mesh.xyz = coordinates_of(*dataset, point_choice);
  add_metadata(*dataset->GetFieldData(), mesh, reading.notes);
  move_fields(*dataset, point_choice, {cell_count, cells.all_kept, cells.kept}, subject, mesh,
              reading.notes);
  pass_gate(reading, used, subject);
  return reading;
}

Inventory inventory_from_vtk(vtkDataSet& dataset, const std::string& subject) {
  Inventory inventory;
  inventory.points = static_cast<std::size_t>(dataset.GetNumberOfPoints());
  inventory.cells = count_cells(dataset, subject);
  inventory.fields = summarize_fields(dataset);
  inventory.times = times_of(*dataset.GetFieldData());
  return inventory;
}

void check_step(const ReadOptions& options, const std::vector<double>& times,
                const std::string& subject) {
  if (options.block)
    throw UsageError(fmt::format("block {}: {} has no named blocks", *options.block, subject));
  if (options.step && *options.step > 0)
    throw UsageError(
        fmt::format("step {}: {} holds one step (0 expected)", *options.step, subject));
  if (!options.time) return;
  if (times.empty())
    throw UsageError(fmt::format("time {}: {} tells no time", *options.time, subject));
  if (times.size() != 1 || times.front() != *options.time)
    throw UsageError(fmt::format("time {}: {} holds another time ({} found)", *options.time,
                                 subject, fmt::join(times, " ")));
}

}  // namespace hiac::formats::vtk
