#include "hiac/optics/linear_piece.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "arb_oracle.hpp"
#include "hiac/optics/extended_piece.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/linear_piece_vectors.hpp"

namespace hiac {
namespace {

constexpr double kBound = 1e-14;
constexpr double kSmallestDenormal = 0x1p-1074;
constexpr double kLargest = 1e6;

struct Pieces {
  std::vector<double> b;
  std::vector<double> a;

  void add(double front, double back) {
    if (front <= kLargest && back <= kLargest) {
      b.push_back(front);
      a.push_back(back);
    }
  }
  void add_both_ways(double x, double y) {
    add(x, y);
    add(y, x);
  }
};

/// Results of a batch, chromaticity and emission.
struct Results {
  std::vector<LinearPieceWeights> weights;
  std::vector<LinearPieceWeights> emission;
};

Results by_scalars(const Pieces& pieces) {
  Results r;
  for (std::size_t i = 0; i < pieces.b.size(); ++i) {
    r.weights.push_back(linear_piece_weights(pieces.b[i], pieces.a[i]));
    r.emission.push_back(linear_piece_emission(pieces.b[i], pieces.a[i]));
  }
  return r;
}

using Batch = void (*)(std::span<const double>, std::span<const double>, const LinearPieceOutput&);

std::vector<LinearPieceWeights> run_batch(Batch batch, std::span<const double> b,
                                          std::span<const double> a) {
  std::vector<double> transparency(b.size());
  std::vector<double> front(b.size());
  std::vector<double> back(b.size());
  batch(b, a, {transparency, front, back});
  std::vector<LinearPieceWeights> r;
  for (std::size_t i = 0; i < b.size(); ++i) r.push_back({transparency[i], front[i], back[i]});
  return r;
}

Results by_batches(const Pieces& pieces) {
  return {run_batch(linear_piece_weights, pieces.b, pieces.a),
          run_batch(linear_piece_emission, pieces.b, pieces.a)};
}

/// Error of a value in units of what is allowed: 1e-14 relative, or two smallest denormals.
double scaled_error(double value, double exact) {
  const double excess = std::abs(value - exact) - 2 * kSmallestDenormal;
  if (excess <= 0) return 0;
  return excess / (kBound * exact);
}

struct Worst {
  double error = 0;
  double b = 0;
  double a = 0;
  const char* what = "";
};

void judge(const Results& results, const Pieces& pieces, const std::vector<test::ExactPiece>& exact,
           const std::string& who) {
  Worst worst;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const auto check = [&](const char* what, double value, double truth) {
      const double error = scaled_error(value, truth);
      if (!(error <= worst.error)) worst = {error, pieces.b[i], pieces.a[i], what};
    };
    const LinearPieceWeights& w = results.weights[i];
    const LinearPieceWeights& e = results.emission[i];
    check("zeta", w.transparency, exact[i].zeta);
    check("1 - Psi", w.front, exact[i].front);
    check("Psi - zeta", w.back, exact[i].back);
    check("1 - zeta", w.front + w.back, exact[i].alpha);
    check("zeta (emission)", e.transparency, exact[i].zeta);
    check("Psi - Psi_1", e.front, exact[i].psi0);
    check("Psi_1", e.back, exact[i].psi1);
    check("Psi", e.front + e.back, exact[i].psi);
  }
  std::printf("%-8s %zu pieces, largest relative error %.1e (%s at b = %.17g, a = %.17g)\n",
              who.c_str(), exact.size(), worst.error * kBound, worst.what, worst.b, worst.a);
  EXPECT_LE(worst.error, 1) << who << ": " << worst.what << " at b = " << worst.b
                            << ", a = " << worst.a;
}

void expect_exact(const Pieces& pieces) {
  std::vector<test::ExactPiece> exact;
  for (std::size_t i = 0; i < pieces.b.size(); ++i)
    exact.push_back(test::exact_linear_piece(pieces.b[i], pieces.a[i]));
  judge(by_scalars(pieces), pieces, exact, "scalar");
  test::for_each_instruction_set(
      [&](const std::string& name) { judge(by_batches(pieces), pieces, exact, name); });
}

class Random {
 public:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  double log_uniform(double low, double high) {
    return std::exp2(uniform(std::log2(low), std::log2(high)));
  }

