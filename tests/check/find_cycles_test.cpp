#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "hiac/check/cycles.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "tests/check/findings.hpp"
#include "tests/order/exact_relation.hpp"
#include "tests/order/hard_meshes.hpp"

namespace hiac::test {
namespace {

std::vector<VisibilityGroup> cycles_of(const ZooMesh& mesh, const View& view) {
  return find_cycles(order_basis(mesh, build_face_adjacency(mesh)), view, 1e-10);
}

// The groups are those of the order, and every step of a cycle is one that some ray makes.
TEST(FindCycles, StepsAreThoseOfRays) {
  for (const auto& [mesh, cells] :
       {std::pair(pinwheel(), 3U), std::pair(ring_of_sticks(5, 1), 5U)}) {
    const View view{true, {0, 0, 9}, {0, 0, -1}};
    const auto groups = cycles_of(mesh, view);
    ASSERT_EQ(groups.size(), 1U);
    EXPECT_EQ(groups[0].cells.size(), cells);
    const auto& cycle = groups[0].cycle;
    ASSERT_EQ(cycle.size(), cells);
    const Arrows arrows = exact_relation(mesh, view).arrows;
    for (std::size_t i = 0; i < cycle.size(); ++i)
      EXPECT_GE(
          std::ranges::count(arrows, std::pair(cycle[i].cell, cycle[(i + 1) % cycle.size()].cell)),
          1);
  }
}

// A step across a face is told by the face's middle, one across a gap by the cell's.
TEST(FindCycles, WitnessesAreInTheMiddle) {
  const ZooMesh bent = moved(structured(2, Cut::bricks), [](const Position& p) {
    return Position{p[0] + 0.3 * (p[1] - 0.5) * (p[2] - 0.5), p[1], p[2]};
  });
  std::map<CycleStep, std::size_t> told;
  for (const auto& [mesh, view] :
       {std::pair(pinwheel(), View{true, {0, 0, 9}, {0, 0, -1}}),
        std::pair(ring_of_sticks(5, 1), View{true, {0, 0, 9}, {0, 0, -1}}),
        std::pair(bent, View{false, {}, {0, 1, 1e-3}})})
    for (const VisibilityGroup& group : cycles_of(mesh, view)) {
      EXPECT_TRUE(std::ranges::is_sorted(group.cells));
      for (std::size_t i = 0; i < group.cycle.size(); ++i) {
        const CycleCell& here = group.cycle[i];
        const auto own = mesh.cell_nodes(here.cell),
                   next = mesh.cell_nodes(group.cycle[(i + 1) % group.cycle.size()].cell);
        std::vector<NodeId> common;
        for (const NodeId node : own)
          if (std::ranges::find(next, node) != next.end()) common.push_back(node);
        EXPECT_EQ(here.step == CycleStep::gap, common.size() < 3);
        if (here.step == CycleStep::gap) common.assign(own.begin(), own.end());
        for (std::size_t c = 0; c < 3; ++c) {
          double sum = 0;
          for (const NodeId node : common) sum += mesh.position(node)[c];
          EXPECT_NEAR(here.witness[c], sum / static_cast<double>(common.size()), 1e-14);
        }
        ++told[here.step];
      }
    }
  for (const CycleStep step : {CycleStep::face, CycleStep::both_ways, CycleStep::gap})
    EXPECT_GT(told[step], 1U) << static_cast<int>(step);
}

TEST(FindCycles, NoneWhereThereAreNone) {
  const ZooMesh mesh = random_delaunay(50, 8);
  for (const View& view : spread_views(20)) EXPECT_TRUE(cycles_of(mesh, view).empty());
  EXPECT_TRUE(cycles_of(pinwheel(), {false, {}, {1, 0, 0}}).empty());
}

// A step across a face that is not planar goes both ways.
TEST(FindCycles, AFaceBothWays) {
  const ZooMesh mesh = moved(structured(2, Cut::bricks), [](const Position& p) {
    return Position{p[0] + 0.3 * (p[1] - 0.5) * (p[2] - 0.5), p[1], p[2]};
  });
  const auto groups = cycles_of(mesh, {false, {}, {0, 1, 1e-3}});
  ASSERT_FALSE(groups.empty());
  EXPECT_EQ(groups[0].cycle.size(), 2U);
  EXPECT_EQ(groups[0].cycle[0].step, CycleStep::both_ways);
}

TEST(FindCycles, ViewsAreSpreadEvenly) {
  const auto views = spread_views(500);
  ASSERT_EQ(views.size(), 500U);
  Position sum{};
  for (const View& view : views) {
    double square = 0, nearest = 4;
    for (std::size_t c = 0; c < 3; ++c) {
      square += view.direction[c] * view.direction[c];
      sum[c] += view.direction[c];
    }
    EXPECT_NEAR(square, 1, 1e-12);
    for (const View& other : views) {
      double distance = 0;
      for (std::size_t c = 0; c < 3; ++c)
        distance += std::pow(view.direction[c] - other.direction[c], 2);
      if (distance > 0) nearest = std::min(nearest, distance);
    }
    // a five-hundredth of the sphere is as large as a square with the side 0.159
    EXPECT_GT(std::sqrt(nearest), 0.1);
    EXPECT_LT(std::sqrt(nearest), 0.2);
  }
  for (const double x : sum) EXPECT_LT(std::abs(x), 1);
}

}  // namespace
}  // namespace hiac::test
