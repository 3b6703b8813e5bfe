#include "formats/vtk/xml/vtk_xml.hpp"

#include <algorithm>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkDataArraySelection.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLRectilinearGridReader.h>
#include <vtkXMLStructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "formats/common/io/mapped_file.hpp"
#include "formats/common/mesh/gate.hpp"
#include "formats/common/mesh/merge_pieces.hpp"
#include "formats/common/mesh/steps.hpp"
#include "formats/vtk/from_vtk.hpp"
#include "formats/vtk/legacy/legacy_values.hpp"
#include "formats/vtk/message_capture.hpp"
#include "formats/vtk/to_vtk.hpp"
#include "formats/vtk/vtk_formats.hpp"
#include "formats/vtk/xml/xml_layout.hpp"
#include "formats/vtk/xml/xml_steps.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats {
namespace vtk {
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

/// A checked XML file and VTK's reader of it.
class XmlFile {
 public:
  XmlFile(const std::string& path, const std::string& type, vtkXMLDataReader& reader,
          const ReadOptions& options)
      : path_(path),
        file_(path),
        step_(xml_step(file_.text(), type, options, path)),
        layout_(check_xml_file(text(), type, path)),
        reader_(reader),
        options_(options) {
    if (step_) copy_ = std::make_unique<MemoryFile>(text(), path_);
    hide_not_finite();
    reader_.SetFileName(copy_ ? copy_->path().c_str() : path_.c_str());
    reader_.UpdateInformation();
    messages_.throw_on_error(path_);
    disable_texts(*reader_.GetPointDataArraySelection(), layout_.pieces.front().point_data);
    disable_texts(*reader_.GetCellDataArraySelection(), layout_.pieces.front().cell_data);
  }

  [[nodiscard]] const XmlLayout& layout() const { return layout_; }

  /// The whole dataset.
  vtkSmartPointer<vtkDataSet> read_whole() {
    reader_.Update();
    vtkSmartPointer<vtkDataSet> dataset = reader_.GetOutputAsDataSet();
    check_read(dataset, layout_.points, layout_.cells);
    if (layout_.pieces.size() == 1) {
      restore_not_finite(layout_.pieces.front(), *dataset, 0, 0);
    } else {
      for (const XmlPiece& piece : layout_.pieces)
        for_each_not_finite_array(piece, [&](const XmlArray& array, bool) {
          throw InputError(path_, fmt::format("array '{}': values that are not finite cannot be "
                                              "read from several pieces",
                                              array.name));
        });
    }
    return dataset;
  }

  /// All pieces of an unstructured grid in one dataset.
  vtkSmartPointer<vtkDataSet> read_all_pieces() {
    reader_.Update();
    vtkSmartPointer<vtkDataSet> dataset = reader_.GetOutputAsDataSet();
    check_read(dataset, layout_.points, layout_.cells);
    std::size_t points = 0;
    std::size_t cells = 0;
    for (const XmlPiece& piece : layout_.pieces) {
      restore_not_finite(piece, *dataset, points, cells);
      points += piece.points;
      cells += piece.cells;
    }
    return dataset;
  }

  /// One piece of an unstructured grid.
  vtkSmartPointer<vtkDataSet> read_piece(std::size_t index) {
    const XmlPiece& piece = layout_.pieces[index];
    reader_.UpdatePiece(static_cast<int>(index), static_cast<int>(layout_.pieces.size()), 0);
    auto dataset = vtkSmartPointer<vtkUnstructuredGrid>::New();
    dataset->ShallowCopy(reader_.GetOutputAsDataSet());
    // the reader must not keep references to data that are converted and released
    reader_.GetOutputAsDataSet()->Initialize();
    check_read(dataset, piece.points, piece.cells);
    restore_not_finite(piece, *dataset, 0, 0);
    return dataset;
  }

  /// The options for the dataset; if the file declares its steps, the step has already been chosen.
  [[nodiscard]] ReadOptions dataset_options() const {
    ReadOptions options = options_;
    if (step_) options.step.reset();
    if (step_) options.time.reset();
    return options;
  }

  /// Adds the step's time and VTK's warnings.
  void complete(Reading& reading) const {
    add_warnings(reading.notes);
    if (!step_) return;
    auto& metadata = reading.mesh.metadata;
    std::erase_if(metadata, [](const auto& entry) { return entry.first == "time"; });
    metadata.emplace_back("time", fmt::format("{}", step_->times[step_->step]));
    if (!options_.step && !options_.time && step_->times.size() > 1)
      reading.notes.push_back(last_step_note(step_->times.size(), step_->times.back()));
  }
  void complete(Inventory& inventory) const {
    add_warnings(inventory.notes);
    if (step_) inventory.times = step_->times;
  }

 private:
  void add_warnings(std::vector<std::string>& notes) const {
    for (std::string& warning : messages_.warnings()) notes.push_back(std::move(warning));
  }

  /// The text of the file, reduced to one step if it has several.
  [[nodiscard]] std::string_view text() const { return step_ ? step_->text : file_.text(); }

  static void disable_texts(vtkDataArraySelection& selection, const Arrays& arrays) {
    for (const XmlArray& array : arrays)
      if (array.type.family == NumberType::Family::text) selection.DisableArray(array.name.c_str());
  }

