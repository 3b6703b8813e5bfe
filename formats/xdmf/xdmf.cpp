#include "formats/xdmf/xdmf.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>
#include <memory>

#include <fmt/format.h>

#include "formats/common/cells/sorted_tetrahedra.hpp"
#include "formats/common/io/isolated.hpp"
#include "formats/common/io/mapped_file.hpp"
#include "formats/common/mesh/assemble.hpp"
#include "formats/common/mesh/foreign_mesh.hpp"
#include "formats/common/mesh/steps.hpp"
#include "formats/common/mesh/structured.hpp"
#include "formats/xdmf/data_items.hpp"
#include "formats/xdmf/topologies.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats {
namespace {

using xdmf::DataItems;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr int kMostDepth = 32;

/// The document and its numbers; every field keeps them alive.
struct Document {
  pugi::xml_document xml;
  std::unique_ptr<DataItems> items;
};

/// A uniform grid; it may include parts that are defined in another grid.
struct Leaf {
  std::string name;
  pugi::xml_node topology;
  pugi::xml_node geometry;
  std::vector<pugi::xml_node> attributes;
  std::size_t points = 0;
  std::size_t cells = 0;
};

/// One attribute on some of the leaves.
struct FieldParts {
  std::string name;
  FieldLocation location;
  std::uint32_t components;
  std::string type;
  std::vector<pugi::xml_node> items;  ///< one per leaf; null when the leaf has none
};

class Reader {
 public:
  Reader(const std::string& path, const ReadOptions& options)
      : document_(std::make_shared<Document>()), options_(options), path_(path) {
    const MappedFile file(path);
    const std::string text = xdmf::with_entities(file.text(), path);
    const auto parsed = document_->xml.load_buffer(text.data(), text.size(), pugi::parse_default);
    if (!parsed)
      throw InputError(
          path, fmt::format("byte {}: is no whole XML ({})", parsed.offset, parsed.description()));
    document_->items = std::make_unique<DataItems>(document_->xml, path);
  }

  ForeignMesh read() {
    const pugi::xml_node domain = document_->xml.child("Xdmf").child("Domain");
    if (!domain) throw InputError(path_, "has no Domain below Xdmf");
    find_times(domain, 0);
    std::sort(mesh_.times.begin(), mesh_.times.end());
    mesh_.times.erase(std::unique(mesh_.times.begin(), mesh_.times.end()), mesh_.times.end());
    if (const auto step = requested_step(options_, mesh_.times, path_))
      step_ = *step;
    else if (!mesh_.times.empty())
      step_ = mesh_.times.size() - 1;
    for (const pugi::xml_node grid : domain.children("Grid")) collect(grid, 0);
    for (Leaf& leaf : leaves_) add_leaf(leaf);
    for (const FieldParts& parts : fields_) add_field(parts);
    turn_sorted_tetrahedra(mesh_);
    return std::move(mesh_);
  }

 private:
  DataItems& items() { return *document_->items; }

  static bool is_temporal(const pugi::xml_node& grid) {
    return xdmf::same_word(grid.attribute("GridType").as_string(), "Collection") &&
           xdmf::same_word(grid.attribute("CollectionType").as_string(), "Temporal");
  }
  static bool is_group(const pugi::xml_node& grid) {
    const std::string_view type = grid.attribute("GridType").as_string("Uniform");
    return xdmf::same_word(type, "Collection") || xdmf::same_word(type, "Tree");
  }

  /// The times of a temporal collection's grids.
  std::vector<double> times_of(const pugi::xml_node& collection) {
    std::vector<double> times;
    std::vector<double> listed;
    const pugi::xml_node time = collection.child("Time");
    const std::string_view sort = time.attribute("TimeType").as_string();
    if (time && time.child("DataItem")) {
      listed = items().reals(items().item_in(time));
      if (xdmf::same_word(sort, "HyperSlab") && listed.size() == 3) {
        const auto [start, stride, count] = std::tuple(listed[0], listed[1], listed[2]);
        listed.clear();
        for (double i = 0; i < std::min(count, 1e6); ++i) listed.push_back(start + i * stride);
      }
    }
    std::size_t number = 0;
    for (const pugi::xml_node grid : collection.children("Grid")) {
      const pugi::xml_attribute value = grid.child("Time").attribute("Value");
      if (value)
        times.push_back(value.as_double());
      else
        times.push_back(number < listed.size() ? listed[number] : static_cast<double>(number));
      ++number;
    }
    return times;
  }

