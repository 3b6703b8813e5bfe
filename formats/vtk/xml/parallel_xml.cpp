#include <fmt/format.h>

#include "formats/common/io/mapped_file.hpp"
#include "formats/common/io/named_file.hpp"
#include "formats/common/mesh/gate.hpp"
#include "formats/common/pieces/merge_pieces.hpp"
#include "formats/common/pieces/piece_field.hpp"
#include "formats/vtk/reading_process.hpp"
#include "formats/vtk/vtk_formats.hpp"
#include "formats/vtk/xml/vtk_xml.hpp"
#include "formats/vtk/xml/xml_layout.hpp"
#include "formats/vtk/xml/xml_text.hpp"

namespace hiac::formats {
namespace {

/// The paths of the pieces in the master file of a parallel run, relative to that file.
std::vector<std::string> piece_paths(const std::string& path, const std::string& type) {
  const MappedFile file(path);
  const vtk::XmlText text(file.text(), type, path);
  std::vector<std::string> paths;
  for (const pugi::xml_node piece : text.primary().children("Piece")) {
    const std::string source = piece.attribute("Source").as_string();
    if (source.empty()) text.fail("a piece without a Source");
    paths.push_back(file_beside(path, source));
  }
  if (paths.empty()) text.fail("names no pieces");
  return paths;
}

/// The format of the master files of a parallel run whose pieces have the format `piece`, which
/// stores datasets of that type.
Format parallel_format(Format piece, std::string_view name, std::string_view extension,
                       const std::string& type) {
  Format format = std::move(piece);
  format.name = name;
  format.extensions = {extension};
  const std::string parallel_type = "P" + type;
  format.recognizes = [parallel_type](std::string_view head) {
    return vtk::xml_file_type(head) == parallel_type;
  };
  const vtk::XmlReader reader = vtk::xml_reader(type);
  format.read = [reader, parallel_type](const std::string& path, const ReadOptions& options) {
    const auto process = vtk::reading_process();  // one for all pieces
    std::vector<Reading> pieces;
    for (const std::string& file : piece_paths(path, parallel_type)) {
      pieces.push_back(reader.read(file, options));
      if (PieceMarking::is_on()) mark_piece(pieces.back().mesh, pieces.size() - 1);
    }
    const std::size_t count = pieces.size();
    Reading reading = merge_pieces(std::move(pieces), path);
    finish_reading(reading, path);
    reading.mesh.metadata.emplace_back("pieces", fmt::format("{}", count));
    return reading;
  };
  format.inspect = [reader, parallel_type, name](const std::string& path) {
    const auto process = vtk::reading_process();
    Inventory inventory;
    inventory.format = name;
    for (const std::string& file : piece_paths(path, parallel_type))
      add_piece(inventory, reader.inspect(file));
    return inventory;
  };
  format.write = nullptr;
  return format;
}

}  // namespace

Format pvtu_format() { return parallel_format(vtu_format(), "pvtu", ".pvtu", "UnstructuredGrid"); }
Format pvts_format() { return parallel_format(vts_format(), "pvts", ".pvts", "StructuredGrid"); }
Format pvti_format() { return parallel_format(vti_format(), "pvti", ".pvti", "ImageData"); }
Format pvtr_format() { return parallel_format(vtr_format(), "pvtr", ".pvtr", "RectilinearGrid"); }

}  // namespace hiac::formats
