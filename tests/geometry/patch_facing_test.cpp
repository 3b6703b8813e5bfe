#include "hiac/geometry/patch_facing.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace hiac {
namespace {

constexpr std::array<PatchShape, 7> kFacingShapes{{{1, false, false},
                                                   {2, false, false},
                                                   {3, false, false},
                                                   {1, true, false},
                                                   {2, true, false},
                                                   {3, true, false},
                                                   {3, true, true}}};

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

// The patch (u - 0.4, v - 0.3, 1), or its mirror image, as the eye sees it, with bumps: nodes are
// moved at random.
Nets bumpy(const PatchShape& shape, double bumps, bool mirrored, std::mt19937& random) {
  std::uniform_real_distribution<double> number(-1, 1);
  std::array<std::array<double, kMostPatchNodes>, 3> nodes;
  const std::size_t corners = shape.corner_count(), n = shape.degree;
  const std::array<std::array<double, 2>, 4> square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  const std::array<std::array<double, 2>, 4> triangle{{{0, 0}, {1, 0}, {0, 1}, {0, 0}}};
  const auto& corner = shape.triangle ? triangle : square;
  for (std::size_t k = 0; k < shape.node_count(); ++k) {
    double u = 1.0 / 3, v = 1.0 / 3;
    if (k < corners * n) {
      const std::size_t edge = k < corners ? k : (k - corners) / (n - 1);
      const std::size_t i = k < corners ? 0 : (k - corners) % (n - 1) + 1;
      const auto &from = corner[edge], &to = corner[(edge + 1) % corners];
      const double s = static_cast<double>(i) / static_cast<double>(n);
      u = from[0] + s * (to[0] - from[0]);
      v = from[1] + s * (to[1] - from[1]);
    }
    nodes[0][k] = (mirrored ? -1 : 1) * (u - 0.4) + bumps * number(random);
    nodes[1][k] = v - 0.3 + bumps * number(random);
    nodes[2][k] = 1 + bumps * number(random);
  }
  Nets nets;
  for (std::size_t c = 0; c < 3; ++c)
    patch_net(shape, std::span(nodes[c]).first(shape.node_count()), nets[c]);
  return nets;
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
  for (const PatchShape& shape : kFacingShapes) {
    std::array<int, 3> said{};
    for (const double bumps : {0.02, 0.1, 0.3, 1.0})
      for (const bool mirrored : {false, true})
        for (int i = 0; i < 20; ++i) {
          const Nets nets = bumpy(shape, bumps, mirrored, random);
          const Range range = sampled(shape, nets, 12);
          const int facing = patch_facing(shape, nets);
          if (facing > 0) EXPECT_GT(range.least, 0) << int{shape.degree};
          if (facing < 0) EXPECT_LT(range.most, 0) << int{shape.degree};
          if (bumps < 0.05) EXPECT_EQ(facing, mirrored ? -1 : 1) << int{shape.degree};
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
  for (const PatchShape& shape : kFacingShapes)
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

}  // namespace
}  // namespace hiac
