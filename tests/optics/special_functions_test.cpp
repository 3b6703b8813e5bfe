#include "hiac/optics/special_functions.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "arb_oracle.hpp"
#include "hiac/optics/special_functions_table.hpp"

namespace hiac {
namespace {

/// Logarithmically spaced arguments, and dense ones where the tables' intervals meet.
std::vector<double> arguments() {
  std::vector<double> xs{0, 5e-324, 1e-310, 1e-300};
  for (double x = 1e-20; x < 1e15; x *= 1.01) xs.push_back(x);
  for (double t = 1.0 / 512; t < 1; t += 1.0 / 512) {
    const double x = 2 * t / (1 - t);
    xs.insert(xs.end(), {std::nextafter(x, 0.0), x, std::nextafter(x, 1e9)});
  }
  return xs;
}

double relative_error(double value, double exact) {
  return value == exact ? 0 : std::abs(value - exact) / std::abs(exact);
}

constexpr double kBound = 2e-15;
constexpr double kSmallestDenormal = 0x1p-1074;

TEST(SpecialFunctions, ErfcxMatchesBallArithmetic) {
  for (const double x : arguments())
    EXPECT_LE(relative_error(erfcx(x), test::exact_erfcx(x)), kBound) << x;
}

TEST(SpecialFunctions, IerfcxMatchesBallArithmetic) {
  for (const double x : arguments())
    EXPECT_LE(relative_error(ierfcx(x), test::exact_ierfcx(x)), kBound) << x;
}

TEST(SpecialFunctions, DawsonMatchesBallArithmetic) {
  for (const double x : arguments()) {
    const double exact = test::exact_dawson(x);
    EXPECT_LE(std::abs(dawson(x) - exact), kBound * exact + kSmallestDenormal) << x;
  }
}

TEST(SpecialFunctions, DawsonDerivativeMatchesBallArithmetic) {
  for (const double x : arguments()) {
    const double exact = test::exact_dawson_derivative(x);
    const double allowed = x < 1.25 ? 1e-15 : kBound * std::abs(exact);
    EXPECT_LE(std::abs(dawson_derivative(x) - exact), allowed) << x;
  }
}

// Each coefficient, however little it adds: the fit leaves the functions' last digits right only if
// all of them are.
TEST(SpecialFunctions, CoefficientsAreThoseOfTheInterpolants) {
  using namespace special_functions_table;
  using test::WeightedFunction;
  // what the asymptotic series of the fit leave out, where they begin
  constexpr double kOfSeries = 1e-32;
  const auto judge = [](WeightedFunction function, const double(&table)[kIntervals][kDegree + 1]) {
    for (int i = 0; i < kIntervals; ++i) {
      const std::vector<double> exact =
          test::exact_powers(function, static_cast<double>(i) / kIntervals,
                             static_cast<double>(i + 1) / kIntervals, kDegree);
      for (std::size_t k = 0; k < exact.size(); ++k)
        EXPECT_NEAR(table[i][k], exact[k], 1e-15 * std::abs(exact[k]) + kOfSeries)
            << static_cast<int>(function) << ' ' << i << ' ' << k;
    }
  };
  judge(WeightedFunction::erfcx, kErfcx);
  judge(WeightedFunction::ierfcx, kIerfcx);
  judge(WeightedFunction::dawson, kDawson);
  judge(WeightedFunction::dawson_derivative, kDawsonDerivative);
}

}  // namespace
}  // namespace hiac
