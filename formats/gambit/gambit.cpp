// The layout: Gambit's user guide, "Neutral file format". Cells list their nodes row by row.
#include "formats/gambit/gambit.hpp"

#include <array>

#include <fmt/format.h>

#include "formats/common/cells/solid_orders.hpp"
#include "formats/common/io/input_text.hpp"
#include "formats/common/io/number_index.hpp"
#include "formats/common/io/text_cursor.hpp"
#include "formats/common/mesh/assemble.hpp"

namespace hiac::formats {
namespace {

// Node i of the zoo's kind is the file's node [i].
constexpr std::array<std::uint8_t, 8> kBrick8{0, 1, 3, 2, 4, 5, 7, 6};
constexpr std::array<std::uint8_t, 20> kBrick20{0, 2, 7,  5,  12, 14, 19, 17, 1,  4,
                                                6, 3, 13, 16, 18, 15, 8,  9,  11, 10};
constexpr std::array<std::uint8_t, 15> kPrism15{0, 5, 2, 9, 14, 11, 3, 4, 1, 12, 13, 10, 6, 8, 7};
constexpr std::array<std::uint8_t, 10> kTetrahedron10{0, 2, 5, 9, 1, 4, 3, 6, 7, 8};
constexpr std::array<std::uint8_t, 5> kPyramid5{0, 1, 3, 2, 4};

constexpr std::int64_t kEdge = 1;
constexpr std::int64_t kBrick = 4;
constexpr std::int64_t kWedge = 5;
constexpr std::int64_t kTetrahedron = 6;
constexpr std::int64_t kPyramid = 7;

CellConversion conversion_of(std::int64_t shape, std::int64_t nodes) {
  if (shape < kBrick) return kNoVolume;
  if (shape == kBrick && nodes == 8) return converted_to(CellKind::brick8, kBrick8);
  if (shape == kBrick && nodes == 20) return converted_to(CellKind::brick20, kBrick20);
  if (shape == kWedge && nodes == 6) return solid_conversion(CellKind::prism6);
  if (shape == kWedge && nodes == 15) return converted_to(CellKind::prism15, kPrism15);
  if (shape == kTetrahedron && nodes == 4) return solid_conversion(CellKind::tetrahedron4);
  if (shape == kTetrahedron && nodes == 10)
    return converted_to(CellKind::tetrahedron10, kTetrahedron10);
  if (shape == kPyramid && nodes == 5) return converted_to(CellKind::pyramid5, kPyramid5);
  return {};
}

std::string_view shape_name(std::int64_t shape) {
  constexpr std::array<std::string_view, 7> kNames{"edge",  "quadrilateral", "triangle", "brick",
                                                   "wedge", "tetrahedron",   "pyramid"};
  return kNames[static_cast<std::size_t>(shape - kEdge)];
}

class NeuReader {
 public:
  explicit NeuReader(const InputText& text) : cursor_(text.text(), text.path()) {}

  ForeignMesh run() {
    read_head();
    while (next_section()) {
    }
    if (mesh_.node_numbers.size() != nodes_ || mesh_.cell_types.size() != cells_)
      cursor_.fail(fmt::format("{} nodes and {} elements expected ({} and {} found)", nodes_,
                               cells_, mesh_.node_numbers.size(), mesh_.cell_types.size()));
    if (any_material_)
      mesh_.fields.push_back(
          field_of("Material Type", FieldLocation::cell, 1, std::move(materials_)));
    if (boundaries_ > 0)
      mesh_.fields.push_back(
          field_of("Boundary Condition", FieldLocation::node, 1, std::move(boundary_of_)));
    return std::move(mesh_);
  }

 private:
  /// Six lines of texts, then NUMNP NELEM NGRPS NBSETS NDFCD NDFVL.
  void read_head() {
    constexpr int kTitleLines = 6;
    for (int i = 0; i < kTitleLines; ++i) cursor_.line();
    nodes_ = cursor_.count("the number of nodes", cursor_.left());
    cells_ = cursor_.count("the number of elements", cursor_.left());
    // the counts of groups and of boundary conditions; in a plane mesh, nodes have two coordinates
    cursor_.integer("the number of groups");
    cursor_.integer("the number of sets of boundary conditions");
    dimension_ = cursor_.integer("the number of coordinate directions");
    if (dimension_ != 2 && dimension_ != 3)
      cursor_.fail(fmt::format("2 or 3 coordinate directions expected ({} found)", dimension_));
    cursor_.line();
    expect_end();
  }

  void expect_end() {
    cursor_.skip_space();
    const std::size_t start = cursor_.offset();
    const std::string_view line = trimmed(cursor_.line());
    if (line != "ENDOFSECTION")
      cursor_.fail_at(start, fmt::format("'ENDOFSECTION' expected ({} found)", shown(line)));
  }

  bool next_section() {
    cursor_.skip_space();
    if (cursor_.at_end()) return false;
    const std::string_view name = trimmed(cursor_.line());
    if (name.starts_with("NODAL COORDINATES")) {
      read_nodes();
    } else if (name.starts_with("ELEMENTS/CELLS")) {
      read_cells();
    } else if (name.starts_with("ELEMENT GROUP")) {
      read_group();
    } else if (name.starts_with("BOUNDARY CONDITIONS")) {
      read_boundary();
    } else {
      mesh_.notes.push_back(fmt::format("left out section {}", shown(name)));
      while (!cursor_.at_end() && trimmed(cursor_.peek_line()) != "ENDOFSECTION") cursor_.line();
    }
    expect_end();
    return true;
  }

  /// One section holds both; the head of the file gives its length.
  void expect_none(const std::vector<std::int64_t>& numbers, const char* what) const {
    if (!numbers.empty()) cursor_.fail(fmt::format("a second section of {}", what));
  }

