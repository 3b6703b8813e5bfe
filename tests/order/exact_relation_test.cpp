#include "tests/order/exact_relation.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/order/hard_meshes.hpp"

namespace hiac::test {
namespace {

Arrows in_order(Arrows arrows) {
  std::ranges::sort(arrows);
  arrows.erase(std::unique(arrows.begin(), arrows.end()), arrows.end());
  return arrows;
}

// The truth itself, against rational arithmetic on shared faces: these arrows are some of it.
TEST(ExactRelation, HoldsWhatSharedFacesSay) {
  for (const std::uint64_t seed : {1U, 2U}) {
    const ZooMesh mesh = random_delaunay(5, seed);
    for (const auto& [name, view] : special_views(mesh, seed)) {
      SCOPED_TRACE(name);
      const ExactRelation truth = exact_relation(mesh, view);
      EXPECT_TRUE(truth.overlapping.empty());
      EXPECT_TRUE(
          std::ranges::includes(in_order(truth.arrows), in_order(rational_arrows(mesh, view))));
    }
  }
}

TEST(ExactRelation, IsTheSameInBothArithmetics) {
  const ZooMesh mesh = distorted(
      blocks(2, [](int i, int, int k) { return Block{static_cast<CellShape>(i + 2 * k)}; }), 1);
  for (const auto& [name, view] : special_views(mesh, 2)) {
    SCOPED_TRACE(name);
    const ExactRelation one = exact_relation(mesh, view), other = exact_relation_in_gmp(mesh, view);
    EXPECT_EQ(one.arrows, other.arrows);
    EXPECT_FALSE(one.arrows.empty());
    EXPECT_EQ(one.overlapping, other.overlapping);
  }
}

// Two cubes side by side; the gap or the overlap between them is one unit in the last place.
TEST(ExactRelation, KnowsCellsThatOverlapByAnUlp) {
  const ZooMesh left = structured(1, Cut::bricks);
  const View view = from_eye("", {-3, 0.25, 0.75}).view;
  const auto right_from = [&](double x) {
    return side_by_side(left, moved(left, [x](const Position& p) {
                          return Position{p[0] == 0 ? x : 1.5, p[1], p[2]};
                        }));
  };
  for (const double x : {1.0, std::nextafter(1.0, 2.0)}) {
    EXPECT_EQ(exact_relation(right_from(x), view).arrows, (Arrows{{0, 1}}));
    EXPECT_TRUE(exact_relation(right_from(x), view).overlapping.empty());
  }
  EXPECT_EQ(exact_relation(right_from(std::nextafter(1.0, 0.0)), view).overlapping,
            (Arrows{{0, 1}}));
}

}  // namespace
}  // namespace hiac::test
