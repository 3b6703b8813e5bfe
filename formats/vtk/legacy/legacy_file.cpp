#include "formats/vtk/legacy/legacy_file.hpp"

#include <memory>

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkRectilinearGrid.h>
#include <vtkRectilinearGridReader.h>
#include <vtkStructuredGrid.h>
#include <vtkStructuredGridReader.h>
#include <vtkStructuredPoints.h>
#include <vtkStructuredPointsReader.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridReader.h>

#include "formats/common/io/mapped_file.hpp"
#include "formats/vtk/legacy/legacy_layout.hpp"
#include "formats/vtk/legacy/legacy_names.hpp"
#include "formats/vtk/legacy/legacy_values.hpp"
#include "formats/vtk/message_capture.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats::vtk {
namespace {

template <typename Reader, typename Dataset>
vtkSmartPointer<vtkDataSet> read_with(const std::string& path) {
  vtkNew<Reader> reader;
  reader->ReadAllScalarsOn();
  reader->ReadAllVectorsOn();
  reader->ReadAllNormalsOn();
  reader->ReadAllTensorsOn();
  reader->ReadAllColorScalarsOn();
  reader->ReadAllTCoordsOn();
  reader->ReadAllFieldsOn();
  auto dataset = vtkSmartPointer<Dataset>::New();
  // bypasses the pipeline, whose search for the dimensions mistakes data for keywords
  reader->ReadMeshSimple(path, dataset);
  return dataset;
}

vtkSmartPointer<vtkDataSet> read_dataset(const std::string& path, LegacyLayout::Dataset dataset) {
  switch (dataset) {
    case LegacyLayout::Dataset::unstructured_grid:
      return read_with<vtkUnstructuredGridReader, vtkUnstructuredGrid>(path);
    case LegacyLayout::Dataset::structured_grid:
      return read_with<vtkStructuredGridReader, vtkStructuredGrid>(path);
    case LegacyLayout::Dataset::structured_points:
      return read_with<vtkStructuredPointsReader, vtkStructuredPoints>(path);
    case LegacyLayout::Dataset::rectilinear_grid:
      return read_with<vtkRectilinearGridReader, vtkRectilinearGrid>(path);
  }
  return nullptr;
}

/// C++ streams do not read "nan" and "inf", and so VTK's reader stops there, also in an array that
/// a later one replaces. It gets a copy with zeros in their places; afterwards the values are
/// restored.
std::unique_ptr<MemoryFile> without_not_finite(std::string_view text, const LegacyLayout& layout,
                                               const std::string& subject) {
  std::unique_ptr<MemoryFile> copy;
  for (const LegacyArray& array : layout.attributes) {
    if (!array.has_not_finite) continue;
    if (!copy) copy = std::make_unique<MemoryFile>(text, subject);
    for_each_not_finite(text, array.begin, array.end,
                        [&](const NotFiniteWord& word) { copy->put_zero(word.at, word.length); });
  }
  return copy;
}

vtkDataArray* array_read_as(const LegacyArray& array, vtkDataSet& dataset) {
  vtkDataSetAttributes* data = array.on_points
                                   ? static_cast<vtkDataSetAttributes*>(dataset.GetPointData())
                                   : dataset.GetCellData();
  return data->GetArray(array.read_as.c_str());
}

void restore_not_finite(std::string_view text, const LegacyArray& array, vtkDataSet& dataset,
                        const std::string& subject) {
  vtkDataArray* read = array_read_as(array, dataset);
  if (read == nullptr || static_cast<std::size_t>(read->GetNumberOfTuples()) != array.tuples ||
      static_cast<std::size_t>(read->GetNumberOfComponents()) != array.components)
    throw InputError(subject, fmt::format("array '{}' was not read whole", array.name));
  for_each_not_finite(text, array.begin, array.end, [&](const NotFiniteWord& word) {
    read->SetComponent(static_cast<vtkIdType>(word.index / array.components),
                       static_cast<int>(word.index % array.components), word.value);
  });
}

}  // namespace

LegacyDataset read_legacy_file(const std::string& path) {
  const MappedFile file(path);
  LegacyLayout layout = check_legacy_file(file.text(), path);
  name_arrays(layout, path);
  const std::unique_ptr<MemoryFile> copy = without_not_finite(file.text(), layout, path);
  const MessageCapture messages;
  LegacyDataset result{read_dataset(copy ? copy->path() : path, layout.dataset), layout.title,
                       std::move(layout.notes)};
  messages.throw_on_error(path);
  const auto points = static_cast<std::size_t>(result.dataset->GetNumberOfPoints());
  const auto cells = static_cast<std::size_t>(result.dataset->GetNumberOfCells());
  if (points != layout.points || cells != layout.cells)
    throw InputError(path, fmt::format("was not read whole ({} points and {} cells expected, {} "
                                       "and {} found)",
                                       layout.points, layout.cells, points, cells));
  for (const LegacyArray& array : layout.attributes)
    if (array.has_not_finite && !array.replaced)
      restore_not_finite(file.text(), array, *result.dataset, path);
  for (std::string& warning : messages.warnings()) result.notes.push_back(std::move(warning));
  return result;
}

}  // namespace hiac::formats::vtk
