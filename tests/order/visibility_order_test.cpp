#include "hiac/order/visibility_order.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hiac/base/parallel.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "tests/order/brute_force_order.hpp"
#include "tests/order/order_meshes.hpp"

namespace hiac::test {
namespace {

constexpr double kPlanarity = 1e-10;
constexpr std::size_t kRays = 100;

OrderResult order_of(const ZooMesh& mesh, const View& view) {
  return exact_order(mesh, build_face_adjacency(mesh), view, kPlanarity);
}

ZooMesh without(const ZooMesh& mesh, const std::function<bool(const Position&)>& gone) {
  return keep_cells(mesh, [&](const Position& centroid, CellId) { return !gone(centroid); });
}

// The order holds along random rays, from everywhere, and no cells are held to be in a cycle.
void expect_right_from_everywhere(const ZooMesh& mesh) {
  for (const auto& [name, view] : many_views()) {
    SCOPED_TRACE(name);
    const OrderResult result = order_of(mesh, view);
    EXPECT_EQ(result.order.groups.size(), 0U);
    ASSERT_TRUE(holds_along_rays(mesh, view, result.order, kRays, 5));
  }
}

TEST(VisibilityOrder, EmptyMeshAndOneCell) {
  EXPECT_EQ(order_of(make_mesh({}, {}), view_named("outside")).order.cells.size(), 0U);
  const auto one = order_of(structured(1, Cut::bricks), view_named("outside"));
  EXPECT_EQ(one.order.cells.size(), 1U);
  EXPECT_EQ(one.order.groups.size(), 0U);
  EXPECT_TRUE(one.statistics.convex);
}

// A Delaunay triangulation has no cycle from anywhere (H. Edelsbrunner, 1990).
TEST(VisibilityOrder, DelaunayIsTheOrderThatRationalArithmeticFinds) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const ZooMesh mesh = random_delaunay(30, seed);
    ASSERT_LT(mesh.cell_count(), kMostCells);
    for (const auto& [name, view] : many_views()) {
      SCOPED_TRACE(name);
      const OrderResult result = order_of(mesh, view);
      EXPECT_TRUE(result.statistics.convex);
      EXPECT_EQ(result.order.groups.size(), 0U);
      ASSERT_TRUE(is_order_of(rational_arrows(mesh, view), mesh.cell_count(), result.order));
      ASSERT_TRUE(holds_along_rays(mesh, view, result.order, kRays, seed));
    }
  }
}

TEST(VisibilityOrder, StructuredMeshesHaveNoCycle) {
  for (const Cut cut : {Cut::bricks, Cut::tetrahedra, Cut::prisms, Cut::pyramids}) {
    SCOPED_TRACE(static_cast<int>(cut));
    const ZooMesh mesh = structured(4, cut);
    for (const auto& [name, view] : many_views()) {
      SCOPED_TRACE(name);
      const OrderResult result = order_of(mesh, view);
      EXPECT_TRUE(result.statistics.convex);
      EXPECT_EQ(result.statistics.both_ways, 0U);
      EXPECT_EQ(result.order.groups.size(), 0U);
      ASSERT_TRUE(holds_along_rays(mesh, view, result.order, kRays, 7));
      if (cut == Cut::tetrahedra) {
        ASSERT_TRUE(is_order_of(rational_arrows(mesh, view), mesh.cell_count(), result.order));
      }
    }
  }
}

// Turned, a plane of a lattice holds to rounding alone, and so do its sides.
TEST(VisibilityOrder, TurnedStructuredMeshes) {
  for (const Cut cut : {Cut::bricks, Cut::tetrahedra, Cut::prisms, Cut::pyramids}) {
    SCOPED_TRACE(static_cast<int>(cut));
    const ZooMesh mesh = moved(structured(3, cut), turned);
    for (const auto& [name, view] : many_views()) {
      SCOPED_TRACE(name);
      View same = view;
      same.eye = turned(view.eye);
      same.direction = turned(view.direction);
      const OrderResult result = order_of(mesh, same);
      EXPECT_EQ(result.statistics.both_ways, 0U);
      ASSERT_TRUE(holds_along_rays(mesh, same, result.order, kRays, 9));
    }
  }
}