  void find_times(const pugi::xml_node& parent, int depth) {
    if (depth > kMostDepth) throw InputError(path_, "its grids are nested too deeply");
    for (const pugi::xml_node grid : parent.children("Grid")) {
      if (is_temporal(grid)) {
        const std::vector<double> times = times_of(grid);
        mesh_.times.insert(mesh_.times.end(), times.begin(), times.end());
      } else if (is_group(grid)) {
        find_times(grid, depth + 1);
      }
    }
  }

  /// Collects the leaves of a grid at the chosen step.
  void collect(const pugi::xml_node& grid, int depth) {
    if (depth > kMostDepth) throw InputError(path_, "its grids are nested too deeply");
    if (is_temporal(grid)) {
      const std::vector<double> times = times_of(grid);
      std::size_t number = 0;
      for (const pugi::xml_node child : grid.children("Grid"))
        if (times[number++] == mesh_.times[step_]) return collect(child, depth + 1);
      return;
    }
    if (is_group(grid)) {
      for (const pugi::xml_node child : grid.children("Grid")) collect(child, depth + 1);
      return;
    }
    const std::string_view type = grid.attribute("GridType").as_string("Uniform");
    if (!xdmf::same_word(type, "Uniform"))
      items().fail(grid,
                   fmt::format("is of the type '{}' (Uniform, Collection or Tree expected)", type));
    add_grid(grid);
  }

  /// The children of a grid, in which every XInclude is replaced by the nodes that it includes.
  std::vector<pugi::xml_node> parts_of(const pugi::xml_node& grid) {
    std::vector<pugi::xml_node> parts;
    for (const pugi::xml_node child : grid.children()) {
      if (std::string_view(child.name()) != "xi:include") {
        parts.push_back(items().resolved(child));
        continue;
      }
      std::string path = child.attribute("xpointer").as_string();
      if (child.attribute("href")) items().fail(child, "includes another file (one file expected)");
      if (path.starts_with("xpointer(") && path.ends_with(')'))
        path = path.substr(9, path.size() - 10);
      try {
        for (const pugi::xpath_node& found : document_->xml.select_nodes(path.c_str()))
          parts.push_back(items().resolved(found.node()));
      } catch (const pugi::xpath_exception&) {
        items().fail(child, fmt::format("'{}' is no XPath that is understood", path));
      }
    }
    return parts;
  }

  void add_grid(const pugi::xml_node& grid) {
    Leaf leaf;
    leaf.name = grid.attribute("Name").as_string();
    for (const pugi::xml_node part : parts_of(grid)) {
      const std::string_view name = part.name();
      if (name == "Topology") leaf.topology = part;
      if (name == "Geometry") leaf.geometry = part;
      if (name == "Attribute") leaf.attributes.push_back(part);
    }
    if (!leaf.topology || !leaf.geometry) items().fail(grid, "has no Topology or no Geometry");
    // a grid with the mesh of an earlier grid only adds attributes to it
    for (Leaf& other : leaves_) {
      if (other.topology != leaf.topology || other.geometry != leaf.geometry) continue;
      other.attributes.insert(other.attributes.end(), leaf.attributes.begin(),
                              leaf.attributes.end());
      return;
    }
    leaves_.push_back(std::move(leaf));
  }

  void add_leaf(Leaf& leaf) {
    const std::size_t first_point = mesh_.point_count();
    const std::size_t first_cell = mesh_.cell_count();
    std::string type = leaf.topology.attribute("TopologyType").as_string();
    if (type.empty()) type = leaf.topology.attribute("Type").as_string();
    if (type.size() > 4 && xdmf::same_word(std::string_view(type).substr(type.size() - 4), "Mesh"))
      add_structured(leaf, type);
    else
      add_unstructured(leaf, type);
    leaf.points = mesh_.point_count() - first_point;
    leaf.cells = mesh_.cell_count() - first_cell;
    if (leaves_.size() > 1) mesh_.blocks.push_back({leaf.name, {{first_cell, mesh_.cell_count()}}});
    const auto index = static_cast<std::size_t>(&leaf - leaves_.data());
    for (const pugi::xml_node attribute : leaf.attributes) note_attribute(index, attribute);
  }

