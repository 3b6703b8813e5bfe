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

Inventory inspect(const std::string& path) {
  Inventory inventory;
  inventory.format = "pvtu";
  for (const std::string& file : piece_paths(path)) {
    const Inventory piece = vtk::inspect_vtu(file);
    add_piece(inventory, piece);
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
