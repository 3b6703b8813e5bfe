#include "formats/vtk/xml/xml_layout.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "formats/common/io/text_cursor.hpp"
#include "formats/vtk/array_names.hpp"
#include "formats/vtk/xml/xml_text.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats::vtk {
namespace {

using Extent = std::array<long, 6>;

bool is_array(pugi::xml_node element) {
  const std::string_view name = element.name();
  return name == "DataArray" || name == "Array";
}

/// The numbers of an attribute.
template <typename Number, std::size_t N>
std::array<Number, N> numbers_attribute(const XmlText& text, pugi::xml_node element,
                                        const char* name) {
  std::array<Number, N> numbers{};
  const std::string_view value = element.attribute(name).as_string();
  const char* at = value.data();
  const char* const end = at + value.size();
  for (Number& number : numbers) {
    while (at != end && (*at == ' ' || *at == '\t' || *at == '\n')) ++at;
    at = without_plus({at, end}).data();
    const auto [next, error] = std::from_chars(at, end, number);
    if (error != std::errc())
      text.fail(fmt::format("{}: wrong {} ({} numbers expected, '{}' found)", element.name(), name,
                            N, value.substr(0, 60)));
    at = next;
  }
  return numbers;
}

Extent extent_attribute(const XmlText& text, pugi::xml_node element, const char* name) {
  const Extent extent = numbers_attribute<long, 6>(text, element, name);
  constexpr long kLargest = 1L << 30;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const long low = extent[2 * axis];
    const long high = extent[2 * axis + 1];
    if (low > high || low < -kLargest || high > kLargest)
      text.fail(fmt::format("{}: wrong {} along {} (rising numbers expected, {} {} found)",
                            element.name(), name, "xyz"[axis], low, high));
  }
  return extent;
}

std::size_t points_along(const Extent& extent, std::size_t axis) {
  return static_cast<std::size_t>(extent[2 * axis + 1] - extent[2 * axis] + 1);
}

std::size_t points_in(const XmlText& text, const Extent& extent) {
  std::size_t points = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    points *= points_along(extent, axis);
    if (points >> 32 != 0) text.fail("has too many points (fewer than 2^32 expected)");
  }
  return points;
}

std::size_t cells_in(const Extent& extent) {
  std::size_t cells = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) cells *= points_along(extent, axis) - 1;
  return cells;
}

class LayoutCheck {
 public:
  LayoutCheck(std::string_view text, const std::string& type, const std::string& subject)
      : text_(text, type, subject) {
    layout_.type = type;
    layout_.storage = text_.storage();
  }

  XmlLayout run() {
    const pugi::xml_node primary = text_.primary();
    check_field_data(primary);
    if (layout_.type == "UnstructuredGrid")
      check_unstructured(primary);
    else
      check_structured(primary);
    if (layout_.pieces.empty()) text_.fail("holds no piece");
    check_same_arrays();
    return std::move(layout_);
  }

 private:
  void check_field_data(pugi::xml_node primary) {
    for (const pugi::xml_node element : section_of(primary, "FieldData").children()) {
      if (!is_array(element)) continue;
      XmlArray array = text_.array(element);
      const std::size_t tuples = element.attribute("NumberOfTuples")
                                     ? count_attribute(text_, element, "NumberOfTuples")
                                     : 0;
      check(array, tuples * array.components, true);
      if (array.has_not_finite)
        text_.fail(
            fmt::format("array '{}': values that are not finite cannot be read here", array.name));
    }
  }

  /// The element with that name, which may occur only once: of several, VTK would take another one.
  [[nodiscard]] pugi::xml_node section_of(pugi::xml_node parent, const char* name) const {
    const pugi::xml_node section = parent.child(name);
    if (section.next_sibling(name)) text_.fail(fmt::format("a second {} element", name));
    return section;
  }

