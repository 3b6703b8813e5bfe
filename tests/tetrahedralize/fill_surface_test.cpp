#include "hiac/tetrahedralize/meshing/fill_surface.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <span>

#include <gmock/gmock.h>

#include "hiac/base/error.hpp"
#include "hiac/tetrahedralize/enclosed_parts.hpp"
#include "tests/support/instrumented.hpp"
#include "tests/tetrahedralize/nested_shells.hpp"

namespace hiac {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Point = std::array<double, 3>;

constexpr EmptyParts kByOrientation{true, {}};

/// The volumes of a mesh's regions, from number 1 on.
std::vector<double> volumes_of(const ZooMesh& mesh) {
  EXPECT_EQ(mesh.fields.size(), 1U);
  EXPECT_EQ(mesh.fields[0].name, "region");
  std::vector<double> volumes;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    const auto nodes = mesh.cell_nodes(cell);
    std::array<Point, 3> e{};
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t c = 0; c < 3; ++c)
        e[k][c] = mesh.position(nodes[k + 1])[c] - mesh.position(nodes[0])[c];
    const auto region = static_cast<std::size_t>(mesh.fields[0].values[cell]);
    EXPECT_GE(region, 1U);
    volumes.resize(std::max(volumes.size(), region));
    volumes[region - 1] += (e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
                            e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
                            e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
                           6;
  }
  return volumes;
}

void expect_near(const std::vector<double>& found, const std::vector<double>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i], expected[i], 1e-10 * expected[i]) << i;
}

/// The shells as their parts are numbered: by the least of their points.
std::vector<test::Shell> sorted(const test::NestedShells& nested) {
  std::vector<test::Shell> shells = nested.shells;
  const auto least = [](const test::Shell& shell) {
    return std::ranges::min(shell.surface().points);
  };
  std::ranges::sort(shells, {}, least);
  return shells;
}

TEST(FillSurface, LeavesWhatShellsWindAroundNoTimeEmpty) {
  std::mt19937_64 random(17);
  std::size_t with_cavities = 0, full = 0, deepest = 0;
  for (std::size_t trial = 0; trial < test::tried(80); ++trial) {
    const test::NestedShells nested = test::nested_shells(true, random);
    std::vector<double> expected, all;
    const std::vector<test::Shell> shells = sorted(nested);
    const FilledSurface filled = fill_surface(nested.surface, {}, kByOrientation);
    ASSERT_EQ(filled.parts.size(), shells.size());
    for (std::size_t i = 0; i < shells.size(); ++i) {
      const FilledPart& part = filled.parts[i];
      int truth = 0;
      for (const test::Shell& around : nested.shells)
        truth += around.low <= shells[i].low && around.side(part.point) > 0 ? around.turn : 0;
      EXPECT_EQ(part.winding, truth);
      EXPECT_EQ(part.winding, nested.winding(part.point));
      EXPECT_EQ(shells[i].side(part.point), 1);
      EXPECT_NEAR(part.volume, nested.volume(shells[i]), 1e-10 * shells[i].volume());
      EXPECT_EQ(part.region.has_value(), truth != 0);
      if (truth != 0) {
        expected.push_back(nested.volume(shells[i]));
        EXPECT_EQ(part.region, static_cast<int>(expected.size()));
      }
      all.push_back(nested.volume(shells[i]));
      deepest = std::max(deepest, static_cast<std::size_t>(std::abs(truth)));
    }
    expect_near(volumes_of(filled.mesh), expected);
    expect_near(volumes_of(fill_surface(nested.surface, {}, {}).mesh), all);
    ++(expected.size() < all.size() ? with_cavities : full);
  }
  EXPECT_GT(with_cavities, 3U);
  EXPECT_GT(full, 3U);
  EXPECT_GT(deepest, 2U);
}

