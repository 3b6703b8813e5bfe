// The layout: the TetGen manual, section 5.2 "File formats".
#include "formats/tetgen/tetgen.hpp"

#include <array>
#include <filesystem>

#include <fmt/format.h>

#include "formats/common/cells/solid_orders.hpp"
#include "formats/common/io/bytes_behind.hpp"
#include "formats/common/io/input_text.hpp"
#include "formats/common/io/text_cursor.hpp"
#include "formats/common/mesh/assemble.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats {
namespace {

/// Edges in the order of the ten-node tetrahedra that `tetgen -o2` writes (found by its library).
constexpr std::array<ShapeEdge, 6> kEdges{{{2, 3}, {0, 3}, {0, 1}, {1, 2}, {1, 3}, {0, 2}}};

/// Lines of words in which # begins a comment.
class WordLines {
 public:
  explicit WordLines(const InputText& text) : cursor_(text.text(), text.path()) {}

  std::int64_t integer(std::string_view what) {
    skip_comments();
    return cursor_.integer(what);
  }
  double real(std::string_view what) {
    skip_comments();
    return cursor_.real(what);
  }
  std::size_t count(std::string_view what) {
    skip_comments();
    return cursor_.count(what, cursor_.left());
  }
  /// A count at the end of a file's first line; 0 when it is omitted.
  std::size_t count_in_line(std::string_view what) {
    const std::string_view rest = trimmed(cursor_.peek_line());
    return rest.empty() || rest.starts_with('#') ? 0 : count(what);
  }
  TextCursor& cursor() { return cursor_; }
  /// Adds a note when more than comments follow.
  void finish(std::string_view what, std::vector<std::string>& notes) {
    skip_comments();
    note_text_behind(cursor_.text().substr(cursor_.offset()), what, notes);
  }

 private:
  void skip_comments() {
    cursor_.skip_space();
    while (!cursor_.at_end() && cursor_.peek_line().starts_with('#')) {
      cursor_.line();
      cursor_.skip_space();
    }
  }
  TextCursor cursor_;
};

void add_columns(std::vector<std::vector<double>>&& columns, std::string_view name,
                 FieldLocation location, ForeignMesh& mesh) {
  for (std::size_t i = 0; i < columns.size(); ++i)
    mesh.fields.push_back(
        field_of(columns.size() == 1 ? std::string(name) : fmt::format("{} {}", name, i + 1),
                 location, 1, std::move(columns[i])));
}

void read_nodes(const std::string& path, ForeignMesh& mesh) {
  const InputText text(path);
  WordLines lines(text);
  const std::size_t count = lines.count("the number of points");
  if (lines.integer("a dimension") != 3) lines.cursor().fail("dimension 3 expected");
  const std::size_t attributes = lines.count_in_line("the number of attributes");
  const std::size_t markers = lines.count_in_line("0 or 1 boundary markers");
  if (count > 0 && attributes > lines.cursor().left() / count)
    lines.cursor().fail("more attributes announced than the file can hold");
  std::vector<std::vector<double>> columns(attributes);
  std::vector<std::vector<double>> marks(markers > 0 ? 1 : 0);
  for (std::size_t i = 0; i < count; ++i) {
    mesh.node_numbers.push_back(lines.integer("a point number"));
    for (int c = 0; c < 3; ++c) mesh.xyz.push_back(lines.real("a coordinate"));
    for (auto& column : columns) column.push_back(lines.real("an attribute"));
    for (auto& column : marks) column.push_back(lines.real("a boundary marker"));
  }
  lines.finish("the points", mesh.notes);
  add_columns(std::move(columns), "attribute", FieldLocation::node, mesh);
  add_columns(std::move(marks), "boundary marker", FieldLocation::node, mesh);
}

void read_elements(const std::string& path, ForeignMesh& mesh) {
  const InputText text(path);
  WordLines lines(text);
  const std::size_t count = lines.count("the number of tetrahedra");
  const std::int64_t nodes = lines.integer("the number of nodes of a tetrahedron");
  if (nodes != 4 && nodes != 10)
    lines.cursor().fail(fmt::format("4 or 10 nodes of a tetrahedron expected ({} found)", nodes));
  const std::size_t attributes = lines.count_in_line("the number of attributes");
  if (count > 0 && attributes > lines.cursor().left() / count)
    lines.cursor().fail("more attributes announced than the file can hold");
  mesh.types = {{fmt::format("tetrahedron{}", nodes), static_cast<std::size_t>(nodes),
                 nodes == 4 ? solid_conversion(CellKind::tetrahedron4)
                            : solid_conversion(CellKind::tetrahedron10, kEdges)}};
  std::vector<std::vector<double>> columns(attributes);
  for (std::size_t i = 0; i < count; ++i) {
    mesh.cell_numbers.push_back(lines.integer("a tetrahedron's number"));
    mesh.cell_types.push_back(0);
    for (std::int64_t n = 0; n < nodes; ++n)
      mesh.cell_nodes.push_back(lines.integer("a point number"));
    for (auto& column : columns) column.push_back(lines.real("an attribute"));
  }
  lines.finish("the tetrahedra", mesh.notes);
  add_columns(std::move(columns), "ref", FieldLocation::cell, mesh);
}

ForeignMesh read_files(const std::string& path) {
  ForeignMesh mesh;
  read_nodes(std::filesystem::path(path).replace_extension(".node").string(), mesh);
  read_elements(std::filesystem::path(path).replace_extension(".ele").string(), mesh);
  return mesh;
}

}  // namespace

Format tetgen_format() {
  Format format;
  format.name = "tetgen";
  format.extensions = {".node", ".ele"};
  format.kinds = "tet4,10";
  format.fields = "node, cell (attributes)";
  format.time_steps = "none";
  format.recognizes = [](std::string_view) { return false; };
  format.plausible = [](std::string_view head) {
    TextCursor cursor(head, "");
    cursor.skip_space();
    return !cursor.at_end() &&
           (head[cursor.offset()] == '#' || to_integer(cursor.word()).has_value());
  };
  read_through(format,
               [](const std::string& path, const ReadOptions&) { return read_files(path); });
  return format;
}

}  // namespace hiac::formats