 private:
  std::mt19937_64 engine_{20240611};
};

// What is left out behind opaque parts, and rounding of exp of the depth in front, are of all
// light.
TEST(ExtendedPiece, IsExact) {
  Random random;
  Pieces pieces;
  pieces.add(0, 0);
  for (int i = 0; i < 2000; ++i) {
    pieces.add(random.uniform(0, 1), random.uniform(0, 1));
    pieces.add(random.uniform(0, 50), random.uniform(0, 50));
    pieces.add(random.log_uniform(1e-20, 1e3), random.log_uniform(1e-20, 1e3));
    pieces.add_both_ways(0, random.log_uniform(1e-20, 1e3));
  }
  pieces.add_both_ways(0, kLargest);
  pieces.add(kLargest, kLargest);
  constexpr long double kExtendedBound = 2e-18L;
  for (std::size_t i = 0; i < pieces.b.size(); ++i) {
    const double b = pieces.b[i], a = pieces.a[i];
    const test::ExtendedExactPiece exact = test::extended_exact_piece(b, a);
    const ExtendedPieceWeights w = extended_piece_weights(b, a);
    const ExtendedPieceWeights e = extended_piece_emission(b, a);
    const auto expect = [&](const char* what, long double value, long double truth,
                            long double size) {
      EXPECT_LE(std::abs(value - truth), kExtendedBound * size)
          << what << " at b = " << b << ", a = " << a;
    };
    expect("zeta", w.transparency, exact.zeta, exact.zeta * (1 + (a + b) / 2));
    expect("1 - Psi", w.front, exact.front, exact.alpha);
    expect("Psi - zeta", w.back, exact.back, exact.alpha);
    expect("Psi - Psi_1", e.front, exact.psi0, exact.psi);
    expect("Psi_1", e.back, exact.psi1, exact.psi);
  }
}

TEST(LinearPiece, IsExactForRendererInput) {
  Random random;
  Pieces pieces;
  for (int i = 0; i < 20000; ++i) pieces.add(random.uniform(0, 0.1), random.uniform(0, 0.1));
  for (int i = 0; i < 20000; ++i) pieces.add(random.uniform(0, 1), random.uniform(0, 1));
  expect_exact(pieces);
}

TEST(LinearPiece, IsExactForModerateNumbers) {
  Random random;
  Pieces pieces;
  for (int i = 0; i < 20000; ++i) pieces.add(random.uniform(0, 10), random.uniform(0, 10));
  for (int i = 0; i < 30000; ++i)
    pieces.add(random.log_uniform(1e-9, kLargest), random.log_uniform(1e-9, kLargest));
  for (int i = 0; i < 10000; ++i) pieces.add(random.uniform(0, 1500), random.uniform(0, 1500));
  expect_exact(pieces);
}

TEST(LinearPiece, IsExactDownToDenormals) {
  Random random;
  Pieces pieces;
  for (int i = 0; i < 3000; ++i)
    pieces.add(random.log_uniform(0x1p-1074, kLargest), random.log_uniform(0x1p-1074, kLargest));
  for (int i = 0; i < 1000; ++i)
    pieces.add(random.log_uniform(0x1p-1074, 1e-300), random.log_uniform(0x1p-1074, 1e-300));
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j) pieces.add(i * kSmallestDenormal, j * kSmallestDenormal);
  expect_exact(pieces);
}

TEST(LinearPiece, IsExactForNearlyEqualEnds) {
  Random random;
  Pieces pieces;
  for (int i = 0; i < 3000; ++i) {
    const double x = random.log_uniform(1e-12, kLargest);
    pieces.add(x, x);
    pieces.add_both_ways(x, std::nextafter(x, 2 * x));
    pieces.add_both_ways(x, x * (1 + 0x1p-52 * std::floor(random.uniform(0, 9))));
    pieces.add_both_ways(x, x * (1 + random.log_uniform(1e-16, 1e-1)));
  }
  expect_exact(pieces);
}

TEST(LinearPiece, IsExactWithAZeroEnd) {
  Random random;
  Pieces pieces;
  pieces.add(0, 0);
  for (int i = 0; i < 8000; ++i) pieces.add_both_ways(0, random.log_uniform(1e-20, kLargest));
  for (int i = 0; i < 1000; ++i)
    pieces.add_both_ways(0, random.log_uniform(kSmallestDenormal, 1e-20));
  expect_exact(pieces);
}

