#include "formats/surface/surface_file.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <set>
#include <string>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include "hiac/base/error.hpp"
#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Position = std::array<double, 3>;

// A tetrahedron's corners and outward triangles.
const std::vector<Position> kPoints{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 4.5}};
const std::vector<std::array<std::uint32_t, 3>> kTriangles{
    {0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

// The triangles of a surface as positions, whatever their corners' numbers and first corner.
std::multiset<std::array<Position, 3>> triangles_of(const Surface& surface) {
  std::multiset<std::array<Position, 3>> all;
  for (const Facet& facet : surface.facets)
    for (const auto& polygon : facet.polygons) {
      EXPECT_EQ(polygon.size(), 3U);
      std::array<Position, 3> t{surface.points[polygon[0]], surface.points[polygon[1]],
                                surface.points[polygon[2]]};
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
      all.insert(t);
    }
  return all;
}

void expect_the_tetrahedron(const Surface& surface) {
  Surface expected;
  expected.points = kPoints;
  for (const auto& [a, b, c] : kTriangles) expected.facets.push_back({{{a, b, c}}, {}});
  EXPECT_EQ(surface.points.size(), 4U);
  EXPECT_EQ(triangles_of(surface), triangles_of(expected));
}

std::string lines_of_points(const char* before) {
  std::string text;
  for (const auto& [x, y, z] : kPoints) text += fmt::format("{}{} {} {}\n", before, x, y, z);
  return text;
}
std::string lines_of_triangles(const char* before, std::uint32_t first) {
  std::string text;
  for (const auto& t : kTriangles) {
    text += fmt::format("{} {} {} {}\n", before, t[0] + first, t[1] + first, t[2] + first);
  }
  return text;
}

std::string ascii_stl() {
  std::string text = "solid t\n";
  for (const auto& t : kTriangles) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const std::uint32_t corner : t)
      text += fmt::format("vertex {}\n", fmt::join(kPoints[corner], " "));
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid t\n";
}

std::string binary_stl() {
  std::string text(80, ' ');
  const auto append = [&](const auto value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    text.append(bytes, sizeof value);
  };
  append(static_cast<std::uint32_t>(kTriangles.size()));
  for (const auto& t : kTriangles) {
    for (int k = 0; k < 3; ++k) append(0.0F);
    for (const std::uint32_t corner : t)
      for (const double v : kPoints[corner]) append(static_cast<float>(v));
    append(std::uint16_t{0});
  }
  return text;
}

TEST(SurfaceFile, EveryFormatGivesTheSameSurface) {
  const ScratchFolder folder;
  const std::string off = "OFF\n4 4 0\n" + lines_of_points("") + lines_of_triangles("3", 0);
  const std::string obj = lines_of_points("v ") + lines_of_triangles("f", 1);
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\n"
      "property double z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n" +
      lines_of_points("") + lines_of_triangles("3", 0);
  for (const auto& [name, text] : {std::pair<const char*, std::string>{"a.off", off},
                                   {"a.obj", obj},
                                   {"a.ply", ply},
                                   {"a.stl", ascii_stl()},
                                   {"b.STL", binary_stl()}}) {
    EXPECT_TRUE(is_surface_file(name));
    SCOPED_TRACE(name);
    expect_the_tetrahedron(read_surface(folder.write(name, text)).surface);
  }
}

constexpr const char* kPoly = R"(# a tetrahedron with a facet inside
5 3 0 0
1  0 0 0
2  2 0 0   # a corner
3  0 3 0
4  0 0 4.5
5  0.1 0.1 0.1
5 1
1 0 7
3  1 3 2
1 0 7
3  1 2 4
1 0 7
3  2 3 4
1 0 7
3  3 1
   4
2 1 8
3  1 5 2
3  1 5 3
1  0.5 0.5 0.25
1
1  0.2 0.2 0.2
1
1  0.3 0.3 0.3  12 0.5
)";

TEST(SurfaceFile, PolyKeepsFacetsHolesAndRegions) {
  const ScratchFolder folder;
  const Surface surface = read_surface(folder.write("a.poly", kPoly)).surface;
  ASSERT_EQ(surface.facets.size(), 5U);
  EXPECT_FALSE(surface.triangulated());
  EXPECT_THAT(surface.facets[3].polygons[0], ElementsAre(2, 0, 3));
  EXPECT_EQ(surface.facets[4].polygons.size(), 2U);
  EXPECT_THAT(surface.facets[4].holes, ElementsAre(Position{0.5, 0.5, 0.25}));
  EXPECT_THAT(surface.holes, ElementsAre(Position{0.2, 0.2, 0.2}));
  ASSERT_EQ(surface.regions.size(), 1U);
  EXPECT_EQ(surface.regions[0].attribute, 12);
  EXPECT_EQ(surface.regions[0].max_volume, 0.5);
}