  void check_read(vtkDataSet* dataset, std::size_t points, std::size_t cells) const {
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

  /// The position of an array's text in the file.
  [[nodiscard]] std::size_t place_of(const XmlArray& array) const {
    return static_cast<std::size_t>(array.data.data() - text().data());
  }

  /// C++ streams do not read "nan" and "inf", and so VTK's reader stops there. It gets a copy with
  /// zeros in their places; afterwards the values are restored.
  void hide_not_finite() {
    for (const XmlPiece& piece : layout_.pieces)
      for_each_not_finite_array(piece, [&](const XmlArray& array, bool) {
        if (!copy_) copy_ = std::make_unique<MemoryFile>(text(), path_);
        for_each_not_finite(array.data, 0, array.data.size(), [&](const NotFiniteWord& word) {
          copy_->put_zero(place_of(array) + word.at, word.length);
        });
      });
  }

  /// `first_point`, `first_cell`: where the piece begins in the dataset.
  void restore_not_finite(const XmlPiece& piece, vtkDataSet& dataset, std::size_t first_point,
                          std::size_t first_cell) const {
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

  MessageCapture messages_;  // first: checking the layout decompresses with VTK
  std::string path_;
  MappedFile file_;
  std::optional<XmlStep> step_;
  XmlLayout layout_;
  vtkXMLDataReader& reader_;
  ReadOptions options_;
  std::unique_ptr<MemoryFile> copy_;
};

template <typename Reader>
Reading read_structured(const std::string& path, const std::string& type,
                        const ReadOptions& options) {
  vtkNew<Reader> reader;
  XmlFile file(path, type, *reader, options);
  const vtkSmartPointer<vtkDataSet> dataset = file.read_whole();
  Reading reading = mesh_from_vtk(dataset, file.dataset_options(), path);
  file.complete(reading);
  return reading;
}

template <typename Reader>
Inventory inspect_structured(const std::string& path, const std::string& type) {
  vtkNew<Reader> reader;
  XmlFile file(path, type, *reader, {});
  Inventory inventory = inventory_from_vtk(*file.read_whole(), path);
  file.complete(inventory);
  return inventory;
}

template <typename Reader>
XmlReader structured_reader(const std::string& type) {
  return {[type](const std::string& path, const ReadOptions& options) {
            return read_structured<Reader>(path, type, options);
          },
          [type](const std::string& path) { return inspect_structured<Reader>(path, type); }};
}

Reading read_vtu(const std::string& path, const ReadOptions& options) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  XmlFile file(path, "UnstructuredGrid", *reader, options);
  std::vector<Reading> pieces;
  const std::size_t count = file.layout().pieces.size();
  for (std::size_t p = 0; p < count; ++p) {
    const std::string subject = count == 1 ? path : fmt::format("{}: piece {}", path, p);
    pieces.push_back(mesh_from_vtk(file.read_piece(p), file.dataset_options(), subject));
  }
  Reading reading = merge_pieces(std::move(pieces), path);
  file.complete(reading);
  return reading;
}

Inventory inspect_vtu(const std::string& path) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  XmlFile file(path, "UnstructuredGrid", *reader, {});
  Inventory inventory = inventory_from_vtk(*file.read_all_pieces(), path);
  inventory.format = "vtu";
  file.complete(inventory);
  return inventory;
}

}  // namespace

XmlReader xml_reader(std::string_view type) {
  if (type == "UnstructuredGrid") return {read_vtu, inspect_vtu};
  if (type == "StructuredGrid")
    return structured_reader<vtkXMLStructuredGridReader>("StructuredGrid");
  if (type == "ImageData") return structured_reader<vtkXMLImageDataReader>("ImageData");
  if (type == "RectilinearGrid")
    return structured_reader<vtkXMLRectilinearGridReader>("RectilinearGrid");
  return {};
}

}  // namespace vtk

namespace {

/// The common part of the three structured XML formats.
Format structured_format(std::string_view name, std::string_view extension,
                         const std::string& type) {
  Format format;
  format.name = name;
  format.extensions = {extension};
  format.kinds = "brick8";
  format.fields = "node, cell";
  format.time_steps = "several";
  format.recognizes = [type](std::string_view head) { return vtk::xml_file_type(head) == type; };
  const vtk::XmlReader reader = vtk::xml_reader(type);
  format.read = [reader](const std::string& path, const ReadOptions& options) {
    Reading reading = reader.read(path, options);
    finish_reading(reading, path);
    return reading;
  };
  format.inspect = [reader, name](const std::string& path) {
    Inventory inventory = reader.inspect(path);
    inventory.format = name;
    return inventory;
  };
  return format;
}

}  // namespace

Format vtu_format() {
  Format format;
  format.name = "vtu";
  format.extensions = {".vtu"};
  format.kinds = "tet4-20 pyr5,13 prism6,15 wedge7 brick8,20";
  format.fields = "node, cell";
  format.time_steps = "several";
  format.recognizes = [](std::string_view head) {
    return vtk::xml_file_type(head) == "UnstructuredGrid";
  };
  const vtk::XmlReader reader = vtk::xml_reader("UnstructuredGrid");
  format.read = [reader](const std::string& path, const ReadOptions& options) {
    Reading reading = reader.read(path, options);
    finish_reading(reading, path);
    return reading;
  };
  format.inspect = reader.inspect;
  format.write = vtk::write_vtu;
  return format;
}

Format vts_format() { return structured_format("vts", ".vts", "StructuredGrid"); }
Format vti_format() { return structured_format("vti", ".vti", "ImageData"); }
Format vtr_format() { return structured_format("vtr", ".vtr", "RectilinearGrid"); }

}  // namespace hiac::formats
