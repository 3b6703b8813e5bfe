// Text: the AVS user's guide, "UCD file format"; binary: as VTK's vtkAVSucdReader reads it.
#include "formats/ucd/ucd_file.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

#include <fmt/format.h>

#include "formats/common/cells/solid_orders.hpp"
#include "formats/common/io/number_index.hpp"
#include "formats/common/io/text_cursor.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats::ucd {
namespace {

constexpr char kBinaryMark = 7;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// A cell type in AVS's own order, and in the order of programs that put the bottom first.
struct UcdType {
  std::string_view name;
  std::size_t nodes;
  CellConversion own;
  CellConversion mirrored;
};

constexpr std::array<std::uint8_t, 4> kUcdTetrahedron{0, 1, 3, 2};
constexpr std::array<std::uint8_t, 5> kUcdPyramid{1, 2, 3, 4, 0};
constexpr std::array<std::uint8_t, 5> kPyramidMirrored{1, 4, 3, 2, 0};
// top first in AVS's prism is bottom first in the zoo's, which has the opposite orientation
constexpr std::array<std::uint8_t, 6> kUcdPrism{0, 1, 2, 3, 4, 5};
constexpr std::array<std::uint8_t, 6> kPrismMirrored{0, 2, 1, 3, 5, 4};
constexpr std::array<std::uint8_t, 8> kUcdBrick{4, 5, 6, 7, 0, 1, 2, 3};

/// In the order of their numbers in binary files.
const std::array<UcdType, 8>& types() {
  static const std::array<UcdType, 8> table{
      {{"pt", 1, kNoVolume, kNoVolume},
       {"line", 2, kNoVolume, kNoVolume},
       {"tri", 3, kNoVolume, kNoVolume},
       {"quad", 4, kNoVolume, kNoVolume},
       {"tet", 4, converted_to(CellKind::tetrahedron4, kUcdTetrahedron),
        converted_to(CellKind::tetrahedron4, {})},
       {"pyr", 5, converted_to(CellKind::pyramid5, kUcdPyramid),
        converted_to(CellKind::pyramid5, kPyramidMirrored)},
       {"prism", 6, converted_to(CellKind::prism6, kUcdPrism),
        converted_to(CellKind::prism6, kPrismMirrored)},
       {"hex", 8, converted_to(CellKind::brick8, kUcdBrick), converted_to(CellKind::brick8, {})}}};
  return table;
}

/// The type with that name in a text; some programs write it in capitals or shorten it to three
/// letters.
const UcdType* type_named(std::string_view word) {
  for (const UcdType& type : types())
    if (type.name == word) return &type;
  const std::string found = upper(word);
  for (const UcdType& type : types()) {
    const std::string wanted = upper(type.name);
    if (found == wanted || (found.size() == 3 && wanted.starts_with(found))) return &type;
  }
  return nullptr;
}

/// Skips blank lines and comments before the counts.
void skip_preamble(TextCursor& cursor) {
  while (!cursor.at_end() &&
         (trimmed(cursor.peek_line()).empty() || trimmed(cursor.peek_line()).starts_with('#')))
    cursor.line();
}

/// The counts at the beginning of both encodings.
struct Counts {
  std::size_t nodes = 0;
  std::size_t cells = 0;
  std::size_t node_data = 0;
  std::size_t cell_data = 0;
};

/// Adds all cell types to the mesh, in AVS's own order.
void begin_mesh(ForeignMesh& mesh) {
  for (const UcdType& type : types())
    mesh.types.push_back({std::string(type.name), type.nodes, type.own});
}

using Point = std::array<double, 3>;

/// Six times the volume of the tetrahedron that nodes of the kind span, positive when the cell is
/// positively oriented (a corner and its three neighbours).
double orientation(CellKind kind, const std::array<Point, 8>& p) {
  std::array<std::size_t, 4> corners{0, 1, 3, 4};
  if (kind == CellKind::tetrahedron4) corners = {0, 1, 2, 3};
  if (kind == CellKind::prism6) corners = {0, 2, 1, 3};
  std::array<Point, 3> edge{};
  for (std::size_t e = 0; e < 3; ++e)
    for (std::size_t c = 0; c < 3; ++c) edge[e][c] = p[corners[e + 1]][c] - p[corners[0]][c];
  return edge[0][0] * (edge[1][1] * edge[2][2] - edge[1][2] * edge[2][1]) -
         edge[0][1] * (edge[1][0] * edge[2][2] - edge[1][2] * edge[2][0]) +
         edge[0][2] * (edge[1][0] * edge[2][1] - edge[1][1] * edge[2][0]);
}

/// Chooses, for every type, the order in which most of its cells are positively oriented.
void choose_orders(ForeignMesh& mesh) {
  const NumberIndex index(mesh.node_numbers);
  std::array<std::int64_t, 8> balance{};
  std::size_t begin = 0;
  for (const std::uint16_t type : mesh.cell_types) {
    const CellConversion& conversion = mesh.types[type].conversion;
    const std::size_t nodes = mesh.types[type].nodes;
    if (conversion.fate == CellFate::converted) {
      std::array<Point, 8> points{};
      bool there = true;
      for (std::size_t n = 0; n < nodes; ++n) {
        const std::size_t place = index.find(
            mesh.cell_nodes[begin +
                            (conversion.permutation.empty() ? n : conversion.permutation[n])]);
        there &= place != NumberIndex::kNone;
        for (std::size_t c = 0; there && c < 3; ++c) points[n][c] = mesh.xyz[3 * place + c];
      }
      const double volume = there ? orientation(conversion.kind, points) : 0;
      balance[type] += volume > 0 ? 1 : (volume < 0 ? -1 : 0);
    }
    begin += nodes;
  }
  for (std::size_t t = 0; t < balance.size(); ++t) {
    if (balance[t] >= 0) continue;
    mesh.types[t].conversion = types()[t].mirrored;
    mesh.notes.push_back(fmt::format(
        "{} cells have their nodes in the mirror image of AVS's order, which is how they are read",
        mesh.types[t].name));
  }
}

class TextReader {
 public:
  explicit TextReader(const InputText& text) : cursor_(text.text(), text.path()) {}

