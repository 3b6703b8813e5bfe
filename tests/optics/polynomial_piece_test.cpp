#include "hiac/optics/polynomial_piece.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/base/gauss_legendre.hpp"
#include "hiac/optics/linear_piece.hpp"

namespace hiac {
namespace {

using Real = long double;
using ColorPoints = std::vector<PiecewiseLinear<3>::Point>;
using ExtinctionPoints = std::vector<PiecewiseLinear<1>::Point>;

PolynomialSegment segment_of(const std::vector<double>& color_field,
                             const std::vector<double>& extinction_field, double length) {
  return {BernsteinPolynomial(color_field), BernsteinPolynomial(extinction_field), length};
}

/// A polynomial in powers of t, in long double: the oracle's own representation.
class Polynomial {
 public:
  explicit Polynomial(const BernsteinPolynomial& f) {
    const std::size_t n = f.degree;
    std::vector<Real> differences(f.c.begin(), f.c.begin() + static_cast<std::ptrdiff_t>(n + 1));
    Real binomial = 1;
    for (std::size_t k = 0; k <= n; ++k) {  // the k-th difference at 0 times (n choose k)
      powers_.push_back(binomial * differences[0]);
      for (std::size_t i = 0; i + 1 < differences.size(); ++i)
        differences[i] = differences[i + 1] - differences[i];
      differences.pop_back();
      binomial = binomial * static_cast<Real>(n - k) / static_cast<Real>(k + 1);
    }
  }
  explicit Polynomial(std::vector<Real> powers) : powers_(std::move(powers)) {}

  Real operator()(Real t) const {
    Real sum = 0;
    for (std::size_t k = powers_.size(); k-- > 0;) sum = sum * t + powers_[k];
    return sum;
  }
  [[nodiscard]] Polynomial derivative() const {
    std::vector<Real> d;
    for (std::size_t k = 1; k < powers_.size(); ++k) d.push_back(static_cast<Real>(k) * powers_[k]);
    return Polynomial(d);
  }
  [[nodiscard]] Polynomial antiderivative() const {
    std::vector<Real> a{0};
    for (std::size_t k = 0; k < powers_.size(); ++k)
      a.push_back(powers_[k] / static_cast<Real>(k + 1));
    return Polynomial(a);
  }
  /// scale f + shift.
  [[nodiscard]] Polynomial mapped(Real scale, Real shift) const {
    std::vector<Real> p = powers_;
    for (Real& v : p) v *= scale;
    if (p.empty()) p.push_back(0);
    p[0] += shift;
    return Polynomial(p);
  }

  /// Roots in (0, 1) where the sign changes: between neighbouring extrema, by bisection.
  [[nodiscard]] std::vector<Real> crossings() const {
    std::vector<Real> roots;
    if (powers_.size() <= 1) return roots;
    std::vector<Real> ends = derivative().crossings();
    ends.insert(ends.begin(), 0);
    ends.push_back(1);
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      Real low = ends[i];
      Real high = ends[i + 1];
      const bool rises = (*this)(low) < 0;
      if (rises == ((*this)(high) < 0)) continue;
      for (int step = 0; step < 80; ++step) {
        const Real middle = (low + high) / 2;
        (((*this)(middle) < 0) == rises ? low : high) = middle;
      }
      roots.push_back((low + high) / 2);
    }
    return roots;
  }

 private:
  std::vector<Real> powers_;
};

struct Exact {
  std::array<double, 3> rgb;
  double transparency;
};

/// Integrates by 24-node rules on many panels, in long double, with its own cuts.
class Oracle {
 public:
  Oracle(const PolynomialSegment& segment, const PiecewiseLinear<3>& color,
         const PiecewiseLinear<1>& extinction, Glow glow)
      : color_field_(segment.color_field),
        extinction_field_(segment.extinction_field),
        color_(color),
        extinction_(extinction),
        length_(segment.length),
        glow_(glow) {}

  Exact run() {
    std::vector<Real> cuts{0, 1};
    add_crossings(color_field_, color_.breakpoints(), cuts);
    add_crossings(extinction_field_, extinction_.breakpoints(), cuts);
    std::ranges::sort(cuts);
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
      if (cuts[i + 1] > cuts[i]) add_piece(cuts[i], cuts[i + 1]);
    Exact e{};
    for (std::size_t c = 0; c < 3; ++c) e.rgb[c] = static_cast<double>(rgb_[c]);
    e.transparency = static_cast<double>(std::exp(-depth_));
    return e;
  }

