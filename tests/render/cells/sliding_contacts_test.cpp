// Blocks of curved cells that slide on others in a common plane, against brute force.

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "tests/render/truth/general_meshes.hpp"
#include "tests/render/truth/scene_truth.hpp"

namespace hiac {
namespace {

using test::Cut;
using test::Position;

// Cells of [0, 1]^3 on one brick [0, 1]^2 x [-1, 0] with nodes of its own; nodes in the plane z = 0
// that are no corners are moved within it by `offset`. Then all in the unit cube.
ZooMesh contact(Cut cut, CellOrder order, double offset) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> angle(0, 2 * std::numbers::pi);
  const ZooMesh linear = test::structured(2, cut);
  std::size_t node = 0;
  const ZooMesh above = test::moved(test::of_order(linear, order), [&](const Position& p) {
    const double turn = angle(random);
    const bool moves = node++ >= linear.node_count() && p[2] == 0;
    const double by = moves ? offset : 0;
    return Position{p[0] + by * std::cos(turn), p[1] + by * std::sin(turn), p[2]};
  });
  const ZooMesh below = test::moved(test::structured(1, Cut::bricks), [](const Position& p) {
    return Position{p[0], p[1], p[2] - 1};
  });
  ZooMesh mesh = test::moved(test::side_by_side(above, below), [](const Position& p) {
    return Position{p[0], p[1], 0.5 * p[2] + 0.5};
  });
  test::add_random_field(mesh, "f", FieldLocation::node, 15);
  test::add_random_field(mesh, "corner", FieldLocation::corner, 16);
  test::add_random_field(mesh, "cell", FieldLocation::cell, 17);
  return mesh;
}

void expect_truth(const ZooMesh& mesh, const Scene& scene) {
  const RenderResult result = test::draw(mesh, scene);
  EXPECT_EQ(result.statistics.violations, 0U);
  const test::SceneTruth truth(mesh, scene);
  double largest = 0, seen = 0;
  for (std::uint32_t y = 0; y < scene.image.height; ++y)
    for (std::uint32_t x = 0; x < scene.image.width; ++x) {
      const auto expected = truth.pixel(x, y);
      const std::size_t at = 4 * (std::size_t{y} * scene.image.width + x);
      for (std::size_t c = 0; c < 4; ++c) {
        const long double value = c == 3 ? 1 - expected[c] : expected[c];
        const auto off = static_cast<double>(std::abs(value - result.image.values()[at + c]));
        EXPECT_TRUE(std::isfinite(off));
        largest = std::max(largest, off);
      }
      seen = std::max(seen, static_cast<double>(1 - expected[3]));
    }
  EXPECT_LE(largest, 1e-12);
  EXPECT_GT(seen, 0.5);
}

TEST(SlidingContacts, PicturesAgreeWithBruteForce) {
  // an even number: the ray through the middle meets a node, of which the truth knows no side
  constexpr std::uint32_t kSide = 2;
  for (const auto& [cut, offset] :
       {std::pair{Cut::tetrahedra, 1e-8}, {Cut::tetrahedra, 1e-2}, {Cut::bricks, 1e-8}})
    for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
      SCOPED_TRACE(testing::Message() << static_cast<int>(cut) << " off by " << offset
                                      << " in projection " << static_cast<int>(projection));
      const double side = projection == Projection::orthographic ? -1 : 1;
      Scene scene = test::cube_scene(projection, kSide, kSide);
      scene.camera.eye = {0.6, 0.7, 0.5 + 3 * side};
      scene.camera.look_at = {0.5, 0.5, 0.5};
      scene.camera.up = {0.1, 1, 0};
      expect_truth(contact(cut, CellOrder::quadratic, offset), scene);
    }
}

}  // namespace
}  // namespace hiac
