#include "formats/vtk/foreign_from_vtk.hpp"

#include <array>

#include <fmt/format.h>
#include <vtkDataSet.h>
#include <vtkIdTypeArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include "formats/vtk/cell_types.hpp"
#include "formats/vtk/dataset_cells.hpp"
#include "formats/vtk/fields_from_vtk.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats::vtk {
namespace {

using Faces = std::vector<std::vector<std::int64_t>>;

/// The faces of prisms over a polygon with `sides` corners.
Faces faces_of_prism(std::span<const vtkIdType> points, std::size_t sides) {
  Faces faces(2);
  for (std::size_t i = 0; i < sides; ++i) {
    const std::size_t j = (i + 1) % sides;
    faces[0].push_back(points[i]);
    faces[1].push_back(points[sides + i]);
    faces.push_back({points[i], points[j], points[sides + j], points[sides + i]});
  }
  return faces;
}

class Converter {
 public:
  Converter(vtkDataSet& dataset, const std::string& subject)
      : dataset_(dataset), subject_(subject), cells_(dataset, subject) {}

  ForeignMesh run() {
    mesh_.xyz.resize(3 * cells_.point_count());
    for (std::size_t p = 0; p < cells_.point_count(); ++p)
      dataset_.GetPoint(static_cast<vtkIdType>(p), &mesh_.xyz[3 * p]);
    std::size_t ghosts = 0;
    for (std::size_t i = 0; i < cells_.count(); ++i) {
      const StoredCell cell = cells_.cell(i);
      if (cells_.is_ghost(i) || cells_.has_hidden_point(cell.points)) {
        ++ghosts;
        mesh_.cell_types.push_back(mesh_.type_place("ghost or hidden cell", 0, kNoVolume));
      } else {
        add(i, cell);
      }
    }
    if (ghosts > 0) mesh_.notes.push_back(fmt::format("dropped {} ghost or hidden cells", ghosts));
    add_fields();
    return std::move(mesh_);
  }

 private:
  void add(std::size_t index, const StoredCell& cell) {
    const std::string name = cell_type_name(cell.type);
    if (cell.type == VTK_POLYHEDRON) return mesh_.add_polyhedron(name, faces_of(index));
    if (cell.type == VTK_PENTAGONAL_PRISM && cell.points.size() == 10)
      return mesh_.add_polyhedron(name, faces_of_prism(cell.points, 5));
    if (cell.type == VTK_HEXAGONAL_PRISM && cell.points.size() == 12)
      return mesh_.add_polyhedron(name, faces_of_prism(cell.points, 6));
    mesh_.cell_types.push_back(
        mesh_.type_place(name, cell.points.size(), conversion_of(cell.type, cell.points.size())));
    mesh_.cell_nodes.insert(mesh_.cell_nodes.end(), cell.points.begin(), cell.points.end());
  }

  /// Checks every number in VTK's list of faces against the list's length and the number of points.
  [[nodiscard]] Faces faces_of(std::size_t index) const {
    auto* grid = vtkUnstructuredGrid::SafeDownCast(&dataset_);
    vtkIdTypeArray* list = grid == nullptr ? nullptr : grid->GetFaces();
    vtkIdTypeArray* places = grid == nullptr ? nullptr : grid->GetFaceLocations();
    const auto damaged = [&] {
      return InputError(subject_,
                        fmt::format("cell {}: a polyhedron with a damaged list of faces", index));
    };
    if (list == nullptr || places == nullptr ||
        places->GetNumberOfValues() <= static_cast<vtkIdType>(index))
      throw damaged();
    vtkIdType at = places->GetValue(static_cast<vtkIdType>(index));
    const auto next = [&](vtkIdType limit) {
      if (at < 0 || at >= list->GetNumberOfValues()) throw damaged();
      const vtkIdType value = list->GetValue(at++);
      if (value < 0 || value > limit) throw damaged();
      return value;
    };
    Faces faces;
    const vtkIdType all = list->GetNumberOfValues();
    for (vtkIdType f = next(all); f > 0; --f) {
      std::vector<std::int64_t> face;
      for (vtkIdType n = next(all); n > 0; --n)
        face.push_back(next(static_cast<vtkIdType>(cells_.point_count()) - 1));
      faces.push_back(std::move(face));
    }
    return faces;
  }

  void add_fields() {
    ZooMesh fields;
    add_metadata(*dataset_.GetFieldData(), fields, mesh_.notes);
    mesh_.metadata = std::move(fields.metadata);
    move_fields(dataset_, {cells_.point_count(), true, {}}, {cells_.count(), true, {}}, subject_,
                fields, mesh_.notes);
    for (Field& field : fields.fields) {
      const std::span<const double> values = field.values.view();
      mesh_.fields.push_back(field_of(field.name, field.location, field.components,
                                      std::vector<double>(values.begin(), values.end())));
      mesh_.fields.back().unit = field.unit;
    }
  }

  vtkDataSet& dataset_;
  const std::string& subject_;
  DatasetCells cells_;
  ForeignMesh mesh_;
};

}  // namespace

bool has_cells_beyond_the_zoo(vtkDataSet& dataset, const std::string& subject) {
  auto* grid = vtkUnstructuredGrid::SafeDownCast(&dataset);
  if (grid == nullptr || grid->GetCellTypesArray() == nullptr) return false;
  // most types are supported with any number of nodes or left out: their cells need no check
  constexpr std::size_t kMany = 1000;
  std::array<bool, 256> suspect{};
  for (std::size_t type = 0; type < suspect.size(); ++type)
    suspect[type] = conversion_of(static_cast<int>(type), kMany).fate == CellFate::unsupported;
  DatasetCells cells(dataset, subject);
  const unsigned char* types = grid->GetCellTypesArray()->GetPointer(0);
  for (std::size_t i = 0; i < cells.count(); ++i) {
    if (!suspect[types[i]]) continue;
    const StoredCell cell = cells.cell(i);
    if (conversion_of(cell.type, cell.points.size()).fate == CellFate::unsupported) return true;
  }
  return false;
}

ForeignMesh foreign_from_vtk(vtkDataSet& dataset, const std::string& subject) {
  return Converter(dataset, subject).run();
}

}  // namespace hiac::formats::vtk
