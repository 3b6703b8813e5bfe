#include "formats/vtk/xml/xml_file.hpp"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkDataArraySelection.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLRectilinearGridReader.h>
#include <vtkXMLStructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "formats/vtk/legacy/legacy_values.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats::vtk {
namespace {

using Arrays = std::vector<XmlArray>;

/// Calls `use(array, on_points)` for the ASCII arrays of a piece that have values that are not
/// finite.
template <typename Use>
void for_each_not_finite_array(const XmlPiece& piece, const Use& use) {
  for (const XmlArray& array : piece.point_data)
    if (array.has_not_finite) use(array, true);
  for (const XmlArray& array : piece.cell_data)
    if (array.has_not_finite) use(array, false);
}

void disable_texts(vtkDataArraySelection& selection, const Arrays& arrays) {
  for (const XmlArray& array : arrays)
    if (array.type.family == NumberType::Family::text) selection.DisableArray(array.name.c_str());
}

vtkSmartPointer<vtkXMLDataReader> new_reader(const std::string& type) {
  if (type == "StructuredGrid") return vtkSmartPointer<vtkXMLStructuredGridReader>::New();
  if (type == "ImageData") return vtkSmartPointer<vtkXMLImageDataReader>::New();
  if (type == "RectilinearGrid") return vtkSmartPointer<vtkXMLRectilinearGridReader>::New();
  return vtkSmartPointer<vtkXMLUnstructuredGridReader>::New();
}

}  // namespace

XmlFile::XmlFile(const std::string& path, const std::string& type, const ReadOptions& options)
    : path_(path),
      file_(path),
      step_(xml_step(file_.text(), type, options, path)),
      layout_(check_xml_file(text(), type, path)),
      reader_(new_reader(type)) {
  if (step_) copy();
  hide_replaced();
  hide_not_finite();
  reader_->SetFileName(copy_ ? copy_->path().c_str() : path_.c_str());
  reader_->UpdateInformation();
  messages_.throw_on_error(path_);
  disable_texts(*reader_->GetPointDataArraySelection(), layout_.pieces.front().point_data);
  disable_texts(*reader_->GetCellDataArraySelection(), layout_.pieces.front().cell_data);
}

XmlFile::~XmlFile() = default;

/// A dataset of its own: the reader keeps no references to what is converted and released.
vtkSmartPointer<vtkDataSet> XmlFile::take_output() {
  vtkDataSet* const output = reader_->GetOutputAsDataSet();
  if (output == nullptr) return nullptr;
  auto dataset = vtkSmartPointer<vtkDataSet>::Take(output->NewInstance());
  dataset->ShallowCopy(output);
  output->Initialize();
  return dataset;
}

vtkSmartPointer<vtkDataSet> XmlFile::read_whole() {
  if (layout_.type != "UnstructuredGrid" && layout_.pieces.size() > 1) require_finite();
  reader_->Update();
  vtkSmartPointer<vtkDataSet> dataset = take_output();
  check_read(dataset, layout_.points, layout_.cells);
  if (layout_.type != "UnstructuredGrid" && layout_.pieces.size() > 1) return dataset;
  std::size_t points = 0;
  std::size_t cells = 0;
  for (const XmlPiece& piece : layout_.pieces) {
    restore_not_finite(piece, *dataset, points, cells);
    points += piece.points;
    cells += piece.cells;
  }
  return dataset;
}

vtkSmartPointer<vtkDataSet> XmlFile::read_piece(std::size_t index) {
  const XmlPiece& piece = layout_.pieces.at(index);
  reader_->UpdatePiece(static_cast<int>(index), static_cast<int>(layout_.pieces.size()), 0);
  vtkSmartPointer<vtkDataSet> dataset = take_output();
  check_read(dataset, piece.points, piece.cells);
  restore_not_finite(piece, *dataset, 0, 0);
  return dataset;
}

/// The text of the file, reduced to one step if it has several.
std::string_view XmlFile::text() const { return step_ ? step_->text : file_.text(); }

void XmlFile::check_read(vtkDataSet* dataset, std::size_t points, std::size_t cells) const {
  messages_.throw_on_error(path_);
  const auto found_points =
      dataset == nullptr ? 0 : static_cast<std::size_t>(dataset->GetNumberOfPoints());
  const auto found_cells =
      dataset == nullptr ? 0 : static_cast<std::size_t>(dataset->GetNumberOfCells());
  if (dataset == nullptr || found_points != points || found_cells != cells)
    throw InputError(path_, fmt::format("was not read whole ({} points and {} cells expected, {} "
                                        "and {} found)",
                                        points, cells, found_points, found_cells));
}

/// The position of a part of the text in the file.
std::size_t XmlFile::place_of(std::string_view part) const {
  return static_cast<std::size_t>(part.data() - text().data());
}

/// The copy of the file that VTK reads in its place.
MemoryFile& XmlFile::copy() {
  if (!copy_) copy_ = std::make_unique<MemoryFile>(text(), path_);
  return *copy_;
}

void XmlFile::hide_replaced() {
  for (const std::string_view element : layout_.replaced)
    copy().put_blanks(place_of(element), element.size());
}

/// C++ streams do not read "nan" and "inf", and so VTK's reader stops there. It gets a copy with
/// zeros in their places; afterwards the values are restored.
void XmlFile::hide_not_finite() {
  for (const XmlPiece& piece : layout_.pieces)
    for_each_not_finite_array(piece, [&](const XmlArray& array, bool) {
      for_each_not_finite(array.data, 0, array.data.size(), [&](const NotFiniteWord& word) {
        copy().put_zero(place_of(array.data) + word.at, word.length);
      });
    });
}

/// `first_point`, `first_cell`: where the piece begins in the dataset.
void XmlFile::restore_not_finite(const XmlPiece& piece, vtkDataSet& dataset,
                                 std::size_t first_point, std::size_t first_cell) const {
  for_each_not_finite_array(piece, [&](const XmlArray& array, bool on_points) {
    vtkDataSetAttributes* data = on_points
                                     ? static_cast<vtkDataSetAttributes*>(dataset.GetPointData())
                                     : dataset.GetCellData();
    vtkDataArray* read = data->GetArray(array.name.c_str());
    const std::size_t tuples = on_points ? piece.points : piece.cells;
    const std::size_t first = on_points ? first_point : first_cell;
    if (read == nullptr || static_cast<std::size_t>(read->GetNumberOfTuples()) < first + tuples ||
        static_cast<std::size_t>(read->GetNumberOfComponents()) != array.components)
      throw InputError(path_, fmt::format("array '{}' was not read whole", array.name));
    for_each_not_finite(array.data, 0, array.data.size(), [&](const NotFiniteWord& word) {
      if (word.index >= tuples * array.components) return;
      read->SetComponent(static_cast<vtkIdType>(first + word.index / array.components),
                         static_cast<int>(word.index % array.components), word.value);
    });
  });
}

/// The pieces of a structured grid lie in each other: no place of one is known in the whole.
void XmlFile::require_finite() const {
  for (const XmlPiece& piece : layout_.pieces)
    for_each_not_finite_array(piece, [&](const XmlArray& array, bool) {
      throw InputError(path_, fmt::format("array '{}': values that are not finite cannot be read "
                                          "from several pieces",
                                          array.name));
    });
}

}  // namespace hiac::formats::vtk