/// Where a + b decides between faint (1/8), thin (1/4), moderate (2), medium (8) and thick.
TEST(LinearPiece, IsExactWhereTheMethodChanges) {
  Random random;
  Pieces pieces;
  for (const double sum : {0.125, 0.25, 2.0, 8.0})
    for (int i = 0; i <= 2000; ++i) {
      const double b = sum * i / 2000;
      const double a = sum - b;
      pieces.add(b, a);
      pieces.add(b, std::nextafter(a, kLargest));
      pieces.add(b, a > 0 ? std::nextafter(a, 0.0) : 0);
      pieces.add(b, a * random.uniform(0.99, 1.01));
    }
  expect_exact(pieces);
}

TEST(LinearPiece, IsExactAtTheLimits) {
  const LinearPieceWeights w = linear_piece_weights(0, 0);
  EXPECT_EQ(w.transparency, 1);
  EXPECT_EQ(w.front, 0);
  EXPECT_EQ(w.back, 0);
  const LinearPieceWeights e = linear_piece_emission(0, 0);
  EXPECT_EQ(e.transparency, 1);
  EXPECT_EQ(e.front, 0.5);
  EXPECT_EQ(e.back, 0.5);
}

// Densities beyond 1e150 count as that: nothing overflows, and the limits of the integrals are met.
// With one dense end at x = 1e150 and the other at y, Psi is 1/x from the dense end, and from the
// thin one sqrt(pi / (2 x)) where y is negligible.
TEST(LinearPiece, DensitiesWithoutLimitCountAsALargestOne) {
  constexpr double kMost = 1e150, kInfinity = std::numeric_limits<double>::infinity();
  const double from_thin = std::sqrt(std::numbers::pi / 2) * 1e-75;
  const auto expect_near = [](double value, double truth) {
    EXPECT_NEAR(value, truth, 1e-13 * truth);
  };
  for (const double large : {kMost, 1e151, 1e200, std::numeric_limits<double>::max(), kInfinity}) {
    for (const double thin : {0.0, 5e-324, 1.0, 1e10}) {
      const LinearPieceWeights dense_first = linear_piece_weights(large, thin);
      EXPECT_EQ(dense_first.transparency, 0);
      EXPECT_EQ(dense_first.front, 1);
      expect_near(dense_first.back, 1e-150);
      const LinearPieceWeights dense_last = linear_piece_weights(thin, large);
      EXPECT_EQ(dense_last.transparency, 0);
      EXPECT_EQ(dense_last.front, 1);
      expect_near(dense_last.back, from_thin);
      const LinearPieceWeights glowing_first = linear_piece_emission(large, thin);
      expect_near(glowing_first.front, 1e-150);
      expect_near(glowing_first.back, 1e-300);
      const LinearPieceWeights glowing_last = linear_piece_emission(thin, large);
      expect_near(glowing_last.front, from_thin);
      expect_near(glowing_last.back, 1e-150);
    }
    const LinearPieceWeights dense = linear_piece_weights(large, large);
    EXPECT_EQ(dense.transparency, 0);
    EXPECT_EQ(dense.front, 1);
    expect_near(dense.back, 1e-150);
    const LinearPieceWeights glowing = linear_piece_emission(large, large);
    expect_near(glowing.front, 1e-150);
    expect_near(glowing.back, 1e-300);
  }
}

bool same_bits(const LinearPieceWeights& x, const LinearPieceWeights& y) {
  return x.transparency == y.transparency && x.front == y.front && x.back == y.back;
}

TEST(LinearPieceBatch, AnElementDependsOnItsOwnPieceAlone) {
  Random random;
  Pieces pieces;
  for (int i = 0; i < 4000; ++i) {
    const double largest = i % 3 == 0 ? 0.1 : i % 3 == 1 ? 4 : 100;
    pieces.add(random.uniform(0, largest), random.uniform(0, largest));
  }
  test::for_each_instruction_set([&](const std::string& name) {
    for (const Batch batch : {Batch{linear_piece_weights}, Batch{linear_piece_emission}}) {
      const auto together = run_batch(batch, pieces.b, pieces.a);
      for (std::size_t i = 0; i < together.size(); ++i) {
        const auto alone = run_batch(batch, {&pieces.b[i], 1}, {&pieces.a[i], 1});
        ASSERT_TRUE(same_bits(together[i], alone[0])) << name << " element " << i;
      }
      for (std::size_t shift = 1; shift < 9; ++shift) {
        const auto shifted = run_batch(batch, std::span(pieces.b).subspan(shift),
                                       std::span(pieces.a).subspan(shift));
        for (std::size_t i = 0; i < shifted.size(); ++i)
          ASSERT_TRUE(same_bits(together[i + shift], shifted[i])) << name << " element " << i;
      }
    }
  });
}

