#include "hiac/frame/surfaces/isosurfaces.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/frame/surfaces/touched_faces.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

using test::Position;

Scene scene_of_surfaces(const std::vector<std::pair<std::string, double>>& surfaces) {
  Scene scene;
  scene.image = {8, 8};
  scene.camera.eye = {3, 4, 5};
  scene.camera.up = {0, 0, 1};
  scene.camera.fov = 30;
  for (const auto& [field, value] : surfaces) {
    Isosurface surface;
    surface.field = field;
    surface.value = value;
    scene.isosurfaces.push_back(surface);
  }
  return scene;
}

Isosurfaces surfaces_in(const ZooMesh& mesh, const Scene& scene) {
  return make_isosurfaces(mesh, scene, Projector(scene.camera, scene.image));
}

// Two tetrahedra on both sides of the face of the nodes 0, 1 and 2.
ZooMesh two_tetrahedra(const std::vector<double>& values) {
  ZooMesh mesh = test::make_mesh(
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}},
      {{CellKind::tetrahedron4, {0, 1, 2, 3}}, {CellKind::tetrahedron4, {0, 2, 1, 4}}});
  mesh.fields = {Field{"f", "", FieldLocation::node, 1, std::vector<double>(values)}};
  return mesh;
}

// The surfaces' numbers in a cell.
std::vector<std::uint32_t> in_cell(const Isosurfaces& all, CellId cell) {
  std::vector<std::uint32_t> numbers;
  for (const IsosurfaceCut& cut : all.in(cell)) numbers.push_back(cut.surface);
  return numbers;
}

using Numbers = std::vector<std::uint32_t>;

TEST(IsosurfaceCuts, AreWhereACellsValuesLieOnBothSides) {
  const ZooMesh mesh = two_tetrahedra({0, 0, 0, 1, -1});
  const Isosurfaces all = surfaces_in(
      mesh, scene_of_surfaces({{"f", 0.5}, {"f", -0.5}, {"f", 2}, {"f", 1}, {"f", -1}}));
  ASSERT_EQ(all.first.size(), 3U);
  EXPECT_EQ(in_cell(all, 0), (Numbers{0}));  // a touched corner is no cut
  EXPECT_EQ(in_cell(all, 1), (Numbers{1}));
  EXPECT_EQ(all.fields.size(), 1U);
  EXPECT_EQ(all.offset(all.surfaces[0], 1, 7, 4), -1.5);
  const Isosurfaces none = surfaces_in(mesh, scene_of_surfaces({}));
  EXPECT_TRUE(none.in(0).empty());
  EXPECT_THROW(surfaces_in(mesh, scene_of_surfaces({{"g", 1}})), UsageError);
}

TEST(IsosurfaceCuts, InAFaceBelongToTheCellBelow) {
  const Isosurfaces all =
      surfaces_in(two_tetrahedra({0, 0, 0, 1, -1}), scene_of_surfaces({{"f", 0}}));
  EXPECT_EQ(in_cell(all, 0), Numbers{});
  ASSERT_EQ(in_cell(all, 1), (Numbers{0}));
  EXPECT_EQ(all.in(1)[0].closed_faces, 0);
}

TEST(IsosurfaceCuts, InAFaceBelowOnBothSidesAreClosed) {
  // the second of two surfaces; the first crosses the cells
  const Isosurfaces all =
      surfaces_in(two_tetrahedra({0, 0, 0, -2, -1}), scene_of_surfaces({{"f", -0.5}, {"f", 0}}));
  for (const CellId cell : {0U, 1U}) {
    ASSERT_EQ(in_cell(all, cell), (Numbers{0, 1}));
    EXPECT_EQ(all.in(cell)[0].closed_faces, 0);
    EXPECT_EQ(all.in(cell)[1].closed_faces, 0b1000);
  }
  // faces of one cell at the boundary stay open
  const Isosurfaces other =
      surfaces_in(two_tetrahedra({0, 0, -2, 0, 0}), scene_of_surfaces({{"f", 0}}));
  for (const CellId cell : {0U, 1U}) {
    ASSERT_EQ(in_cell(other, cell), (Numbers{0}));
    EXPECT_EQ(other.in(cell)[0].closed_faces, 0);
  }
  const auto touched = touched_boundary_faces(two_tetrahedra({0, 0, -2, 0, 0}), other);
  ASSERT_EQ(touched.size(), 2U);
  constexpr NodeId kNone = std::numeric_limits<NodeId>::max();
  EXPECT_EQ(touched[0].nodes, (std::array<NodeId, 4>{0, 1, 3, kNone}));
  EXPECT_EQ(touched[0].face, 0);
  EXPECT_EQ(touched[0].cut, 0U);
  EXPECT_EQ(touched[1].nodes, (std::array<NodeId, 4>{0, 1, 4, kNone}));
  EXPECT_EQ(touched[1].face, 2);
  EXPECT_EQ(touched[1].cut, 1U);
  // the face between the cells is none of the boundary
  EXPECT_TRUE(touched_boundary_faces(two_tetrahedra({0, 0, 0, -2, -1}), all).empty());
}