 private:
  static void add_crossings(const Polynomial& f, std::span<const double> levels,
                            std::vector<Real>& cuts) {
    for (const double s : levels)
      for (const Real t : f.mapped(1, -static_cast<Real>(s)).crossings()) cuts.push_back(t);
  }

  void add_piece(Real t0, Real t1) {
    const Real middle = (t0 + t1) / 2;
    const auto& color = color_.piece(color_.interval_of(static_cast<double>(color_field_(middle))));
    const auto& extinction =
        extinction_.piece(extinction_.interval_of(static_cast<double>(extinction_field_(middle))));
    const Real slope = extinction.slope[0];
    const Polynomial tau =
        extinction_field_.mapped(slope, extinction.value[0] - slope * extinction.anchor);
    const Polynomial depth = tau.antiderivative();
    const Real from = depth(t0);
    constexpr int kPanels = 24;
    const GaussRule rule = gauss_legendre(kMaxGaussNodes);
    for (int panel = 0; panel < kPanels; ++panel) {
      const Real half = (t1 - t0) / kPanels / 2;
      const Real center = t0 + (2 * panel + 1) * half;
      for (std::size_t i = 0; i < kMaxGaussNodes; ++i) {
        const Real t = center + half * rule.nodes[i];
        Real weight =
            half * rule.weights[i] * length_ * std::exp(-depth_ - length_ * (depth(t) - from));
        if (glow_ == Glow::chromaticity) weight *= tau(t);
        for (std::size_t c = 0; c < 3; ++c)
          rgb_[c] += weight * (color.value[c] + color.slope[c] * (color_field_(t) - color.anchor));
      }
    }
    depth_ += length_ * (depth(t1) - from);
  }

