#include "hiac/order/gaps/ray_precedence.hpp"

#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/mesh/shape_functions.hpp"
#include "tests/geometry/rational_orientation.hpp"
#include "tests/order/order_meshes.hpp"

namespace hiac::test {
namespace {

using Points = std::vector<Position>;

// The side of the plane through a, b and the eye on which x is seen.
int side_of_sight(const Position& a, const Position& b, const Position& x, const View& view) {
  return view.perspective ? rational_orientation(a, b, x, view.eye)
                          : -rational_orientation_towards(a, b, x, view.direction);
}

bool degenerate(const Position& a, const Position& b, const Position& c) {
  for (const Position& d : {Position{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}})
    if (rational_orientation(a, b, c, d) != 0) return false;
  return true;
}

// Whether all of `side` of p are on one side (or 0) and all of q on the other: +1 when p has the
// positive one, 0 when they are not parted.
template <typename Side>
int parted(const Points& p, const Points& q, const Side& side) {
  bool below = true, above = true;
  for (const auto& [body, sign] : {std::pair{&p, 1}, std::pair{&q, -1}})
    for (const Position& x : *body) {
      const int s = sign * side(x);
      above = above && s >= 0;
      below = below && s <= 0;
      if (!above && !below) return 0;
    }
  return above ? 1 : below ? -1 : 0;
}

// What met_first answers, found in another way, in rational arithmetic. Weakly separating planes of
// two bodies form a polyhedral cone whose extreme rays are planes through three of their corners.
// Bodies that overlap are each met first by some ray. Others are only met by a common ray when no
// plane through the eye, and so none through it and two corners, separates them, and then a plane
// between them tells: the one on the eye's side is always met first.
bool truly_met_first(const Points& p, const Points& q, const View& view) {
  Points all = p;
  all.insert(all.end(), q.begin(), q.end());
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      const auto side = [&](const Position& x) { return side_of_sight(all[i], all[j], x, view); };
      const bool plane = std::ranges::any_of(all, [&](const Position& x) { return side(x) != 0; });
      if (plane && parted(p, q, side) != 0) return false;
    }
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i + 1; j < all.size(); ++j)
      for (std::size_t k = j + 1; k < all.size(); ++k) {
        if (degenerate(all[i], all[j], all[k])) continue;
        const int p_side = parted(p, q, [&](const Position& x) {
          return rational_orientation(all[i], all[j], all[k], x);
        });
        if (p_side == 0) continue;
        const int eye = view.perspective
                            ? rational_orientation(all[i], all[j], all[k], view.eye)
                            : -rational_orientation_towards(all[i], all[j], all[k], view.direction);
        EXPECT_NE(eye, 0);
        return eye == p_side;
      }
  return true;  // they overlap
}

View random_view(std::mt19937_64& random, const auto& coordinate) {
  View view{random() % 3 != 0, {coordinate(), coordinate(), coordinate()}, {}};
  while (view.direction == Position{})
    view.direction = {coordinate() - 1, coordinate() - 1, coordinate() - 1};
  return view;
}

struct Tally {
  int none = 0, one = 0, both = 0;
};

// Random tetrahedra that may share corners, touch, overlap and hold the eye.
Tally compare_with_truth(int trials, const auto& coordinate, std::mt19937_64& random) {
  Tally tally;
  for (int trial = 0; trial < trials; ++trial) {
    Points points;
    for (int k = 0; k < 8; ++k) points.push_back({coordinate(), coordinate(), coordinate()});
    const auto shared = static_cast<NodeId>(random() % 4);  // corners of either
    const ZooMesh mesh = make_mesh(
        points, {{CellKind::tetrahedron4, {0, 1, 2, 3}},
                 {CellKind::tetrahedron4, {4 - shared, 5 - shared, 6 - shared, 7 - shared}}});
    const View view = random_view(random, coordinate);
    const auto p = hull_cell(mesh, 0, view, 0), q = hull_cell(mesh, 1, view, 0);
    if (!p || !q) continue;
    const bool pq = met_first(*p, *q, view), qp = met_first(*q, *p, view);
    EXPECT_EQ(pq, truly_met_first(p->corners, q->corners, view)) << trial;
    EXPECT_EQ(qp, truly_met_first(q->corners, p->corners, view)) << trial;
    ++(pq && qp ? tally.both : pq || qp ? tally.one : tally.none);
  }
  return tally;
}

