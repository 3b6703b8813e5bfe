#include "hiac/render/bounds/ray_displacement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "hiac/geometry/vector.hpp"

namespace hiac {
namespace {

struct Part {
  double from, to;
};

// Of a ray with a direction of length 1 in the tetrahedron 0 <= x, y, z, x + y + z <= 1.
Part part_in_corner(const Vector& origin, const Vector& direction) {
  Part part{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  const auto clip = [&](double inside, double slope) {
    if (slope > 0) part.from = std::max(part.from, -inside / slope);
    if (slope < 0) part.to = std::min(part.to, -inside / slope);
  };
  for (std::size_t c = 0; c < 3; ++c) clip(origin[c], direction[c]);
  clip(1 - origin[0] - origin[1] - origin[2], -direction[0] - direction[1] - direction[2]);
  return part;
}

// Rays moved aside by as much as they may be end no farther away than the doubts say, close to
// edges and along faces, too.
TEST(EndDoubts, HoldWhatDisplacementsDo) {
  constexpr double kAside = 1e-3;
  const std::array<Vector, 4> corners{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const EndDoubts doubts(CellKind::tetrahedron4, corners);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit_range(-1, 1);
  const auto any = [&] {
    return Vector{unit_range(random), unit_range(random), unit_range(random)};
  };
  double closest = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const Vector inside{0.3 * std::abs(unit_range(random)), 0.3 * std::abs(unit_range(random)),
                        trial % 3 == 0 ? 1e-4 : 0.3 * std::abs(unit_range(random))};
    Vector direction = any();
    if (trial % 2 == 0) direction[2] *= 1e-3;
    direction = unit(direction);
    Vector origin = inside, moved = inside;
    const Vector aside = unit(any());
    for (std::size_t c = 0; c < 3; ++c) {
      origin[c] -= 3 * direction[c];
      moved[c] = origin[c] + kAside * aside[c];
    }
    const Part here = part_in_corner(origin, direction), there = part_in_corner(moved, direction);
    const EndDoubts::Doubts d = doubts.at(origin, direction, {.at_ends = kAside});
    ASSERT_LE(std::abs(here.from - there.from), d.front);
    ASSERT_LE(std::abs(here.to - there.to), d.back);
    closest = std::max(closest, std::abs(here.to - there.to) / d.back);
  }
  EXPECT_GT(closest, 0.4);  // they are taken twice as large
}

}  // namespace
}  // namespace hiac