  void read_nodes() {
    expect_none(mesh_.node_numbers, "nodes");
    for (std::size_t i = 0; i < nodes_; ++i) {
      mesh_.node_numbers.push_back(cursor_.integer("a node number"));
      for (int c = 0; c < 3; ++c)
        mesh_.xyz.push_back(c < dimension_ ? cursor_.real("a coordinate") : 0.0);
    }
    node_index_ = NumberIndex(mesh_.node_numbers);
    boundary_of_.assign(nodes_, 0);
  }

  void read_cells() {
    expect_none(mesh_.cell_numbers, "elements");
    for (std::size_t i = 0; i < cells_; ++i) {
      mesh_.cell_numbers.push_back(cursor_.integer("an element number"));
      cursor_.skip_space();
      const std::size_t start = cursor_.offset();
      const std::int64_t shape = cursor_.integer("an element's shape");
      const std::int64_t nodes = cursor_.integer("a number of nodes");
      if (shape < kEdge || shape > kPyramid || nodes < 1 || nodes > 64)
        cursor_.fail_at(start, fmt::format("a shape from 1 to 7 with 1 to 64 nodes expected ({} "
                                           "with {} found)",
                                           shape, nodes));
      mesh_.cell_types.push_back(mesh_.type_place(
          shape_name(shape), static_cast<std::size_t>(nodes), conversion_of(shape, nodes)));
      for (std::int64_t n = 0; n < nodes; ++n)
        mesh_.cell_nodes.push_back(cursor_.integer("a node number"));
    }
    cell_index_ = NumberIndex(mesh_.cell_numbers);
    materials_.assign(cells_, 0);
  }

  /// "GROUP: n ELEMENTS: n MATERIAL: n NFLAGS: n", a name, the flags, the elements.
  void read_group() {
    const std::size_t start = cursor_.offset();
    std::array<std::int64_t, 4> numbers{};
    constexpr std::array<std::string_view, 4> kWords{"GROUP:", "ELEMENTS:", "MATERIAL:", "NFLAGS:"};
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (cursor_.word() != kWords[i])
        cursor_.fail_at(start, fmt::format("'{}' expected in the line", kWords[i]));
      numbers[i] = cursor_.integer("a number");
    }
    cursor_.line();
    if (numbers[1] < 0 || numbers[3] < 0) cursor_.fail_at(start, "a negative count");
    ForeignBlock block{std::string(trimmed(cursor_.line())), {}};
    for (std::int64_t i = 0; i < numbers[3]; ++i) cursor_.integer("a flag");
    any_material_ = true;
    for (std::int64_t i = 0; i < numbers[1]; ++i) {
      const std::size_t cell = place(cell_index_, cursor_.integer("an element number"));
      materials_[cell] = static_cast<double>(numbers[2]);
      if (!block.cells.empty() && block.cells.back().end == cell)
        ++block.cells.back().end;
      else
        block.cells.push_back({cell, cell + 1});
    }
    mesh_.blocks.push_back(std::move(block));
  }

  std::size_t place(const NumberIndex& index, std::int64_t number) const {
    const std::size_t found = index.find(number);
    if (found == NumberIndex::kNone)
      cursor_.fail(fmt::format("{} is named, which there is not", number));
    return found;
  }

  /// A name, its type (0: nodes, 1: faces of elements), entries, values an entry, codes.
  void read_boundary() {
    skip_name();
    const std::int64_t type = cursor_.integer("a type of boundary data");
    const std::size_t entries = cursor_.count("the number of entries", cursor_.left());
    cursor_.line();
    if (type == 0) ++boundaries_;
    for (std::size_t i = 0; i < entries; ++i) {
      const std::int64_t number = cursor_.integer("a node or element number");
      if (type == 0) boundary_of_[place(node_index_, number)] = static_cast<double>(boundaries_);
      cursor_.line();
    }
  }

  /// A name has 32 columns and may hold blanks; in files without fixed columns it is one word.
  void skip_name() {
    constexpr std::size_t kColumns = 32;
    const std::string_view line = cursor_.peek_line();
    TextCursor numbers(line.size() > kColumns ? line.substr(kColumns) : std::string_view(), "");
    bool all_numbers = true;
    for (int i = 0; i < 3; ++i) all_numbers &= to_integer(numbers.word()).has_value();
    if (all_numbers)
      cursor_.bytes(kColumns, "a name");
    else
      cursor_.word();
  }

  TextCursor cursor_;
  ForeignMesh mesh_;
  std::size_t nodes_ = 0;
  std::size_t cells_ = 0;
  std::int64_t dimension_ = 3;
  NumberIndex node_index_;
  NumberIndex cell_index_;
  std::vector<double> materials_;
  std::vector<double> boundary_of_;
  bool any_material_ = false;
  std::int64_t boundaries_ = 0;
};

ForeignMesh read_neutral_file(const std::string& path) { return NeuReader(InputText(path)).run(); }

}  // namespace

Format gambit_format() {
  Format format;
  format.name = "gambit";
  format.extensions = {".neu"};
  format.kinds = "tet4,10 pyr5 prism6,15 wedge7,18 brick8,20";
  format.fields = "node, cell (marks)";
  format.time_steps = "none";
  format.recognizes = [](std::string_view head) {
    return head.find("CONTROL INFO") < 80 && head.find("GAMBIT NEUTRAL") != std::string_view::npos;
  };
  format.plausible = [](std::string_view head) { return head.find("CONTROL INFO") < 80; };
  format.gzip = true;
  read_through(format,
               [](const std::string& path, const ReadOptions&) { return read_neutral_file(path); });
  return format;
}

}  // namespace hiac::formats