// Vectors of faint pieces alone and of thin ones alone, and both by turns: few bits depend on the
// terms that a faint piece leaves out, so that it takes many pieces.
TEST(LinearPieceBatch, FaintPiecesAreTheSameBesideThinOnes) {
  Random random;
  Pieces faint, thin, mixed;
  for (int i = 0; i < 1 << 17; ++i) {
    const auto add = [&](double sum, Pieces& alone) {
      const double b = random.uniform(0, sum);
      alone.add(b, sum - b);
      mixed.add(b, sum - b);
    };
    add(random.uniform(0.1, 0.1249), faint);
    add(random.uniform(0.1251, 0.2499), thin);
  }
  test::for_each_instruction_set([&](const std::string& name) {
    for (const Batch batch : {Batch{linear_piece_weights}, Batch{linear_piece_emission},
                              Batch{linear_piece_mean_color}}) {
      const auto together = run_batch(batch, mixed.b, mixed.a);
      const auto faint_alone = run_batch(batch, faint.b, faint.a);
      const auto thin_alone = run_batch(batch, thin.b, thin.a);
      for (std::size_t i = 0; i < faint_alone.size(); ++i) {
        ASSERT_TRUE(same_bits(together[2 * i], faint_alone[i])) << name << " element " << i;
        ASSERT_TRUE(same_bits(together[2 * i + 1], thin_alone[i])) << name << " element " << i;
      }
    }
  });
}

// Half the opacity for either end, by every method and where it changes.
TEST(LinearPieceBatch, MeanColorHasHalfTheOpacityAtEitherEnd) {
  Random random;
  Pieces pieces;
  for (const double sum : {0.0, 0.125, 0.25, 2.0, 8.0}) pieces.add(0.25 * sum, 0.75 * sum);
  for (int i = 0; i < 8000; ++i) {
    const double largest = i % 4 == 0 ? 0.06 : i % 4 == 1 ? 0.2 : i % 4 == 2 ? 2 : 40;
    pieces.add(random.uniform(0, largest), random.uniform(0, largest));
  }
  // whole vectors of one method as well as mixed ones
  for (const double largest : {0.05, 0.1})
    for (int i = 0; i < 64; ++i)
      pieces.add(random.uniform(0.7, 1) * largest, random.uniform(0.7, 1) * largest);
  test::for_each_instruction_set([&](const std::string& name) {
    const auto found = run_batch(linear_piece_mean_color, pieces.b, pieces.a);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const double depth = 0.5 * (pieces.a[i] + pieces.b[i]), opacity = -std::expm1(-depth);
      ASSERT_NEAR(found[i].transparency, std::exp(-depth), 1e-14 * std::exp(-depth)) << name;
      ASSERT_NEAR(found[i].front, 0.5 * opacity, 1e-14 * opacity) << name << ' ' << depth;
      ASSERT_EQ(found[i].back, found[i].front) << name;
    }
  });
}

TEST(LinearPieceBatch, RefusesSpansOfDifferentLengths) {
  std::vector<double> two(2);
  std::vector<double> three(3);
  EXPECT_THROW(linear_piece_weights(two, three, {two, two, two}), std::invalid_argument);
  EXPECT_THROW(linear_piece_emission(two, two, {two, three, two}), std::invalid_argument);
}

/// A segment of length 1 on which the scalar runs from 0 to 1, the extinction is the tent (0, 0)
/// (0.5, 4) (1, 0) and the colour runs from 0.2 to 0.9: two linear pieces. Integrators that look at
/// the segment's ends alone see no extinction.
TEST(LinearPiece, KeepsTheInteriorBreakpointOfATent) {
  const LinearPieceWeights front = linear_piece_weights(0.0 * 0.5, 4.0 * 0.5);
  const LinearPieceWeights back = linear_piece_weights(4.0 * 0.5, 0.0 * 0.5);
  const double radiance = 0.2 * front.front + 0.55 * front.back +
                          front.transparency * (0.55 * back.front + 0.9 * back.back);
  const double opacity = 1 - front.transparency * back.transparency;
  EXPECT_NEAR(radiance, 0.408869, 5e-7);
  EXPECT_NEAR(opacity, 1 - std::exp(-2), 1e-15);
}

}  // namespace
}  // namespace hiac