// A field of the size of one over the whole mesh and values of its surfaces; above the grain in
// which cells are dealt out, with closed faces in planes between bricks.
TEST(IsosurfaceCuts, OfManyCellsAreThoseOfEach) {
  constexpr std::size_t kSide = 26;
  ZooMesh mesh = test::structured(kSide, test::Cut::bricks);
  ASSERT_GT(mesh.cell_count(), std::size_t{1} << 14);
  // a hat over the middle plane x = 1/2, which it touches from below
  test::add_node_field(mesh, "f", [](const Position& p) { return -std::abs(p[0] - 0.5); });
  const double quarter = -0.26;
  const Isosurfaces all = surfaces_in(mesh, scene_of_surfaces({{"f", quarter}, {"f", 0}}));
  ASSERT_EQ(all.first.size(), mesh.cell_count() + 1);
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    double least = 1, most = -1, left = 1;
    for (const NodeId node : mesh.cell_nodes(cell)) {
      const double value = mesh.fields[0].values[node];
      least = std::min(least, value), most = std::max(most, value);
      left = std::min(left, mesh.position(node)[0]);
    }
    Numbers expected;
    if (least < quarter && quarter < most) expected.push_back(0);
    if (most == 0) expected.push_back(1);
    ASSERT_EQ(in_cell(all, cell), expected) << cell;
    if (most < 0) continue;
    const unsigned side = left < 0.5 - 1e-9 ? 0b10 : 0b01;  // of a brick, at larger and less x
    EXPECT_EQ(all.in(cell).back().closed_faces, side) << cell;
  }
}

TEST(IsosurfaceCuts, LightIsTheLargestOfAllSurfaces) {
  Scene scene = scene_of_surfaces({{"f", 0.5}, {"f", 0.25}, {"f", 0.75}});
  scene.lights.clear();
  scene.isosurfaces[1].ambient = 0.9;
  const Isosurfaces all = surfaces_in(two_tetrahedra({0, 0, 0, 1, -1}), scene);
  EXPECT_EQ(all.largest_light, 0.9);
  EXPECT_TRUE(all.lights.empty());
}

// Differences from 0 whose products would underflow: the field is scaled by a power of two, and the
// surface with it.
TEST(IsosurfaceCuts, OfVanishingFieldsAreScaled) {
  struct Case {
    double unit, value, factor;
  };
  constexpr double kTiny = std::numeric_limits<double>::denorm_min();
  for (const auto& [unit, value, factor] :
       {Case{1, 0.25, 1}, Case{1, 0, 1}, Case{0x1p-500, 0, 1}, Case{0x1p-501, 0, 0x1p900},
        Case{0x1p-600, 0x1p-601, 0x1p999}, Case{0x1p-600, -0x1p-601, 0x1p999},
        Case{kTiny, 0, 0x1p1023}}) {
    const ZooMesh mesh = two_tetrahedra({0, 0, 0, unit, -2 * unit});
    const Isosurfaces all = surfaces_in(mesh, scene_of_surfaces({{"f", value}}));
    ASSERT_EQ(all.fields.size(), 1U);
    EXPECT_EQ(all.fields[0].values[3], unit * factor) << unit;
    EXPECT_EQ(all.fields[0].values[4], -2 * unit * factor) << unit;
    EXPECT_EQ(all.surfaces[0].value, value * factor) << unit;
  }
  // one field twice, once scaled
  const ZooMesh mesh = two_tetrahedra({0, 0, 0, 1, 0x1p-700});
  const Isosurfaces all =
      surfaces_in(mesh, scene_of_surfaces({{"f", 0.5}, {"f", 0}, {"f", 0x1p-701}, {"f", 0.25}}));
  ASSERT_EQ(all.fields.size(), 2U);
  EXPECT_EQ(all.surfaces[0].field, 0U);
  EXPECT_EQ(all.surfaces[1].field, 1U);
  EXPECT_EQ(all.surfaces[2].field, 1U);
  EXPECT_EQ(all.surfaces[3].field, 0U);
  EXPECT_EQ(all.fields[1].values[3], 0x1p400);
  EXPECT_EQ(all.fields[1].values[4], 0x1p-300);
  EXPECT_EQ(all.surfaces[2].value, 0x1p-301);
}

}  // namespace
}  // namespace hiac
