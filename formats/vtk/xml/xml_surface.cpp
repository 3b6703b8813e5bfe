#include "formats/vtk/xml/xml_surface.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <vtkCellType.h>

#include "formats/common/io/mapped_file.hpp"
#include "formats/common/io/printable.hpp"
#include "formats/common/mesh/steps.hpp"
#include "formats/vtk/cell_types.hpp"
#include "formats/vtk/message_capture.hpp"
#include "formats/vtk/xml/xml_layout.hpp"
#include "formats/vtk/xml/xml_steps.hpp"
#include "formats/vtk/xml/xml_text.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats::vtk {
namespace {

using Family = NumberType::Family;

class SurfaceReader {
 public:
  SurfaceReader(std::string_view text, const std::string& type, const std::string& subject)
      : text_(text, type, subject), polygonal_(type == "PolyData") {}

  XmlSurface read() {
    for (const pugi::xml_node piece : text_.primary().children("Piece")) read_piece(piece);
    if (lines_ > 0) surface_.notes.push_back(fmt::format("left out {} points and lines", lines_));
    return std::move(surface_);
  }

 private:
  void read_piece(pugi::xml_node piece) {
    points_ = count_attribute(text_, piece, "NumberOfPoints");
    first_ = surface_.xyz.size() / 3;
    if (points_ >= std::numeric_limits<std::uint32_t>::max() - first_)
      text_.fail("has too many points (fewer than 2^32 expected)");
    require_no_ghosts(piece);
    read_points(piece.child("Points"));
    if (polygonal_) {
      lines_ += cell_count(piece, "NumberOfVerts") + cell_count(piece, "NumberOfLines");
      read_cells(piece.child("Polys"), cell_count(piece, "NumberOfPolys"), VTK_POLYGON);
      read_cells(piece.child("Strips"), cell_count(piece, "NumberOfStrips"), VTK_TRIANGLE_STRIP);
    } else {
      read_cells(piece.child("Cells"), count_attribute(text_, piece, "NumberOfCells"), {});
    }
  }

  // Files without cells of a sort may leave out how many there are.
  [[nodiscard]] std::size_t cell_count(pugi::xml_node piece, const char* name) const {
    return piece.attribute(name) ? count_attribute(text_, piece, name) : 0;
  }

  void require_no_ghosts(pugi::xml_node piece) const {
    for (const char* section : {"PointData", "CellData"})
      if (piece.child(section).find_child_by_attribute("Name", "vtkGhostType"))
        text_.fail("holds ghost cells, which are not read in a surface");
  }

  void read_points(pugi::xml_node section) {
    if (points_ == 0) return;
    XmlArray array = text_.array(section.child("DataArray"));
    if (array.components != 3 || array.type.family == Family::text)
      text_.fail(
          fmt::format("the points have {} components (3 numbers expected)", array.components));
    check_xml_array(array, 3 * points_, text_.storage(), false, text_.subject());
    const std::vector<double> xyz =
        read_xml_reals(array, 3 * points_, text_.storage(), text_.subject());
    surface_.xyz.insert(surface_.xyz.end(), xyz.begin(), xyz.end());
  }

  [[nodiscard]] std::vector<std::int64_t> integers(pugi::xml_node cells, const char* name,
                                                   std::size_t count) const {
    const pugi::xml_node element = cells.find_child_by_attribute("DataArray", "Name", name);
    if (!element) text_.fail(fmt::format("a piece's cells have no array '{}'", name));
    XmlArray array = text_.array(element);
    if (array.components != 1 || array.type.family == Family::text ||
        array.type.family == Family::real)
      text_.fail(fmt::format("array '{}' of the cells does not hold single integers", name));
    check_xml_array(array, count, text_.storage(), false, text_.subject());
    return read_xml_integers(array, 0, count, text_.storage(), text_.subject());
  }

