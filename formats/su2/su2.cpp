// The layout: the SU2 documentation, "Mesh File". Elements have VTK's numbers and node orders.
#include "formats/su2/su2.hpp"

#include <map>

#include <fmt/format.h>

#include "formats/common/cells/solid_orders.hpp"
#include "formats/common/io/input_text.hpp"
#include "formats/common/io/text_cursor.hpp"
#include "formats/common/mesh/assemble.hpp"

namespace hiac::formats {
namespace {

class Su2Reader {
 public:
  explicit Su2Reader(const InputText& text) : cursor_(text.text(), text.path()) {}

  ForeignMesh run() {
    while (!cursor_.at_end()) {
      const std::size_t start = cursor_.offset();
      const std::string_view line = trimmed(cursor_.line());
      if (line.empty() || line.starts_with('%')) continue;
      const std::size_t equals = line.find('=');
      // lines of sections that are left out: corners of free-form deformation boxes, periodic
      // markers
      if (equals == std::string_view::npos && skipping_) continue;
      if (equals == std::string_view::npos)
        cursor_.fail_at(start, fmt::format("a keyword NAME= expected ({} found)", shown(line)));
      read(upper(trimmed(line.substr(0, equals))), trimmed(line.substr(equals + 1)), start);
    }
    end_zone();
    if (mesh_.xyz.empty() || mesh_.cell_types.empty())
      cursor_.fail(fmt::format("the file ends too early ({}= expected)",
                               mesh_.xyz.empty() ? "NPOIN" : "NELEM"));
    return std::move(mesh_);
  }

 private:
  std::size_t count_in(std::string_view value, std::size_t start) const {
    TextCursor words(value, "");
    const auto count = to_integer(words.word());
    if (!count || *count < 0 || static_cast<std::uint64_t>(*count) > cursor_.left())
      cursor_.fail_at(start, fmt::format("a count expected ({} found)", shown(value)));
    return static_cast<std::size_t>(*count);
  }

  void read(const std::string& keyword, std::string_view value, std::size_t start) {
    if (keyword == "NDIME" && count_in(value, start) != 3)
      cursor_.fail_at(start, fmt::format("NDIME= 3 expected ({} found)", shown(value)));
    skipping_ = false;
    if (keyword == "IZONE") {
      begin_zone(value);
    } else if (keyword == "NELEM") {
      read_elements(count_in(value, start));
    } else if (keyword == "NPOIN") {
      read_points(count_in(value, start));
    } else if (keyword == "MARKER_ELEMS") {
      skip_markers(count_in(value, start));
    } else {
      skipping_ = !keyword.starts_with("ND") && keyword != "NZONE" && keyword != "NMARK";
    }
  }

  /// Every zone numbers its points from 0.
  void begin_zone(std::string_view number) {
    end_zone();
    zone_ = fmt::format("zone {}", number);
    first_point_ = mesh_.point_count();
    first_node_place_ = mesh_.cell_nodes.size();
    first_cell_ = mesh_.cell_count();
  }
  void end_zone() {
    if (zone_.empty()) return;
    mesh_.blocks.push_back({zone_, {{first_cell_, mesh_.cell_count()}}});
    const auto points = static_cast<std::int64_t>(mesh_.point_count() - first_point_);
    for (std::size_t i = first_node_place_; i < mesh_.cell_nodes.size(); ++i) {
      std::int64_t& node = mesh_.cell_nodes[i];
      if (node < 0 || node >= points)
        cursor_.fail(
            fmt::format("{}: there is no point {} (0 to {} expected)", zone_, node, points - 1));
      node += static_cast<std::int64_t>(first_point_);
    }
  }

  /// Moves to the next row, skipping comments.
  void begin_row() {
    cursor_.skip_space();
    while (!cursor_.at_end() && cursor_.peek_line().starts_with('%')) {
      cursor_.line();
      cursor_.skip_space();
    }
  }

  void read_elements(std::size_t count) {
    static const std::map<std::int64_t, ForeignType> kTypes{
        {3, {"line", 2, kNoVolume}},
        {5, {"triangle", 3, kNoVolume}},
        {9, {"quadrilateral", 4, kNoVolume}},
        {10, {"tetrahedron", 4, solid_conversion(CellKind::tetrahedron4)}},
        {12, {"hexahedron", 8, solid_conversion(CellKind::brick8)}},
        {13, {"prism", 6, solid_conversion(CellKind::prism6)}},
        {14, {"pyramid", 5, solid_conversion(CellKind::pyramid5)}}};
    for (std::size_t i = 0; i < count; ++i) {
      begin_row();
      const std::size_t start = cursor_.offset();
      const std::int64_t number = cursor_.integer("an element type");
      const auto type = kTypes.find(number);
      if (type == kTypes.end())
        cursor_.fail_at(start, fmt::format("unknown element type {}", number));
      mesh_.cell_types.push_back(
          mesh_.type_place(type->second.name, type->second.nodes, type->second.conversion));
      for (std::size_t n = 0; n < type->second.nodes; ++n)
        mesh_.cell_nodes.push_back(cursor_.integer("a node"));
      cursor_.line();  // the element's own number may follow
    }
  }

  void read_points(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      begin_row();
      for (int c = 0; c < 3; ++c) mesh_.xyz.push_back(cursor_.real("a coordinate"));
      cursor_.line();
    }
  }

  void skip_markers(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      begin_row();
      if (cursor_.at_end()) cursor_.fail("the file ends within a marker's elements");
      cursor_.line();
    }
  }

  TextCursor cursor_;
  ForeignMesh mesh_;
  bool skipping_ = false;  ///< in a section that is left out
  std::string zone_;       ///< the current zone if the file has several
  std::size_t first_point_ = 0;
  std::size_t first_node_place_ = 0;
  std::size_t first_cell_ = 0;
};

}  // namespace

Format su2_format() {
  Format format;
  format.name = "su2";
  format.extensions = {".su2"};
  format.kinds = "tet4 pyr5 prism6 wedge7 brick8";
  format.fields = "none";
  format.time_steps = "none";
  format.recognizes = [](std::string_view head) {
    TextCursor cursor(head, "");
    while (!cursor.at_end()) {
      const std::string_view line = trimmed(cursor.line());
      if (line.empty() || line.starts_with('%')) continue;
      const std::string keyword = upper(trimmed(line.substr(0, line.find('='))));
      return keyword == "NDIME" || keyword == "NZONE" || keyword == "NELEM" || keyword == "NPOIN";
    }
    return false;
  };
  format.gzip = true;
  read_through(format, [](const std::string& path, const ReadOptions&) {
    return Su2Reader(InputText(path)).run();
  });
  return format;
}

}  // namespace hiac::formats
