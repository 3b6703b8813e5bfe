#include "hiac/render/renderable.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "hiac/base/error.hpp"
#include "tests/render/general_meshes.hpp"

namespace hiac {
namespace {

using test::cube_scene;
using test::Cut;
using test::Position;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

Scene scene() { return cube_scene(Projection::perspective, 8, 8); }

ZooMesh with_field(ZooMesh mesh) {
  test::add_random_field(mesh, "f", FieldLocation::node, 1);
  return mesh;
}

ZooMesh with_values(ZooMesh mesh, FieldLocation location, std::vector<double> values) {
  mesh.fields = {Field{"f", "", location, 1, std::move(values)}};
  return mesh;
}

TEST(Renderable, EveryLinearKindIsLetPass) {
  for (const Cut cut : {Cut::bricks, Cut::tetrahedra, Cut::prisms, Cut::pyramids})
    EXPECT_NO_THROW(check_renderable(with_field(test::structured(3, cut)), scene()));
  EXPECT_NO_THROW(check_renderable(with_field(test::two_wedges()), scene()));
  EXPECT_NO_THROW(
      check_renderable(with_field(test::moved(test::mixed_columns(3), test::tapered)), scene()));
}

TEST(Renderable, CellsAllTurnedInsideOutAreLetPass) {
  const auto mirrored = [](const Position& p) { return Position{-p[0], p[1], p[2]}; };
  EXPECT_NO_THROW(
      check_renderable(with_field(test::moved(test::mixed_columns(2), mirrored)), scene()));
}

TEST(Renderable, FacesThatAreNotPlanarAreNamed) {
  const ZooMesh twisted =
      with_field(test::moved(test::structured(2, Cut::bricks), [](const Position& p) {
        return p[0] == 1 && p[1] == 1 && p[2] == 1 ? Position{1.25, 1, 1} : p;
      }));
  Scene s = scene();
  EXPECT_THAT([&] { check_renderable(twisted, s); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("cell 7 (brick8)"), HasSubstr("not planar"),
                                              HasSubstr("1e-10"))));
  s.render.planarity = 0.5;
  EXPECT_NO_THROW(check_renderable(twisted, s));
}

TEST(Renderable, TheNumberOfFailingCellsIsSaid) {
  const ZooMesh twisted =
      with_field(test::moved(test::structured(2, Cut::bricks), [](const Position& p) {
        return p[0] == 0.5 && p[1] == 0.5 && p[2] == 0.5 ? Position{0.6, 0.52, 0.5} : p;
      }));
  EXPECT_THAT([&] { check_renderable(twisted, scene()); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("cell 0"), HasSubstr("8 cells in all"))));
}

TEST(Renderable, CellsThatAreNotConvexAreNamed) {
  // the top of the brick turned half around: its sides cross, and are planar still
  const ZooMesh crossed = with_field(test::make_mesh(
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 1, 1}, {0, 1, 1}, {0, 0, 1}, {1, 0, 1}},
      {{CellKind::brick8, {0, 1, 2, 3, 4, 5, 6, 7}}}));
  EXPECT_THROW(check_renderable(crossed, scene()), InputError);
  // a prism over a quadrilateral with a corner pushed in
  const ZooMesh dented =
      with_field(test::make_mesh({{0, 0, 0},
                                  {1, 0, 0},
                                  {0.2, 0.2, 0},
                                  {0, 1, 0},
                                  {0, 0, 1},
                                  {1, 0, 1},
                                  {0.2, 0.2, 1},
                                  {0, 1, 1}},
                                 {{CellKind::brick8, {0, 1, 2, 3, 4, 5, 6, 7}}}));
  EXPECT_THAT(
      [&] { check_renderable(dented, scene()); },
      ThrowsMessage<InputError>(AllOf(HasSubstr("cell 0 (brick8)"), HasSubstr("not convex"))));
}

TEST(Renderable, ValuesThatAreNotFiniteAreNamed) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const ZooMesh mesh = test::structured(1, Cut::prisms);
  std::vector<double> values(8, 0.5);
  values[2] = values[5] = kNan;
  EXPECT_THAT([&] { check_renderable(with_values(mesh, FieldLocation::node, values), scene()); },
              ThrowsMessage<InputError>(
                  AllOf(HasSubstr("field 'f'"), HasSubstr("2 others"), HasSubstr("node 2"))));
  EXPECT_THAT(
      [&] {
        check_renderable(with_values(mesh, FieldLocation::cell, {0.5, HUGE_VAL}), scene());
      },
      ThrowsMessage<InputError>(HasSubstr("inf at cell 1")));
  std::vector<double> corners(12, 0.5);
  corners[7] = kNan;
  EXPECT_THAT([&] { check_renderable(with_values(mesh, FieldLocation::corner, corners), scene()); },
              ThrowsMessage<InputError>(HasSubstr("cell 1, entry 7")));
}

TEST(Renderable, NodesOfNoCellMayHoldAnything) {
  ZooMesh mesh = test::structured(1, Cut::bricks);
  std::vector<double> xyz(mesh.xyz.begin(), mesh.xyz.end()), values(9, 0.5);
  xyz.insert(xyz.end(), {5, 5, 5});
  mesh.xyz = std::move(xyz);
  values.back() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NO_THROW(check_renderable(with_values(mesh, FieldLocation::node, values), scene()));
}

TEST(Renderable, FieldsThatDoNotExistAreRefused) {
  EXPECT_THROW(check_renderable(test::structured(1, Cut::bricks), scene()), UsageError);
}

TEST(Renderable, StraightCellsOfHigherOrderAreLetPassAndCurvedEdgesAreNamed) {
  for (const CellOrder order : {CellOrder::quadratic, CellOrder::cubic}) {
    ZooMesh mesh =
        with_field(test::of_order(test::moved(test::mixed_columns(2), test::tapered), order));
    EXPECT_NO_THROW(check_renderable(mesh, scene()));
    std::vector<double> xyz(mesh.xyz.begin(), mesh.xyz.end());
    xyz.back() += 1e-6;  // a node between corners of the last cell
    mesh.xyz = std::move(xyz);
    EXPECT_THAT(
        [&] { check_renderable(mesh, scene()); },
        ThrowsMessage<InputError>(AllOf(HasSubstr("edges are curved"), HasSubstr("--corners-only"),
                                        HasSubstr("render.planarity"))));
  }
}

}  // namespace
}  // namespace hiac
