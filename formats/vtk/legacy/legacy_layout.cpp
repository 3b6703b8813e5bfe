// Based on: the VTK User's Guide, "VTK File Formats", and the behaviour of the reader
// (vtkDataReader and its subclasses in VTK 9.1), which this code follows word by word, so that the
// reader sees only input that has been checked here.
#include "formats/vtk/legacy/legacy_layout.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

#include <fmt/format.h>

#include "formats/vtk/legacy/legacy_cells.hpp"
#include "formats/vtk/legacy/legacy_values.hpp"
#include "formats/vtk/legacy/legacy_words.hpp"

namespace hiac::formats::vtk {
namespace {

using Family = NumberType::Family;
using Dataset = LegacyLayout::Dataset;

constexpr NumberType kInt{Family::signed_integer, 4};
constexpr std::string_view kMagic = "# vtk DataFile Version";
/// VTK's reader recurses at each change between point and cell data.
constexpr int kMostDataSections = 64;

class LegacyWalk {
 public:
  LegacyWalk(std::string_view text, const std::string& subject) : words_(text, subject) {}

  LegacyLayout run() {
    read_header();
    read_geometry();
    finish_geometry();
    while (!data_keyword_.empty()) read_data_section();
    note_cut_end();
    return std::move(layout_);
  }

 private:
  void read_header() {
    const std::string_view first = words_.line();
    if (!first.starts_with(kMagic))
      words_.fail(fmt::format("not a legacy VTK file ('{} ...' expected)", kMagic));
    const std::string_view version = first.substr(kMagic.size());
    const std::size_t digit = std::min(version.find_first_not_of(" \t"), version.size());
    std::from_chars(version.data() + digit, version.data() + version.size(), major_);
    layout_.title = words_.line();
    const std::string encoding = words_.keyword("ASCII or BINARY");
    if (encoding != "ascii" && encoding != "binary")
      words_.fail(fmt::format("unknown encoding (ASCII or BINARY expected, '{}' found)", encoding));
    layout_.binary = encoding == "binary";
    if (words_.keyword("DATASET") != "dataset") words_.fail("DATASET expected");
    const std::string dataset = words_.keyword("the kind of dataset");
    if (dataset == "unstructured_grid")
      layout_.dataset = Dataset::unstructured_grid;
    else if (dataset == "structured_grid")
      layout_.dataset = Dataset::structured_grid;
    else if (dataset == "structured_points")
      layout_.dataset = Dataset::structured_points;
    else if (dataset == "rectilinear_grid")
      layout_.dataset = Dataset::rectilinear_grid;
    else
      words_.fail(
          fmt::format("holds no volume cells (UNSTRUCTURED_GRID, STRUCTURED_GRID, "
                      "STRUCTURED_POINTS or RECTILINEAR_GRID expected, '{}' found)",
                      dataset));
    if (layout_.binary) words_.set_binary();
  }

  /// Reads sections up to the first POINT_DATA or CELL_DATA, and stores that keyword in
  /// data_keyword_.
  void read_geometry() {
    while (!words_.at_end()) {
      const std::string keyword = words_.keyword("a section");
      if (keyword == "point_data" || keyword == "cell_data") {
        data_keyword_ = keyword;
        return;
      }
      if (keyword == "field")
        read_field(std::nullopt);
      else if (!read_geometry_section(keyword))
        words_.fail(fmt::format("unexpected '{}' (a section of the dataset expected)",
                                keyword.substr(0, 40)));
    }
  }

  bool read_geometry_section(const std::string& keyword) {
    if (keyword == "dimensions" && layout_.dataset != Dataset::unstructured_grid) {
      read_dimensions();
      return true;
    }
    switch (layout_.dataset) {
      case Dataset::unstructured_grid:
        if (keyword == "points") return read_points(), true;
        if (keyword == "cells") return read_cells(), true;
        if (keyword == "cell_types") return read_cell_types(), true;
        return false;
      case Dataset::structured_grid:
        if (keyword == "points") return read_points(), true;
        if (keyword == "blanking" && major_ < 4) return read_blanking(), true;
        return false;
      case Dataset::structured_points:
        return read_image_section(keyword);
      case Dataset::rectilinear_grid:
        return read_coordinates(keyword);
    }
    return false;
  }

  void read_points() {
    if (has_points_) words_.fail("a second POINTS section");
    has_points_ = true;
    layout_.points = words_.count("the number of points");
    read_array(read_type(true), layout_.points, 3);
  }

