#include "formats/vtk/xml/vtk_xml.hpp"

#include <memory>

#include <fmt/format.h>
#include <vtkDataSet.h>
#include <vtkSmartPointer.h>

#include "formats/common/mesh/field_steps.hpp"
#include "formats/common/mesh/gate.hpp"
#include "formats/common/mesh/steps.hpp"
#include "formats/common/pieces/merge_pieces.hpp"
#include "formats/common/pieces/piece_field.hpp"
#include "formats/vtk/from_vtk.hpp"
#include "formats/vtk/packed_dataset.hpp"
#include "formats/vtk/reading_process.hpp"
#include "formats/vtk/to_vtk.hpp"
#include "formats/vtk/vtk_formats.hpp"
#include "formats/vtk/xml/xml_layout.hpp"
#include "hiac/base/process/isolated_process.hpp"

namespace hiac::formats {
namespace vtk {
namespace {

/// A file that VTK reads in another process.
class XmlSource {
 public:
  XmlSource(const std::string& path, const std::string& type, const ReadOptions& options)
      : process_(reading_process()), path_(path), options_(options) {
    const XmlRequest request{type, options.step, options.time, options.nearest_time};
    const PackedAnswer answer = process_->answer(path, open_request(request));
    PackReader in(answer.bytes(), path);
    opened_ = unpack_opened(in);
  }

  [[nodiscard]] std::size_t piece_count() const { return opened_.pieces; }
  vtkSmartPointer<vtkDataSet> read_whole() { return dataset(whole_request()); }
  vtkSmartPointer<vtkDataSet> read_piece(std::size_t index) {
    return dataset(piece_request(index));
  }

  /// The options for the dataset; if the file declares its steps, the step has already been chosen.
  [[nodiscard]] ReadOptions dataset_options() const {
    ReadOptions options = options_;
    if (!opened_.times.empty()) options.step.reset();
    if (!opened_.times.empty()) options.time.reset();
    return options;
  }

  /// Adds the step's time and VTK's warnings.
  void complete(Reading& reading) const {
    add_notes(reading.notes);
    if (opened_.times.empty()) return;
    auto& metadata = reading.mesh.metadata;
    std::erase_if(metadata, [](const auto& entry) { return entry.first == "time"; });
    metadata.emplace_back("time", fmt::format("{}", opened_.times.at(opened_.step)));
    note_absent_fields(opened_.field_steps, opened_.times, opened_.step, reading.notes);
    if (!options_.step && !options_.time && opened_.times.size() > 1)
      reading.notes.push_back(last_step_note(opened_.times.size(), opened_.times.back()));
  }
  void complete(Inventory& inventory) const {
    add_notes(inventory.notes);
    if (opened_.times.empty()) return;
    inventory.times = opened_.times;
    note_partial_fields(opened_.field_steps, opened_.times.size(), inventory.notes);
  }

 private:
  void add_notes(std::vector<std::string>& notes) const {
    notes.insert(notes.end(), warnings_.begin(), warnings_.end());
    notes.insert(notes.end(), opened_.notes.begin(), opened_.notes.end());
  }
  vtkSmartPointer<vtkDataSet> dataset(const std::string& request) {
    PackedAnswer answer = process_->answer(path_, request);
    PackReader in(answer.bytes(), path_);
    vtkSmartPointer<vtkDataSet> dataset = unpack_dataset(in, answer);
    if (dataset == nullptr) in.fail();
    warnings_ = unpack_texts(in);
    return dataset;
  }

  std::shared_ptr<IsolatedProcess> process_;
  std::string path_;
  ReadOptions options_;
  OpenedXml opened_;
  std::vector<std::string> warnings_;
};

Reading read_structured(const std::string& path, const std::string& type,
                        const ReadOptions& options) {
  XmlSource file(path, type, options);
  const vtkSmartPointer<vtkDataSet> dataset = file.read_whole();
  Reading reading = mesh_from_vtk(dataset, file.dataset_options(), path);
  file.complete(reading);
  return reading;
}

Inventory inspect_structured(const std::string& path, const std::string& type) {
  XmlSource file(path, type, {});
  Inventory inventory = inventory_from_vtk(*file.read_whole(), path);
  file.complete(inventory);
  return inventory;
}

XmlReader structured_reader(const std::string& type) {
  return {[type](const std::string& path, const ReadOptions& options) {
            return read_structured(path, type, options);
          },
          [type](const std::string& path) { return inspect_structured(path, type); }};
}

Reading read_vtu(const std::string& path, const ReadOptions& options) {
  XmlSource file(path, "UnstructuredGrid", options);
  std::vector<Reading> pieces;
  const std::size_t count = file.piece_count();
  for (std::size_t p = 0; p < count; ++p) {
    const std::string subject = count == 1 ? path : fmt::format("{}: piece {}", path, p);
    pieces.push_back(mesh_from_vtk(file.read_piece(p), file.dataset_options(), subject));
    if (PieceMarking::is_on() && count > 1) mark_piece(pieces.back().mesh, p);
  }
  Reading reading = merge_pieces(std::move(pieces), path);
  file.complete(reading);
  return reading;
}

Inventory inspect_vtu(const std::string& path) {
  XmlSource file(path, "UnstructuredGrid", {});
  Inventory inventory = inventory_from_vtk(*file.read_whole(), path);
  inventory.format = "vtu";
  file.complete(inventory);
  return inventory;
}

}  // namespace

XmlReader xml_reader(std::string_view type) {
  if (type == "UnstructuredGrid") return {read_vtu, inspect_vtu};
  if (type == "StructuredGrid" || type == "ImageData" || type == "RectilinearGrid")
    return structured_reader(std::string(type));
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
