#include "formats/vtk/dataset_cells.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataSetAttributes.h>
#include <vtkImageData.h>
#include <vtkPointData.h>
#include <vtkRectilinearGrid.h>
#include <vtkStructuredGrid.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include "hiac/base/error.hpp"

namespace hiac::formats::vtk {
namespace {

vtkUnsignedCharArray* ghosts_of(vtkDataSetAttributes* attributes, std::size_t count,
                                const std::string& subject) {
  auto* ghosts = vtkUnsignedCharArray::SafeDownCast(
      attributes->GetArray(vtkDataSetAttributes::GhostArrayName()));
  if (ghosts != nullptr && (ghosts->GetNumberOfComponents() != 1 ||
                            static_cast<std::size_t>(ghosts->GetNumberOfTuples()) != count))
    throw InputError(subject, fmt::format("the ghost marks do not fit ({} expected, {} found)",
                                          count, ghosts->GetNumberOfValues()));
  return ghosts;
}

std::array<std::size_t, 3> dimensions_of(vtkDataSet& dataset) {
  std::array<int, 3> dimensions{};
  if (auto* grid = vtkStructuredGrid::SafeDownCast(&dataset))
    grid->GetDimensions(dimensions.data());
  else if (auto* image = vtkImageData::SafeDownCast(&dataset))
    image->GetDimensions(dimensions.data());
  else if (auto* rectilinear = vtkRectilinearGrid::SafeDownCast(&dataset))
    rectilinear->GetDimensions(dimensions.data());
  std::array<std::size_t, 3> result{};
  for (std::size_t c = 0; c < 3; ++c) result[c] = static_cast<std::size_t>(dimensions[c]);
  return result;
}

std::int64_t integer_at(vtkDataArray* array, bool wide, std::size_t index) {
  const auto i = static_cast<vtkIdType>(index);
  return wide ? static_cast<vtkTypeInt64Array*>(array)->GetValue(i)
              : static_cast<vtkTypeInt32Array*>(array)->GetValue(i);
}

}  // namespace

DatasetCells::DatasetCells(vtkDataSet& dataset, std::string subject)
    : subject_(std::move(subject)), points_(static_cast<std::size_t>(dataset.GetNumberOfPoints())) {
  if (auto* grid = vtkUnstructuredGrid::SafeDownCast(&dataset)) {
    open_unstructured(*grid);
  } else {
    dimensions_ = dimensions_of(dataset);
    count_ = 1;
    for (const std::size_t n : dimensions_) count_ *= n > 0 ? n - 1 : 0;
    buffer_.resize(8);
  }
  cell_ghosts_ = ghosts_of(dataset.GetCellData(), count_, subject_);
  point_ghosts_ = ghosts_of(dataset.GetPointData(), points_, subject_);
}

void DatasetCells::open_unstructured(vtkUnstructuredGrid& grid) {
  vtkCellArray* cells = grid.GetCells();
  types_ = grid.GetCellTypesArray();
  if (cells == nullptr || types_ == nullptr || types_->GetNumberOfTuples() == 0) return;
  count_ = static_cast<std::size_t>(types_->GetNumberOfTuples());
  wide_ = cells->IsStorage64Bit();
  offsets_ = cells->GetOffsetsArray();
  connectivity_ = cells->GetConnectivityArray();
  if (static_cast<std::size_t>(offsets_->GetNumberOfTuples()) != count_ + 1)
    throw InputError(subject_, fmt::format("the cell types do not fit the cells ({} expected, {} "
                                           "found)",
                                           offsets_->GetNumberOfTuples() - 1, count_));
}

std::size_t DatasetCells::entry_count() const {
  if (connectivity_ != nullptr) return static_cast<std::size_t>(connectivity_->GetNumberOfTuples());
  return dimensions_[0] == 0 ? 0 : 8 * count_;
}

StoredCell DatasetCells::cell(std::size_t index) {
  return types_ != nullptr ? unstructured_cell(index) : structured_cell(index);
}

StoredCell DatasetCells::unstructured_cell(std::size_t index) {
  const std::int64_t begin = integer_at(offsets_, wide_, index);
  const std::int64_t end = integer_at(offsets_, wide_, index + 1);
  const auto entries = static_cast<std::int64_t>(connectivity_->GetNumberOfTuples());
  if (begin < 0 || end < begin || end > entries)
    throw InputError(subject_, fmt::format("cell {}: wrong offsets (0 to {} in rising order "
                                           "expected, {} and {} found)",
                                           index, entries, begin, end));
  const int type = types_->GetValue(static_cast<vtkIdType>(index));
  buffer_.clear();
  if (type == VTK_POLYHEDRON) return {type, {}};
  for (std::int64_t i = begin; i < end; ++i) {
    const std::int64_t point = integer_at(connectivity_, wide_, static_cast<std::size_t>(i));
    if (point < 0 || static_cast<std::uint64_t>(point) >= points_)
      throw InputError(subject_, fmt::format("cell {}: no such point (0 to {} expected, {} found)",
                                             index, static_cast<std::int64_t>(points_) - 1, point));
    buffer_.push_back(point);
  }
  return {type, buffer_};
}

StoredCell DatasetCells::structured_cell(std::size_t index) {
  const std::size_t nx = dimensions_[0];
  const std::size_t ny = dimensions_[1];
  const std::size_t i = index % (nx - 1);
  const std::size_t j = index / (nx - 1) % (ny - 1);
  const std::size_t k = index / ((nx - 1) * (ny - 1));
  const std::size_t corner = (k * ny + j) * nx + i;
  const std::array<std::size_t, 4> bottom{corner, corner + 1, corner + nx + 1, corner + nx};
  for (std::size_t n = 0; n < 4; ++n) {
    buffer_[n] = static_cast<vtkIdType>(bottom[n]);
    buffer_[n + 4] = static_cast<vtkIdType>(bottom[n] + nx * ny);
  }
  return {VTK_HEXAHEDRON, buffer_};
}

bool DatasetCells::is_ghost(std::size_t index) const {
  constexpr unsigned kNotHere = vtkDataSetAttributes::DUPLICATECELL |
                                vtkDataSetAttributes::REFINEDCELL |
                                vtkDataSetAttributes::HIDDENCELL;
  return cell_ghosts_ != nullptr &&
         (cell_ghosts_->GetValue(static_cast<vtkIdType>(index)) & kNotHere) != 0;
}

bool DatasetCells::has_hidden_point(std::span<const vtkIdType> points) const {
  if (point_ghosts_ == nullptr) return false;
  for (const vtkIdType point : points)
    if ((point_ghosts_->GetValue(point) & vtkDataSetAttributes::HIDDENPOINT) != 0) return true;
  return false;
}

}  // namespace hiac::formats::vtk
