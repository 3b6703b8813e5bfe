#include "formats/surface/poly.hpp"

#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "formats/surface/tetgen_text.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats {
namespace {

class PolyReader {
 public:
  explicit PolyReader(const std::string& path)
      : lines_(path), simple_(std::filesystem::path(path).extension() == ".smesh") {}

  Surface read() {
    read_points();
    read_facets();
    // lists that may be missing at the end of a file
    if (!lines_.next_or_none().empty()) read_holes();
    if (!lines_.next_or_none().empty()) read_regions();
    return std::move(surface_);
  }

 private:
  void read_points() {
    TetgenNodes nodes = read_tetgen_nodes(lines_);
    if (nodes.points.empty()) {
      TetgenLines beside(std::filesystem::path(lines_.path()).replace_extension(".node").string());
      nodes = read_tetgen_nodes(beside);
    }
    first_ = nodes.first;
    surface_.points = std::move(nodes.points);
  }

  void read_facets() {
    lines_.next("the number of facets");
    const std::uint64_t count = lines_.whole(0, "the number of facets");
    for (std::uint64_t i = 0; i < count; ++i) {
      lines_.next("a facet");
      Facet facet;
      if (simple_) {
        facet.polygons.push_back(read_polygon());
      } else {
        const std::uint64_t polygons = lines_.whole(0, "a facet's number of polygons");
        const std::uint64_t holes = lines_.whole_or(1, "a facet's number of holes", 0);
        for (std::uint64_t k = 0; k < polygons; ++k) {
          lines_.next("a polygon");
          facet.polygons.push_back(read_polygon());
        }
        for (std::uint64_t k = 0; k < holes; ++k) {
          lines_.next("a facet's hole");
          facet.holes.push_back(lines_.point(1, "a coordinate"));
        }
      }
      surface_.facets.push_back(std::move(facet));
    }
  }

  // Reads from the current line, and from the following ones if the list is long.
  std::vector<std::uint32_t> read_polygon() {
    const std::uint64_t count = lines_.whole(0, "a polygon's number of corners");
    if (count < 1) lines_.fail("a polygon of at least one corner expected (0 found)");
    std::vector<std::uint32_t> corners;
    std::size_t word = 1;
    auto words = lines_.words();
    while (corners.size() < count) {
      if (word == words.size()) {
        words = lines_.next("a polygon's corners");
        word = 0;
      }
      const std::uint64_t corner = lines_.whole(word++, "a corner");
      if (corner < first_ || corner - first_ >= surface_.points.size())
        lines_.fail(fmt::format("a corner between {} and {} expected ({} found)", first_,
                                first_ + surface_.points.size() - 1, corner));
      corners.push_back(static_cast<std::uint32_t>(corner - first_));
    }
    return corners;
  }

  void read_holes() {
    const std::uint64_t count = lines_.whole(0, "the number of holes");
    for (std::uint64_t i = 0; i < count; ++i) {
      lines_.next("a hole");
      surface_.holes.push_back(lines_.point(1, "a coordinate"));
    }
  }

  void read_regions() {
    const std::uint64_t count = lines_.whole(0, "the number of regions");
    for (std::uint64_t i = 0; i < count; ++i) {
      const auto words = lines_.next("a region");
      Region region{lines_.point(1, "a coordinate"), lines_.real(4, "a region's attribute"), -1};
      if (words.size() > 5) region.max_volume = lines_.real(5, "a region's largest volume");
      surface_.regions.push_back(region);
    }
  }

  TetgenLines lines_;
  bool simple_;
  std::uint64_t first_ = 0;
  Surface surface_;
};

}  // namespace

Surface read_poly(const std::string& path) { return PolyReader(path).read(); }

}  // namespace hiac::formats