  ForeignMesh run() {
    begin_mesh(mesh_);
    skip_preamble(cursor_);
    read_counts();
    read_nodes();
    read_cells();
    read_data(counts_.node_data, FieldLocation::node);
    read_data(counts_.cell_data, FieldLocation::cell);
    return std::move(mesh_);
  }

 private:
  void read_counts() {
    const std::size_t left = cursor_.left();
    counts_.nodes = cursor_.count("the number of nodes", left);
    counts_.cells = cursor_.count("the number of cells", left);
    counts_.node_data = cursor_.count("the number of node data", left);
    counts_.cell_data = cursor_.count("the number of cell data", left);
    cursor_.count("the number of model data", left);
  }

  void read_nodes() {
    mesh_.node_numbers.reserve(counts_.nodes / 4);
    for (std::size_t i = 0; i < counts_.nodes; ++i) {
      mesh_.node_numbers.push_back(cursor_.integer("a node number"));
      for (int c = 0; c < 3; ++c) mesh_.xyz.push_back(cursor_.real("a coordinate"));
    }
  }

  void read_cells() {
    std::vector<double> materials;
    for (std::size_t i = 0; i < counts_.cells; ++i) {
      mesh_.cell_numbers.push_back(cursor_.integer("a cell number"));
      materials.push_back(static_cast<double>(cursor_.integer("a material")));
      cursor_.skip_space();
      const std::size_t at = cursor_.offset();
      const std::string_view name = cursor_.word();
      const UcdType* type = type_named(name);
      if (type == nullptr)
        cursor_.fail_at(at,
                        fmt::format("unknown cell type (pt, line, tri, quad, tet, pyr, prism or "
                                    "hex expected, {} found)",
                                    shown(name)));
      mesh_.cell_types.push_back(static_cast<std::uint16_t>(type - types().data()));
      for (std::size_t n = 0; n < type->nodes; ++n)
        mesh_.cell_nodes.push_back(cursor_.integer("a node number"));
    }
    mesh_.fields.push_back(field_of("Material Id", FieldLocation::cell, 1, std::move(materials)));
  }

