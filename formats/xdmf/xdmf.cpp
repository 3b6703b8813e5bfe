#include "formats/xdmf/xdmf.hpp"

#include <memory>

#include <fmt/format.h>

#include "formats/common/cells/sorted_tetrahedra.hpp"
#include "formats/common/io/bytes_behind.hpp"
#include "formats/common/io/isolated.hpp"
#include "formats/common/io/mapped_file.hpp"
#include "formats/common/mesh/assemble.hpp"
#include "formats/common/mesh/foreign_mesh.hpp"
#include "formats/xdmf/attributes.hpp"
#include "formats/xdmf/data_items.hpp"
#include "formats/xdmf/grid_mesh.hpp"
#include "formats/xdmf/grids.hpp"
#include "hiac/base/error.hpp"
#include "hiac/base/special_values.hpp"

namespace hiac::formats {
namespace {

using xdmf::Attributes;
using xdmf::DataItems;
using xdmf::FieldParts;
using xdmf::Grids;
using xdmf::UniformGrid;

/// The document and its numbers; every field keeps them alive.
struct Document {
  pugi::xml_document xml;
  std::unique_ptr<DataItems> items;
};

class XdmfReader {
 public:
  XdmfReader(const std::string& path, const ReadOptions& options)
      : document_(std::make_shared<Document>()), options_(options) {
    const MappedFile file(path);
    const std::string text = xdmf::with_entities(file.text(), path);
    const auto parsed = document_->xml.load_buffer(text.data(), text.size(), pugi::parse_default);
    if (!parsed)
      throw InputError(
          path, fmt::format("byte {}: is no whole XML ({})", parsed.offset, parsed.description()));
    note_behind_root(text, "Xdmf", mesh_.notes);
    document_->items = std::make_unique<DataItems>(document_->xml, path);
  }

  ForeignMesh read() {
    DataItems& items = *document_->items;
    Grids grids = xdmf::grids_of(document_->xml, items, options_);
    mesh_.times = grids.times;
    mesh_.field_steps = grids.field_steps;
    Attributes attributes(grids.uniform, items, mesh_.notes);
    for (std::size_t grid = 0; grid < grids.uniform.size(); ++grid) {
      add_grid(grids.uniform[grid], grids.uniform.size() > 1);
      attributes.add_all(grid);
    }
    for (const FieldParts& parts : attributes.fields()) add_field(parts, grids);
    turn_sorted_tetrahedra(mesh_);
    return std::move(mesh_);
  }

 private:
  void add_grid(UniformGrid& grid, bool is_block) {
    const std::size_t first_cell = mesh_.cell_count();
    xdmf::add_grid_mesh(*document_->items, grid, mesh_);
    if (is_block) mesh_.blocks.push_back({grid.name, {{first_cell, mesh_.cell_count()}}});
  }

  void add_field(const FieldParts& parts, const Grids& grids) {
    ForeignField field;
    field.name = parts.name;
    field.location = parts.location;
    field.components = parts.components;
    field.type = parts.type;
    if (!grids.times.empty()) field.step = grids.step;
    std::vector<std::size_t> counts;
    for (const UniformGrid& grid : grids.uniform)
      counts.push_back(parts.location == FieldLocation::node ? grid.points : grid.cells);
    field.values = [document = document_, parts, counts] {
      std::vector<double> values;
      for (std::size_t grid = 0; grid < counts.size(); ++grid) {
        if (!parts.items[grid]) {
          values.insert(values.end(), counts[grid] * parts.components, kNaN);
          continue;
        }
        const std::vector<double> part = document->items->reals(parts.items[grid]);
        values.insert(values.end(), part.begin(), part.end());
      }
      return values;
    };
    mesh_.fields.push_back(std::move(field));
  }

  std::shared_ptr<Document> document_;
  ReadOptions options_;
  ForeignMesh mesh_;
};

ForeignMesh xdmf_mesh(const std::string& path, const ReadOptions& options) {
  return read_isolated(path, "the HDF5 library",
                       [&](const std::string& file) { return XdmfReader(file, options).read(); });
}

}  // namespace

Format xdmf_format() {
  Format format;
  format.name = "xdmf";
  format.extensions = {".xdmf", ".xmf"};
  format.kinds = "tet4,10 pyr5,13 prism6,15 brick8,20";
  format.fields = "node, cell";
  format.time_steps = "several";
  format.recognizes = [](std::string_view head) {
    return head.find("<Xdmf") != std::string_view::npos;
  };
  read_through(format, xdmf_mesh);
  return format;
}

}  // namespace hiac::formats
