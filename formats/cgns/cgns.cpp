#include "formats/cgns/cgns.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <memory>

#include <fmt/format.h>

#include "formats/cgns/cgns_file.hpp"
#include "formats/cgns/element_types.hpp"
#include "formats/common/io/isolated.hpp"
#include "formats/common/mesh/assemble.hpp"
#include "formats/common/mesh/foreign_mesh.hpp"
#include "formats/common/mesh/structured.hpp"
#include "formats/common/mesh/vector_names.hpp"
#include "formats/hdf5/hdf5_model.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats {
namespace {

using cgns::CgnsFile;
using cgns::Node;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kNameLength = 32;

/// A zone and its place in the mesh.
struct Zone {
  std::string name;
  Node node;
  bool structured = false;
  StructuredBlock block;
  std::size_t points = 0;
  std::size_t cells = 0;
  /// For an unstructured zone: the place of each of its cells among the values of a solution.
  std::vector<std::size_t> numbers;
  std::size_t numbered = 0;  ///< cells of the zone that solutions have values for
};

/// The arrays of one zone that hold a field at one step, one per component.
struct FieldPart {
  std::vector<Node> arrays;
  std::array<std::size_t, 6> rind{};  ///< extra layers of a structured zone's solution
};

struct FieldKey {
  std::string name;
  FieldLocation location;
  std::size_t components;
  std::size_t step;
  auto operator<=>(const FieldKey&) const = default;
};

/// The interior values of an array of a structured zone that has extra layers (rind) around it.
std::vector<double> inner(const std::vector<double>& all, const std::array<std::size_t, 3>& extents,
                          const std::array<std::size_t, 6>& rind) {
  const std::size_t ni = extents[0] + rind[0] + rind[1];
  const std::size_t nj = extents[1] + rind[2] + rind[3];
  std::vector<double> values;
  values.reserve(extents[0] * extents[1] * extents[2]);
  for (std::size_t k = 0; k < extents[2]; ++k)
    for (std::size_t j = 0; j < extents[1]; ++j)
      for (std::size_t i = 0; i < extents[0]; ++i)
        values.push_back(all[i + rind[0] + ni * (j + rind[2] + nj * (k + rind[4]))]);
  return values;
}

/// A field's values in one zone, one list per component.
std::vector<std::vector<double>> values_in(const CgnsFile& file, const Zone& zone,
                                           const FieldPart& part, FieldLocation location) {
  std::array<std::size_t, 3> extents{};
  std::size_t expected = location == FieldLocation::node ? zone.points : zone.numbered;
  if (zone.structured) {
    for (std::size_t d = 0; d < 3; ++d)
      extents[d] = zone.block.points[d] - (location == FieldLocation::cell ? 1 : 0);
    expected = 1;
    for (std::size_t d = 0; d < 3; ++d)
      expected *= extents[d] + part.rind[2 * d] + part.rind[2 * d + 1];
  }
  std::vector<std::vector<double>> columns;
  for (const Node& array : part.arrays) {
    std::vector<double> values = file.reals(array);
    if (values.size() != expected)
      file.fail(array, fmt::format("holds {} values ({} expected)", values.size(), expected));
    if (zone.structured) {
      values = inner(values, extents, part.rind);
    } else if (location == FieldLocation::cell) {
      std::vector<double> of_cells;
      for (const std::size_t number : zone.numbers)
        of_cells.push_back(number < values.size() ? values[number] : kNaN);
      values = std::move(of_cells);
    }
    columns.push_back(std::move(values));
  }
  return columns;
}

class Reader {
 public:
  explicit Reader(const std::string& path) : file_(std::make_shared<CgnsFile>(path)) {}

