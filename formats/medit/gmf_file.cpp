// The keywords, their numbers in binary files and the node orders: libMeshb (libmeshb7, "GMF").
#include "formats/medit/gmf_file.hpp"

#include <array>
#include <cctype>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "formats/common/cells/solid_orders.hpp"
#include "formats/common/io/byte_stream.hpp"
#include "formats/common/io/bytes_behind.hpp"
#include "formats/common/io/text_cursor.hpp"

namespace hiac::formats::medit {
namespace {

/// A keyword of cells: its number in binary files, the number of nodes and the kind of its cells.
struct CellKeyword {
  std::string_view name;
  std::int32_t code;
  std::size_t nodes;
  std::optional<CellKind> kind;                     ///< none: no volume, unless `corners`
  std::optional<CellShape> corners = std::nullopt;  ///< for volumes that the zoo has no kind for
};

constexpr std::array<CellKeyword, 16> kCells{
    {{"Edges", 5, 2, std::nullopt},
     {"Triangles", 6, 3, std::nullopt},
     {"Quadrilaterals", 7, 4, std::nullopt},
     {"Tetrahedra", 8, 4, CellKind::tetrahedron4},
     {"Prisms", 9, 6, CellKind::prism6},
     {"Hexahedra", 10, 8, CellKind::brick8},
     {"TrianglesP2", 24, 6, std::nullopt},
     {"EdgesP2", 25, 3, std::nullopt},
     {"QuadrilateralsQ2", 27, 9, std::nullopt},
     {"TetrahedraP2", 30, 10, CellKind::tetrahedron10},
     {"HexahedraQ2", 33, 27, std::nullopt, CellShape::brick},
     {"Pyramids", 49, 5, CellKind::pyramid5},
     {"PrismsP2", 86, 18, std::nullopt, CellShape::prism},
     {"PyramidsP2", 87, 14, std::nullopt, CellShape::pyramid},
     {"TetrahedraP3", 90, 20, std::nullopt, CellShape::tetrahedron},
     {"TetrahedraP4", 94, 35, std::nullopt, CellShape::tetrahedron}}};

constexpr std::int32_t kDimensionCode = 3;
constexpr std::int32_t kVerticesCode = 4;
constexpr std::int32_t kEndCode = 54;

CellConversion conversion_of(const CellKeyword& keyword) {
  if (keyword.kind) return solid_conversion(*keyword.kind);
  return keyword.corners ? unsupported_with_corners(*keyword.corners) : kNoVolume;
}

/// The mesh that both encodings are read into.
class MeshBuilder {
 public:
  void add_vertex(const std::array<double, 3>& point, std::int64_t reference) {
    mesh_.xyz.insert(mesh_.xyz.end(), point.begin(), point.end());
    node_references_.push_back(static_cast<double>(reference));
  }
  std::uint16_t type_place(const CellKeyword& keyword) {
    return mesh_.type_place(keyword.name, keyword.nodes, conversion_of(keyword));
  }
  void add_cell(std::uint16_t type, std::int64_t reference) {
    mesh_.cell_types.push_back(type);
    cell_references_.push_back(static_cast<double>(reference));
  }
  void add_node(std::int64_t node) { mesh_.cell_nodes.push_back(node); }
  void leave_out(std::string keyword) { left_out_.insert(std::move(keyword)); }

  std::vector<std::string>& notes() { return mesh_.notes; }
  [[nodiscard]] bool has_vertices() const { return !mesh_.xyz.empty(); }
  ForeignMesh finish() {
    mesh_.first_node = 1;
    mesh_.fields.push_back(field_of("ref", FieldLocation::node, 1, std::move(node_references_)));
    mesh_.fields.push_back(field_of("ref", FieldLocation::cell, 1, std::move(cell_references_)));
    if (!left_out_.empty())
      mesh_.notes.push_back(fmt::format("left out: {}", fmt::join(left_out_, ", ")));
    return std::move(mesh_);
  }