  void check(XmlArray& array, std::size_t values, bool may_be_not_finite) const {
    check_xml_array(array, values, text_.storage(), may_be_not_finite, text_.subject());
  }

  /// The arrays of a piece's PointData or CellData. VTK's reader looks for each array at the place
  /// of the first with its name, and so it must not see one that another one replaces.
  std::vector<XmlArray> check_data(pugi::xml_node piece, const char* section, std::size_t tuples) {
    std::vector<XmlArray> arrays;
    std::vector<pugi::xml_node> elements;
    std::vector<std::string> names;
    for (const pugi::xml_node element : section_of(piece, section).children()) {
      if (!is_array(element)) continue;
      XmlArray array = text_.array(element);
      if (array.name.empty())
        text_.fail(fmt::format("piece {}: array {} of its {} has no name", layout_.pieces.size(),
                               arrays.size(), section));
      check(array, tuples * array.components, true);
      names.push_back(array.name);
      elements.push_back(element);
      arrays.push_back(std::move(array));
    }
    const std::vector<bool> replaced = replaced_names(names, layout_.notes);
    std::vector<XmlArray> kept;
    for (std::size_t i = 0; i < arrays.size(); ++i) {
      if (replaced[i])
        layout_.replaced.push_back(text_.up_to_next(elements[i]));
      else
        kept.push_back(std::move(arrays[i]));
    }
    return kept;
  }

  void check_unstructured(pugi::xml_node primary) {
    for (const pugi::xml_node element : primary.children("Piece")) {
      XmlPiece piece;
      piece.points = count_attribute(text_, element, "NumberOfPoints");
      piece.cells = count_attribute(text_, element, "NumberOfCells");
      check_points(element, piece.points);
      check_cells(section_of(element, "Cells"), piece);
      piece.point_data = check_data(element, "PointData", piece.points);
      piece.cell_data = check_data(element, "CellData", piece.cells);
      layout_.points += piece.points;
      layout_.cells += piece.cells;
      layout_.pieces.push_back(std::move(piece));
    }
  }

  void check_points(pugi::xml_node piece, std::size_t count) const {
    const pugi::xml_node section = section_of(piece, "Points");
    const auto arrays = std::count_if(section.begin(), section.end(), is_array);
    if (count == 0 && arrays == 0) return;
    if (arrays != 1)
      text_.fail(fmt::format("a piece has {} arrays of points (1 expected)", arrays));
    XmlArray array = text_.array(*std::find_if(section.begin(), section.end(), is_array));
    if (array.components != 3 || array.type.family == NumberType::Family::text)
      text_.fail(
          fmt::format("the points have {} components (3 numbers expected)", array.components));
    check(array, 3 * count, false);
  }

  /// The array with that name in a piece's cells.
  [[nodiscard]] pugi::xml_node cells_array(pugi::xml_node cells, const char* name) const {
    return cells.find_child_by_attribute("DataArray", "Name", name);
  }

  XmlArray checked_cells_array(pugi::xml_node cells, const char* name, std::size_t values) const {
    const pugi::xml_node element = cells_array(cells, name);
    if (!element) text_.fail(fmt::format("a piece's cells have no array '{}'", name));
    XmlArray array = text_.array(element);
    if (array.components != 1 || array.type.family == NumberType::Family::text ||
        array.type.family == NumberType::Family::real)
      text_.fail(fmt::format("array '{}' of the cells does not hold single integers", name));
    check(array, values, false);
    return array;
  }

  void check_cells(pugi::xml_node cells, const XmlPiece& piece) const {
    if (piece.cells == 0) return;
    checked_cells_array(cells, "types", piece.cells);
    const XmlArray offsets = checked_cells_array(cells, "offsets", piece.cells);
    const std::int64_t entries = integers(offsets, piece.cells - 1, 1).front();
    if (entries < 0 || entries >> 48 != 0)
      text_.fail(fmt::format("wrong last offset of the cells ({})", entries));
    checked_cells_array(cells, "connectivity", static_cast<std::size_t>(entries));
    if (cells_array(cells, "faces") && cells_array(cells, "faceoffsets")) check_faces(cells, piece);
  }

