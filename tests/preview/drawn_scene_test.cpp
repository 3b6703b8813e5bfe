// What of a scene and a mesh the shaders get; no driver is needed.

#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/preview/drawn_fields.hpp"
#include "hiac/preview/drawn_mesh.hpp"
#include "hiac/preview/float_target.hpp"
#include "tests/preview/preview_support.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

using preview::drawn_scene;
using preview::DrawnField;
using preview::DrawnScene;

ZooMesh mesh_of_three_fields() {
  ZooMesh mesh = test::structured(1, test::Cut::tetrahedra);
  test::add_node_field(mesh, "f", [](const test::Position& p) { return 10 * p[0] - 3; });
  test::add_node_field(mesh, "g", [](const test::Position& p) { return 8 * p[1]; });
  test::add_node_field(mesh, "h", [](const test::Position& p) { return 2 * p[2]; });
  test::add_node_field(mesh, "even", [](const test::Position&) { return 7; });
  std::vector<double> of_cells;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) of_cells.push_back(cell);
  mesh.fields.push_back({"c", "", FieldLocation::cell, 1, std::move(of_cells)});
  return mesh;
}

Scene plain_scene() {
  Scene scene = test::benchmark_scene(Projection::perspective, 8, 8);
  scene.volume = {};
  return scene;
}

/// Every value of the mesh's field, moved and scaled.
void expect_scaled(const DrawnField& found, const ZooMesh& mesh, double middle, double half) {
  EXPECT_DOUBLE_EQ(found.middle, middle) << found.name;
  EXPECT_DOUBLE_EQ(found.half, half) << found.name;
  const Field field = scalar_field(mesh, found.name);
  ASSERT_EQ(found.values.size(), field.values.size());
  for (std::size_t k = 0; k < found.values.size(); ++k)
    EXPECT_DOUBLE_EQ(found.values[k], (field.values[k] - middle) / half) << found.name << k;
}

TEST(DrawnScene, HasEveryFieldOnceScaledByWhatTellsItsValuesApart) {
  const ZooMesh mesh = mesh_of_three_fields();
  Scene scene = plain_scene();
  scene.volume.extinction = {"f", {{-1, {0}}, {3, {1}}}};
  scene.volume.color = {"g", {{2, {0, 0, 0}}, {6, {1, 1, 1}}}};
  scene.isosurfaces.push_back({"g", 10, {}});
  scene.isosurfaces.push_back({"h", 5, {}});
  scene.isosurfaces.push_back({"g", 3, {}});
  scene.isosurfaces.push_back({"f", 0, {}});
  const DrawnScene drawn = drawn_scene(mesh, scene);
  ASSERT_EQ(drawn.fields.size(), 3U);
  EXPECT_EQ(drawn.extinction, 0U);
  EXPECT_EQ(drawn.color, 1U);
  EXPECT_FALSE(drawn.same_field());
  EXPECT_EQ(drawn.fields[0].name, "f");
  expect_scaled(drawn.fields[0], mesh, 1, 2);
  expect_scaled(drawn.fields[1], mesh, 6, 4);      // from 2 to the isosurface at 10
  expect_scaled(drawn.fields[2], mesh, 2.5, 2.5);  // one mark tells nothing apart: values, 0 to 2
  ASSERT_EQ(drawn.surface_fields.size(), 3U);
  EXPECT_EQ(drawn.surface_fields[0].field, 1U);
  EXPECT_EQ(drawn.surface_fields[0].surfaces, (std::vector<std::size_t>{2, 0}));
  EXPECT_EQ(drawn.surface_fields[1].field, 2U);
  EXPECT_EQ(drawn.surface_fields[1].surfaces, std::vector<std::size_t>{1});
  EXPECT_EQ(drawn.surface_fields[2].field, 0U);
  EXPECT_EQ(drawn.surface_field_of, (std::vector<std::size_t>{0, 1, 0, 2}));
  ASSERT_EQ(drawn.surface_values.size(), 4U);
  EXPECT_DOUBLE_EQ(drawn.surface_values[0], 1);
  EXPECT_DOUBLE_EQ(drawn.surface_values[1], 1);
  EXPECT_DOUBLE_EQ(drawn.surface_values[2], -0.75);
  EXPECT_DOUBLE_EQ(drawn.surface_values[3], -0.5);
}

TEST(DrawnScene, HasOneFieldForBothFunctions) {
  const ZooMesh mesh = mesh_of_three_fields();
  Scene scene = plain_scene();
  scene.volume.extinction = {"f", {{1, {0}}, {3, {1}}}};
  scene.volume.color = {"f", {{-1, {0, 0, 0}}, {2, {1, 1, 1}}}};
  DrawnScene drawn = drawn_scene(mesh, scene);
  ASSERT_EQ(drawn.fields.size(), 1U);
  EXPECT_TRUE(drawn.same_field());
  expect_scaled(drawn.fields[0], mesh, 1, 2);  // by the breakpoints of both
  scene.volume.extinction.reset();
  scene.volume.glow = Glow::emission;
  drawn = drawn_scene(mesh, scene);
  ASSERT_EQ(drawn.fields.size(), 1U);
  EXPECT_EQ(drawn.extinction, 0U);
  EXPECT_EQ(drawn.color, 0U);
  expect_scaled(drawn.fields[0], mesh, 0.5, 1.5);
}

