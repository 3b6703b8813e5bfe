#include "hiac/order/published/mpvo.hpp"

#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hiac/mesh/face_adjacency.hpp"
#include "tests/order/brute_force_order.hpp"
#include "tests/order/order_meshes.hpp"
#include "tests/support/ray_order.hpp"

namespace hiac::test {
namespace {

constexpr double kPlanarity = 1e-10;

VisibilityOrder order_of(const ZooMesh& mesh, const View& view) {
  return mpvo_order(mesh, build_face_adjacency(mesh), view, kPlanarity);
}

TEST(Mpvo, EmptyMeshAndOneCell) {
  EXPECT_EQ(order_of(make_mesh({}, {}), view_named("outside")).cells.size(), 0U);
  const VisibilityOrder one = order_of(structured(1, Cut::bricks), view_named("outside"));
  EXPECT_EQ(one.cells.size(), 1U);
  EXPECT_EQ(one.algorithm, "mpvo");
}

// A Delaunay triangulation has no cycle from anywhere (H. Edelsbrunner, 1990).
TEST(Mpvo, DelaunayIsTheOrderThatRationalArithmeticFinds) {
  for (const std::uint64_t seed : {1U, 2U}) {
    const ZooMesh mesh = random_delaunay(30, seed);
    for (const auto& [name, view] : many_views()) {
      SCOPED_TRACE(name);
      const VisibilityOrder order = order_of(mesh, view);
      EXPECT_EQ(order.groups.size(), 0U);
      ASSERT_TRUE(is_order_of(rational_arrows(mesh, view), mesh.cell_count(), order));
    }
  }
}

TEST(Mpvo, ConvexMeshesOfOtherShapes) {
  for (const Cut cut : {Cut::bricks, Cut::prisms, Cut::pyramids}) {
    SCOPED_TRACE(static_cast<int>(cut));
    const ZooMesh mesh = structured(3, cut);
    for (const auto& [name, view] : many_views()) {
      SCOPED_TRACE(name);
      ASSERT_TRUE(holds_along_rays(mesh, view, order_of(mesh, view), 50, 7));
    }
  }
}

TEST(Mpvo, CellsOfACycleAreOneGroup) {
  const VisibilityOrder order = order_of(pinwheel(), from_eye("axis", {0, 0, 4}).view);
  EXPECT_THAT(std::vector(order.cells.begin(), order.cells.end()),
              testing::ElementsAre(0U, 1U, 2U, 3U));
  EXPECT_THAT(std::vector(order.groups.begin(), order.groups.end()),
              testing::ElementsAre(CellGroup{1, 3}));
  ASSERT_TRUE(is_sequence_of_groups(order, 4));
}

// Two cubes one behind the other share no face: the search has to begin with the farther one.
TEST(Mpvo, SeparatePartsComeByDepth) {
  const ZooMesh mesh = side_by_side(structured(2, Cut::tetrahedra),
                                    moved(structured(2, Cut::tetrahedra), [](const Position& p) {
                                      return Position{p[0] + 3, p[1], p[2]};
                                    }));
  for (const View& view :
       {from_eye("left", {-4, 0.4, 0.6}).view, from_eye("right", {8, 0.4, 0.6}).view,
        along("x", {1, 0, 0}).view, along("-x", {-1, 0.01, 0}).view})
    ASSERT_TRUE(holds_along_rays(mesh, view, order_of(mesh, view), 200, 3));
}

// No guarantee, but far fewer pairs out of order than by chance.
TEST(Mpvo, NonConvexMeshesAreMostlyRight) {
  const ZooMesh mesh = keep_cells(random_delaunay(60, 6), [](const Position& p, CellId) {
    return p[2] < 0.5 || p[0] < 0.3 || p[0] > 0.7;
  });
  for (const auto& [name, view] : many_views()) {
    SCOPED_TRACE(name);
    const VisibilityOrder order = order_of(mesh, view);
    ASSERT_TRUE(is_sequence_of_groups(order, mesh.cell_count()));
    const RayCheck check = check_along_rays(mesh, order, view, 100, 5);
    EXPECT_LT(check.misordered, check.pairs / 20);
  }
}

}  // namespace
}  // namespace hiac::test