  void add_unstructured(const Leaf& leaf, const std::string& type) {
    const auto first_point = static_cast<std::int64_t>(mesh_.point_count());
    add_points(leaf.geometry);
    const pugi::xml_node item = items().item_in(leaf.topology);
    std::vector<std::int64_t> numbers = items().integers(item);
    // Fortran programs number from 1
    const std::int64_t offset = leaf.topology.attribute("BaseOffset").as_llong(0);
    if (xdmf::same_word(type, "Mixed")) {
      if (offset != 0) items().fail(leaf.topology, "is mixed and has a BaseOffset");
      xdmf::add_mixed_cells(numbers, first_point, path_, mesh_);
      return;
    }
    const auto topology = xdmf::topology_named(type);
    if (!topology) items().fail(leaf.topology, fmt::format("is of the unknown type '{}'", type));
    std::size_t nodes = topology->nodes;
    if (nodes == 0) nodes = leaf.topology.attribute("NodesPerElement").as_uint(1);
    if (nodes == 0 || numbers.size() % nodes != 0)
      items().fail(leaf.topology, fmt::format("{} nodes make no whole number of cells of {}",
                                              numbers.size(), nodes));
    xdmf::add_cells(*topology, nodes, numbers, first_point - offset, mesh_);
  }

  void add_points(const pugi::xml_node& geometry) {
    std::string type = geometry.attribute("GeometryType").as_string();
    if (type.empty()) type = geometry.attribute("Type").as_string("XYZ");
    for (char& c : type) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    if (type == "XYZ" || type == "XY") {
      const std::vector<double> values = items().reals(items().item_in(geometry));
      const std::size_t width = type.size();
      if (values.size() % width != 0) items().fail(geometry, "has an incomplete point");
      for (std::size_t i = 0; i < values.size(); i += width)
        for (std::size_t d = 0; d < 3; ++d) mesh_.xyz.push_back(d < width ? values[i + d] : 0);
    } else if (type == "X_Y_Z" || type == "X_Y") {
      const std::size_t width = type == "X_Y" ? 2 : 3;
      std::vector<std::vector<double>> axes(3);
      for (std::size_t d = 0; d < width; ++d) axes[d] = items().reals(items().item_in(geometry, d));
      axes[2].resize(width == 2 ? axes[0].size() : axes[2].size());
      if (axes[1].size() != axes[0].size() || axes[2].size() != axes[0].size())
        items().fail(geometry, "its axes have different numbers of points");
      for (std::size_t i = 0; i < axes[0].size(); ++i)
        for (std::size_t d = 0; d < 3; ++d) mesh_.xyz.push_back(axes[d][i]);
    } else {
      items().fail(geometry, fmt::format("is of the type '{}' (XYZ, XY or X_Y_Z expected)", type));
    }
  }

  /// A structured mesh: points as a list, from three axes, or from an origin and a spacing. XDMF
  /// gives all its parts in the order z, y, x.
  void add_structured(const Leaf& leaf, const std::string& type) {
    const pugi::xml_attribute dimensions = leaf.topology.attribute("Dimensions")
                                               ? leaf.topology.attribute("Dimensions")
                                               : leaf.topology.attribute("NumberOfElements");
    std::array<long long, 3> zyx{1, 1, 1};
    if (std::sscanf(dimensions.as_string(), "%lld %lld %lld", &zyx[0], &zyx[1], &zyx[2]) != 3)
      items().fail(leaf.topology, "does not have three Dimensions");
    const std::size_t first_point = mesh_.point_count();
    const std::array<std::int64_t, 3> xyz{zyx[2], zyx[1], zyx[0]};
    if (xdmf::same_word(type, "3DSMesh")) {
      add_points(leaf.geometry);
      const StructuredBlock block = structured_block(xyz, mesh_.point_count() - first_point, path_);
      if (block.point_count() != mesh_.point_count() - first_point)
        items().fail(leaf.geometry,
                     fmt::format("has {} points ({} expected)", mesh_.point_count() - first_point,
                                 block.point_count()));
      add_bricks(mesh_, block, first_point, {}, "");
      return;
    }
    std::array<std::vector<double>, 3> axes = axes_of(leaf, type, xyz);
    const StructuredBlock block = structured_block(xyz, std::size_t{1} << 31, path_);
    require_field(leaf, block);
    for (const double z : axes[2])
      for (const double y : axes[1])
        for (const double x : axes[0]) mesh_.xyz.insert(mesh_.xyz.end(), {x, y, z});
    add_bricks(mesh_, block, first_point, {}, "");
  }

  /// A grid declared by its axes takes few bytes: a field on it proves its size.
  void require_field(const Leaf& leaf, const StructuredBlock& block) {
    for (const pugi::xml_node attribute : leaf.attributes)
      if (items().reals(items().item_in(attribute)).size() >= block.cell_count()) return;
    items().fail(leaf.topology, "has no attribute over its points or cells");
  }