  ForeignMesh read() {
    const std::vector<Node> bases = file_->children(file_->root(), "CGNSBase_t");
    if (bases.empty()) throw InputError(file_->path(), "holds no CGNSBase_t");
    if (bases.size() > 1)
      mesh_.notes.push_back(
          fmt::format("read the base '{}' alone of {}", bases.front().name, bases.size()));
    if (const auto steps = file_->labelled(bases.front(), "BaseIterativeData_t"))
      if (const auto times = file_->child(*steps, "TimeValues")) mesh_.times = file_->reals(*times);
    for (const Node& node : file_->children(bases.front(), "Zone_t")) add_zone(node);
    for (std::size_t z = 0; z < zones_.size(); ++z) note_solutions(z);
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
      add_sections(zone, static_cast<std::int64_t>(first_point) - 1);
    zone.cells = mesh_.cell_count() - first_cell;
    mesh_.blocks.push_back({zone.name, {{first_cell, mesh_.cell_count()}}});
    if (!zone.structured && sizes.size() > 1) {
      zone.numbered = static_cast<std::size_t>(std::max<std::int64_t>(sizes[1], 0));
      number_volumes(zone, first_cell);
    }
    zones_.push_back(std::move(zone));
  }

  void add_points(const Zone& zone) {
    const auto grid = file_->child(zone.node, "GridCoordinates");
    if (!grid) file_->fail(zone.node, "has no GridCoordinates");
    std::array<std::vector<double>, 3> axes;
    constexpr std::array<const char*, 3> kNames{"CoordinateX", "CoordinateY", "CoordinateZ"};
    const auto rind = rind_of(*grid);
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

  [[nodiscard]] std::array<std::size_t, 6> rind_of(const Node& parent) const {
    std::array<std::size_t, 6> rind{};
    const auto node = file_->labelled(parent, "Rind_t");
    if (!node) return rind;
    const std::vector<std::int64_t> layers = file_->integers(*node);
    for (std::size_t i = 0; i < std::min<std::size_t>(layers.size(), 6); ++i) {
      if (layers[i] < 0 || layers[i] > 1000) file_->fail(*node, "has no sensible layers");
      rind[i] = static_cast<std::size_t>(layers[i]);
    }
    return rind;
  }

  /// Sections in the order of their element numbers, which is the order of cell data.
  void add_sections(Zone& zone, std::int64_t offset) {
    std::vector<std::pair<std::int64_t, Node>> sections;
    for (const Node& section : file_->children(zone.node, "Elements_t")) {
      const auto range = file_->child(section, "ElementRange");
      const auto numbers = range ? file_->integers(*range) : std::vector<std::int64_t>();
      if (numbers.size() != 2) file_->fail(section, "has no ElementRange");
      sections.emplace_back(numbers[0], section);
    }
    std::sort(sections.begin(), sections.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    polygons_.clear();
    uses_.clear();
    for (const auto& [first, section] : sections) note_polygons(first, section, offset);
    for (const auto& [first, section] : sections) {
      const std::size_t first_cell = mesh_.cell_count();
      add_section(section, offset);
      const std::size_t count = mesh_.cell_count() - first_cell;
      for (std::size_t i = 0; i < count; ++i)
        zone.numbers.push_back(static_cast<std::size_t>(std::max<std::int64_t>(first, 1)) - 1 + i);
      if (sections.size() > 1)
        mesh_.blocks.push_back({section.name, {{first_cell, mesh_.cell_count()}}});
    }
  }

  /// The cell count of a zone may exclude surface elements, and solutions then have one value for
  /// each of the counted cells. If sections of surfaces precede or lie between those of volumes,
  /// element numbers are not places among these values, and volume cells are numbered
  /// consecutively.
  void number_volumes(Zone& zone, std::size_t first_cell) const {
    const auto has_volume = [&](std::size_t i) {
      const std::uint16_t type = mesh_.cell_types[first_cell + i];
      return mesh_.types[type].conversion.fate != CellFate::no_volume;
    };
    std::size_t volumes = 0;
    for (std::size_t i = 0; i < zone.numbers.size(); ++i) volumes += has_volume(i) ? 1 : 0;
    if (volumes != zone.numbered) return;
    std::size_t next = 0;
    for (std::size_t i = 0; i < zone.numbers.size(); ++i)
      zone.numbers[i] = has_volume(i) ? next++ : volumes;
  }

  void add_section(const Node& section, std::int64_t offset) {
    const std::vector<std::int64_t> kind = file_->integers(section);
    const auto list = file_->child(section, "ElementConnectivity");
    if (kind.empty() || !list) file_->fail(section, "has no ElementConnectivity");
    const std::vector<std::int64_t> numbers = file_->integers(*list);
    if (kind[0] == cgns::kPolygons || kind[0] == cgns::kPolyhedra) {
      add_lists(section, kind[0] == cgns::kPolyhedra);
    } else if (kind[0] == cgns::kMixed) {
      for (std::size_t at = 0; at < numbers.size();) {
        const auto type = type_of(section, numbers[at++]);
        if (type.nodes > numbers.size() - at) file_->fail(*list, "ended in the middle of a cell");
        add_cells(type, std::span(numbers).subspan(at, type.nodes), offset);
        at += type.nodes;
      }
    } else {
      const auto type = type_of(section, kind[0]);
      if (numbers.size() % type.nodes != 0)
        file_->fail(*list,
                    fmt::format("{} nodes make no whole number of {}", numbers.size(), type.name));
      add_cells(type, numbers, offset);
    }
  }

  [[nodiscard]] cgns::ElementType type_of(const Node& section, std::int64_t number) const {
    const auto type = cgns::element_numbered(number);
    if (!type) file_->fail(section, fmt::format("has elements of the unknown type {}", number));
    return *type;
  }

  void add_cells(const cgns::ElementType& type, std::span<const std::int64_t> numbers,
                 std::int64_t offset) {
    mesh_.cell_types.insert(mesh_.cell_types.end(), numbers.size() / type.nodes,
                            mesh_.type_place(type.name, type.nodes, type.conversion));
    for (const std::int64_t number : numbers) mesh_.cell_nodes.push_back(number + offset);
  }

  using Lists = std::vector<std::vector<std::int64_t>>;

  /// The lists of an NGON_n or NFACE_n section: delimited by offsets (CGNS 4), or each preceded by
  /// its length.
  [[nodiscard]] Lists lists_of(const Node& section) const {
    const auto connectivity = file_->child(section, "ElementConnectivity");
    if (!connectivity) file_->fail(section, "has no ElementConnectivity");
    const std::vector<std::int64_t> numbers = file_->integers(*connectivity);
    Lists lists;
    std::size_t at = 0;
    const auto take = [&](std::int64_t count) {
      if (count < 0 || static_cast<std::uint64_t>(count) > numbers.size() - at)
        file_->fail(*connectivity, "ended in the middle of a list");
      const auto begin = numbers.begin() + static_cast<std::ptrdiff_t>(at);
      lists.emplace_back(begin, begin + count);
      at += static_cast<std::size_t>(count);
    };
    if (const auto offsets = file_->child(section, "ElementStartOffset")) {
      const std::vector<std::int64_t> starts = file_->integers(*offsets);
      for (std::size_t i = 1; i < starts.size(); ++i) {
        if (starts[i] < starts[i - 1]) file_->fail(*offsets, "does not rise");
        take(starts[i] - starts[i - 1]);
      }
    } else {
      while (at < numbers.size()) {
        const std::int64_t count = numbers[at++];
        take(count);
      }
    }
    return lists;
  }

  /// The faces of polyhedra, by element number.
  void note_polygons(std::int64_t first, const Node& section, std::int64_t offset) {
    const std::vector<std::int64_t> kind = file_->integers(section);
    if (kind.empty() || kind[0] != cgns::kPolygons) return;
    std::int64_t number = first;
    for (std::vector<std::int64_t>& polygon : lists_of(section)) {
      for (std::int64_t& node : polygon) node += offset;
      polygons_[number++] = std::move(polygon);
    }
  }

  void add_lists(const Node& section, bool polyhedra) {
    const Lists lists = lists_of(section);
    if (!polyhedra) {
      mesh_.cell_types.insert(mesh_.cell_types.end(), lists.size(),
                              mesh_.type_place("NGON_n", 0, kNoVolume));
      return;
    }
    for (const std::vector<std::int64_t>& list : lists) {
      Lists faces;
      for (const std::int64_t signed_number : list) {
        // the sign gives the orientation of the face, which is determined later anyway
        const auto found = polygons_.find(signed_number < 0 ? -signed_number : signed_number);
        if (found == polygons_.end())
          file_->fail(section, fmt::format("names the face {}, which is in no NGON_n section",
                                           signed_number));
        // otherwise a small file could demand much memory
        if (++uses_[found->first] > 2)
          file_->fail(section, fmt::format("names the face {} more than twice", found->first));
        faces.push_back(found->second);
      }
      mesh_.add_polyhedron("NFACE_n (polyhedron)", faces);
    }
  }

  /// The step of every solution that the pointers of a zone name.
  std::map<std::string, std::size_t> steps_of(const Node& zone) const {
    std::map<std::string, std::size_t> steps;
    const auto iterative = file_->labelled(zone, "ZoneIterativeData_t");
    const auto pointers =
        iterative ? file_->child(*iterative, "FlowSolutionPointers") : std::nullopt;
    if (!pointers) return steps;
    const std::string all = file_->text(*pointers);
    for (std::size_t s = 0; s < mesh_.times.size() && (s + 1) * kNameLength <= all.size(); ++s) {
      std::string name = all.substr(s * kNameLength, kNameLength);
      name.resize(std::min(name.find('\0'), name.size()));
      while (name.ends_with(' ')) name.pop_back();
      steps[name] = s;
    }
    return steps;
  }

  void note_solutions(std::size_t z) {
    const Zone& zone = zones_[z];
    const std::map<std::string, std::size_t> steps = steps_of(zone.node);
    for (const Node& solution : file_->children(zone.node, "FlowSolution_t")) {
      FieldLocation location = FieldLocation::node;
      if (const auto place = file_->labelled(solution, "GridLocation_t")) {
        const std::string name = file_->text(*place);
        if (name.starts_with("CellCenter")) {
          location = FieldLocation::cell;
        } else if (!name.starts_with("Vertex")) {
          mesh_.notes.push_back(
              fmt::format("left out the solution '{}', which lives on {}", solution.name, name));
          continue;
        }
      }
      // if the pointers name solutions, a solution that they do not name belongs to no step
      const auto step = steps.find(solution.name);
      if (!steps.empty() && step == steps.end()) continue;
      const std::vector<Node> arrays = file_->children(solution, "DataArray_t");
      std::vector<std::string> names;
      for (const Node& array : arrays) names.push_back(array.name);
      for (const VectorName& vector : vectors_among(names)) {
        FieldPart part;
        part.rind = rind_of(solution);
        for (const std::size_t i : vector.parts) part.arrays.push_back(arrays[i]);
        auto& parts = fields_[{vector.name, location, vector.parts.size(),
                               steps.empty() ? kAlways : step->second}];
        parts.resize(zones_.size());
        parts[z] = std::move(part);
      }
    }
  }

  void add_field(const FieldKey& key, const std::vector<FieldPart>& parts) {
    ForeignField field;
    field.name = key.name;
    field.location = key.location;
    field.components = static_cast<std::uint32_t>(key.components);
    if (key.step != kAlways) field.step = key.step;
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

  static constexpr std::size_t kAlways = std::numeric_limits<std::size_t>::max();

  std::shared_ptr<CgnsFile> file_;
  std::map<std::int64_t, std::vector<std::int64_t>> polygons_;  ///< of the zone, by their numbers
  std::map<std::int64_t, int> uses_;                            ///< of polygons, by cells
  ForeignMesh mesh_;
  std::vector<Zone> zones_;
  std::shared_ptr<const std::vector<Zone>> zones_kept_;
  std::map<FieldKey, std::vector<FieldPart>> fields_;
};

ForeignMesh foreign_mesh(const std::string& path) {
  return read_isolated(path, "the CGNS library",
                       [](const std::string& file) { return Reader(file).read(); });
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
  read_through(format,
               [](const std::string& path, const ReadOptions&) { return foreign_mesh(path); });
  return format;
}

}  // namespace hiac::formats
