#include "hiac/order/published/pair_sort.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hiac/base/parallel.hpp"
#include "hiac/order/published/multitiled.hpp"
#include "hiac/order/published/stein.hpp"
#include "hiac/order/published/visibility_cycle.hpp"
#include "tests/order/brute_force_order.hpp"
#include "tests/order/order_meshes.hpp"

namespace hiac::test {
namespace {

constexpr double kPlanarity = 1e-10;
constexpr std::size_t kRays = 40;

const std::vector<TilingOptions>& tilings() {
  static const std::vector<TilingOptions> kTilings{{0, 0, false}, {2, 1, false}, {1, 3, true},
                                                   {5, 4, true},  {7, 9, false}, {40, 40, false}};
  return kTilings;
}

ZooMesh without(const ZooMesh& mesh, const std::function<bool(const Position&)>& gone) {
  return keep_cells(mesh, [&](const Position& centroid, CellId) { return !gone(centroid); });
}

void expect_same_for_tiling(const ZooMesh& mesh, const View& view, const VisibilityOrder& stein,
                            const TilingOptions& tiling) {
  const VisibilityOrder multitiled = multitiled_order(mesh, view, kPlanarity, tiling);
  EXPECT_EQ(multitiled.groups.size(), 0U);
  EXPECT_TRUE(std::ranges::equal(stein.cells, multitiled.cells));
}

// The order holds along random rays, and is the same for a tiling: the next one at every call.
void expect_right(const ZooMesh& mesh, const View& view) {
  static std::size_t turn = 0;
  const VisibilityOrder stein = stein_order(mesh, view, kPlanarity);
  ASSERT_EQ(stein.groups.size(), 0U);
  ASSERT_TRUE(holds_along_rays(mesh, view, stein, kRays, 5));
  expect_same_for_tiling(mesh, view, stein, tilings()[turn++ % tilings().size()]);
}

void expect_right_from_everywhere(const ZooMesh& mesh) {
  for (const auto& [name, view] : many_views()) {
    SCOPED_TRACE(name);
    ASSERT_NO_FATAL_FAILURE(expect_right(mesh, view));
  }
}

TEST(PairSort, EmptyMeshAndOneCell) {
  const View view = view_named("outside");
  EXPECT_EQ(stein_order(make_mesh({}, {}), view, kPlanarity).cells.size(), 0U);
  const VisibilityOrder one = multitiled_order(structured(1, Cut::bricks), view, kPlanarity);
  EXPECT_EQ(one.cells.size(), 1U);
  EXPECT_EQ(one.algorithm, "multitiled");
}

// A Delaunay triangulation has no cycle from anywhere (H. Edelsbrunner, 1990).
TEST(PairSort, DelaunayHasTheArrowsThatRationalArithmeticFinds) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const ZooMesh mesh = random_delaunay(10, seed);
    for (const auto& [name, view] : many_views()) {
      SCOPED_TRACE(name);
      ASSERT_NO_FATAL_FAILURE(expect_right(mesh, view));
      ASSERT_TRUE(is_order_of(rational_arrows(mesh, view), mesh.cell_count(),
                              stein_order(mesh, view, kPlanarity)));
    }
  }
}

TEST(PairSort, StructuredMeshes) {
  for (const Cut cut : {Cut::bricks, Cut::tetrahedra, Cut::prisms, Cut::pyramids}) {
    SCOPED_TRACE(static_cast<int>(cut));
    expect_right_from_everywhere(structured(3, cut));
  }
}

// Turned, planes hold to rounding alone.
TEST(PairSort, TurnedStructuredMeshes) {
  for (const Cut cut : {Cut::bricks, Cut::tetrahedra, Cut::prisms, Cut::pyramids}) {
    SCOPED_TRACE(static_cast<int>(cut));
    const ZooMesh mesh = moved(structured(3, cut), turned);
    for (NamedView view : many_views()) {
      SCOPED_TRACE(view.name);
      view.view.eye = turned(view.view.eye);
      view.view.direction = turned(view.view.direction);
      ASSERT_NO_FATAL_FAILURE(expect_right(mesh, view.view));
    }
  }
}

TEST(PairSort, FarFromTheOrigin) {
  const ZooMesh mesh = moved(random_delaunay(8, 4), [](const Position& p) {
    return Position{p[0] + 1e6, p[1] - 1e6, p[2] + 1e6};
  });
  for (NamedView view : many_views()) {
    SCOPED_TRACE(view.name);
    for (std::size_t c = 0; c < 3; ++c) view.view.eye[c] += c == 1 ? -1e6 : 1e6;
    ASSERT_NO_FATAL_FAILURE(expect_right(mesh, view.view));
  }
}