 private:
  ForeignMesh mesh_;
  std::vector<double> node_references_;
  std::vector<double> cell_references_;
  std::set<std::string> left_out_;
};

class TextReader {
 public:
  explicit TextReader(const InputText& text) : cursor_(text.text(), text.path()) {}

  ForeignMesh run() {
    while (true) {
      const std::string_view keyword = next_keyword();
      if (keyword.empty() || keyword == "End") break;
      read(keyword);
    }
    note_text_behind(cursor_.text().substr(cursor_.offset()), "the keyword End", builder_.notes());
    if (!builder_.has_vertices()) cursor_.fail("no vertices found ('Vertices' expected)");
    return builder_.finish();
  }

 private:
  /// The next word that is not a number; skips comments and the numbers of keywords that are left
  /// out.
  std::string_view next_keyword() {
    while (true) {
      skip_comments();
      if (cursor_.at_end()) return {};
      const char first = cursor_.text()[cursor_.offset()];
      start_ = cursor_.offset();
      const std::string_view word = cursor_.word();
      if (std::isalpha(static_cast<unsigned char>(first)) != 0) return word;
      if (!skipping_) {
        cursor_.fail_at(start_, fmt::format("a keyword expected ({} found)", shown(word)));
      }
    }
  }

  void skip_comments() {
    cursor_.skip_space();
    while (!cursor_.at_end() && cursor_.text()[cursor_.offset()] == '#') {
      cursor_.line();
      cursor_.skip_space();
    }
  }

  void read(std::string_view keyword) {
    skipping_ = false;
    skip_comments();
    if (keyword == "MeshVersionFormatted") {
      cursor_.integer("a version");
    } else if (keyword == "Dimension") {
      const std::int64_t dimension = cursor_.integer("a dimension");
      if (dimension != 3)
        cursor_.fail_at(start_, fmt::format("dimension 3 expected ({} found)", dimension));
    } else if (keyword == "Vertices") {
      read_vertices();
    } else {
      for (const CellKeyword& known : kCells)
        if (known.name == keyword) return read_cells(known);
      builder_.leave_out(shown(keyword));
      skipping_ = true;
    }
  }

  void read_vertices() {
    const std::size_t count = cursor_.count("the number of vertices", cursor_.left());
    for (std::size_t i = 0; i < count; ++i) {
      skip_comments();
      std::array<double, 3> point{};
      for (double& x : point) x = cursor_.real("a coordinate");
      builder_.add_vertex(point, cursor_.integer("a reference"));
    }
  }

  void read_cells(const CellKeyword& keyword) {
    const std::uint16_t type = builder_.type_place(keyword);
    const std::size_t count = cursor_.count("the number of cells", cursor_.left());
    for (std::size_t i = 0; i < count; ++i) {
      skip_comments();
      for (std::size_t n = 0; n < keyword.nodes; ++n)
        builder_.add_node(cursor_.integer("a vertex"));
      builder_.add_cell(type, cursor_.integer("a reference"));
    }
  }

  TextCursor cursor_;
  MeshBuilder builder_;
  std::size_t start_ = 0;
  bool skipping_ = false;  ///< the numbers of a keyword that is left out
};

class BinaryReader {
 public:
  explicit BinaryReader(const InputText& text) : stream_(text.text(), text.path()) {}

  ForeignMesh run() {
    read_head();
    while (stream_.left() > 0 && read_keyword()) {
    }
    note_bytes_behind(stream_.left(), "the last keyword", builder_.notes());
    if (!builder_.has_vertices()) stream_.fail("no vertices found");
    return builder_.finish();
  }

 private:
  void read_head() {
    stream_.set_order(std::endian::little);
    if (stream_.read<std::int32_t>("the number one") != 1) stream_.set_order(std::endian::big);
    version_ = stream_.read<std::int32_t>("a version");
    if (version_ < 1 || version_ > 4)
      stream_.fail(fmt::format("version 1 to 4 expected ({} found)", version_));
  }