TEST(VisibilityOrder, FarFromTheOrigin) {
  const ZooMesh mesh = moved(random_delaunay(20, 4), [](const Position& p) {
    return Position{p[0] + 1e6, p[1] - 1e6, p[2] + 1e6};
  });
  for (NamedView view : many_views()) {
    SCOPED_TRACE(view.name);
    for (std::size_t c = 0; c < 3; ++c) view.view.eye[c] += c == 1 ? -1e6 : 1e6;
    const OrderResult result = order_of(mesh, view.view);
    ASSERT_TRUE(is_sequence_of_groups(result.order, mesh.cell_count()));
    ASSERT_TRUE(holds_along_rays(mesh, view.view, result.order, kRays, 3));
  }
}

// Bricks whose bottoms and tops are triangles with a fourth corner on a side.
TEST(VisibilityOrder, CornersInLine) {
  for (const NodeId in_line : {NodeId{0}, NodeId{7}}) {
    const ZooMesh mesh = corners_in_line(in_line);
    for (const auto& [name, view] : many_views()) {
      SCOPED_TRACE(name);
      const OrderResult result = order_of(mesh, view);
      EXPECT_TRUE(result.statistics.convex);
      EXPECT_EQ(result.order.groups.size(), 0U);
      ASSERT_TRUE(holds_along_rays(mesh, view, result.order, kRays, 7));
    }
  }
}

TEST(VisibilityOrder, ThreeCellsInACycleAreOneGroup) {
  const ZooMesh mesh = pinwheel();
  for (const double z : {0.5, 4.0, -3.0}) {
    SCOPED_TRACE(z);
    const View view = from_eye("axis", {0, 0, z}).view;
    const OrderResult result = order_of(mesh, view);
    EXPECT_TRUE(result.statistics.convex);
    EXPECT_EQ(result.statistics.largest_group, 3U);
    EXPECT_EQ(result.statistics.cells_in_groups, 3U);
    EXPECT_THAT(std::vector(result.order.cells.begin(), result.order.cells.end()),
                testing::ElementsAre(0U, 1U, 2U, 3U));
    EXPECT_THAT(std::vector(result.order.groups.begin(), result.order.groups.end()),
                testing::ElementsAre(CellGroup{1, 3}));
    EXPECT_TRUE(holds_along_rays(mesh, view, result.order, kRays, 1));
  }
  EXPECT_EQ(order_of(mesh, along("across", {1, 0.2, 0}).view).order.groups.size(), 0U);
  EXPECT_EQ(order_of(mesh, from_eye("beside", {-20, 3, 0.5}).view).order.groups.size(), 0U);
}

TEST(VisibilityOrder, ReversedNodesChangeNothing) {
  for (const Cut cut : {Cut::bricks, Cut::tetrahedra, Cut::prisms, Cut::pyramids}) {
    SCOPED_TRACE(static_cast<int>(cut));
    const ZooMesh mesh = structured(3, cut);
    const std::vector<ZooMesh> reversed{
        inverted(mesh, [](CellId) { return true; }),
        inverted(mesh, [](CellId cell) { return (cell * 2654435761U >> 16) % 2 == 0; })};
    for (const ZooMesh& other : reversed)
      for (const auto& [name, view] : many_views()) {
        SCOPED_TRACE(name);
        const OrderResult result = order_of(other, view);
        EXPECT_TRUE(result.statistics.convex);
        EXPECT_EQ(result.order.groups.size(), 0U);
        ASSERT_TRUE(holds_along_rays(mesh, view, result.order, kRays, 7));
      }
  }
}

TEST(VisibilityOrder, ReversedNodesChangeNoCycle) {
  const ZooMesh mesh = inverted(pinwheel(), [](CellId cell) { return cell % 2 == 1; });
  const OrderResult result = order_of(mesh, from_eye("axis", {0, 0, 0.5}).view);
  EXPECT_EQ(result.order.cells[0], 0U);
  EXPECT_THAT(std::vector(result.order.groups.begin(), result.order.groups.end()),
              testing::ElementsAre(CellGroup{1, 3}));
}

TEST(VisibilityOrder, CellsWithoutVolumePassOnWhatTheirNeighboursSay) {
  const ZooMesh mesh = flat_between();
  for (const auto& [name, view] : many_views()) {
    SCOPED_TRACE(name);
    const OrderResult result = order_of(mesh, view);
    EXPECT_TRUE(result.statistics.convex);
    EXPECT_EQ(result.order.groups.size(), 0U);
    ASSERT_TRUE(is_order_of(rational_arrows(mesh, view), mesh.cell_count(), result.order));
    ASSERT_TRUE(holds_along_rays(mesh, view, result.order, kRays, 7));
  }
}

