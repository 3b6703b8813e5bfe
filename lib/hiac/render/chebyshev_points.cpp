#include "hiac/render/chebyshev_points.hpp"

#include <cmath>
#include <numbers>

namespace hiac {

ChebyshevPoints::ChebyshevPoints(std::size_t n) : n_(n) {
  // cos(pi i / n) for i < 2 n, exact where it matters: at the ends and in the middle
  std::array<double, 2 * kMostChebyshevDegree> cosine{};
  for (std::size_t i = 0; i < 2 * n; ++i)
    cosine[i] = 2 * i % n == 0 && i % n != 0
                    ? 0
                    : std::cos(std::numbers::pi * static_cast<double>(i) / static_cast<double>(n));
  const auto halved = [n](std::size_t i) { return i == 0 || i == n ? 0.5 : 1.0; };
  for (std::size_t j = 0; j <= n; ++j) {
    place_[j] = 0.5 - 0.5 * cosine[j];
    for (std::size_t k = 0; k <= n; ++k)
      transform_[k][j] =
          2 * halved(k) * halved(j) * cosine[(n - j) * k % (2 * n)] / static_cast<double>(n);
  }
}

void ChebyshevPoints::coefficients(const double* values, std::size_t stride, double* c) const {
  for (std::size_t k = 0; k <= n_; ++k) {
    c[k] = 0;
    for (std::size_t j = 0; j <= n_; ++j) c[k] += transform_[k][j] * values[j * stride];
  }
}

const ChebyshevPoints& chebyshev_points(std::size_t n) {
  static const std::array<ChebyshevPoints, 7> kPoints{
      ChebyshevPoints(1), ChebyshevPoints(2), ChebyshevPoints(3), ChebyshevPoints(4),
      ChebyshevPoints(5), ChebyshevPoints(8), ChebyshevPoints(16)};
  return kPoints[n <= 5 ? n - 1 : n / 8 + 4];
}

const ChebyshevPowers& chebyshev_powers() {
  static const ChebyshevPowers kPowers = [] {
    ChebyshevPowers t{};
    t[0][0] = t[1][1] = 1;
    for (std::size_t k = 2; k < t.size(); ++k)
      for (std::size_t i = 0; i <= k; ++i)
        t[k][i] = (i > 0 ? 2 * t[k - 1][i - 1] : 0) - t[k - 2][i];
    return t;
  }();
  return kPowers;
}

namespace {

std::vector<std::vector<double>> make_between(std::size_t n) {
  const ChebyshevPoints &known = chebyshev_points(n), &wanted = chebyshev_points(2 * n);
  std::vector<std::vector<double>> weights(n, std::vector<double>(n + 1, 1));
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i <= n; ++i)
      for (std::size_t k = 0; k <= n; ++k)
        if (k != i)
          weights[j][i] *=
              (wanted.place(2 * j + 1) - known.place(k)) / (known.place(i) - known.place(k));
  return weights;
}

}  // namespace

const std::vector<std::vector<double>>& between_points(std::size_t n) {
  static const std::array<std::vector<std::vector<double>>, 2> kWeights{make_between(4),
                                                                        make_between(8)};
  return kWeights[n / 8];
}

}  // namespace hiac
