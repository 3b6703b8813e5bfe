#include "hiac/frame/renderable.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "hiac/base/error.hpp"
#include "tests/render/truth/general_meshes.hpp"

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

// A corner of the last brick pushed in along its diagonal: its faces are no longer planar, the
// cell no longer convex, and all is well until it comes near the faces opposite.
ZooMesh with_corner_at(double x) {
  return with_field(test::moved(test::structured(2, Cut::bricks), [x](const Position& p) {
    return p[0] == 1 && p[1] == 1 && p[2] == 1 ? Position{x, x, x} : p;
  }));
}

TEST(Renderable, FacesThatAreNotPlanarAreLetPass) {
  EXPECT_NO_THROW(check_renderable(with_corner_at(1.25), scene()));
  EXPECT_NO_THROW(check_renderable(with_corner_at(0.9), scene()));
}

TEST(Renderable, CellsInsideOutInPartAreNamedOrSkipped) {
  const ZooMesh twisted = with_corner_at(0.6);
  EXPECT_THAT(
      [&] { check_renderable(twisted, scene()); },
      ThrowsMessage<InvalidCellError>(AllOf(HasSubstr("cell 7 (brick8)"), HasSubstr("Jacobian"))));
  EXPECT_EQ(invalid_cells(twisted, 1e-10), std::vector<CellId>{7});
  EXPECT_NO_THROW(check_renderable(twisted, scene(), InvalidCells::skipped));
}

TEST(Renderable, OrdersAreKeptWithoutSomeCells) {
  VisibilityOrder order{std::vector<CellId>{5, 3, 0, 1, 4, 2},
                        std::vector<CellGroup>{{1, 3}, {4, 2}}, "exact"};
  const VisibilityOrder left = without_cells(order, std::vector<CellId>{2, 3, 5});
  EXPECT_EQ(std::vector(left.cells.begin(), left.cells.end()), (std::vector<CellId>{0, 1, 4}));
  ASSERT_EQ(left.groups.size(), 1U);
  EXPECT_EQ(left.groups[0], (CellGroup{0, 2}));
}

// The corner that all eight cells share is moved away from the far corner of one of them, which
// only grows, and through the others.
TEST(Renderable, TheNumberOfFailingCellsIsSaid) {
  const ZooMesh twisted =
      with_field(test::moved(test::structured(2, Cut::bricks), [](const Position& p) {
        return p[0] == 0.5 && p[1] == 0.5 && p[2] == 0.5 ? Position{-0.2, 1.7, -0.8} : p;
      }));
  EXPECT_THAT([&] { check_renderable(twisted, scene()); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("cell 0"), HasSubstr("7 cells in all"))));
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

TEST(Renderable, CellsThatAreNotConvexAreNamedWhateverTheirSize) {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    const auto told = [&](std::vector<Position> points) {
      for (Position& p : points)
        for (double& x : p) x *= scale;
      const ZooMesh mesh = test::make_mesh(points, {{CellKind::brick8, {0, 1, 2, 3, 4, 5, 6, 7}}});
      return !invalid_cells(mesh, 1e-10).empty();
    };
    EXPECT_FALSE(told({{0, 0, 0},
                       {1, 0, 0},
                       {1, 1, 0},
                       {0, 1, 0},  //
                       {0, 0, 1},
                       {1, 0, 1},
                       {1, 1, 1},
                       {0, 1, 1}}));
    // the top turned half around: sides that cross
    EXPECT_TRUE(told({{0, 0, 0},
                      {1, 0, 0},
                      {1, 1, 0},
                      {0, 1, 0},  //
                      {1, 1, 1},
                      {0, 1, 1},
                      {0, 0, 1},
                      {1, 0, 1}}));
    // a corner of bottom and top pushed in
    EXPECT_TRUE(told({{0, 0, 0},
                      {1, 0, 0},
                      {0.2, 0.2, 0},
                      {0, 1, 0},  //
                      {0, 0, 1},
                      {1, 0, 1},
                      {0.2, 0.2, 1},
                      {0, 1, 1}}));
  }
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

TEST(Renderable, CellsOfHigherOrderAreLetPassUnlessTheirEdgesBendTooFar) {
  for (const CellOrder order : {CellOrder::quadratic, CellOrder::cubic}) {
    ZooMesh mesh =
        with_field(test::of_order(test::moved(test::mixed_columns(2), test::tapered), order));
    EXPECT_NO_THROW(check_renderable(mesh, scene()));
    std::vector<double> xyz(mesh.xyz.begin(), mesh.xyz.end());
    xyz.back() += 1e-3;  // a node between corners of the last cell
    mesh.xyz = std::vector<double>(xyz);
    EXPECT_NO_THROW(check_renderable(mesh, scene()));
    xyz.back() += 0.5;
    mesh.xyz = std::vector<double>(xyz);
    EXPECT_THAT([&] { check_renderable(mesh, scene()); },
                ThrowsMessage<InputError>(HasSubstr("Jacobian")));
  }
}

TEST(Renderable, CellsWithoutAPolynomialAreCounted) {
  Scene polynomial = scene();
  polynomial.render.interpolation = Interpolation::polynomial;
  const auto told = [&](const ZooMesh& mesh, InvalidCells invalid = InvalidCells::refused) {
    try {
      check_renderable(with_field(mesh), polynomial, invalid);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const double c = std::sqrt(0.5);
  const auto turned = [c](const Position& p) {
    return Position{c * (p[0] - p[1]), c * (p[0] + p[1]), p[2]};
  };
  const std::string bricks =
      "cell 0 (brick8): `render.interpolation` = \"polynomial\": the nodes do not determine the "
      "paper's function, which depends on how the cell lies (independent equations expected, a "
      "pivot below 1e-10 found";
  EXPECT_EQ(told(test::structured(1, Cut::bricks)), "");
  EXPECT_EQ(told(test::moved(test::structured(1, Cut::bricks), turned)), bricks + ")");
  EXPECT_EQ(told(test::moved(test::structured(2, Cut::bricks), turned)),
            bricks + "; 8 cells in all)");
  const auto flat = [](const Position& p) { return Position{p[0], p[1], 0}; };
  EXPECT_EQ(
      told(test::moved(test::structured(1, Cut::pyramids), flat)),
      "cell 0 (pyramid5): `render.interpolation` = \"polynomial\": the nodes do not determine "
      "a polynomial (nodes that are apart and not in one plane expected, others found; 6 "
      "cells in all)");
  // cells that are turned inside out in part are left out, and need none
  const ZooMesh crossed = test::make_mesh(
      {{0, 0, 0}, {1, 1, 0}, {0, 2, 0}, {-1, 1, 0}, {0, 2, 1}, {-1, 1, 1}, {0, 0, 1}, {1, 1, 1}},
      {{CellKind::brick8, {0, 1, 2, 3, 4, 5, 6, 7}}});
  EXPECT_EQ(told(crossed, InvalidCells::skipped), "");
}

}  // namespace
}  // namespace hiac