TEST(FillSurface, FurtherPointsChangeNeitherPartsNorNumbers) {
  std::mt19937_64 random(23);
  for (std::size_t trial = 0; trial < test::tried(5); ++trial) {
    const test::NestedShells nested = test::nested_shells(false, random);
    const SurfaceMeshing fine{2.0, 2e4, false};
    const FilledSurface coarse = fill_surface(nested.surface, {}, kByOrientation);
    const FilledSurface filled = fill_surface(nested.surface, fine, kByOrientation);
    EXPECT_GT(filled.mesh.cell_count(), coarse.mesh.cell_count());
    expect_near(volumes_of(filled.mesh), volumes_of(coarse.mesh));
    ASSERT_EQ(filled.parts.size(), coarse.parts.size());
    for (std::size_t i = 0; i < filled.parts.size(); ++i)
      EXPECT_EQ(filled.parts[i].region, coarse.parts[i].region);
  }
}

TEST(FillSurface, LeavesThePartsAroundPointsEmpty) {
  const Surface nested = test::with(
      test::box_surface({1, 1, 1}, {2, 2, 2}),
      test::with(test::box_surface({0, 0, 0}, {3, 3, 3}), test::box_surface({4, 0, 0}, {6, 1, 1})));
  const auto volumes = [&](const EmptyParts& empty) {
    return volumes_of(fill_surface(nested, {}, empty).mesh);
  };
  expect_near(volumes(kByOrientation), {26, 1, 2});
  expect_near(volumes({true, {{1.5, 1.5, 1.5}}}), {26, 2});
  expect_near(volumes({true, {{0.5, 0.5, 0.5}}}), {1, 2});
  expect_near(volumes({false, {{0.5, 0.5, 0.5}, {2.5, 2.5, 2.5}, {5, 0.5, 0.5}}}), {1});
  EXPECT_THROW(volumes({true, {{1.5, 1.5, 1.5}, {0.5, 0.5, 0.5}, {5, 0.5, 0.5}}}), JudgementError);
  const auto complaint = [&](const Point& point) -> std::string {
    try {
      volumes({true, {point}});
    } catch (const UsageError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_THAT(complaint({3.5, 0.5, 0.5}), HasSubstr("hole 3.5,0.5,0.5: the point is outside"));
  EXPECT_THAT(complaint({7, 7, 7}), HasSubstr("is outside"));
  // a face, an edge and a corner: of the outer box, and between two parts
  for (const Point& point : std::initializer_list<Point>{
           {3, 1.5, 1.25}, {3, 3, 1}, {3, 3, 3}, {1, 1.5, 1.25}, {2, 2, 1.5}, {1, 1, 2}})
    EXPECT_THAT(complaint(point), HasSubstr("is on the surface")) << point[0];
  EXPECT_THAT(complaint({3, std::nextafter(3.0, 4.0), 1}), HasSubstr("is outside"));
  EXPECT_EQ(complaint({std::nextafter(3.0, 0.0), 1.5, 1.25}), "none");
}

/// A box in two rooms: the wall between them belongs to both, and no orientation fits.
Surface two_rooms() {
  Surface rooms = test::box_surface({0, 0, 0}, {1, 1, 1});
  for (const auto& p : {Point{3, 0, 0}, {3, 1, 0}, {3, 0, 1}, {3, 1, 1}}) rooms.points.push_back(p);
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    rooms.facets.push_back({{{a, b, c}}, {}});
    rooms.facets.push_back({{{a, c, d}}, {}});
  };
  add(1, 3, 9, 8), add(5, 10, 11, 7), add(1, 8, 10, 5), add(3, 7, 11, 9), add(8, 9, 11, 10);
  return rooms;
}

TEST(FillSurface, RoomsWithAWallAreParts) {
  const FilledSurface rooms = fill_surface(two_rooms(), {}, kByOrientation);
  expect_near(volumes_of(rooms.mesh), {1, 2});
  EXPECT_FALSE(rooms.parts[0].winding);
  const EmptyParts first{true, {{0.5, 0.5, 0.5}}};
  expect_near(volumes_of(fill_surface(two_rooms(), {}, first).mesh), {2});
}

TEST(FillSurface, OneShellIsFilledWhicheverWayItIsOriented) {
  Surface box = test::box_surface({0, 0, 0}, {1, 1, 1});
  const auto winding = [&] {
    const FilledSurface filled = fill_surface(box, {}, kByOrientation);
    expect_near(volumes_of(filled.mesh), {1});
    return filled.parts.front().winding;
  };
  EXPECT_EQ(winding(), 1);
  for (Facet& facet : box.facets) std::swap(facet.polygons[0][0], facet.polygons[0][1]);
  EXPECT_EQ(winding(), -1);
  std::swap(box.facets[0].polygons[0][0], box.facets[0].polygons[0][1]);
  EXPECT_EQ(winding(), std::nullopt);
}

TEST(FillSurface, RegionsOfTheSurfaceKeepTheirNames) {
  Surface nested =
      test::with(test::box_surface({0, 0, 0}, {3, 3, 3}), test::box_surface({1, 1, 1}, {2, 2, 2}));
  nested.regions.push_back({{0.5, 0.5, 0.5}, 7, -1});
  nested.regions.push_back({{1.5, 1.5, 1.5}, 9, -1});
  const FilledSurface filled = fill_surface(nested, {}, {false, {{1.5, 1.5, 1.5}}});
  EXPECT_TRUE(filled.parts.empty());
  for (const double region : filled.mesh.fields[0].values) EXPECT_EQ(region, 7);
  EXPECT_NEAR(volumes_of(filled.mesh)[6], 26, 1e-12);
}

// Two tetrahedra on a common edge, with the same least point: the next points decide.
TEST(NumberParts, PartsWithTheSameFirstPoint) {
  ZooMesh mesh;
  mesh.xyz = std::vector<double>{0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 1, 0, 1, 0, -1, 0};
  mesh.kinds = std::vector<CellKind>(3, CellKind::tetrahedron4);
  mesh.elems = std::vector<std::uint64_t>{0, 4, 8, 12};
  mesh.nodes = std::vector<NodeId>{0, 1, 2, 3, 0, 1, 2, 5, 0, 1, 2, 4};
  const std::vector<Point> points{{0, 0, 0}, {0, 0, 1}, {1, 0, 0},
                                  {0, 1, 0}, {1, 0, 1}, {0, -1, 0}};
  std::vector<double> parts{5, 0, 3};
  number_parts(mesh, points, parts);
  EXPECT_THAT(parts, ElementsAre(2, 1, 3));
  // the point (0, -1, 0) is of the surface no more, and a list comes before those that continue it
  parts = {5, 0, 3};
  number_parts(mesh, std::span(points).first(5), parts);
  EXPECT_THAT(parts, ElementsAre(1, 2, 3));
  // without any, too, parts have numbers
  parts = {5, 0, 5};
  number_parts(mesh, {}, parts);
  EXPECT_THAT(parts, ElementsAre(2, 1, 2));
}

// TetGen leaves out points that no facet uses: nodes are fewer than points, in any order.
TEST(NumberParts, PointsThatAreNoNodes) {
  ZooMesh mesh;
  mesh.xyz = std::vector<double>{2, 0, 0, 3, 0, 0, 2, 1, 0, 2, 0, 1, 1, 0, 0};
  mesh.kinds = std::vector<CellKind>(2, CellKind::tetrahedron4);
  mesh.elems = std::vector<std::uint64_t>{0, 4, 8};
  mesh.nodes = std::vector<NodeId>{0, 1, 2, 3, 0, 2, 3, 4};
  const std::vector<Point> points{{9, 9, 9}, {3, 0, 0}, {-9, 0, 0}, {2, 0, 0}, {2, 1, 0},
                                  {2, 0, 1}, {1, 0, 0}, {1, 0, 0},  {-9, 1, 0}};
  std::vector<double> parts{0, 1};
  number_parts(mesh, points, parts);
  EXPECT_THAT(parts, ElementsAre(2, 1));
  // nodes that are no points of the surface say nothing: the parts are alike, and keep their order
  parts = {0, 1};
  number_parts(mesh, std::span(points).subspan(3, 3), parts);
  EXPECT_THAT(parts, ElementsAre(1, 2));
}

}  // namespace
}  // namespace hiac