TEST(VisibilityOrder, TwoSeparateCubes) {
  for (const Cut cut : {Cut::bricks, Cut::tetrahedra}) {
    const ZooMesh far = moved(structured(2, cut), [](const Position& p) {
      return Position{p[0] + 1.5, p[1] + 0.3, p[2] - 0.2};
    });
    const ZooMesh mesh = side_by_side(structured(2, cut), far);
    EXPECT_FALSE(order_of(mesh, view_named("outside")).statistics.convex);
    expect_right_from_everywhere(mesh);
  }
}

TEST(VisibilityOrder, NotchesCavitiesAndHoles) {
  const auto notch = [](const Position& p) { return p[2] > 0.5 && p[0] > 0.3 && p[0] < 0.7; };
  const auto cavity = [](const Position& p) {
    return std::ranges::all_of(p, [](double x) { return x > 0.3 && x < 0.7; });
  };
  const auto hole = [](const Position& p) { return std::hypot(p[0] - 0.5, p[1] - 0.5) < 0.25; };
  const auto scattered = [](const Position& p) {
    return std::sin(1e3 * (p[0] + 3 * p[1] + 7 * p[2])) > 0.6;
  };
  for (const Cut cut : {Cut::bricks, Cut::tetrahedra, Cut::prisms, Cut::pyramids}) {
    SCOPED_TRACE(static_cast<int>(cut));
    expect_right_from_everywhere(without(structured(4, cut), notch));
    expect_right_from_everywhere(without(structured(4, cut), cavity));
    expect_right_from_everywhere(without(structured(4, cut), hole));
    expect_right_from_everywhere(without(structured(4, cut), scattered));
  }
  expect_right_from_everywhere(without(random_delaunay(60, 6), cavity));
  expect_right_from_everywhere(without(random_delaunay(60, 7), scattered));
}

// Two bodies that touch along a plane on which their nodes do not match.
TEST(VisibilityOrder, SlidingInterfacesAndHangingNodes) {
  const auto half = [](double x0) {
    return [x0](const Position& p) { return Position{x0 + p[0] / 2, p[1], p[2]}; };
  };
  for (const Cut cut : {Cut::bricks, Cut::tetrahedra, Cut::prisms}) {
    SCOPED_TRACE(static_cast<int>(cut));
    const ZooMesh left = moved(structured(2, cut), half(0));
    expect_right_from_everywhere(side_by_side(left, moved(structured(4, cut), half(0.5))));
    expect_right_from_everywhere(side_by_side(left, moved(structured(3, cut), half(0.5))));
    const ZooMesh slid = moved(structured(2, cut), [](const Position& p) {
      return Position{0.5 + p[0] / 2, p[1] + 0.17, p[2] - 0.11};
    });
    expect_right_from_everywhere(side_by_side(left, slid));
  }
}

// A crack of no width leaves the outside of a convex body as it is, but rays cross it between
// cells that share no face.
TEST(VisibilityOrder, Cracks) {
  for (const Cut cut : {Cut::bricks, Cut::tetrahedra, Cut::prisms, Cut::pyramids})
    for (const double front : {0.25, 0.5, 0.75}) {
      SCOPED_TRACE(static_cast<int>(cut));
      SCOPED_TRACE(front);
      const ZooMesh mesh = torn(structured(4, cut), front);
      EXPECT_FALSE(order_of(mesh, view_named("outside")).statistics.convex);
      expect_right_from_everywhere(mesh);
    }
}

TEST(VisibilityOrder, ThreadsChangeNothing) {
  const std::vector<ZooMesh> meshes{random_delaunay(3000, 8),
                                    without(structured(12, Cut::tetrahedra), [](const Position& p) {
                                      return p[0] > 0.4 && p[2] > 0.4;
                                    })};
  for (const ZooMesh& mesh : meshes)
    for (const auto& [name, view] : many_views()) {
      SCOPED_TRACE(name);
      const auto with_threads = [&mesh, &view = view](unsigned threads) {
        const ThreadLimit limit(threads);
        return order_of(mesh, view);
      };
      const OrderResult one = with_threads(1), two = with_threads(2);
      ASSERT_TRUE(std::ranges::equal(one.order.cells, two.order.cells));
      ASSERT_TRUE(std::ranges::equal(one.order.groups, two.order.groups));
      ASSERT_EQ(one.statistics.gap_arrows, two.statistics.gap_arrows);
    }
}

}  // namespace
}  // namespace hiac::test