  std::vector<std::int64_t> integers(const XmlArray& array, std::size_t first,
                                     std::size_t count) const {
    return read_xml_integers(array, first, count, text_.storage(), text_.subject());
  }

  /// Polyhedra: `faceoffsets` gives the end of each cell's list of faces (-1 for other cells); a
  /// list is the number of faces and for each face its number of nodes and its nodes.
  void check_faces(pugi::xml_node cells, const XmlPiece& piece) const {
    const XmlArray ends = checked_cells_array(cells, "faceoffsets", piece.cells);
    const std::vector<std::int64_t> end = integers(ends, 0, piece.cells);
    const std::int64_t length =
        std::max<std::int64_t>(0, *std::max_element(end.begin(), end.end()));
    const XmlArray faces = checked_cells_array(cells, "faces", static_cast<std::size_t>(length));
    const std::vector<std::int64_t> list = integers(faces, 0, static_cast<std::size_t>(length));
    std::size_t at = 0;
    const auto next = [&](std::int64_t high) {
      if (at >= list.size() || list[at] < 0 || list[at] > high)
        text_.fail(fmt::format("the face lists of the polyhedra are damaged at entry {}", at));
      return list[at++];
    };
    for (const std::int64_t cell_end : end) {
      if (cell_end < 0) continue;
      const std::int64_t face_count = next(length);
      for (std::int64_t f = 0; f < face_count; ++f) {
        const std::int64_t corners = next(length);
        for (std::int64_t c = 0; c < corners; ++c)
          next(static_cast<std::int64_t>(piece.points) - 1);
      }
      if (at != static_cast<std::size_t>(cell_end))
        text_.fail(
            fmt::format("the face lists of the polyhedra do not end where they should ({} "
                        "expected, {} found)",
                        cell_end, at));
    }
    if (at != list.size()) text_.fail("the face lists of the polyhedra are too long");
  }

  void check_structured(pugi::xml_node primary) {
    const Extent whole = extent_attribute(text_, primary, "WholeExtent");
    layout_.points = points_in(text_, whole);
    layout_.cells = cells_in(whole);
    if (layout_.cells == 0)
      text_.fail("holds no volume cells (2 or more points along each axis expected)");
    if (layout_.type == "ImageData") check_image(primary);
    for (const pugi::xml_node element : primary.children("Piece")) {
      XmlPiece piece;
      piece.extent = extent_attribute(text_, element, "Extent");
      piece.points = points_in(text_, piece.extent);
      piece.cells = cells_in(piece.extent);
      if (layout_.type == "StructuredGrid") check_points(element, piece.points);
      if (layout_.type == "RectilinearGrid") check_axes(element, piece.extent);
      piece.point_data = check_data(element, "PointData", piece.points);
      piece.cell_data = check_data(element, "CellData", piece.cells);
      // without data, a grid with implicit coordinates is almost empty, whatever size it declares
      if (layout_.type != "StructuredGrid" && piece.point_data.empty() && piece.cell_data.empty())
        text_.fail("a piece holds no data, only its extent");
      layout_.pieces.push_back(std::move(piece));
    }
    check_cover(whole);
  }

  void check_image(pugi::xml_node primary) const {
    for (const char* name : {"Origin", "Spacing"}) {
      const auto values = numbers_attribute<double, 3>(text_, primary, name);
      for (const double value : values)
        if (!std::isfinite(value) || (value == 0 && std::string_view(name) == "Spacing"))
          text_.fail(fmt::format("wrong {} (finite numbers expected, {} found)", name, value));
    }
  }