TEST(RayPrecedence, OfTetrahedraInSpecialPosition) {
  std::mt19937_64 random(1);
  for (const int most : {2, 3, 5}) {
    const auto coordinate = [&] {
      return static_cast<double>(random() % static_cast<unsigned>(most + 1));
    };
    const Tally tally = compare_with_truth(250, coordinate, random);
    EXPECT_GT(tally.none, 10);
    EXPECT_GT(tally.one, 10);
    EXPECT_GT(tally.both, 10);
  }
}

TEST(RayPrecedence, OfTetrahedraInGeneralPosition) {
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  const Tally tally = compare_with_truth(
      250, [&] { return normal(random); }, random);
  EXPECT_GT(tally.none, 10);
  EXPECT_GT(tally.one, 10);
  EXPECT_GT(tally.both, 10);
}

// Nothing that a rounding error could decide: coordinates that differ in their last bits.
TEST(RayPrecedence, OfTetrahedraThatAreAlmostInSpecialPosition) {
  std::mt19937_64 random(3);
  const auto coordinate = [&] {
    return static_cast<double>(random() % 3) + static_cast<double>(random() % 3) * 0x1p-50;
  };
  const Tally tally = compare_with_truth(250, coordinate, random);
  EXPECT_GT(tally.one, 10);
}

TEST(RayPrecedence, VeryLargeAndVerySmall) {
  for (const double scale : {1e-100, 1e100}) {
    std::mt19937_64 random(4);
    const auto coordinate = [&] { return scale * static_cast<double>(random() % 4); };
    compare_with_truth(30, coordinate, random);
  }
}

TEST(RayPrecedence, AFlatCellHasNoInside) {
  const ZooMesh mesh = flat_between();
  const View view = view_named("outside");
  EXPECT_FALSE(hull_cell(mesh, 0, view, 0));
  EXPECT_TRUE(hull_cell(mesh, 1, view, 0));
  EXPECT_FALSE(hull_cell(mesh, 1, view, 1));
}

TEST(RayPrecedence, ACellThatIsNotConvexIsNone) {
  std::vector<Position> corners;
  for (const double z : {0.0, 1.0})
    for (const auto& [x, y] :
         std::initializer_list<std::pair<double, double>>{{0, 0}, {4, 0}, {1, 1}, {0, 4}})
      corners.push_back({x, y, z});
  const ZooMesh mesh = make_mesh(corners, {{CellKind::brick8, {0, 1, 2, 3, 4, 5, 6, 7}}});
  EXPECT_FALSE(hull_cell(mesh, 0, view_named("outside"), 0));
}

// The unit cube, some of its quadratic top's edges lowered in their middles.
ZooMesh dented_cube(double by) {
  std::vector<Position> nodes;
  Cell cell{CellKind::brick20, {}};
  for (const auto& p : reference_nodes(CellKind::brick20)) {
    cell.nodes.push_back(static_cast<NodeId>(nodes.size()));
    const bool inner = p[0] == 0.5 || p[1] == 0.5;
    nodes.push_back({p[0], p[1], p[2] - (p[2] == 1 && inner ? by : 0)});
  }
  return make_mesh(nodes, {cell});
}

// Faces move inwards by the inset, times the cube's diagonal, and twice what control points are off
// their plane: those of the edges twice as far as their nodes, and that of the face four times.
TEST(RayPrecedence, HullsAreDrawnInsideTheirFaces) {
  const View view{false, {}, {0, 0, 1}};
  const double inset = 0.01, diagonal = std::sqrt(3);
  for (const double by : {0.0, 0.01}) {
    const auto hull = hull_cell(dented_cube(by), 0, view, inset);
    ASSERT_TRUE(hull);
    EXPECT_NEAR(hull->deviation, 4 * by / diagonal, 1e-14);
    const double inwards = inset * diagonal + 2 * 4 * by;
    for (const auto& p : hull->seen)
      for (const double x : p) EXPECT_NEAR(std::abs(x - 0.5), 0.5 - inwards, 1e-14) << by;
  }
  // nothing is left where they would pass the middle
  EXPECT_FALSE(hull_cell(dented_cube(0.07), 0, view, inset));
}

}  // namespace
}  // namespace hiac::test