  void read_cells() {
    if (cells_.entries_at != 0) words_.fail("a second CELLS section");
    const std::size_t count = words_.count("the number of cells");
    cells_.entries = words_.count("the size of the list of cells");
    if (count == 0) words_.fail("holds no cells");
    cells_.has_offsets = major_ >= 5;
    if (!cells_.has_offsets) {
      cells_.count = count;
      cells_.entry_type = kInt;
      cells_.entries_at = walk_legacy_values(words_, kInt, cells_.entries, false).begin;
      return;
    }
    cells_.count = count - 1;
    if (words_.keyword("OFFSETS") != "offsets") words_.fail("OFFSETS expected");
    cells_.offset_type = read_integer_type();
    cells_.offsets_at = read_array(cells_.offset_type, count, 1).begin;
    if (words_.keyword("CONNECTIVITY") != "connectivity") words_.fail("CONNECTIVITY expected");
    cells_.entry_type = read_integer_type();
    cells_.entries_at = read_array(cells_.entry_type, cells_.entries, 1).begin;
  }

  void read_cell_types() {
    if (cells_.types_at != 0) words_.fail("a second CELL_TYPES section");
    type_count_ = words_.count("the number of cell types");
    cells_.types_at = walk_legacy_values(words_, kInt, type_count_, false).begin;
  }

  void read_dimensions() {
    if (has_dimensions_) words_.fail("a second DIMENSIONS section");
    has_dimensions_ = true;
    std::size_t points = 1;
    std::size_t cells = 1;
    for (int axis = 0; axis < 3; ++axis) {
      dimensions_[axis] = words_.count("the number of points along an axis");
      if (dimensions_[axis] == 0) words_.fail("a dimension of 0 (1 or more points expected)");
      points *= dimensions_[axis];
      cells *= dimensions_[axis] - 1;
      if (points >> 31 != 0)
        words_.fail("too many points (fewer than 2147483648 in all three dimensions expected)");
    }
    layout_.points = points;
    // VTK counts the cells of flat grids too, as the product over the dimensions that are not flat
    layout_.cells = 1;
    for (const std::size_t n : dimensions_) layout_.cells *= std::max<std::size_t>(n - 1, 1);
    if (cells == 0)
      words_.fail(
          fmt::format("holds no volume cells (2 or more points along each axis expected, "
                      "{} x {} x {} found)",
                      dimensions_[0], dimensions_[1], dimensions_[2]));
  }

  void read_blanking() {
    require_dimensions();
    const std::size_t count = words_.count("the number of points");
    const NumberType type = read_type(true);
    if (count != layout_.points || type.family != Family::unsigned_integer || type.bytes != 1)
      words_.fail(
          fmt::format("wrong BLANKING ({} values of unsigned_char expected)", layout_.points));
    read_array(type, count, 1);
  }

  bool read_image_section(const std::string& keyword) {
    if (keyword != "spacing" && keyword != "aspect_ratio" && keyword != "origin") return false;
    for (int axis = 0; axis < 3; ++axis) {
      const double value = words_.number(keyword);
      if (keyword != "origin" && value == 0) words_.fail("a spacing of 0");
    }
    return true;
  }

  bool read_coordinates(const std::string& keyword) {
    const bool known =
        keyword == "x_coordinates" || keyword == "y_coordinates" || keyword == "z_coordinates";
    if (!known) return false;
    require_dimensions();
    const auto axis = static_cast<std::size_t>(keyword.front() - 'x');
    const std::size_t count = words_.count("the number of coordinates");
    if (count != dimensions_[axis] || has_coordinates_[axis])
      words_.fail(
          fmt::format("the coordinates do not fit the dimensions ({} once expected, {} "
                      "found)",
                      dimensions_[axis], count));
    has_coordinates_[axis] = true;
    read_array(read_type(true), count, 1);
    return true;
  }

  void require_dimensions() const {
    if (!has_dimensions_) words_.fail("DIMENSIONS must come first");
  }