  void check_axes(pugi::xml_node piece, const Extent& extent) const {
    std::size_t axis = 0;
    for (const pugi::xml_node element : section_of(piece, "Coordinates").children()) {
      if (!is_array(element)) continue;
      XmlArray array = text_.array(element);
      if (axis < 3) check(array, points_along(extent, axis), false);
      ++axis;
    }
    if (axis != 3)
      text_.fail(fmt::format("a piece has {} arrays of coordinates (3 expected)", axis));
  }

  /// The pieces must cover every cell of the whole extent once: VTK leaves cells without a piece
  /// undefined.
  void check_cover(const Extent& whole) const {
    constexpr std::size_t kMostPieces = 10'000;  // every pair is compared
    if (layout_.pieces.size() > kMostPieces)
      text_.fail(fmt::format("has too many pieces (at most {} expected, {} found)", kMostPieces,
                             layout_.pieces.size()));
    std::size_t cells = 0;
    for (std::size_t p = 0; p < layout_.pieces.size(); ++p) {
      const Extent& a = layout_.pieces[p].extent;
      cells += layout_.pieces[p].cells;
      bool inside = true;
      for (std::size_t axis = 0; axis < 3; ++axis)
        inside &= whole[2 * axis] <= a[2 * axis] && a[2 * axis + 1] <= whole[2 * axis + 1];
      if (!inside) text_.fail(fmt::format("piece {} reaches beyond the whole extent", p));
      for (std::size_t q = 0; q < p; ++q)
        if (overlap(a, layout_.pieces[q].extent))
          text_.fail(fmt::format("pieces {} and {} overlap", q, p));
    }
    if (cells != layout_.cells)
      text_.fail(
          fmt::format("the pieces do not cover the whole extent ({} cells expected, {} "
                      "found)",
                      layout_.cells, cells));
  }

  static bool overlap(const Extent& a, const Extent& b) {
    bool common = true;
    for (std::size_t axis = 0; axis < 3; ++axis)
      common &= std::max(a[2 * axis], b[2 * axis]) < std::min(a[2 * axis + 1], b[2 * axis + 1]);
    return common;
  }

  /// VTK reads from every piece the arrays that the first piece has, by their places.
  void check_same_arrays() const {
    for (const XmlPiece& piece : layout_.pieces) {
      if (piece.points == 0 && piece.cells == 0) continue;
      check_same(layout_.pieces.front().point_data, piece.point_data);
      check_same(layout_.pieces.front().cell_data, piece.cell_data);
    }
  }

  void check_same(const std::vector<XmlArray>& first, const std::vector<XmlArray>& other) const {
    const auto same = [](const XmlArray& a, const XmlArray& b) {
      return a.name == b.name && a.components == b.components && a.type.family == b.type.family &&
             a.type.bytes == b.type.bytes;
    };
    if (!std::equal(first.begin(), first.end(), other.begin(), other.end(), same))
      text_.fail("its pieces do not carry the same arrays in the same order");
  }

  XmlText text_;
  XmlLayout layout_;
};

}  // namespace

XmlLayout check_xml_file(std::string_view text, const std::string& type,
                         const std::string& subject) {
  return LayoutCheck(text, type, subject).run();
}

std::string xml_file_type(std::string_view head) {
  const std::size_t root = head.find("<VTKFile");
  if (root == std::string_view::npos) return {};
  const std::string_view tag = head.substr(root, head.find('>', root) - root);
  constexpr std::string_view kKey = "type=";
  for (std::size_t at = tag.find(kKey); at != std::string_view::npos; at = tag.find(kKey, at + 1)) {
    // not the end of another attribute's name, such as header_type
    const bool whole_name = std::string_view(" \t\r\n").find(tag[at - 1]) != std::string_view::npos;
    const std::string_view value = tag.substr(at + kKey.size());
    if (!whole_name || value.empty()) continue;
    const std::size_t end = value.find(value.front(), 1);
    if (end != std::string_view::npos) return std::string(value.substr(1, end - 1));
  }
  return {};
}

}  // namespace hiac::formats::vtk
