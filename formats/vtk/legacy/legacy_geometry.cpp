// Based on: as legacy_layout.cpp.
#include "formats/vtk/legacy/legacy_geometry.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace hiac::formats::vtk {
namespace {

using Family = NumberType::Family;
using Dataset = LegacyLayout::Dataset;

constexpr NumberType kInt{Family::signed_integer, 4};

}  // namespace

bool LegacyGeometry::read_section(const std::string& keyword) {
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

void LegacyGeometry::finish(bool has_data) {
  if (layout_.dataset == Dataset::unstructured_grid) return finish_cells();
  if (!has_dimensions_) words_.fail("the file ends too soon (DIMENSIONS expected)");
  if (layout_.dataset == Dataset::structured_grid) {
    const std::size_t grid = dimensions_[0] * dimensions_[1] * dimensions_[2];
    if (!has_points_) words_.fail("the file ends too soon (POINTS expected)");
    if (layout_.points != grid)
      words_.fail(fmt::format("the points do not fit the dimensions ({} expected, {} found)", grid,
                              layout_.points));
  }
  if (layout_.dataset == Dataset::rectilinear_grid &&
      !(has_coordinates_[0] && has_coordinates_[1] && has_coordinates_[2]))
    words_.fail("the file ends too soon (X_, Y_ and Z_COORDINATES expected)");
  // without data, a grid with implicit coordinates is a few words long, whatever size it declares
  if (layout_.dataset != Dataset::structured_grid && !has_data)
    words_.fail("the file ends too soon (POINT_DATA or CELL_DATA expected)");
}

void LegacyGeometry::finish_cells() {
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
}

void LegacyGeometry::read_points() {
  if (has_points_) words_.fail("a second POINTS section");
  has_points_ = true;
  layout_.points = words_.count("the number of points");
  walk_array(read_legacy_type(words_, true), layout_.points, 3);
}

void LegacyGeometry::read_cells() {
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
  cells_.offsets_at = walk_array(cells_.offset_type, count, 1).begin;
  if (words_.keyword("CONNECTIVITY") != "connectivity") words_.fail("CONNECTIVITY expected");
  cells_.entry_type = read_integer_type();
  cells_.entries_at = walk_array(cells_.entry_type, cells_.entries, 1).begin;
}

void LegacyGeometry::read_cell_types() {
  if (cells_.types_at != 0) words_.fail("a second CELL_TYPES section");
  type_count_ = words_.count("the number of cell types");
  cells_.types_at = walk_legacy_values(words_, kInt, type_count_, false).begin;
}

void LegacyGeometry::read_dimensions() {
  if (has_dimensions_) words_.fail("a second DIMENSIONS section");
  has_dimensions_ = true;
  std::size_t points = 1;
  std::size_t cells = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
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

void LegacyGeometry::read_blanking() {
  require_dimensions();
  const std::size_t count = words_.count("the number of points");
  const NumberType type = read_legacy_type(words_, true);
  if (count != layout_.points || type.family != Family::unsigned_integer || type.bytes != 1)
    words_.fail(
        fmt::format("wrong BLANKING ({} values of unsigned_char expected)", layout_.points));
  walk_array(type, count, 1);
}

bool LegacyGeometry::read_image_section(const std::string& keyword) {
  if (keyword != "spacing" && keyword != "aspect_ratio" && keyword != "origin") return false;
  for (int axis = 0; axis < 3; ++axis) {
    const double value = words_.number(keyword);
    if (keyword != "origin" && value == 0) words_.fail("a spacing of 0");
  }
  return true;
}

bool LegacyGeometry::read_coordinates(const std::string& keyword) {
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
  walk_array(read_legacy_type(words_, true), count, 1);
  return true;
}

void LegacyGeometry::require_dimensions() const {
  if (!has_dimensions_) words_.fail("DIMENSIONS must come first");
}

NumberType LegacyGeometry::read_integer_type() {
  const NumberType type = read_legacy_type(words_, true);
  if (type.family == Family::real) words_.fail("an integer data type expected");
  return type;
}

LegacyValues LegacyGeometry::walk_array(const NumberType& type, std::size_t tuples,
                                        std::size_t components) {
  return walk_legacy_array(words_, type, tuples, components, false);
}

}  // namespace hiac::formats::vtk