TEST(DrawnScene, ScalesByValuesWhereFunctionsAreTheSameEverywhere) {
  const ZooMesh mesh = mesh_of_three_fields();
  Scene scene = plain_scene();
  scene.volume.extinction = {"f", {{0, {1}}}};
  scene.volume.color = {"even", {{7, {1, 1, 1}}}};
  const DrawnScene drawn = drawn_scene(mesh, scene);
  expect_scaled(drawn.fields[0], mesh, 2, 5);  // -3 to 7
  expect_scaled(drawn.fields[1], mesh, 7, 1);  // one value: not scaled
  scene.volume.color->field = "c";
  EXPECT_EQ(drawn_scene(mesh, scene).fields[1].location, FieldLocation::cell);
  EXPECT_EQ(drawn_scene(mesh, scene).fields[0].location, FieldLocation::node);
  scene.volume.color->field = "none";
  EXPECT_THROW(drawn_scene(mesh, scene), UsageError);
}

TEST(DrawnScene, OfABackgroundAloneHasZeros) {
  const ZooMesh mesh = mesh_of_three_fields();
  const DrawnScene drawn = drawn_scene(mesh, plain_scene());
  ASSERT_EQ(drawn.fields.size(), 1U);
  EXPECT_EQ(drawn.fields[0].location, FieldLocation::cell);
  EXPECT_EQ(drawn.fields[0].values, std::vector<double>(mesh.cell_count()));
  EXPECT_TRUE(drawn.surface_fields.empty());
}

TEST(DrawnMesh, IsTheMeshItselfOrLinearTetrahedra) {
  const ZooMesh tetrahedra = test::structured(2, test::Cut::tetrahedra);
  const preview::DrawnMesh same = preview::drawn_mesh(tetrahedra, 2);
  EXPECT_EQ(same.approximated, 0U);
  EXPECT_EQ(same.halvings, 0U);
  EXPECT_EQ(same.mesh.nodes.view().data(), tetrahedra.nodes.view().data());
  // straight edges are not halved
  const preview::DrawnMesh prisms = preview::drawn_mesh(test::structured(2, test::Cut::prisms), 2);
  EXPECT_EQ(prisms.approximated, 16U);
  EXPECT_EQ(prisms.halvings, 0U);
  for (const CellKind kind : prisms.mesh.kinds) EXPECT_EQ(kind, CellKind::tetrahedron4);
}

TEST(DrawnMesh, HalvesTheEdgesOfCurvedCells) {
  const std::vector<test::Position> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  std::vector<test::Position> nodes = corners;
  for (const auto& [a, b] : {std::pair(0U, 1U), {1U, 2U}, {2U, 0U}, {0U, 3U}, {1U, 3U}, {2U, 3U}})
    nodes.push_back({(corners[a][0] + corners[b][0]) / 2, (corners[a][1] + corners[b][1]) / 2,
                     (corners[a][2] + corners[b][2]) / 2});
  const ZooMesh curved =
      test::make_mesh(nodes, {{CellKind::tetrahedron10, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}}});
  for (const unsigned levels : {0U, 1U, 2U}) {
    const preview::DrawnMesh drawn = preview::drawn_mesh(curved, levels);
    EXPECT_EQ(drawn.approximated, 1U);
    EXPECT_EQ(drawn.halvings, levels);
    EXPECT_EQ(drawn.mesh.cell_count(), levels == 0 ? 1U : levels == 1 ? 8U : 64U);
  }
}

TEST(PartsOf, GoRowByRowAndAreSmallerAtTheEndsAlone) {
  const auto parts = preview::parts_of({3, 5, 10, 7}, 4);
  const PixelRect expected[] = {{3, 5, 4, 4}, {7, 5, 4, 4}, {11, 5, 2, 4},
                                {3, 9, 4, 3}, {7, 9, 4, 3}, {11, 9, 2, 3}};
  ASSERT_EQ(parts.size(), 6U);
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_EQ(parts[k].x, expected[k].x) << k;
    EXPECT_EQ(parts[k].y, expected[k].y) << k;
    EXPECT_EQ(parts[k].width, expected[k].width) << k;
    EXPECT_EQ(parts[k].height, expected[k].height) << k;
  }
  EXPECT_EQ(preview::parts_of({0, 0, 8, 8}, 8).size(), 1U);
  EXPECT_EQ(preview::parts_of({0, 0, 8, 9}, 8).size(), 2U);
}

}  // namespace
}  // namespace hiac