  Polynomial color_field_;
  Polynomial extinction_field_;
  const PiecewiseLinear<3>& color_;
  const PiecewiseLinear<1>& extinction_;
  Real length_;
  Glow glow_;
  std::array<Real, 3> rgb_{};
  Real depth_ = 0;
};

/// Largest true error, largest claim and how far claims are from tolerances, of many segments.
struct Tally {
  double error = 0;
  double claim = 0;
};

/// The claims hold, and the tolerance is met but for rounding.
void expect_proven(const PolynomialSegment& segment, const PiecewiseLinear<3>& color,
                   const PiecewiseLinear<1>& extinction, double tolerance, double slack,
                   Tally& tally) {
  for (const Glow glow : {Glow::chromaticity, Glow::emission}) {
    const SegmentRadiance r = integrate_segment(segment, color, extinction, glow, tolerance);
    const Exact exact = Oracle(segment, color, extinction, glow).run();
    double scale = 1;
    for (std::size_t c = 0; c < 3; ++c) {
      const double error = std::abs(r.rgb[c] - exact.rgb[c]);
      EXPECT_LE(error, r.error);
      tally.error = std::max(tally.error, error);
      scale = std::max(scale, std::abs(exact.rgb[c]));
    }
    EXPECT_LE(std::abs(r.transparency - exact.transparency), r.transparency_error);
    EXPECT_LE(r.error, tolerance + slack * scale);
    tally.claim = std::max(tally.claim, r.error);
  }
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  std::vector<double> field(std::size_t degree, double low, double high) {
    std::vector<double> c(degree + 1);
    for (double& v : c) v = uniform(low, high);
    return c;
  }
  /// Points with a step at one of them.
  PiecewiseLinear<3> color(int points) {
    ColorPoints p;
    for (int i = 0; i < points; ++i)
      p.push_back({i / 2 * 0.3, {uniform(0, 1), uniform(0, 1), uniform(0, 1)}});
    return PiecewiseLinear<3>(p);
  }
  PiecewiseLinear<1> extinction(int points, double largest) {
    ExtinctionPoints p;
    for (int i = 0; i < points; ++i) p.push_back({i * 0.2, {uniform(0, largest)}});
    if (points > 3) p[2].scalar = p[1].scalar;
    return PiecewiseLinear<1>(p);
  }

 private:
  std::mt19937_64 engine_;
};

// In extended precision: the same numbers to within the bounds of those in doubles, with bounds
// that rounding leaves far lower.
TEST(PolynomialPiece, IsFinerInExtendedPrecision) {
  Random random(12);
  const auto extended = [](const BernsteinPolynomial& f) {
    std::vector<Real> c(f.c.begin(), f.c.begin() + static_cast<std::ptrdiff_t>(f.degree + 1));
    return ExtendedBernstein(c);
  };
  for (int trial = 0; trial < 60; ++trial) {
    const auto degree = static_cast<std::size_t>(1 + trial % 6);
    const PolynomialSegment segment =
        segment_of(random.field(degree, -0.5, 1.5), random.field(degree, -0.5, 1.5), 1);
    const auto color = random.color(2 + trial % 5);
    const auto extinction = random.extinction(2 + trial % 4, 4);
    for (const Glow glow : {Glow::chromaticity, Glow::emission}) {
      const SegmentRadiance r = integrate_segment(segment, color, extinction, glow, 1e-16);
      const auto fine = integrate_segment(
          BasicPolynomialSegment<Real>{extended(segment.color_field),
                                       extended(segment.extinction_field), segment.length},
          color, extinction, glow, 1e-16);
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_LE(std::abs(fine.rgb[c] - r.rgb[c]), r.error + fine.error);
      EXPECT_LE(std::abs(fine.transparency - r.transparency),
                r.transparency_error + fine.transparency_error);
      EXPECT_LE(fine.error, r.error / 8);
      EXPECT_LE(fine.transparency_error, r.transparency_error / 8);
    }
  }
}

TEST(PolynomialPiece, ErrorsStayWithinTheirBounds) {
  for (const double tolerance : {1e-4, 1e-9, 1e-13}) {
    Random random(11);
    Tally tally;
    for (int trial = 0; trial < 250; ++trial) {
      const auto degree = static_cast<std::size_t>(1 + trial % 6);
      const PolynomialSegment segment =
          segment_of(random.field(degree, -0.5, 1.5), random.field(degree, -0.5, 1.5), 1);
      const double largest = std::exp2(random.uniform(-6, 6));
      expect_proven(segment, random.color(2 + trial % 5), random.extinction(2 + trial % 4, largest),
                    tolerance, 1e-10, tally);
    }
    std::printf("tolerance %.0e: largest error %.1e, largest bound %.1e\n", tolerance, tally.error,
                tally.claim);
  }
}

TEST(PolynomialPiece, KeepsItsDigitsForSmallVariationsOfLargeNumbers) {
  Random random(14);
  Tally tally;
  for (int trial = 0; trial < 60; ++trial) {
    const std::vector<double> field =
        random.field(static_cast<std::size_t>(1 + trial % 6), 1e6, 1e6 + 1);
    const PiecewiseLinear<3> color(ColorPoints{{1e6, {0, 0.5, 1}}, {1e6 + 1, {1, 0.5, 0}}});
    const PiecewiseLinear<1> tent(ExtinctionPoints{{1e6, {0}}, {1e6 + 0.5, {4}}, {1e6 + 1, {0}}});
    expect_proven(segment_of(field, field, 1), color, tent, 1e-12, 1e-11, tally);
  }
}

TEST(PolynomialPiece, MeetsItsToleranceForThickSegments) {
  Random random(12);
  Tally tally;
  for (int trial = 0; trial < 60; ++trial) {
    const auto degree = static_cast<std::size_t>(1 + trial % 6);
    const std::vector<double> field = random.field(degree, 0, 1);
    expect_proven(segment_of(field, field, 10), random.color(4), random.extinction(4, 100), 1e-9,
                  1e-9, tally);
  }
}

/// 2 t (1 - t) touches its largest value 1/2 at t = 1/2, where the functions bend or jump.
TEST(PolynomialPiece, SurvivesTangencies) {
  const std::vector<double> arch{0, 1, 0};
  const PiecewiseLinear<1> bends(ExtinctionPoints{{0, {1}}, {0.5, {3}}, {1, {0}}});
  const PiecewiseLinear<1> jumps(ExtinctionPoints{{0, {1}}, {0.5, {1}}, {0.5, {50}}, {1, {50}}});
  const PiecewiseLinear<3> color(ColorPoints{{0, {0, 0.5, 1}}, {1, {1, 0.5, 0}}});
  Tally tally;
  expect_proven(segment_of(arch, arch, 1), color, bends, 1e-12, 1e-12, tally);
  for (const double offset : {0.0, 1e-16, -1e-16, 1e-13, -1e-13, 1e-6, -1e-6}) {
    const std::vector<double> moved{offset, 1 + offset, offset};
    expect_proven(segment_of(moved, moved, 1), color, jumps, 1e-12, 1e-4, tally);
  }
}

TEST(PolynomialPiece, ConstantFieldsAreClosedForms) {
  const PiecewiseLinear<3> color(ColorPoints{{0, {0, 0.5, 1}}, {1, {1, 0.5, 0}}});
  const PiecewiseLinear<1> step(ExtinctionPoints{{0.5, {1}}, {0.5, {2}}});
  for (const double value : {0.25, 0.5, 0.75}) {  // continuous from the right at the step
    const std::vector<double> field{value, value, value};
    const SegmentRadiance r =
        integrate_segment(segment_of(field, field, 1.5), color, step, Glow::chromaticity, 1e-12);
    const double tau = value < 0.5 ? 1 : 2;
    EXPECT_NEAR(r.transparency, std::exp(-1.5 * tau), 1e-15);
    EXPECT_NEAR(r.rgb[0], value * (1 - r.transparency), 1e-15);
    EXPECT_LE(r.error, 1e-12 + 1e-13);
  }
  const SegmentRadiance glowing = integrate_segment(segment_of({0.25}, {0.25}, 1.5), color,
                                                    PiecewiseLinear<1>(), Glow::emission, 1e-12);
  EXPECT_NEAR(glowing.rgb[0], 0.25 * 1.5, 1e-15);
  EXPECT_EQ(glowing.transparency, 1);
}

TEST(PolynomialPiece, DegreeOneAgreesWithTheClosedForm) {
  Random random(13);
  const PiecewiseLinear<3> color(ColorPoints{{0, {0, 1, 0.5}}, {1, {1, 0, 0.5}}});
  for (int trial = 0; trial < 300; ++trial) {
    const double largest = std::exp2(random.uniform(-20, 12));
    const PiecewiseLinear<1> extinction(ExtinctionPoints{{0, {0}}, {1, {largest}}});
    const double front = random.uniform(0, 1);
    const double back = random.uniform(0, 1);
    const double length = random.uniform(0.1, 2);
    const PolynomialSegment segment = segment_of({front, back}, {front, back}, length);
    const double b = front * largest * length;
    const double a = back * largest * length;
    const LinearPieceWeights w = linear_piece_weights(b, a);
    const SegmentRadiance chroma =
        integrate_segment(segment, color, extinction, Glow::chromaticity, 1e-12);
    EXPECT_NEAR(chroma.rgb[0], front * w.front + back * w.back, chroma.error + 1e-14);
    EXPECT_LE(chroma.error, 1e-11);
    EXPECT_NEAR(chroma.transparency, w.transparency, chroma.transparency_error + 1e-15);
    const LinearPieceWeights e = linear_piece_emission(b, a);
    const SegmentRadiance glow =
        integrate_segment(segment, color, extinction, Glow::emission, 1e-12);
    EXPECT_NEAR(glow.rgb[0], length * (front * e.front + back * e.back), glow.error + 1e-14);
    EXPECT_LE(glow.error, 1e-11);
  }
}

TEST(PolynomialPiece, KeepsTheInteriorBreakpointOfATent) {
  const PiecewiseLinear<3> color(ColorPoints{{0, {0.2, 0, 0}}, {1, {0.9, 0, 0}}});
  const PiecewiseLinear<1> tent(ExtinctionPoints{{0, {0}}, {0.5, {4}}, {1, {0}}});
  const SegmentRadiance r =
      integrate_segment(segment_of({0, 1}, {0, 1}, 1), color, tent, Glow::chromaticity, 1e-12);
  EXPECT_NEAR(r.rgb[0], 0.408869, 5e-7);
  EXPECT_NEAR(r.transparency, std::exp(-2), 1e-15);
}

TEST(PolynomialPiece, RefusesWhatIsNotFiniteOrNegative) {
  const PiecewiseLinear<3> color(ColorPoints{{0, {1, 1, 1}}});
  const PiecewiseLinear<1> one(ExtinctionPoints{{0, {1}}});
  const PiecewiseLinear<1> negative(ExtinctionPoints{{0, {-1}}});
  const PiecewiseLinear<1> huge(ExtinctionPoints{{0, {1e308}}});
  const auto refuses = [&](const PolynomialSegment& s, const PiecewiseLinear<1>& extinction,
                           double tolerance) {
    EXPECT_THROW(integrate_segment(s, color, extinction, Glow::chromaticity, tolerance),
                 std::invalid_argument);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refuses(segment_of({nan, 0}, {0, 0}, 1), one, 1e-9);
  refuses(segment_of({0, 0}, {0, 1e200}, 1), one, 1e-9);
  refuses(segment_of({0}, {0}, -1), one, 1e-9);
  refuses(segment_of({0}, {0}, nan), one, 1e-9);
  refuses(segment_of({0}, {0}, 1), one, 0);
  refuses(segment_of({0}, {0}, 1), negative, 1e-9);
  refuses(segment_of({0}, {0}, 100), huge, 1e-9);
}

// Fields that stay within a narrow tent of the extinction for a while: rounding errors of the field
// are as large as the tent. The light is that of some extinction that is not negative, and has a
// bound.
TEST(PolynomialPiece, LightOfFunctionsTooSteepForTheirFieldIsWithinItsRange) {
  Random random(15);
  std::size_t unknown = 0, known = 0;
  for (const double width : {1e-6, 1e-12, 1e-14, 1e-15})
    for (const double top : {1.0, 1e10, 1e100, 1e300})
      for (int trial = 0; trial < 30; ++trial) {
        const auto degree = static_cast<std::size_t>(3 + trial % 6);
        std::vector<double> field = random.field(degree, 0.5 - 2 * width, 0.5 + 2 * width);
        if (trial % 2 == 0)
          field.front() = random.uniform(0, 1), field.back() = random.uniform(0, 1);
        const PiecewiseLinear<1> tent(
            ExtinctionPoints{{0.5, {0}}, {0.5 + width, {top}}, {0.5 + 2 * width, {0}}});
        const PiecewiseLinear<3> color(
            ColorPoints{{0.5, {0, 0.25, 1}}, {0.5 + width, {1, 0.25, 0}}});
        const double length = random.uniform(0.5, 2);
        const PolynomialSegment segment = segment_of(field, field, length);
        for (const Glow glow : {Glow::chromaticity, Glow::emission}) {
          const SegmentRadiance r = integrate_segment(segment, color, tent, glow, 1e-9);
          const double most = (glow == Glow::emission ? length : 1) * (1 + 1e-12);
          ASSERT_GE(r.transparency, 0);
          ASSERT_LE(r.transparency, 1);
          for (const double channel : r.rgb) {
            ASSERT_GE(channel, 0) << width << ' ' << top << ' ' << trial;
            ASSERT_LE(channel, most) << width << ' ' << top << ' ' << trial;
          }
          ASSERT_LE(r.rgb[1], 0.25 * most);
          ASSERT_GE(r.error, 0);  // and is no NaN
          ASSERT_GE(r.transparency_error, 0);
          ASSERT_LE(r.transparency_error, 1);
          ++(std::isinf(r.error) ? unknown : known);
        }
      }
  EXPECT_GT(unknown, 100U);
  EXPECT_GT(known, 100U);
}

// Bounds that overflow prove nothing: such a piece counts as linear from end to end. All of its
// light comes from its front.
TEST(PolynomialPiece, ExtinctionsAsLargeAsNumbersAreHaveNoBound) {
  const PiecewiseLinear<1> large(ExtinctionPoints{{0, {1e308}}, {1, {1.7e308}}});
  const PiecewiseLinear<3> color(ColorPoints{{0, {0.2, 0.5, 0}}, {1, {0.8, 0.5, 1}}});
  for (const auto& [front, back] : {std::pair(0.25, 0.75), std::pair(0.75, 0.25)}) {
    const std::vector<double> field{front, 0.4, back};
    const SegmentRadiance r =
        integrate_segment(segment_of(field, field, 1), color, large, Glow::chromaticity, 1e-9);
    EXPECT_NEAR(r.rgb[0], 0.2 + 0.6 * front, 1e-14);
    EXPECT_NEAR(r.rgb[1], 0.5, 1e-14);
    EXPECT_NEAR(r.rgb[2], front, 1e-14);
    EXPECT_EQ(r.transparency, 0);
    EXPECT_TRUE(std::isinf(r.error));
  }
}

TEST(PolynomialPiece, AnEmptySegmentIsTransparent) {
  const PiecewiseLinear<3> color(ColorPoints{{0, {1, 1, 1}}});
  const PiecewiseLinear<1> one(ExtinctionPoints{{0, {1}}});
  const SegmentRadiance r =
      integrate_segment(segment_of({0, 1}, {0, 1}, 0), color, one, Glow::chromaticity, 1e-9);
  EXPECT_EQ(r.transparency, 1);
  EXPECT_EQ(r.rgb[0], 0);
}

}  // namespace
}  // namespace hiac
