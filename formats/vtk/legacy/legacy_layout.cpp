// Based on: the VTK User's Guide, "VTK File Formats", and the behaviour of the reader
// (vtkDataReader and its subclasses in VTK 9.1), which this code follows word by word, so that the
// reader sees only input that has been checked here.
#include "formats/vtk/legacy/legacy_layout.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

#include <fmt/format.h>

#include "formats/vtk/legacy/legacy_attributes.hpp"
#include "formats/vtk/legacy/legacy_geometry.hpp"
#include "formats/vtk/legacy/legacy_words.hpp"

namespace hiac::formats::vtk {
namespace {

using Dataset = LegacyLayout::Dataset;

constexpr std::string_view kMagic = "# vtk DataFile Version";
/// VTK's reader recurses at each change between point and cell data.
constexpr int kMostDataSections = 64;

class LegacyWalk {
 public:
  LegacyWalk(std::string_view text, const std::string& subject)
      : words_(text, subject), attributes_(words_, layout_) {}

  LegacyLayout run() {
    const int major = read_header();
    read_geometry(major);
    while (!data_keyword_.empty()) read_data_section();
    note_cut_end();
    return std::move(layout_);
  }

 private:
  /// Returns the file's version.
  int read_header() {
    const std::string_view first = words_.line();
    if (!first.starts_with(kMagic))
      words_.fail(fmt::format("not a legacy VTK file ('{} ...' expected)", kMagic));
    const std::string_view version = first.substr(kMagic.size());
    const std::size_t digit = std::min(version.find_first_not_of(" \t"), version.size());
    int major = 0;
    std::from_chars(version.data() + digit, version.data() + version.size(), major);
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
    return major;
  }

  /// Reads sections up to the first POINT_DATA or CELL_DATA, and stores that keyword in
  /// data_keyword_.
  void read_geometry(int major) {
    LegacyGeometry geometry(words_, layout_, major);
    while (data_keyword_.empty() && !words_.at_end()) {
      const std::string keyword = words_.keyword("a section");
      if (keyword == "point_data" || keyword == "cell_data")
        data_keyword_ = keyword;
      else if (keyword == "field")
        attributes_.read_field(std::nullopt);
      else if (!geometry.read_section(keyword))
        words_.fail(fmt::format("unexpected '{}' (a section of the dataset expected)",
                                keyword.substr(0, 40)));
    }
    geometry.finish(!data_keyword_.empty());
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
      attributes_.read(keyword, on_points);
    }
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
  LegacyAttributes attributes_;
  std::string data_keyword_;
  int data_sections_ = 0;
};

}  // namespace

LegacyLayout check_legacy_file(std::string_view text, const std::string& subject) {
  return LegacyWalk(text, subject).run();
}

}  // namespace hiac::formats::vtk