TEST(SurfaceFile, PolyFindsItsPointsInTheNodeFileBesideIt) {
  const ScratchFolder folder;
  const std::string beside =
      folder.write("a.node", "4 3 0 0\n0 0 0 0\n1 2 0 0\n2 0 3 0\n3 0 0 4.5\n");
  ASSERT_FALSE(beside.empty());
  std::string smesh = "0 3 0 0\n4 0\n" + lines_of_triangles("3", 0);
  expect_the_tetrahedron(read_surface(folder.write("a.smesh", smesh)).surface);
  std::string poly = "0 3 0 0\n4 0\n";
  for (const auto& [a, b, c] : kTriangles) poly += fmt::format("1\n3 {} {} {}\n", a, b, c);
  expect_the_tetrahedron(read_surface(folder.write("a.poly", poly)).surface);
}

std::string refusal_of(const std::string& path) {
  try {
    read_surface(path);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(SurfaceFile, PolygonsAreCutThroughTheirLeastCorner) {
  const ScratchFolder folder;
  const SurfaceReading reading = read_surface(
      folder.write("a.off", "OFF\n5 1 0\n0 0 0\n1 0 0\n2 1 0\n1 2 0\n0 1 0\n5 2 3 4 0 1\n"));
  EXPECT_THAT(reading.notes, ElementsAre(HasSubstr("1 polygons")));
  ASSERT_EQ(reading.surface.facets.size(), 3U);
  for (const Facet& facet : reading.surface.facets)
    EXPECT_THAT(facet.polygons[0], testing::Contains(0U));
}

TEST(SurfaceFile, WhatIsMalformedIsRefusedWithItsPlace) {
  const ScratchFolder folder;
  EXPECT_THAT(refusal_of(folder.file("nothing.stl")), HasSubstr("cannot be opened"));
  EXPECT_THAT(refusal_of(folder.write("a.xyz9", "")), HasSubstr("unknown kind"));
  EXPECT_THAT(refusal_of(folder.write("empty.off", "")), HasSubstr("empty.off: "));
  EXPECT_THAT(refusal_of(folder.write("points.off", "OFF\n1 0 0\n0 0 0\n")),
              HasSubstr("holds no polygon"));
  EXPECT_THAT(refusal_of(folder.write("corner.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n")),
              HasSubstr("corner.off: "));
  EXPECT_THAT(refusal_of(folder.write("many.off", "OFF\n9999999999999 9 0\n0 0 0\n")),
              HasSubstr("many.off: "));
  std::string poly = kPoly;
  EXPECT_THAT(refusal_of(folder.write("a.poly", poly.substr(0, 60))), HasSubstr("a.poly"));
  poly.replace(poly.find("3  1 3 2"), 8, "3  1 9 2");
  EXPECT_THAT(refusal_of(folder.write("b.poly", poly)),
              HasSubstr("b.poly:10: a corner between 1 and 5 expected (9 found)"));
  EXPECT_THAT(refusal_of(folder.write("c.poly", "3 3\n1 0 0 x\n")),
              HasSubstr("c.poly:2: a coordinate expected as word 4 ('x' found)"));
}

// The beginnings of a file. A cut file is refused in one line that names it, or what is read of it
// is the beginning of what the whole file holds.
TEST(SurfaceFile, TruncatedFilesAreRefusedOrBeginnings) {
  const ScratchFolder folder;
  // a .poly file may leave its holes and regions out: it is whole behind its last facet, whose last
  // number may be cut (there is no telling)
  const std::size_t facets_end = std::string(kPoly).find("0.25") + 1;
  for (const auto& [name, text, first_whole] :
       {std::tuple<const char*, std::string, std::size_t>{"a.poly", kPoly, facets_end},
        {"a.stl", ascii_stl(), ascii_stl().rfind("endsolid")},
        {"b.stl", binary_stl(), binary_stl().size()}}) {
    const Surface whole = read_surface(folder.write(name, text)).surface;
    for (std::size_t length = 0; length < text.size(); length += 2) {
      SCOPED_TRACE(fmt::format("{} cut to {} bytes", name, length));
      const std::string path = folder.write(name, text.substr(0, length));
      try {
        const Surface part = read_surface(path).surface;
        EXPECT_GE(length, first_whole);
        ASSERT_LE(part.points.size(), whole.points.size());
        ASSERT_LE(part.facets.size(), whole.facets.size());
        EXPECT_TRUE(std::equal(part.points.begin(), part.points.end(), whole.points.begin()));
        for (std::size_t f = 0; f < part.facets.size(); ++f)
          EXPECT_EQ(part.facets[f].polygons, whole.facets[f].polygons);
        if (!std::string(name).ends_with("poly")) continue;
        EXPECT_EQ(part.facets.size(), whole.facets.size());
        if (text[length - 1] != '\n') continue;
        EXPECT_EQ(part.facets.back().holes, whole.facets.back().holes);
        ASSERT_LE(part.holes.size(), whole.holes.size());
        EXPECT_TRUE(std::equal(part.holes.begin(), part.holes.end(), whole.holes.begin()));
        EXPECT_LE(part.regions.size(), whole.regions.size());
      } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr(path));
        EXPECT_THAT(error.what(), testing::Not(HasSubstr("\n")));
      }
    }
  }
}

}  // namespace
}  // namespace hiac::formats
