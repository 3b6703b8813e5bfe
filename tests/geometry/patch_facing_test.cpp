#include "hiac/geometry/patch_facing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "tests/geometry/patch_shapes.hpp"

namespace hiac {
namespace {

using Nets = std::array<PatchNet<double>, 3>;

double determinant_at(const PatchShape& shape, const Nets& nets, double u, double v) {
  const std::size_t n = shape.degree;
  std::array<std::array<double, 3>, 3> m;
  for (std::size_t c = 0; c < 3; ++c) {
    const PatchValue p = evaluate_patch(n, nets[c], BernsteinValues(n, u), BernsteinValues(n, v));
    m[c] = {p.value, p.by_u, p.by_v};
  }
  const auto& [x, y, z] = m;
  return x[0] * (y[1] * z[2] - y[2] * z[1]) + y[0] * (z[1] * x[2] - z[2] * x[1]) +
         z[0] * (x[1] * y[2] - x[2] * y[1]);
}

using Place = std::array<double, 2>;

std::vector<Place> node_places(const PatchShape& shape) {
  const std::size_t corners = shape.corner_count(), n = shape.degree;
  const std::array<Place, 4> square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  const std::array<Place, 4> triangle{{{0, 0}, {1, 0}, {0, 1}, {0, 0}}};
  const auto& corner = shape.triangle ? triangle : square;
  std::vector<Place> places(corner.begin(), corner.begin() + static_cast<int>(corners));
  for (std::size_t edge = 0; edge < corners; ++edge)
    for (std::size_t i = 1; i < n; ++i) {
      const Place &from = corner[edge], &to = corner[(edge + 1) % corners];
      const double s = static_cast<double>(i) / static_cast<double>(n);
      places.push_back({from[0] + s * (to[0] - from[0]), from[1] + s * (to[1] - from[1])});
    }
  if (shape.centre) places.push_back({1.0 / 3, 1.0 / 3});
  return places;
}

// The patch through the points that `position` gives for the places of nodes.
template <typename Position>
Nets nets_through(const PatchShape& shape, const Position& position) {
  std::array<std::vector<double>, 3> nodes;
  for (const Place& place : node_places(shape)) {
    const std::array<double, 3> p = position(place[0], place[1]);
    for (std::size_t c = 0; c < 3; ++c) nodes[c].push_back(p[c]);
  }
  Nets nets;
  for (std::size_t c = 0; c < 3; ++c) patch_net(shape, nodes[c], nets[c]);
  return nets;
}

// The patch (u - 0.4, v - 0.3, 1), or its mirror image, as the eye sees it, with bumps: nodes are
// moved at random.
Nets bumpy(const PatchShape& shape, double bumps, bool mirrored, std::mt19937& random) {
  std::uniform_real_distribution<double> number(-1, 1);
  return nets_through(shape, [&](double u, double v) {
    return std::array{(mirrored ? -1 : 1) * (u - 0.4) + bumps * number(random),
                      v - 0.3 + bumps * number(random), 1 + bumps * number(random)};
  });
}

struct Range {
  double least = INFINITY, most = -INFINITY;
};

Range sampled(const PatchShape& shape, const Nets& nets, int intervals) {
  Range range;
  for (int j = 0; j <= intervals; ++j)
    for (int i = 0; i <= (shape.triangle ? intervals - j : intervals); ++i) {
      const double d = determinant_at(shape, nets, static_cast<double>(i) / intervals,
                                      static_cast<double>(j) / intervals);
      range = {std::min(range.least, d), std::max(range.most, d)};
    }
  return range;
}

TEST(PatchFacing, WhatIsSaidToTurnOneWayDoesSoEverywhere) {
  std::mt19937 random(1);
  for (const PatchShape& shape : test::kPatchShapes) {
    std::array<int, 3> said{};
    for (const double bumps : {0.02, 0.1, 0.3, 1.0})
      for (const bool mirrored : {false, true})
        for (int i = 0; i < 20; ++i) {
          const Nets nets = bumpy(shape, bumps, mirrored, random);
          const Range range = sampled(shape, nets, 12);
          const int facing = patch_facing(shape, nets);
          if (facing > 0) {
            EXPECT_GT(range.least, 0) << int{shape.degree};
          } else if (facing < 0) {
            EXPECT_LT(range.most, 0) << int{shape.degree};
          }
          if (bumps < 0.05) {
            EXPECT_EQ(facing, mirrored ? -1 : 1) << int{shape.degree};
          }
          ++said[static_cast<std::size_t>(facing + 1)];
        }
    EXPECT_GT(said[0], 20);
    // a plane triangle turns one way
    EXPECT_GE(said[1], shape.triangle && shape.degree == 1 ? 0 : 5);
    EXPECT_GT(said[2], 20);
  }
}

TEST(PatchFacing, CornersDecideInDegreeOne) {
  std::mt19937 random(2);
  for (const bool triangle : {false, true}) {
    const PatchShape shape{1, triangle, false};
    std::array<int, 3> said{};
    for (int i = 0; i < 300; ++i) {
      const Nets nets = bumpy(shape, 0.5, i % 2 == 0, random);
      const Range corners = sampled(shape, nets, 1);
      const int expected = corners.least > 0 ? 1 : corners.most < 0 ? -1 : 0;
      EXPECT_EQ(patch_facing(shape, nets), expected);
      ++said[static_cast<std::size_t>(expected + 1)];
    }
    EXPECT_GT(said[0], 20);
    EXPECT_GE(said[1], triangle ? 0 : 20);
    EXPECT_GT(said[2], 20);
  }
}

// A patch in a plane through the eye, whatever rounding makes of its determinants; and moved out of
// the plane by far more than that.
TEST(PatchFacing, APlaneThroughTheEyeHasNoSide) {
  std::mt19937 random(3);
  for (const PatchShape& shape : test::kPatchShapes)
    for (std::size_t c = 0; c < 3; ++c)
      for (int i = 0; i < 20; ++i) {
        Nets nets = bumpy(shape, 0.02, false, random);
        const PatchNet<double> kept = nets[2];
        for (std::size_t k = 0; k < shape.control_count(); ++k) {
          const double x = nets[0][k], y = nets[1][k];
          nets[2][k] = 0.3 * x - 0.7 * y;
        }
        std::rotate(nets.begin(), nets.begin() + static_cast<std::ptrdiff_t>(c), nets.end());
        EXPECT_EQ(patch_facing(shape, nets), 0) << int{shape.degree};
        PatchNet<double>& out = nets[(5 - c) % 3];
        for (std::size_t k = 0; k < shape.control_count(); ++k) out[k] += 1e-6 * kept[k];
        EXPECT_EQ(patch_facing(shape, nets), 1) << int{shape.degree} << ' ' << c;
      }
}

// What a triangle's surface does beyond its third edge does not matter: it turns over where u + v
// is 5/4.
TEST(PatchFacing, OfTrianglesTheSquareBeyondDoesNotCount) {
  for (const PatchShape& shape : test::kPatchShapes) {
    if (!shape.triangle || shape.degree == 1) continue;
    for (const double sign : {1.0, -1.0}) {
      const Nets nets = nets_through(shape, [&](double u, double v) {
        return std::array{sign * (u - 0.4 * (u + v) * (u + v)), v, 1.0};
      });
      EXPECT_LT(sign * determinant_at(shape, nets, 1, 1), 0);
      EXPECT_EQ(patch_facing(shape, nets), sign) << int{shape.degree};
    }
  }
}

// (x, y, x + h), with x and y from -1/2 to 1/2, has the determinant h, a difference of products of
// which the largest sum is 1. Rounding counts as 64 epsilon of that.
TEST(PatchFacing, CountsRoundingOfTheLargestProducts) {
  constexpr double kLeast = 64 * std::numeric_limits<double>::epsilon();
  const PatchShape shape{1, false, false};
  for (std::size_t turn = 0; turn < 3; ++turn)
    for (const double times : {1.05, 0.95, -0.95, -1.05}) {
      Nets nets = nets_through(shape, [&](double u, double v) {
        return std::array{u - 0.5, v - 0.5, u - 0.5 + times * kLeast};
      });
      std::rotate(nets.begin(), nets.begin() + static_cast<std::ptrdiff_t>(turn), nets.end());
      EXPECT_EQ(patch_facing(shape, nets), times > 1    ? 1
                                           : times < -1 ? -1
                                                        : 0)
          << turn << ' ' << times;
    }
}

}  // namespace
}  // namespace hiac
