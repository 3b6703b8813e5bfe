#include "hiac/order/verify_order.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hiac/base/parallel.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "tests/order/brute_force_order.hpp"
#include "tests/order/exact_relation.hpp"
#include "tests/order/hard_meshes.hpp"
#include "tests/order/order_meshes.hpp"

namespace hiac::test {
namespace {

constexpr double kPlanarity = 1e-10;

VisibilityOrder order_of(const ZooMesh& mesh, const View& view) {
  return exact_order(mesh, build_face_adjacency(mesh), view, kPlanarity).order;
}

OrderCheck by_pairs(const ZooMesh& mesh, const View& view, const VisibilityOrder& order) {
  return verify_pairs(mesh, view, order, kPlanarity);
}

OrderCheck by_arrows(const ZooMesh& mesh, const View& view, const VisibilityOrder& order) {
  return verify_arrows(order_basis(mesh, build_face_adjacency(mesh)), view, order, kPlanarity);
}

using Check = OrderCheck (*)(const ZooMesh&, const View&, const VisibilityOrder&);
constexpr Check kChecks[] = {by_pairs, by_arrows};

void expect_right(const ZooMesh& mesh, const std::function<Position(const Position&)>& map) {
  const ZooMesh there = moved(mesh, map);
  for (const auto& [name, view] : many_views()) {
    SCOPED_TRACE(name);
    View same = view;
    same.eye = map(view.eye);
    const Position tip = map(view.direction), origin = map({0, 0, 0});
    for (std::size_t c = 0; c < 3; ++c) same.direction[c] = tip[c] - origin[c];
    const VisibilityOrder order = order_of(there, same);
    for (const Check check : kChecks) {
      const OrderCheck found = check(there, same, order);
      ASSERT_EQ(found.wrong_count, 0U) << found.wrong[0].first << " " << found.wrong[0].second;
      ASSERT_TRUE(found.loose.empty());
    }
  }
}

Position stay(const Position& p) { return p; }

TEST(VerifyOrder, OrdersOfRandomTetrahedraAreRight) { expect_right(random_delaunay(14, 3), stay); }

TEST(VerifyOrder, OrdersOfStructuredMeshesAreRight) {
  for (const Cut cut : {Cut::bricks, Cut::tetrahedra, Cut::prisms, Cut::pyramids}) {
    SCOPED_TRACE(static_cast<int>(cut));
    expect_right(structured(2, cut), stay);
    expect_right(structured(2, cut), turned);
  }
}

TEST(VerifyOrder, OrdersAcrossGapsAreRight) {
  const auto holed = [](const ZooMesh& mesh) {
    return keep_cells(mesh, [](const Position& c, CellId) { return c[0] < 0.4 || c[2] < 0.4; });
  };
  expect_right(holed(structured(3, Cut::bricks)), turned);
  expect_right(torn(structured(2, Cut::tetrahedra), 0.5), turned);
  expect_right(holed(random_delaunay(14, 5)), stay);
}

TEST(VerifyOrder, CyclesAreGroups) {
  for (const View& view :
       {from_eye("axis", {0, 0, 9}).view, from_eye("beside", {0.1, 0.2, 9}).view}) {
    const VisibilityOrder order = order_of(pinwheel(), view);
    ASSERT_EQ(order.groups.size(), 1U);
    for (const Check check : kChecks) {
      const OrderCheck found = check(pinwheel(), view, order);
      EXPECT_TRUE(found.right());
      EXPECT_EQ(found.groups, check == by_arrows ? 1U : 0U);
    }
  }
}

TEST(VerifyOrder, EveryTwoCellsAreAsked) {
  const ZooMesh mesh = structured(2, Cut::tetrahedra);
  const View view = view_named("outside");
  const OrderCheck found = by_pairs(mesh, view, order_of(mesh, view));
  EXPECT_EQ(found.pairs, mesh.cell_count() * (mesh.cell_count() - 1) / 2);
  EXPECT_EQ(found.left_out, 0U);
  EXPECT_EQ(by_arrows(mesh, view, order_of(mesh, view)).pairs, 0U);
}

VisibilityOrder with_cells(const VisibilityOrder& order, std::vector<CellId> cells,
                           std::vector<CellGroup> groups) {
  return {std::move(cells), std::move(groups), order.algorithm};
}

std::vector<CellId> cells_of_order(const VisibilityOrder& order) {
  return {order.cells.begin(), order.cells.end()};
}

// Any two cells that share a face that is not seen edge-on, when they change places.
TEST(VerifyOrder, TwoCellsThatChangedPlacesAreFound) {
  const ZooMesh mesh = random_delaunay(10, 6);
  for (const char* const name : {"outside", "inside", "random direction 0"}) {
    SCOPED_TRACE(name);
    const View view = view_named(name);
    const VisibilityOrder order = order_of(mesh, view);
    const auto places = group_ranks(order);
    const Arrows arrows = rational_arrows(mesh, view);
    for (std::size_t i = 0; i < arrows.size(); i += 29) {
      const auto [front, behind] = arrows[i];
      std::vector<CellId> cells = cells_of_order(order);
      std::swap(cells[places[front]], cells[places[behind]]);
      for (const Check check : kChecks) {
        const OrderCheck found = check(mesh, view, with_cells(order, cells, {}));
        ASSERT_GT(found.wrong_count, 0U);
        if (found.wrong_count <= kMostWrongPairs) {
          ASSERT_THAT(found.wrong, testing::Contains(std::pair(behind, front)));
        }
      }
    }
  }
}

TEST(VerifyOrder, AnOrderBackwardsIsWrongEverywhere) {
  const ZooMesh mesh = structured(3, Cut::bricks);
  const View view = view_named("outside");
  std::vector<CellId> cells = cells_of_order(order_of(mesh, view));
  std::ranges::reverse(cells);
  const VisibilityOrder backwards = with_cells({}, cells, {});
  EXPECT_GE(by_pairs(mesh, view, backwards).wrong_count, 54U);  // 54 faces are shared
  EXPECT_EQ(by_arrows(mesh, view, backwards).wrong_count, 54U);
  for (const Check check : kChecks) {
    const OrderCheck found = check(mesh, view, backwards);
    EXPECT_EQ(found.wrong.size(), kMostWrongPairs);
    EXPECT_EQ(found.wrong[0].first, cells[0]);
  }
}

// Every cell is drawn inwards by twice the planarity times its diagonal: two unit cubes that
// overlap by less than twice that are in order, or not, and those that overlap by more are in none.
TEST(VerifyOrder, CellsMayOverlapByTwiceThePlanarityEach) {
  constexpr double planarity = 1e-3;
  const View view{false, {}, {0, 0, 1}};
  const double largest = 2 * 2 * planarity * std::sqrt(3);
  for (const double part : {0.6, 0.99, 1.01}) {
    std::vector<Position> corners;
    for (const double z : {0.0, 1.0, 1 - part * largest, 2.0})
      for (const auto& [x, y] :
           std::initializer_list<std::pair<double, double>>{{0, 0}, {1, 0}, {1, 1}, {0, 1}})
        corners.push_back({x, y, z});
    const ZooMesh mesh = make_mesh(corners, {{CellKind::brick8, {0, 1, 2, 3, 4, 5, 6, 7}},
                                             {CellKind::brick8, {8, 9, 10, 11, 12, 13, 14, 15}}});
    const auto wrong = [&](std::vector<CellId> cells) {
      return verify_pairs(mesh, view, with_cells({}, std::move(cells), {}), planarity).wrong_count;
    };
    EXPECT_EQ(wrong({0, 1}), part < 1 ? 0U : 1U) << part;
    EXPECT_EQ(wrong({1, 0}), 1U) << part;
  }
}

TEST(VerifyOrder, AGroupTakenApartIsFound) {
  const View view = from_eye("axis", {0, 0, 9}).view;
  const VisibilityOrder order = order_of(pinwheel(), view);
  for (const Check check : kChecks) {
    const OrderCheck found = check(pinwheel(), view, with_cells(order, cells_of_order(order), {}));
    EXPECT_GE(found.wrong_count, 1U);
    for (const auto& [a, b] : found.wrong) {
      EXPECT_NE(a, b);
      EXPECT_GE(std::min(a, b), 1U);  // cells 1, 2, 3 are the cycle
    }
  }
}

TEST(VerifyOrder, AGroupOfCellsInNoCycleIsFound) {
  const ZooMesh mesh = random_delaunay(10, 6);
  const View view = view_named("outside");
  const VisibilityOrder order = order_of(mesh, view);
  const CellGroup group{3, 4};
  const VisibilityOrder merged = with_cells(order, cells_of_order(order), {group});
  EXPECT_TRUE(by_pairs(mesh, view, merged).right());  // a group too large is not wrong on any ray
  for (const OrderCheck& found :
       {by_arrows(mesh, view, merged),
        verify_order(order_basis(mesh, build_face_adjacency(mesh)), view, merged, kPlanarity)}) {
    EXPECT_EQ(found.wrong_count, 0U);
    ASSERT_EQ(found.loose.size(), 1U);
    EXPECT_EQ(found.loose[0], group);
    EXPECT_FALSE(found.right());
  }
}

TEST(VerifyOrder, ManyCellsAreCheckedByArrows) {
  const View view = view_named("outside");
  for (const std::size_t n : {16U, 17U}) {
    const ZooMesh mesh = structured(n, Cut::bricks);
    const OrderBasis basis = order_basis(mesh, build_face_adjacency(mesh));
    const OrderCheck found =
        verify_order(basis, view, exact_order(basis, view, kPlanarity).order, kPlanarity);
    EXPECT_TRUE(found.right());
    EXPECT_EQ(found.pairs > 0, n == 16);
    EXPECT_EQ(found.arrows, n == 16 ? 0U : basis.shared_faces);
  }
}

// Cells in any order, mixed and distorted: exactly the pairs that the truth has the other way
// round.
TEST(VerifyOrder, FindsExactlyThePairsThatAreWrong) {
  std::mt19937_64 random(8);
  const std::array shapes{CellShape::tetrahedron, CellShape::pyramid, CellShape::prism,
                          CellShape::wedge, CellShape::brick};
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const ZooMesh mesh = distorted(blocks(2,
                                          [&](int i, int j, int k) -> std::optional<Block> {
                                            const auto at =
                                                static_cast<std::size_t>(i + 2 * j + 3 * k);
                                            if (at == seed) return std::nullopt;
                                            return Block{shapes[(at + seed) % 5], at == 2};
                                          }),
                                   seed);
    for (const auto& [name, view] : special_views(mesh, seed)) {
      SCOPED_TRACE(name);
      std::vector<CellId> cells(mesh.cell_count());
      std::iota(cells.begin(), cells.end(), CellId{0});
      std::ranges::shuffle(cells, random);
      const VisibilityOrder order = with_cells({}, cells, {});
      const auto place = group_ranks(order);
      std::size_t wrong = 0;
      for (const auto& [front, behind] : exact_relation(mesh, view).arrows)
        wrong += place[front] > place[behind] ? 1 : 0;
      EXPECT_GT(wrong, 0U);
      const OrderCheck found = verify_pairs(mesh, view, order, 0);
      ASSERT_EQ(found.wrong_count, wrong);
      ASSERT_EQ(found.left_out, 0U);
      ASSERT_TRUE(verify_order(order_basis(mesh, build_face_adjacency(mesh)), view,
                               order_of(mesh, view), kPlanarity)
                      .right());
    }
  }
}

// Sides that are not planar, edges collapsed into an axis, and cycles.
TEST(VerifyOrder, OrdersOfHardMeshesAreRight) {
  for (const ZooMesh& mesh :
       {jittered_bricks(3, 0.2, 1), collapsed_fan(5, 2, 2, Collapse::coincident),
        collapsed_fan(5, 2, 2, Collapse::merged), ring_of_sticks(7, 0.2)})
    for (const auto& [name, view] : special_views(mesh, 4)) {
      SCOPED_TRACE(name);
      const OrderCheck found = verify_order(order_basis(mesh, build_face_adjacency(mesh)), view,
                                            order_of(mesh, view), kPlanarity);
      ASSERT_EQ(found.wrong_count, 0U) << found.wrong[0].first << " " << found.wrong[0].second;
      ASSERT_TRUE(found.loose.empty());
    }
}

TEST(VerifyOrder, FlatCellsAreLeftOutAndCounted) {
  const View view = view_named("outside");
  const OrderCheck found = by_pairs(flat_between(), view, order_of(flat_between(), view));
  EXPECT_TRUE(found.right());
  EXPECT_EQ(found.left_out, 1U);
}

TEST(VerifyOrder, ThreadsChangeNothing) {
  const ZooMesh mesh = structured(4, Cut::prisms);
  const View view = view_named("outside");
  std::vector<CellId> cells(mesh.cell_count());
  for (CellId cell = 0; cell < cells.size(); ++cell) cells[cell] = cell;
  const VisibilityOrder order = with_cells({}, cells, {});
  for (const Check check : kChecks) {
    const auto with_threads = [&](unsigned threads) {
      const ThreadLimit limit(threads);
      return check(mesh, view, order);
    };
    const OrderCheck one = with_threads(1), two = with_threads(2);
    EXPECT_EQ(one.wrong, two.wrong);
    EXPECT_EQ(one.wrong_count, two.wrong_count);
    EXPECT_EQ(one.pairs, two.pairs);
    EXPECT_EQ(one.arrows, two.arrows);
  }
}

}  // namespace
}  // namespace hiac::test
