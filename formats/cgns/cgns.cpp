#include "formats/cgns/cgns.hpp"

#include <algorithm>
#include <array>
#include <memory>

#include <fmt/format.h>

#include "formats/cgns/cgns_file.hpp"
#include "formats/cgns/sections.hpp"
#include "formats/cgns/solutions.hpp"
#include "formats/cgns/zone.hpp"
#include "formats/common/io/isolated.hpp"
#include "formats/common/mesh/assemble.hpp"
#include "formats/common/mesh/foreign_mesh.hpp"
#include "formats/common/mesh/structured.hpp"
#include "formats/hdf5/hdf5_model.hpp"
#include "hiac/base/error.hpp"
#include "hiac/base/special_values.hpp"

namespace hiac::formats {
namespace {

using cgns::CgnsFile;
using cgns::FieldKey;
using cgns::FieldPart;
using cgns::Node;
using cgns::Zone;

class CgnsReader {
 public:
  explicit CgnsReader(const std::string& path) : file_(std::make_shared<CgnsFile>(path)) {}

  ForeignMesh read() {
    const std::vector<Node> bases = file_->children(file_->root(), "CGNSBase_t");
    if (bases.empty()) throw InputError(file_->path(), "holds no CGNSBase_t");
    if (bases.size() > 1)
      mesh_.notes.push_back(
          fmt::format("read the base '{}' alone of {}", bases.front().name, bases.size()));
    if (const auto steps = file_->labelled(bases.front(), "BaseIterativeData_t"))
      if (const auto times = file_->child(*steps, "TimeValues")) mesh_.times = file_->reals(*times);
    for (const Node& node : file_->children(bases.front(), "Zone_t")) add_zone(node);
    for (std::size_t z = 0; z < zones_.size(); ++z)
      cgns::add_solutions(*file_, zones_, z, mesh_.times.size(), fields_, mesh_.notes);
    for (const auto& [key, parts] : fields_) add_field(key, parts);
    return std::move(mesh_);
  }

 private:
  void add_zone(const Node& node) {
    Zone zone;
    zone.name = node.name;
    zone.node = node;
    const auto type = file_->labelled(node, "ZoneType_t");
    zone.structured = !type || file_->text(*type).starts_with("Structured");
    const std::vector<std::int64_t> sizes = file_->integers(node);
    if (sizes.empty() || (zone.structured && sizes.size() != 3 * node.shape[0]))
      file_->fail(node, "does not say how large it is");
    if (zone.structured)
      zone.block = structured_block(std::span(sizes).first(std::min<std::size_t>(node.shape[0], 3)),
                                    file_->size() / 3, file_->path());
    zone.points = zone.structured ? zone.block.point_count()
                                  : static_cast<std::size_t>(std::max<std::int64_t>(sizes[0], 0));
    const std::size_t first_point = mesh_.point_count();
    const std::size_t first_cell = mesh_.cell_count();
    add_points(zone);
    if (zone.structured)
      add_bricks(mesh_, zone.block, first_point, {}, "");
    else
      cgns::add_sections(*file_, first_point, zone, mesh_);
    zone.cells = mesh_.cell_count() - first_cell;
    mesh_.blocks.push_back({zone.name, {{first_cell, mesh_.cell_count()}}});
    if (!zone.structured && sizes.size() > 1) {
      zone.numbered = static_cast<std::size_t>(std::max<std::int64_t>(sizes[1], 0));
      cgns::number_volumes(mesh_, first_cell, zone);
    }
    zones_.push_back(std::move(zone));
  }

  void add_points(const Zone& zone) {
    const auto grid = file_->child(zone.node, "GridCoordinates");
    if (!grid) file_->fail(zone.node, "has no GridCoordinates");
    std::array<std::vector<double>, 3> axes;
    constexpr std::array<const char*, 3> kNames{"CoordinateX", "CoordinateY", "CoordinateZ"};
    const auto rind = cgns::rind_of(*file_, *grid);
    for (std::size_t d = 0; d < 3; ++d) {
      const auto axis = file_->child(*grid, kNames[d]);
      if (!axis && d == 2) {
        axes[d].assign(axes[0].size(), 0);
        continue;
      }
      if (!axis)
        file_->fail(*grid, fmt::format("has no {} (Cartesian coordinates expected)", kNames[d]));
      axes[d] = values_in(*file_, zone, {{*axis}, rind}, FieldLocation::node).front();
    }
    for (std::size_t i = 0; i < zone.points; ++i)
      mesh_.xyz.insert(mesh_.xyz.end(), {axes[0][i], axes[1][i], axes[2][i]});
  }

  void add_field(const FieldKey& key, const std::vector<FieldPart>& parts) {
    ForeignField field;
    field.name = key.name;
    field.location = key.location;
    field.components = static_cast<std::uint32_t>(key.components);
    if (key.step != cgns::kAlways) field.step = key.step;
    if (!zones_kept_) zones_kept_ = std::make_shared<const std::vector<Zone>>(zones_);
    field.values = [file = file_, zones = zones_kept_, key, parts] {
      std::vector<double> values;
      for (std::size_t z = 0; z < zones->size(); ++z) {
        const Zone& zone = (*zones)[z];
        const std::size_t count = key.location == FieldLocation::node ? zone.points : zone.cells;
        if (parts[z].arrays.empty()) {
          values.insert(values.end(), count * key.components, kNaN);
          continue;
        }
        const auto columns = values_in(*file, zone, parts[z], key.location);
        for (std::size_t i = 0; i < count; ++i)
          for (const std::vector<double>& column : columns) values.push_back(column[i]);
      }
      return values;
    };
    mesh_.fields.push_back(std::move(field));
  }

  std::shared_ptr<CgnsFile> file_;
  ForeignMesh mesh_;
  std::vector<Zone> zones_;
  std::shared_ptr<const std::vector<Zone>> zones_kept_;
  cgns::FieldParts fields_;
};

ForeignMesh cgns_mesh(const std::string& path) {
  return read_isolated(path, "the CGNS library",
                       [](const std::string& file) { return CgnsReader(file).read(); });
}

}  // namespace

Format cgns_format() {
  Format format;
  format.name = "cgns";
  format.extensions = {".cgns"};
  format.kinds = "tet4,10,20 pyr5,13,21 prism6,15,24 brick8,20,32";
  format.fields = "node, cell";
  format.time_steps = "several";
  // the first words of an ADF file
  format.recognizes = [](std::string_view head) { return head.find("ADF Database Version") == 4; };
  format.contains = [](const std::string& path) { return hdf5::model_of(path) == "cgns"; };
  read_through(format, [](const std::string& path, const ReadOptions&) { return cgns_mesh(path); });
  return format;
}

}  // namespace hiac::formats