  void finish_geometry() {
    if (layout_.dataset == Dataset::unstructured_grid) {
      if (!has_points_ || cells_.entries_at == 0 || cells_.types_at == 0)
        words_.fail(fmt::format("the file ends too soon ({} expected)", !has_points_ ? "POINTS"
                                                                        : cells_.entries_at == 0
                                                                            ? "CELLS"
                                                                            : "CELL_TYPES"));
      if (type_count_ != cells_.count)
        words_.fail(fmt::format("the cell types do not fit the cells ({} expected, {} found)",
                                cells_.count, type_count_));
      check_legacy_cells(words_, cells_, layout_.points);
      layout_.cells = cells_.count;
      return;
    }
    if (!has_dimensions_) words_.fail("the file ends too soon (DIMENSIONS expected)");
    if (layout_.dataset == Dataset::structured_grid) {
      const std::size_t grid = dimensions_[0] * dimensions_[1] * dimensions_[2];
      if (!has_points_) words_.fail("the file ends too soon (POINTS expected)");
      if (layout_.points != grid)
        words_.fail(fmt::format("the points do not fit the dimensions ({} expected, {} found)",
                                grid, layout_.points));
    }
    if (layout_.dataset == Dataset::rectilinear_grid &&
        !(has_coordinates_[0] && has_coordinates_[1] && has_coordinates_[2]))
      words_.fail("the file ends too soon (X_, Y_ and Z_COORDINATES expected)");
    // without data, a grid with implicit coordinates is a few words long, whatever size it declares
    if (layout_.dataset != Dataset::structured_grid && data_keyword_.empty())
      words_.fail("the file ends too soon (POINT_DATA or CELL_DATA expected)");
  }

  /// Reads POINT_DATA or CELL_DATA, after its keyword, up to the next such keyword or the file's
  /// end.
  void read_data_section() {
    if (++data_sections_ > kMostDataSections)
      words_.fail(
          fmt::format("too many sections of data (at most {} expected)", kMostDataSections));
    const bool on_points = data_keyword_ == "point_data";
    const std::size_t expected = on_points ? layout_.points : layout_.cells;
    const std::size_t count =
        words_.count(on_points ? "the number of points" : "the number of cells");
    if (count != expected)
      words_.fail(fmt::format("the data do not fit the {} ({} values expected, {} found)",
                              on_points ? "points" : "cells", expected, count));
    data_keyword_.clear();
    while (!words_.at_end()) {
      const std::string keyword = words_.keyword("data");
      if (keyword == "point_data" || keyword == "cell_data") {
        data_keyword_ = keyword;
        return;
      }
      read_attribute(keyword, on_points, count);
    }
  }

  void read_attribute(const std::string& keyword, bool on_points, std::size_t count) {
    if (keyword == "field") return read_field(on_points);
    if (keyword == "lookup_table") return read_lookup_table();
    const bool scalars =
        keyword == "scalars" || keyword == "color_scalars" || keyword == "texture_coordinates";
    const std::size_t fixed = fixed_components(keyword, on_points);
    if (!scalars && fixed == 0)
      words_.fail(fmt::format("unexpected '{}' (SCALARS, VECTORS, FIELD, ... expected)",
                              keyword.substr(0, 40)));
    const std::string name(next_name());
    if (keyword == "color_scalars") {
      const std::size_t components = words_.count("the number of components");
      // the reader converts them to bytes, which cannot hold values that are not finite
      if (!layout_.binary) {
        read_array({Family::real, 4}, count, components);
        return;
      }
      return keep(name, {Family::unsigned_integer, 1}, count, components, on_points);
    }
    if (keyword == "scalars") {
      const NumberType type = read_type(true);
      return keep(name, type, count, scalar_components(), on_points);
    }
    if (keyword == "texture_coordinates") {
      const std::size_t components = words_.count("the number of components");
      if (components < 1 || components > 3) words_.fail("wrong dimension (1 to 3 expected)");
      return keep(name, read_type(true), count, components, on_points);
    }
    const bool may_be_text = keyword == "pedigree_ids" || keyword == "edge_flags";
    keep(name, read_type(!may_be_text), count, fixed, on_points);
  }

  /// The number of components of an attribute for which it is fixed; 0 for other words.
  static std::size_t fixed_components(const std::string& keyword, bool on_points) {
    if (keyword == "vectors" || keyword == "normals") return 3;
    if (keyword == "tensors6") return 6;
    if (keyword == "tensors") return 9;
    if (keyword == "global_ids" || keyword == "pedigree_ids") return 1;
    return keyword == "edge_flags" && on_points ? 1 : 0;
  }