TEST(PairSort, NotchesCavitiesHolesAndSeparateParts) {
  const auto notch = [](const Position& p) { return p[2] > 0.5 && p[0] > 0.3 && p[0] < 0.7; };
  const auto cavity = [](const Position& p) {
    return std::ranges::all_of(p, [](double x) { return x > 0.3 && x < 0.7; });
  };
  const auto scattered = [](const Position& p) {
    return std::sin(1e3 * (p[0] + 3 * p[1] + 7 * p[2])) > 0.4;
  };
  for (const Cut cut : {Cut::bricks, Cut::tetrahedra, Cut::prisms, Cut::pyramids}) {
    SCOPED_TRACE(static_cast<int>(cut));
    expect_right_from_everywhere(without(structured(3, cut), notch));
    expect_right_from_everywhere(without(structured(3, cut), cavity));
    expect_right_from_everywhere(without(structured(3, cut), scattered));
  }
  expect_right_from_everywhere(without(random_delaunay(30, 6), cavity));
  expect_right_from_everywhere(without(random_delaunay(20, 7), scattered));
}

TEST(PairSort, SlidingInterfacesAndHangingNodes) {
  const auto half = [](double x0) {
    return [x0](const Position& p) { return Position{x0 + p[0] / 2, p[1], p[2]}; };
  };
  for (const Cut cut : {Cut::bricks, Cut::tetrahedra, Cut::prisms}) {
    SCOPED_TRACE(static_cast<int>(cut));
    const ZooMesh left = moved(structured(2, cut), half(0));
    expect_right_from_everywhere(side_by_side(left, moved(structured(3, cut), half(0.5))));
    const ZooMesh slid = moved(structured(2, cut), [](const Position& p) {
      return Position{0.5 + p[0] / 2, p[1] + 0.17, p[2] - 0.11};
    });
    expect_right_from_everywhere(side_by_side(left, slid));
  }
}

TEST(PairSort, Cracks) {
  for (const Cut cut : {Cut::bricks, Cut::tetrahedra, Cut::prisms, Cut::pyramids}) {
    SCOPED_TRACE(static_cast<int>(cut));
    expect_right_from_everywhere(torn(structured(2, cut), 0));
  }
}

TEST(PairSort, CornersInLine) {
  for (const NodeId in_line : {NodeId{0}, NodeId{7}})
    expect_right_from_everywhere(corners_in_line(in_line));
}

TEST(PairSort, CellsWithoutVolumeAreInNobodysWay) { expect_right_from_everywhere(flat_between()); }

TEST(PairSort, ReversedNodesChangeNothing) {
  for (const Cut cut : {Cut::bricks, Cut::tetrahedra, Cut::prisms, Cut::pyramids}) {
    SCOPED_TRACE(static_cast<int>(cut));
    const ZooMesh mesh = structured(3, cut);
    const ZooMesh other =
        inverted(mesh, [](CellId cell) { return (cell * 2654435761U >> 16) % 2 == 0; });
    for (const auto& [name, view] : many_views()) {
      SCOPED_TRACE(name);
      ASSERT_TRUE(std::ranges::equal(stein_order(mesh, view, kPlanarity).cells,
                                     stein_order(other, view, kPlanarity).cells));
    }
  }
}

TEST(PairSort, ReportsTheCellsOfACycle) {
  const ZooMesh mesh = pinwheel();
  for (const double z : {0.5, 4.0, -3.0}) {
    const View view = from_eye("axis", {0, 0, z}).view;
    for (const TilingOptions& tiling : tilings()) {
      try {
        multitiled_order(mesh, view, kPlanarity, tiling);
        FAIL() << "no cycle found";
      } catch (const VisibilityCycle& cycle) {
        EXPECT_EQ(cycle.exit_code(), ExitCode::judgement);
        EXPECT_THAT(cycle.cells(), testing::UnorderedElementsAre(1U, 2U, 3U));
        EXPECT_THAT(cycle.what(), testing::HasSubstr("a cycle of 3 found"));
      }
    }
  }
  expect_right(mesh, along("across", {1, 0.2, 0}).view);
  expect_right(mesh, from_eye("beside", {-20, 3, 0.5}).view);
}

// Tiles and threads, on a mesh that fills many tiles and that rays leave and enter again.
TEST(PairSort, TilesAndThreadsChangeNothing) {
  const ZooMesh mesh =
      without(random_delaunay(150, 8), [](const Position& p) { return p[0] > 0.4 && p[2] > 0.4; });
  const std::vector<NamedView> views = many_views();
  for (std::size_t v = 0; v < views.size(); v += 3) {
    SCOPED_TRACE(views[v].name);
    const View& view = views[v].view;
    const VisibilityOrder stein = stein_order(mesh, view, kPlanarity);
    for (const TilingOptions& tiling : tilings()) expect_same_for_tiling(mesh, view, stein, tiling);
    const ThreadLimit limit(1);
    ASSERT_TRUE(std::ranges::equal(stein.cells, multitiled_order(mesh, view, kPlanarity).cells));
  }
}

}  // namespace
}  // namespace hiac::test