  /// Reads the counts of components, a line "name, unit" for each, and a tuple for each node or
  /// cell.
  void read_data(std::size_t total, FieldLocation location) {
    if (total == 0) return;
    const bool on_nodes = location == FieldLocation::node;
    const std::size_t tuples = on_nodes ? counts_.nodes : counts_.cells;
    const std::size_t components = cursor_.count("a number of data", total);
    std::vector<std::size_t> widths;
    for (std::size_t i = 0; i < components; ++i)
      widths.push_back(cursor_.count("a number of components", total));
    cursor_.line();
    std::vector<ForeignField> fields;
    std::vector<std::vector<double>> values(components);
    for (std::size_t i = 0; i < components; ++i) {
      const std::string_view line = cursor_.line();
      const std::size_t comma = line.find(',');
      fields.push_back(field_of(std::string(trimmed(line.substr(0, comma))), location,
                                static_cast<std::uint32_t>(widths[i]), {}));
      if (comma != std::string_view::npos) fields.back().unit = trimmed(line.substr(comma + 1));
    }
    read_tuples(tuples, on_nodes, widths, values);
    for (std::size_t i = 0; i < components; ++i) {
      if (widths[i] == 0) continue;
      fields[i].values = field_of("", location, 1, std::move(values[i])).values;
      mesh_.fields.push_back(std::move(fields[i]));
    }
  }

  void read_tuples(std::size_t tuples, bool on_nodes, const std::vector<std::size_t>& widths,
                   std::vector<std::vector<double>>& values) {
    const NumberIndex index(on_nodes ? mesh_.node_numbers : mesh_.cell_numbers);
    for (std::size_t i = 0; i < widths.size(); ++i) {
      if (widths[i] > cursor_.left())
        cursor_.fail(fmt::format("{} values expected, more than the file can hold", widths[i]));
      if (tuples > 0 && widths[i] > cursor_.left() / tuples)
        cursor_.fail("more values expected than the file can hold");
      values[i].assign(tuples * widths[i], kNone);
    }
    for (std::size_t t = 0; t < tuples; ++t) {
      cursor_.skip_space();
      const std::size_t at = cursor_.offset();
      const std::int64_t number = cursor_.integer("a node or cell number");
      const std::size_t place = index.find(number);
      if (place == NumberIndex::kNone)
        cursor_.fail_at(at, fmt::format("a value for {}, which there is not", number));
      for (std::size_t i = 0; i < widths.size(); ++i)
        for (std::size_t c = 0; c < widths[i]; ++c)
          values[i][place * widths[i] + c] = cursor_.real("a value");
    }
  }

  TextCursor cursor_;
  ForeignMesh mesh_;
  Counts counts_;
};

class BinaryReader {
 public:
  explicit BinaryReader(const InputText& text) : cursor_(text.text(), text.path()) {}

  ForeignMesh run() {
    begin_mesh(mesh_);
    read_counts();
    read_cells();
    read_nodes();
    read_data(counts_.node_data, counts_.nodes, FieldLocation::node);
    read_data(counts_.cell_data, counts_.cells, FieldLocation::cell);
    return std::move(mesh_);
  }

 private:
  static constexpr std::size_t kHeadIntegers = 6;
  static constexpr std::size_t kLabelBytes = 1024;

  std::int32_t integer() { return number<std::int32_t>(); }
  double real() { return static_cast<double>(number<float>()); }

  template <typename Number>
  Number number() {
    char bytes[sizeof(Number)];
    std::memcpy(bytes, cursor_.bytes(sizeof(Number), "a number").data(), sizeof(Number));
    if (swapped_) std::reverse(std::begin(bytes), std::end(bytes));
    Number value;
    std::memcpy(&value, bytes, sizeof(Number));
    return value;
  }

  /// The byte order for which the declared counts give the file's size.
  void read_counts() {
    std::array<std::size_t, kHeadIntegers> head{};
    for (const bool swapped : {false, true}) {
      swapped_ = swapped;
      cursor_.move_to(1);
      bool sane = true;
      for (std::size_t& count : head) {
        const std::int32_t value = integer();
        sane &= value >= 0;
        count = static_cast<std::size_t>(value);
      }
      if (sane && announced_bytes(head) == cursor_.text().size()) {
        counts_ = {head[0], head[1], head[2], head[3]};
        entries_ = head[5];
        return;
      }
    }
    throw InputError(cursor_.subject(),
                     fmt::format("the counts do not make the file's size ({} bytes found)",
                                 cursor_.text().size()));
  }

  static std::size_t announced_bytes(const std::array<std::size_t, kHeadIntegers>& head) {
    const auto [nodes, cells, node_data, cell_data, model_data, entries] = head;
    std::size_t bytes = 1 + 4 * kHeadIntegers + 16 * cells + 4 * entries + 12 * nodes;
    const std::size_t labels = 2 * kLabelBytes + 4;
    if (node_data > 0) bytes += labels + node_data * (16 + 4 * nodes);
    if (cell_data > 0) bytes += labels + cell_data * (16 + 4 * cells);
    if (model_data > 0) bytes += labels + model_data * 20;
    return bytes;
  }