  // `type` is that of all cells; none: an array tells.
  void read_cells(pugi::xml_node cells, std::size_t count, std::optional<int> type) {
    if (count == 0) return;
    const std::vector<std::int64_t> ends = integers(cells, "offsets", count);
    if (ends.back() < 0 || ends.back() >> 48 != 0 || !std::ranges::is_sorted(ends) ||
        ends.front() < 0)
      text_.fail("wrong offsets of the cells (rising numbers expected)");
    const auto entries = static_cast<std::size_t>(ends.back());
    const std::vector<std::int64_t> points = integers(cells, "connectivity", entries);
    std::vector<std::int64_t> types;
    if (!type) types = integers(cells, "types", count);
    std::size_t begin = 0;
    for (std::size_t cell = 0; cell < count; ++cell) {
      corners_.clear();
      for (; begin < static_cast<std::size_t>(ends[cell]); ++begin) {
        if (points[begin] < 0 || static_cast<std::size_t>(points[begin]) >= points_)
          text_.fail(fmt::format("cell {}: no such point (0 to {} expected, {} found)", cell,
                                 static_cast<std::int64_t>(points_) - 1, points[begin]));
        corners_.push_back(
            static_cast<std::uint32_t>(first_ + static_cast<std::size_t>(points[begin])));
      }
      add(cell, type ? *type : static_cast<int>(types[cell]));
    }
  }

  void polygon(std::initializer_list<std::size_t> places) {
    std::vector<std::uint32_t> corners;
    for (const std::size_t place : places) corners.push_back(corners_[place]);
    surface_.polygons.push_back(std::move(corners));
  }

  void add(std::size_t cell, int type) {
    const std::size_t count = corners_.size();
    const auto require = [&](bool fits) {
      if (!fits)
        text_.fail(
            fmt::format("cell {}: a {} cannot have {} points", cell, cell_type_name(type), count));
    };
    switch (type) {
      case VTK_EMPTY_CELL:
      case VTK_VERTEX:
      case VTK_POLY_VERTEX:
      case VTK_LINE:
      case VTK_POLY_LINE:
      case VTK_QUADRATIC_EDGE:
      case VTK_CUBIC_LINE:
      case VTK_LAGRANGE_CURVE:
        ++lines_;
        return;
      case VTK_TRIANGLE:
      case VTK_QUAD:
      case VTK_POLYGON:
        require(type == VTK_TRIANGLE ? count == 3 : type == VTK_QUAD ? count == 4 : count >= 3);
        surface_.polygons.push_back(corners_);
        return;
      case VTK_PIXEL:
        require(count == 4);
        return polygon({0, 1, 3, 2});
      case VTK_TRIANGLE_STRIP:
        require(count >= 3);
        for (std::size_t k = 2; k < count; ++k)
          polygon({k % 2 == 0 ? k - 2 : k - 1, k % 2 == 0 ? k - 1 : k - 2, k});
        return;
      case VTK_QUADRATIC_TRIANGLE:
        require(count == 6);
        polygon({0, 3, 5});
        polygon({3, 1, 4});
        polygon({5, 4, 2});
        return polygon({3, 4, 5});
      case VTK_QUADRATIC_QUAD:
        require(count == 8);
        polygon({0, 4, 7});
        polygon({1, 5, 4});
        polygon({2, 6, 5});
        polygon({3, 7, 6});
        return polygon({4, 5, 6, 7});
      case VTK_BIQUADRATIC_QUAD:
        require(count == 9);
        polygon({0, 4, 8, 7});
        polygon({4, 1, 5, 8});
        polygon({8, 5, 2, 6});
        return polygon({7, 8, 6, 3});
      default:
        text_.fail(fmt::format("cell {} is a {} (a surface of triangles and polygons expected)",
                               cell, cell_type_name(type)));
    }
  }

  XmlText text_;
  bool polygonal_;
  std::size_t points_ = 0;  // of the current piece
  std::size_t first_ = 0;   // the number of its first point
  std::vector<std::uint32_t> corners_;
  std::size_t lines_ = 0;
  XmlSurface surface_;
};

XmlSurface read_file(const std::string& path) {
  const MessageCapture messages;  // decompression is VTK's
  const MappedFile file(path);
  constexpr std::size_t kHead = 4096;
  const std::string type = xml_file_type(file.text().substr(0, kHead));
  if (type != "PolyData" && type != "UnstructuredGrid")
    throw InputError(path, fmt::format("is not a surface of VTK (a VTKFile of type PolyData or "
                                       "UnstructuredGrid expected, {} found)",
                                       type.empty() ? "another file" : type));
  const auto step = xml_step(file.text(), type, {}, path);
  XmlSurface surface = SurfaceReader(step ? step->text : file.text(), type, path).read();
  messages.throw_on_error(path);
  if (step && step->times.size() > 1)
    surface.notes.push_back(last_step_note(step->times.size(), step->times.back()));
  return surface;
}

}  // namespace

XmlSurface read_xml_surface(const std::string& path) {
  try {
    return read_file(path);
  } catch (const InputError& error) {
    throw InputError(printable(error.what()));  // with names from the file on one line
  }
}

}  // namespace hiac::formats::vtk
