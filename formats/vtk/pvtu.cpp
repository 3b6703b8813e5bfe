#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "formats/gate.hpp"
#include "formats/mapped_file.hpp"
#include "formats/merge_pieces.hpp"
#include "formats/vtk/from_vtk.hpp"
#include "formats/vtk/vtk_formats.hpp"
#include "formats/vtk/vtk_xml.hpp"
#include "formats/vtk/xml_layout.hpp"
#include "formats/vtk/xml_text.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats {
namespace {

/// The paths of the pieces that a .pvtu file names, relative to it.
std::vector<std::string> piece_paths(const std::string& path) {
  const MappedFile file(path);
  const vtk::XmlText text(file.text(), "PUnstructuredGrid", path);
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  std::vector<std::string> paths;
  for (const pugi::xml_node piece : text.primary().children("Piece")) {
    const std::string source = piece.attribute("Source").as_string();
    if (source.empty()) text.fail("a piece without a Source");
    paths.push_back((folder / source).string());
  }
  if (paths.empty()) text.fail("names no pieces");
  return paths;
}

Reading read_mesh(const std::string& path, const ReadOptions& options) {
  std::vector<Reading> pieces;
  for (const std::string& piece : piece_paths(path))
    pieces.push_back(vtk::read_vtu(piece, options));
  const std::size_t count = pieces.size();
  Reading reading = merge_pieces(std::move(pieces), path);
  finish_reading(reading, path);
  reading.mesh.metadata.emplace_back("pieces", fmt::format("{}", count));
  return reading;
}

void add_cells(Inventory& all, const Inventory& piece) {
  for (const CellCount& cells : piece.cells) {
    const auto known =
        std::find_if(all.cells.begin(), all.cells.end(), [&](const CellCount& other) {
          return other.kind == cells.kind && other.fate == cells.fate;
        });
    if (known == all.cells.end())
      all.cells.push_back(cells);
    else
      known->count += cells.count;
  }
}

void add_fields(Inventory& all, const Inventory& piece) {
  for (const FieldSummary& field : piece.fields) {
    const auto known =
        std::find_if(all.fields.begin(), all.fields.end(), [&](const FieldSummary& other) {
          return other.name == field.name && other.location == field.location;
        });
    if (known == all.fields.end()) {
      all.fields.push_back(field);
      continue;
    }
    known->tuples += field.tuples;
    known->low = std::min(known->low, field.low);
    known->high = std::max(known->high, field.high);
    known->not_finite += field.not_finite;
  }
}

Inventory inspect(const std::string& path) {
  Inventory inventory;
  inventory.format = "pvtu";
  for (const std::string& file : piece_paths(path)) {
    const Inventory piece = vtk::inspect_vtu(file);
    inventory.points += piece.points;
    add_cells(inventory, piece);
    add_fields(inventory, piece);
    if (inventory.times.empty()) inventory.times = piece.times;
  }
  return inventory;
}

}  // namespace

Format pvtu_format() {
  Format format = vtu_format();
  format.name = "pvtu";
  format.extensions = {".pvtu"};
  format.recognizes = [](std::string_view head) {
    return vtk::xml_file_type(head) == "PUnstructuredGrid";
  };
  format.read = read_mesh;
  format.inspect = inspect;
  format.write = nullptr;
  return format;
}

}  // namespace hiac::formats
