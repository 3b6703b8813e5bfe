// The layout: Netgen's Mesh::Save; node orders and edges: its MeshTopology (left-handed cells).
#include "formats/netgen/netgen.hpp"

#include <array>
#include <map>

#include <fmt/format.h>

#include "formats/common/cells/solid_orders.hpp"
#include "formats/common/io/input_text.hpp"
#include "formats/common/io/text_cursor.hpp"
#include "formats/common/mesh/assemble.hpp"

namespace hiac::formats {
namespace {

constexpr std::array<std::uint8_t, 4> kNetgenTetrahedron{0, 2, 1, 3};
constexpr std::array<std::uint8_t, 5> kNetgenPyramid{0, 3, 2, 1, 4};
constexpr std::array<std::uint8_t, 6> kNetgenPrism{0, 1, 2, 3, 4, 5};
constexpr std::array<std::uint8_t, 8> kNetgenBrick{0, 3, 2, 1, 4, 7, 6, 5};
constexpr std::array<ShapeEdge, 6> kTetrahedronEdges{
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
constexpr std::array<ShapeEdge, 8> kPyramidEdges{
    {{0, 1}, {2, 3}, {0, 3}, {1, 2}, {0, 4}, {1, 4}, {2, 4}, {3, 4}}};
constexpr std::array<ShapeEdge, 9> kPrismEdges{
    {{0, 1}, {0, 2}, {1, 2}, {0, 3}, {1, 4}, {2, 5}, {3, 4}, {3, 5}, {4, 5}}};
constexpr std::array<ShapeEdge, 12> kBrickEdges{{{0, 1},
                                                 {2, 3},
                                                 {3, 0},
                                                 {1, 2},
                                                 {4, 5},
                                                 {6, 7},
                                                 {7, 4},
                                                 {5, 6},
                                                 {0, 4},
                                                 {1, 5},
                                                 {2, 6},
                                                 {3, 7}}};

CellConversion conversion_of(std::int64_t nodes) {
  switch (nodes) {
    case 4:
      return ordered_conversion(CellKind::tetrahedron4, kNetgenTetrahedron, {});
    case 5:
      return ordered_conversion(CellKind::pyramid5, kNetgenPyramid, {});
    case 6:
      return ordered_conversion(CellKind::prism6, kNetgenPrism, {});
    case 8:
      return ordered_conversion(CellKind::brick8, kNetgenBrick, {});
    case 10:
      return ordered_conversion(CellKind::tetrahedron10, kNetgenTetrahedron, kTetrahedronEdges);
    case 13:
      return ordered_conversion(CellKind::pyramid13, kNetgenPyramid, kPyramidEdges);
    case 15:
      return ordered_conversion(CellKind::prism15, kNetgenPrism, kPrismEdges);
    case 20:
      return ordered_conversion(CellKind::brick20, kNetgenBrick, kBrickEdges);
    default:
      return {};
  }
}

class VolReader {
 public:
  explicit VolReader(const InputText& text) : cursor_(text.text(), text.path()) {}

  ForeignMesh run() {
    bool ended = false;
    while (!ended) {
      const std::string_view keyword = next_keyword();
      if (keyword.empty()) break;
      ended = keyword == "endmesh";
      read(keyword);
    }
    if (mesh_.xyz.empty()) cursor_.fail("no points found ('points' expected)");
    mesh_.fields.push_back(field_of("index", FieldLocation::cell, 1, std::move(indices_)));
    name_blocks();
    return std::move(mesh_);
  }

 private:
  /// The next line that begins with a letter; skips lines of numbers, which belong to a section
  /// that is left out.
  std::string_view next_keyword() {
    while (!cursor_.at_end()) {
      const std::string_view line = trimmed(cursor_.line());
      if (line.empty() || line.starts_with('#')) continue;
      const char first = line.front();
      if ((first >= 'a' && first <= 'z') || (first >= 'A' && first <= 'Z')) return line;
    }
    return {};
  }

  void read(std::string_view keyword) {
    if (keyword == "points") {
      read_points();
    } else if (keyword == "volumeelements") {
      read_elements();
    } else if (keyword == "materials") {
      read_materials();
    } else if (keyword == "dimension") {
      if (cursor_.integer("a dimension") != 3) cursor_.fail("dimension 3 expected");
    } else if (keyword == "curvedelements") {
      mesh_.notes.emplace_back("left out 'curvedelements': cells are straight between their nodes");
    } else if (keyword.starts_with("surfaceelements")) {
      const std::size_t count = cursor_.count("the number of surface elements", cursor_.left());
      if (count > 0)
        mesh_.notes.push_back(
            fmt::format("dropped cells without volume: {} surface elements", count));
    }
  }

  void read_points() {
    const std::size_t count = cursor_.count("the number of points", cursor_.left());
    mesh_.first_node = 1;
    for (std::size_t i = 0; i < 3 * count; ++i) mesh_.xyz.push_back(cursor_.real("a coordinate"));
  }

  void read_elements() {
    const std::size_t count = cursor_.count("the number of elements", cursor_.left());
    for (std::size_t i = 0; i < count; ++i) {
      indices_.push_back(static_cast<double>(cursor_.integer("a material")));
      cursor_.skip_space();
      const std::size_t start = cursor_.offset();
      const std::int64_t nodes = cursor_.integer("a number of nodes");
      const CellConversion conversion = nodes == last_nodes_ ? last_ : conversion_of(nodes);
      if (conversion.fate != CellFate::converted)
        cursor_.fail_at(start, fmt::format("4, 5, 6, 8, 10, 13, 15 or 20 nodes of an element "
                                           "expected ({} found)",
                                           nodes));
      last_nodes_ = nodes;
      last_ = conversion;
      mesh_.cell_types.push_back(mesh_.type_place(std::string(kind_name(conversion.kind)),
                                                  static_cast<std::size_t>(nodes), conversion));
      for (std::int64_t n = 0; n < nodes; ++n)
        mesh_.cell_nodes.push_back(cursor_.integer("a point"));
    }
  }

  void read_materials() {
    const std::size_t count = cursor_.count("the number of materials", cursor_.left());
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t number = cursor_.integer("a material");
      materials_[number] = trimmed(cursor_.line());
    }
  }

  void name_blocks() {
    std::map<std::int64_t, ForeignBlock> blocks;
    const std::vector<double> indices = mesh_.fields.back().values();
    for (std::size_t cell = 0; cell < indices.size(); ++cell) {
      const auto material = static_cast<std::int64_t>(indices[cell]);
      auto& [name, cells] = blocks[material];
      if (!cells.empty() && cells.back().end == cell)
        ++cells.back().end;
      else
        cells.push_back({cell, cell + 1});
    }
    for (auto& [material, block] : blocks) {
      const auto name = materials_.find(material);
      block.name = name == materials_.end() ? fmt::format("{}", material) : name->second;
      mesh_.blocks.push_back(std::move(block));
    }
  }

  TextCursor cursor_;
  ForeignMesh mesh_;
  std::vector<double> indices_;
  std::map<std::int64_t, std::string> materials_;
  std::int64_t last_nodes_ = 0;
  CellConversion last_;
};

}  // namespace

Format netgen_format() {
  Format format;
  format.name = "netgen";
  format.extensions = {".vol"};
  format.kinds = "tet4,10 pyr5,13 prism6,15 wedge7,18 brick8,20";
  format.fields = "cell (index)";
  format.time_steps = "none";
  format.recognizes = [](std::string_view head) {
    TextCursor cursor(head, "");
    while (!cursor.at_end()) {
      const std::string_view line = trimmed(cursor.line());
      if (line.empty() || line.starts_with('#')) continue;
      return line == "mesh3d";
    }
    return false;
  };
  format.gzip = true;
  read_through(format, [](const std::string& path, const ReadOptions&) {
    return VolReader(InputText(path)).run();
  });
  return format;
}

}  // namespace hiac::formats
