#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <vtkCellType.h>
#include <vtkSmartPointer.h>
#include <vtkType.h>

class vtkDataArray;
class vtkDataSet;
class vtkUnsignedCharArray;
class vtkUnstructuredGrid;

namespace hiac::formats::vtk {

/// One cell of a dataset as it is stored.
struct StoredCell {
  int type;
  std::span<const vtkIdType> points;
};

/// The cells of an unstructured grid, or of a structured one as hexahedra, one after the other.
/// Reads only arrays: no VTK cell is created, so a damaged grid cannot mislead VTK.
class DatasetCells {
 public:
  /// Throws InputError(subject, ...) when the arrays do not fit each other.
  DatasetCells(vtkDataSet& dataset, std::string subject);

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::size_t point_count() const { return points_; }
  /// The number of entries of all cells together.
  [[nodiscard]] std::size_t entry_count() const;

  /// The cell with that number; its points are valid until the next call, and exist. For a
  /// polyhedron only the type is set.
  StoredCell cell(std::size_t index);

  /// Whether the cell is a duplicate (ghost), refined away or hidden.
  [[nodiscard]] bool is_ghost(std::size_t index) const;
  /// Whether one of these points is hidden (blanked).
  [[nodiscard]] bool has_hidden_point(std::span<const vtkIdType> points) const;

 private:
  void open_unstructured(vtkUnstructuredGrid& grid);
  StoredCell unstructured_cell(std::size_t index);
  StoredCell structured_cell(std::size_t index);

  std::string subject_;
  std::size_t count_ = 0;
  std::size_t points_ = 0;
  vtkDataArray* offsets_ = nullptr;
  vtkDataArray* connectivity_ = nullptr;
  vtkUnsignedCharArray* types_ = nullptr;
  vtkUnsignedCharArray* cell_ghosts_ = nullptr;
  vtkUnsignedCharArray* point_ghosts_ = nullptr;
  bool wide_ = false;  ///< 64-bit offsets and connectivity
  std::array<std::size_t, 3> dimensions_{};
  std::vector<vtkIdType> buffer_;
};

}  // namespace hiac::formats::vtk
