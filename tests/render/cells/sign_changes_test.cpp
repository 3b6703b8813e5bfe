// Where offsets along a ray change their sign, against samples.
#include "hiac/render/cells/sign_changes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/optics/bernstein.hpp"
#include "hiac/render/cells/cuts_along_ray.hpp"

namespace hiac {
namespace {

struct OffsetPiece {
  double begin, end;
  std::array<BernsteinPolynomial, 1> fields;
};

double value_at(const std::vector<OffsetPiece>& pieces, double t) {
  for (const OffsetPiece& piece : pieces)
    if (t <= piece.end)
      return evaluate(piece.fields[0], (t - piece.begin) / (piece.end - piece.begin));
  return 0;
}

// The zeros of `level` under the pieces, by bisection between samples.
std::vector<double> sampled_changes(const std::vector<OffsetPiece>& pieces, double level) {
  constexpr int kSteps = 4000;
  std::vector<double> places;
  const auto below = [&](double t) { return value_at(pieces, t) < level; };
  for (int k = 0; k < kSteps; ++k) {
    double low = static_cast<double>(k) / kSteps, high = static_cast<double>(k + 1) / kSteps;
    if (below(low) == below(high)) continue;
    const bool first = below(low);
    for (int step = 0; step < 50; ++step) {
      const double middle = (low + high) / 2;
      (below(middle) == first ? low : high) = middle;
    }
    places.push_back((low + high) / 2);
  }
  return places;
}

// Three pieces that fit at their ends.
std::vector<OffsetPiece> random_pieces(std::mt19937_64& random) {
  std::uniform_real_distribution<double> any(-1, 1);
  const double a = 0.3 + 0.1 * any(random), b = 0.7 + 0.1 * any(random);
  std::vector<OffsetPiece> pieces;
  double last = any(random);
  for (const auto& [begin, end] : {std::pair{0.0, a}, {a, b}, {b, 1.0}}) {
    std::vector<double> c(2 + random() % 4);
    for (double& x : c) x = any(random);
    c.front() = last;
    last = c.back();
    pieces.push_back({begin, end, {BernsteinPolynomial(c)}});
  }
  return pieces;
}

TEST(SignChanges, AreWhereSamplesChangeSign) {
  std::mt19937_64 random(3);
  std::vector<RootEnclosure> roots;
  std::size_t found = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const auto pieces = random_pieces(random);
    const double level = trial % 2 == 0 ? 0 : 0.2;
    const auto expected = sampled_changes(pieces, level);
    std::vector<double> places{9, 9};
    find_shifted_changes(pieces, level, places, roots);
    ASSERT_EQ(places.size(), expected.size()) << trial;
    for (std::size_t k = 0; k < places.size(); ++k) EXPECT_NEAR(places[k], expected[k], 1e-9);
    found += places.size();
  }
  EXPECT_GT(found, 200U);
}

// What is known at the ends decides there: a sign other than that of the polynomial is a change
// between the end and the first place at which the polynomial's is certain.
TEST(SignChanges, CountWhatIsKnownAtTheEnds) {
  std::vector<RootEnclosure> roots;
  const auto places = [&](std::optional<bool> first, const std::vector<double>& c,
                          double rounding = 0) {
    std::vector<double> found;
    SignChanges<double> changes(first, found);
    changes.follow(BernsteinPolynomial(c), 0.25, 0.75, rounding, roots);
    changes.certain(true, 1, 1);
    return found;
  };
  // positive from 0.25 to 0.75, negative behind
  EXPECT_EQ(places(std::nullopt, {1, 2}), (std::vector{0.875}));
  EXPECT_EQ(places(false, {1, 2}), (std::vector{0.875}));
  EXPECT_EQ(places(true, {1, 2}), (std::vector{0.125, 0.875}));
  EXPECT_EQ(places(true, {-1, -2}), (std::vector<double>{}));
  EXPECT_EQ(places(false, {-1, -2}), (std::vector{0.125}));
  // within rounding no sign is certain
  EXPECT_EQ(places(true, {1, 2}, 3), (std::vector<double>{}));
  EXPECT_EQ(places(false, {-1, -2}, 3), (std::vector{0.5}));
  EXPECT_EQ(places(false, {1, 2}, 3), (std::vector{0.5}));
  // once it has a sign it has the other at its end
  const auto crossed = places(false, {3, -1});
  ASSERT_EQ(crossed.size(), 1U);
  EXPECT_NEAR(crossed[0], 0.25 + 0.75 * 0.5, 1e-12);
}

// A hollow that only rounding makes touch zero is none; one beyond it is two changes.
TEST(SignChanges, DoNotCountWhatRoundingMayHaveMade) {
  std::vector<RootEnclosure> roots;
  const auto count = [&](double depth, double rounding) {
    std::vector<double> places;
    SignChanges<double> changes(std::nullopt, places);
    // (2 t - 1)^2 - depth
    changes.follow(BernsteinPolynomial(std::vector{1 - depth, -1 - depth, 1 - depth}), 0, 1,
                   rounding, roots);
    return places.size();
  };
  EXPECT_EQ(count(0.01, 0), 2U);
  EXPECT_EQ(count(0.01, 0.009), 2U);
  EXPECT_EQ(count(0.01, 0.011), 0U);
  EXPECT_EQ(count(-0.01, 0), 0U);
  EXPECT_EQ(count(0, 0), 0U);
}

// Places move by what the offset is off over its slope, of which twice is said; where a hollow of
// 0.04 appears or goes the number of places changes.
TEST(ShiftedChanges, AreAsManyWhereTheyOnlyMove) {
  std::vector<RootEnclosure> roots;
  std::vector<double> shifted;
  const std::vector<OffsetPiece> line{{0, 0.5, {BernsteinPolynomial(std::vector{-1.0, 1.0})}},
                                      {0.5, 1, {BernsteinPolynomial(std::vector{1.0, 2.0})}}};
  std::vector<double> moved{0};
  EXPECT_TRUE(as_many_when_shifted(line, 0.1, std::vector{0.25}, moved, shifted, roots));
  EXPECT_NEAR(moved[0], 2 * 0.1 / 4, 1e-12);
  // no less than was said already
  moved = {0.5};
  EXPECT_TRUE(as_many_when_shifted(line, 0.1, std::vector{0.25}, moved, shifted, roots));
  EXPECT_EQ(moved[0], 0.5);
  // none is asked for
  std::vector<double> none;
  EXPECT_TRUE(as_many_when_shifted(line, 0.1, std::vector{0.25}, none, shifted, roots));
  EXPECT_FALSE(as_many_when_shifted(line, 1.5, std::vector{0.25}, none, shifted, roots));
  EXPECT_FALSE(as_many_when_shifted(line, 0.1, std::vector<double>{}, none, shifted, roots));
  for (const double depth : {0.04, -0.04}) {
    const std::vector<OffsetPiece> hollow{
        {0, 1, {BernsteinPolynomial(std::vector{1 - depth, -1 - depth, 1 - depth})}}};
    const std::vector<double> places = depth > 0 ? std::vector{0.4, 0.6} : std::vector<double>{};
    EXPECT_TRUE(as_many_when_shifted(hollow, 0.03, places, none, shifted, roots)) << depth;
    EXPECT_FALSE(as_many_when_shifted(hollow, 0.05, places, none, shifted, roots)) << depth;
  }
}

// Surfaces of different values that are nearer than both are off may be in either order.
TEST(OrderOfCrossings, IsInDoubtWithinTheirErrors) {
  struct Crossed {
    const FrameIsosurface* surface;
    double t, moved;
  };
  FrameIsosurface a{}, other_value{}, other_field{}, twin{};
  other_value.value = 1;
  other_field.field = 1;
  twin.color = {1, 0, 0};
  const auto doubtful = [](const std::vector<Crossed>& found) { return order_doubtful(found); };
  for (const FrameIsosurface* b : {&other_value, &other_field}) {
    EXPECT_TRUE(doubtful({{&a, 1, 0.1}, {b, 1.25, 0.15}}));
    EXPECT_FALSE(doubtful({{&a, 1, 0.1}, {b, 1.25, 0.125}}));
    EXPECT_FALSE(doubtful({{&a, 1, 0.125}, {b, 1.25, 0.1}}));
    EXPECT_TRUE(doubtful({{&a, 1, 0}, {b, 1, 0}}));
    // not neighbours
    EXPECT_TRUE(doubtful({{&a, 1, 0.2}, {&a, 1.125, 0}, {b, 1.25, 0.1}}));
    EXPECT_TRUE(doubtful({{&a, 1, 0}, {b, 2, 0}, {&a, 3, 0.5}, {b, 3.5, 0.5}}));
  }
  EXPECT_FALSE(doubtful({{&a, 1, 0.5}, {&twin, 1.25, 0.5}}));
  EXPECT_FALSE(doubtful({{&a, 1, 0.5}}));
  EXPECT_FALSE(doubtful({}));
}

}  // namespace
}  // namespace hiac