  /// Positions in the file have 32 bits in versions 1 and 2.
  std::int64_t position() {
    return version_ >= 3 ? stream_.read<std::int64_t>("a position")
                         : stream_.read<std::int32_t>("a position");
  }
  std::int64_t integer(std::string_view what) {
    return version_ >= 4 ? stream_.read<std::int64_t>(what) : stream_.read<std::int32_t>(what);
  }
  double real(std::string_view what) {
    return version_ == 1 ? static_cast<double>(stream_.read<float>(what))
                         : stream_.read<double>(what);
  }

  bool read_keyword() {
    const auto code = stream_.read<std::int32_t>("a keyword");
    if (code == kEndCode) {
      // some programs let the position of a next keyword follow, which is 0
      if (stream_.left() >= (version_ >= 3 ? 8U : 4U)) position();
      return false;
    }
    const std::int64_t next = position();
    const std::size_t begin = stream_.offset();
    if (next != 0 && (next < static_cast<std::int64_t>(begin) ||
                      static_cast<std::uint64_t>(next) > stream_.size()))
      stream_.fail(
          fmt::format("the next keyword's position: impossible ({} to {} expected, {} "
                      "found)",
                      begin, stream_.size(), next));
    if (code == kDimensionCode) {
      const auto dimension = stream_.read<std::int32_t>("a dimension");
      if (dimension != 3) stream_.fail(fmt::format("dimension 3 expected ({} found)", dimension));
    } else if (code == kVerticesCode) {
      read_vertices();
    } else {
      read_others(code);
    }
    if (next == 0) return false;
    stream_.move_to(static_cast<std::size_t>(next));
    return true;
  }

  std::size_t count(std::string_view what, std::size_t bytes) {
    const std::int64_t value = integer(what);
    if (value < 0 || static_cast<std::uint64_t>(value) > stream_.left() / bytes)
      stream_.fail(fmt::format("{}: impossible (0 to {} expected, {} found)", what,
                               stream_.left() / bytes, value));
    return static_cast<std::size_t>(value);
  }

  void read_vertices() {
    const std::size_t bytes = 3 * (version_ == 1 ? 4U : 8U) + (version_ >= 4 ? 8U : 4U);
    const std::size_t vertices = count("the number of vertices", bytes);
    for (std::size_t i = 0; i < vertices; ++i) {
      std::array<double, 3> point{};
      for (double& x : point) x = real("a coordinate");
      builder_.add_vertex(point, integer("a reference"));
    }
  }

  void read_others(std::int32_t code) {
    for (const CellKeyword& known : kCells) {
      if (known.code != code) continue;
      const std::uint16_t type = builder_.type_place(known);
      const std::size_t cells =
          count("the number of cells", (known.nodes + 1) * (version_ >= 4 ? 8U : 4U));
      for (std::size_t i = 0; i < cells; ++i) {
        for (std::size_t n = 0; n < known.nodes; ++n) builder_.add_node(integer("a vertex"));
        builder_.add_cell(type, integer("a reference"));
      }
      return;
    }
    builder_.leave_out(fmt::format("keyword {}", code));
  }

  ByteStream stream_;
  MeshBuilder builder_;
  std::int32_t version_ = 0;
};

bool is_binary(std::string_view head) {
  return head.starts_with(std::string_view("\1\0\0\0", 4)) ||
         head.starts_with(std::string_view("\0\0\0\1", 4));
}

}  // namespace

bool looks_like_gmf(std::string_view head) {
  if (is_binary(head)) {
    ByteStream stream(head, "");
    stream.set_order(head.front() == 1 ? std::endian::little : std::endian::big);
    if (head.size() < 12) return false;
    stream.move_to(4);
    const auto version = stream.read<std::int32_t>("");
    return version >= 1 && version <= 4 && stream.read<std::int32_t>("") == kDimensionCode;
  }
  TextCursor cursor(head, "");
  while (!cursor.at_end() &&
         (trimmed(cursor.peek_line()).empty() || trimmed(cursor.peek_line()).starts_with('#')))
    cursor.line();
  return cursor.word() == "MeshVersionFormatted";
}

ForeignMesh read_gmf(const InputText& text) {
  return is_binary(text.text()) ? BinaryReader(text).run() : TextReader(text).run();
}

}  // namespace hiac::formats::medit
