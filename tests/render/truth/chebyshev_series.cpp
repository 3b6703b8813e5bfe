#include "tests/render/truth/chebyshev_series.hpp"

#include <cmath>
#include <numbers>

namespace hiac::test {
namespace {

using Real = ChebyshevSeries::Real;

constexpr std::size_t kMost = ChebyshevSeries::kMostDegree;

// place[n][j], and transform[n][k][j] from values to coefficients.
struct Tables {
  std::array<std::array<Real, kMost + 1>, kMost + 1> place{};
  std::array<std::array<std::array<Real, kMost + 1>, kMost + 1>, kMost + 1> transform{};

  Tables() {
    for (std::size_t n = 1; n <= kMost; ++n) {
      const auto cosine = [n](std::size_t i) {
        return std::cos(std::numbers::pi_v<Real> * static_cast<Real>(i % (2 * n)) /
                        static_cast<Real>(n));
      };
      const auto halved = [n](std::size_t i) { return i == 0 || i == n ? 0.5L : 1.0L; };
      for (std::size_t j = 0; j <= n; ++j) {
        place[n][j] = -cosine(j);
        for (std::size_t k = 0; k <= n; ++k)
          transform[n][k][j] =
              2 * halved(k) * halved(j) * cosine((n - j) * k) / static_cast<Real>(n);
      }
      place[n][0] = -1;
      place[n][n] = 1;
      if (n % 2 == 0) place[n][n / 2] = 0;
    }
  }
};

const Tables& tables() {
  static const Tables kTables;
  return kTables;
}

// On [low, high], a part of [-1, 1].
void append_on(const ChebyshevSeries& p, Real value, Real low, Real high, int halvings,
               std::vector<Real>& places) {
  std::array<Real, kMost + 1> values;
  for (std::size_t j = 0; j <= p.degree; ++j)
    values[j] = p.at((low + high) / 2 + (high - low) / 2 * ChebyshevSeries::place(p.degree, j));
  const ChebyshevSeries part = ChebyshevSeries::through(p.degree, values.data());
  Real sum = 0, slopes = 0;
  for (std::size_t k = 1; k <= p.degree; ++k) {
    sum += std::abs(part.c[k]);
    if (k > 1) slopes += static_cast<Real>(k * k) * std::abs(part.c[k]);
  }
  if (std::abs(part.c[0] - value) > sum) return;
  const bool monotonic = std::abs(part.c[1]) > slopes;
  if (!monotonic && halvings > 0) {
    append_on(p, value, low, (low + high) / 2, halvings - 1, places);
    append_on(p, value, (low + high) / 2, high, halvings - 1, places);
    return;
  }
  const Real before = values[0] - value, after = values[p.degree] - value;
  if ((before < 0) == (after < 0)) return;
  Real below = low, above = high;
  for (int k = 0; k < 66; ++k) {
    const Real middle = (below + above) / 2;
    ((p.at(middle) - value < 0) == (before < 0) ? below : above) = middle;
  }
  places.push_back(below);
}

}  // namespace

Real ChebyshevSeries::place(std::size_t degree, std::size_t j) { return tables().place[degree][j]; }

ChebyshevSeries ChebyshevSeries::through(std::size_t degree, const Real* values) {
  ChebyshevSeries p;
  p.degree = degree;
  if (degree == 0) {
    p.c[0] = values[0];
    return p;
  }
  const auto& transform = tables().transform[degree];
  for (std::size_t k = 0; k <= degree; ++k)
    for (std::size_t j = 0; j <= degree; ++j) p.c[k] += transform[k][j] * values[j];
  return p;
}

Real ChebyshevSeries::at(Real x) const {
  Real b1 = 0, b2 = 0;
  for (std::size_t k = degree; k > 0; --k) {
    const Real b = c[k] + 2 * x * b1 - b2;
    b2 = b1;
    b1 = b;
  }
  return c[0] + x * b1 - b2;
}

ChebyshevSeries ChebyshevSeries::integral() const {
  ChebyshevSeries result;
  result.degree = degree + 1;
  const auto coefficient = [&](std::size_t k) { return k <= degree ? c[k] : 0; };
  Real at_start = 0;
  for (std::size_t k = 1; k <= degree + 1; ++k) {
    const Real before = k == 1 ? 2 * c[0] : coefficient(k - 1);
    result.c[k] = (before - coefficient(k + 1)) / (2 * static_cast<Real>(k));
    at_start += k % 2 == 0 ? result.c[k] : -result.c[k];
  }
  result.c[0] = -at_start;
  return result;
}

void ChebyshevSeries::append_crossings(Real value, std::vector<Real>& places) const {
  if (degree == 0) return;
  if (degree > 1) {
    append_on(*this, value, -1, 1, 60, places);
    return;
  }
  const Real x = (value - c[0]) / c[1];
  if (c[1] != 0 && x > -1 && x < 1) places.push_back(x);
}

}  // namespace hiac::test