  std::array<std::vector<double>, 3> axes_of(const Leaf& leaf, const std::string& type,
                                             const std::array<std::int64_t, 3>& counts) {
    std::array<std::vector<double>, 3> axes;
    if (xdmf::same_word(type, "3DRectMesh")) {
      for (std::size_t d = 0; d < 3; ++d)
        axes[d] = items().reals(items().item_in(leaf.geometry, d));
    } else if (xdmf::same_word(type, "3DCoRectMesh")) {
      const std::vector<double> origin = items().reals(items().item_in(leaf.geometry, 0));
      const std::vector<double> spacing = items().reals(items().item_in(leaf.geometry, 1));
      if (origin.size() != 3 || spacing.size() != 3)
        items().fail(leaf.geometry, "does not have an origin and a spacing of three numbers");
      for (std::size_t d = 0; d < 3; ++d)
        for (std::int64_t i = 0; i < std::min<std::int64_t>(counts[d], 1 << 24); ++i)
          axes[d].push_back(origin[2 - d] + static_cast<double>(i) * spacing[2 - d]);
    } else {
      items().fail(leaf.topology, fmt::format("is of the unknown type '{}'", type));
    }
    for (std::size_t d = 0; d < 3; ++d)
      if (static_cast<std::int64_t>(axes[d].size()) != counts[d])
        items().fail(leaf.geometry, fmt::format("has {} places along an axis ({} expected)",
                                                axes[d].size(), counts[d]));
    return axes;
  }

  void note_attribute(std::size_t leaf, const pugi::xml_node& attribute) {
    std::string center = attribute.attribute("Center").as_string("Node");
    for (const std::string_view known : {"Node", "Cell"})
      if (xdmf::same_word(center, known)) center = known;
    const std::string name = attribute.attribute("Name").as_string("attribute");
    if (std::string_view(attribute.attribute("ItemType").as_string()) == "FiniteElementFunction" ||
        (center != "Node" && center != "Cell")) {
      mesh_.notes.push_back(fmt::format("left out '{}', which lives on {}", name,
                                        center == "Node" ? "degrees of freedom" : center));
      return;
    }
    const FieldLocation location = center == "Node" ? FieldLocation::node : FieldLocation::cell;
    const std::size_t count =
        location == FieldLocation::node ? leaves_[leaf].points : leaves_[leaf].cells;
    const pugi::xml_node item = items().item_in(attribute);
    std::uint64_t size = 1;
    for (const std::uint64_t extent : items().shape(item))
      if (__builtin_mul_overflow(size, extent, &size)) size = ~std::uint64_t{0};
    if (count == 0 || size % count != 0 || size / count == 0 || size / count > 1000)
      items().fail(attribute, fmt::format("has {} numbers for {} {}s", size, count,
                                          center == "Node" ? "point" : "cell"));
    const auto components = static_cast<std::uint32_t>(size / count);
    auto known = std::find_if(fields_.begin(), fields_.end(), [&](const FieldParts& field) {
      return field.name == name && field.location == location && field.components == components;
    });
    if (known == fields_.end())
      known = fields_.insert(fields_.end(), {name, location, components, items().type(item), {}});
    known->items.resize(leaves_.size());
    known->items[leaf] = item;
  }

  void add_field(const FieldParts& parts) {
    ForeignField field;
    field.name = parts.name;
    field.location = parts.location;
    field.components = parts.components;
    field.type = parts.type;
    if (!mesh_.times.empty()) field.step = step_;
    std::vector<std::size_t> counts;
    for (const Leaf& leaf : leaves_)
      counts.push_back(parts.location == FieldLocation::node ? leaf.points : leaf.cells);
    field.values = [document = document_, parts, counts] {
      std::vector<double> values;
      for (std::size_t leaf = 0; leaf < counts.size(); ++leaf) {
        if (!parts.items[leaf]) {
          values.insert(values.end(), counts[leaf] * parts.components, kNaN);
          continue;
        }
        const std::vector<double> part = document->items->reals(parts.items[leaf]);
        values.insert(values.end(), part.begin(), part.end());
      }
      return values;
    };
    mesh_.fields.push_back(std::move(field));
  }

  std::shared_ptr<Document> document_;
  ReadOptions options_;
  std::string path_;
  ForeignMesh mesh_;
  std::size_t step_ = 0;
  std::vector<Leaf> leaves_;
  std::vector<FieldParts> fields_;
};

ForeignMesh foreign_mesh(const std::string& path, const ReadOptions& options) {
  return read_isolated(path, "the HDF5 library",
                       [&](const std::string& file) { return Reader(file, options).read(); });
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
  read_through(format, foreign_mesh);
  return format;
}

}  // namespace hiac::formats