  void read_cells() {
    std::vector<double> materials;
    std::size_t entries = 0;
    for (std::size_t i = 0; i < counts_.cells; ++i) {
      mesh_.cell_numbers.push_back(integer());
      materials.push_back(integer());
      const std::int32_t nodes = integer();
      const std::int32_t type = integer();
      if (type < 0 || static_cast<std::size_t>(type) >= types().size() ||
          nodes != static_cast<std::int32_t>(types()[static_cast<std::size_t>(type)].nodes))
        throw InputError(cursor_.subject(),
                         fmt::format("cell {}: type {} with {} nodes is not known",
                                     mesh_.cell_numbers.back(), type, nodes));
      mesh_.cell_types.push_back(static_cast<std::uint16_t>(type));
      entries += static_cast<std::size_t>(nodes);
    }
    if (entries != entries_)
      throw InputError(cursor_.subject(),
                       fmt::format("the cells' nodes do not fit ({} expected, {} "
                                   "found)",
                                   entries_, entries));
    for (std::size_t i = 0; i < entries; ++i) mesh_.cell_nodes.push_back(integer());
    mesh_.fields.push_back(field_of("Material Id", FieldLocation::cell, 1, std::move(materials)));
  }

  void read_nodes() {
    mesh_.xyz.resize(3 * counts_.nodes);
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < counts_.nodes; ++i) mesh_.xyz[3 * i + c] = real();
    for (std::size_t i = 0; i < counts_.nodes; ++i)
      mesh_.node_numbers.push_back(static_cast<std::int64_t>(i) + 1);
  }

  void read_data(std::size_t total, std::size_t tuples, FieldLocation location) {
    if (total == 0) return;
    std::string_view names = cursor_.bytes(kLabelBytes, "labels");
    std::string_view units = cursor_.bytes(kLabelBytes, "units");
    const std::int32_t components = integer();
    std::vector<std::size_t> widths;
    for (std::size_t i = 0; i < total; ++i) widths.push_back(static_cast<std::size_t>(integer()));
    cursor_.bytes(8 * total, "ranges");
    std::size_t sum = 0;
    for (std::int32_t i = 0; i < components && sum < total; ++i) {
      const std::size_t width = widths[static_cast<std::size_t>(i)];
      if (width < 1 || width > total - sum)
        throw InputError(cursor_.subject(), "numbers of components do not fit the number of data");
      sum += width;
      std::vector<double> values(width * tuples);
      for (double& value : values) value = real();
      ForeignField field = field_of(next_label(names), location, static_cast<std::uint32_t>(width),
                                    std::move(values));
      field.unit = next_label(units);
      field.type = "float";
      mesh_.fields.push_back(std::move(field));
    }
    if (sum != total)
      throw InputError(cursor_.subject(), fmt::format("{} data expected ({} found)", total, sum));
    cursor_.bytes(4 * total, "active data");
  }

  /// Labels are separated by full stops and end with a zero byte.
  static std::string next_label(std::string_view& labels) {
    const std::size_t end =
        std::min(labels.find_first_of(std::string_view(".\0", 2)), labels.size());
    std::string label(trimmed(labels.substr(0, end)));
    labels.remove_prefix(std::min(end + 1, labels.size()));
    return label;
  }

  TextCursor cursor_;
  bool swapped_ = false;
  ForeignMesh mesh_;
  Counts counts_;
  std::size_t entries_ = 0;
};

}  // namespace

bool looks_like_ucd(std::string_view head) {
  if (head.starts_with(kBinaryMark)) return true;
  TextCursor cursor(head, "");
  skip_preamble(cursor);
  TextCursor counts(cursor.line(), "");
  for (int i = 0; i < 5; ++i)
    if (!to_integer(counts.word())) return false;
  counts.skip_space();
  return counts.at_end();
}

ForeignMesh read_ucd(const InputText& text) {
  ForeignMesh mesh =
      text.text().starts_with(kBinaryMark) ? BinaryReader(text).run() : TextReader(text).run();
  choose_orders(mesh);
  return mesh;
}

}  // namespace hiac::formats::ucd