  /// After "SCALARS name type": the optional number of components, then LOOKUP_TABLE and its name.
  std::size_t scalar_components() {
    std::size_t components = 1;
    std::string keyword = words_.keyword("LOOKUP_TABLE");
    if (keyword != "lookup_table") {
      const auto [end, error] =
          std::from_chars(keyword.data(), keyword.data() + keyword.size(), components);
      if (error != std::errc() || end != keyword.data() + keyword.size() || components < 1 ||
          components > 1'000'000)
        words_.fail("LOOKUP_TABLE or a number of components expected");
      keyword = words_.keyword("LOOKUP_TABLE");
    }
    if (keyword != "lookup_table") words_.fail("LOOKUP_TABLE expected");
    words_.keyword("the name of a lookup table");
    return components;
  }

  void read_lookup_table() {
    words_.keyword("the name of a lookup table");
    const std::size_t size = words_.count("the size of a lookup table");
    const NumberType type =
        layout_.binary ? NumberType{Family::unsigned_integer, 1} : NumberType{Family::real, 4};
    walk_legacy_values(words_, type, 4 * size, false);
  }

  /// FIELD name n and its n arrays; in point and cell data each has a tuple per point or cell.
  void read_field(std::optional<bool> on_points) {
    next_name();
    const std::size_t arrays = words_.count("the number of arrays");
    if (arrays > words_.left())
      words_.fail(
          fmt::format("too many arrays ({} declared, {} bytes left)", arrays, words_.left()));
    for (std::size_t i = 0; i < arrays; ++i) {
      const std::string name(next_name());
      if (name == "NULL_ARRAY") continue;
      const std::size_t components = words_.count("the number of components");
      const std::size_t tuples = words_.count("the number of tuples");
      const NumberType type = read_type(false);
      if (!on_points) {
        read_array(type, tuples, components);
        continue;
      }
      const std::size_t expected = *on_points ? layout_.points : layout_.cells;
      if (tuples != expected)
        words_.fail(fmt::format("array '{}' does not fit the {} ({} tuples expected, {} found)",
                                name.substr(0, 60), *on_points ? "points" : "cells", expected,
                                tuples));
      keep(name, type, tuples, components, *on_points);
    }
  }

  /// The next word as a name, with its case kept.
  std::string_view next_name() {
    const std::size_t before = words_.at();
    words_.keyword("a name");
    std::string_view name = words_.text().substr(before, words_.at() - before);
    name.remove_prefix(std::min(name.find_first_not_of(" \t\r\n\v\f"), name.size()));
    return name;
  }

  NumberType read_type(bool numeric) {
    const std::string name = words_.keyword("a data type");
    const auto type = legacy_number_type(name);
    if (!type) words_.fail(fmt::format("unknown data type '{}'", name.substr(0, 40)));
    if (type->family == Family::variant ||
        (numeric && (type->family == Family::text || type->family == Family::bit)))
      words_.fail(fmt::format("data type '{}' cannot be read here", name));
    return *type;
  }

  NumberType read_integer_type() {
    const NumberType type = read_type(true);
    if (type.family == Family::real) words_.fail("an integer data type expected");
    return type;
  }

  void keep(const std::string& name, const NumberType& type, std::size_t tuples,
            std::size_t components, bool on_points) {
    const LegacyValues values = walk_legacy_array(words_, type, tuples, components, true);
    layout_.attributes.push_back({name, type, tuples, components, values.begin, values.end,
                                  on_points, values.has_not_finite});
  }

  /// Walks through an array that is not an attribute.
  LegacyValues read_array(const NumberType& type, std::size_t tuples, std::size_t components) {
    return walk_legacy_array(words_, type, tuples, components, false);
  }

  /// An ASCII file that ends in the middle of a line may have lost digits of its last number.
  void note_cut_end() {
    const std::string_view text = words_.text();
    if (!layout_.binary && !text.empty() && text.back() != '\n' && text.back() != ' ')
      layout_.notes.emplace_back(
          "the file does not end with a line end: its last number may have been cut off");
  }

  LegacyWords words_;
  LegacyLayout layout_;
  int major_ = 0;
  bool has_points_ = false;
  bool has_dimensions_ = false;
  std::size_t dimensions_[3] = {0, 0, 0};
  bool has_coordinates_[3] = {false, false, false};
  LegacyCells cells_;
  std::size_t type_count_ = 0;
  std::string data_keyword_;
  int data_sections_ = 0;
};

}  // namespace

LegacyLayout check_legacy_file(std::string_view text, const std::string& subject) {
  return LegacyWalk(text, subject).run();
}

}  // namespace hiac::formats::vtk
