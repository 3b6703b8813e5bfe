#include "formats/zoo/zparts_format.hpp"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "formats/common/io/named_file.hpp"
#include "formats/common/pieces/piece_field.hpp"
#include "formats/zoo/zoo_format.hpp"
#include "hiac/mesh/parted/join_parts.hpp"
#include "hiac/mesh/parted/parted_index.hpp"
#include "hiac/mesh/parted/write_parts.hpp"

namespace hiac::formats {
namespace {

PartedIndex read_index(const std::string& path) {
  PartedIndex index = read_parted_index(path, PartFiles::anywhere);
  for (const PartInfo& part : index.parts) file_beside(path, part.file);
  return index;
}

ZooMesh read_whole(const PartedIndex& index) { return join_parts(index, read_all_parts(index)); }

/// The whole mesh with marks of the parts that its cells come from.
ZooMesh read_marked(const PartedIndex& index) {
  std::vector<MeshPart> parts = read_all_parts(index);
  ZooMesh whole = join_parts(index, parts);
  std::vector<double> marks(whole.cell_count());
  for (std::size_t k = 0; k < parts.size(); ++k)
    for (const std::uint64_t cell : parts[k].global_cells) marks[cell] = static_cast<double>(k);
  mark_pieces(whole, std::move(marks));
  return whole;
}

Reading read_parted(const std::string& path, const ReadOptions& options) {
  const PartedIndex index = read_index(path);
  Reading reading = reading_of({PieceMarking::is_on() ? read_marked(index) : read_whole(index), {}},
                               options, path);
  reading.notes.push_back(fmt::format("joined {} parts", index.parts.size()));
  return reading;
}

Inventory inspect_parts(const std::string& path) {
  const PartedIndex index = read_index(path);
  Inventory inventory = inventory_of(read_whole(index));
  inventory.format = "zparts";
  for (std::size_t k = 0; k < index.parts.size(); ++k) {
    const PartInfo& part = index.parts[k];
    inventory.notes.push_back(fmt::format(
        "part {}: {}, {} cells, {} nodes, x {:g} to {:g}, y {:g} to {:g}, z {:g} to {:g}", k,
        part.file, part.cells, part.nodes, part.low[0], part.high[0], part.low[1], part.high[1],
        part.low[2], part.high[2]));
  }
  return inventory;
}

std::vector<std::string> write_parted(const std::string& path, const ZooMesh& mesh) {
  write_parted_mesh(path, mesh, std::vector<std::uint32_t>(mesh.cell_count(), 0), 1,
                    [](const std::string&) {});
  return {};
}

}  // namespace

Format zparts_format() {
  Format format;
  format.name = "zparts";
  format.extensions = {kPartedExtension};
  format.kinds = "all fifteen";
  format.fields = "node, cell, corner";
  format.time_steps = "one";
  format.recognizes = [](std::string_view head) { return is_parted_index(head); };
  format.read = read_parted;
  format.inspect = inspect_parts;
  format.write = write_parted;
  return format;
}

}  // namespace hiac::formats
