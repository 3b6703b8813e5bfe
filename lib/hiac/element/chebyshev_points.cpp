#include "hiac/element/chebyshev_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

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
    for (std::size_t i = 0; i <= n; ++i)
      for (std::size_t k = i; k <= n; k += 2)
        power_[i][j] += chebyshev_powers()[k][i] * transform_[k][j];
  }
}

void ChebyshevPoints::coefficients(const double* values, std::size_t stride, double* c) const {
  for (std::size_t k = 0; k <= n_; ++k) {
    c[k] = 0;
    for (std::size_t j = 0; j <= n_; ++j) c[k] += transform_[k][j] * values[j * stride];
  }
}

const ChebyshevPoints& chebyshev_points(std::size_t n) {
  static const std::vector<ChebyshevPoints> kPoints = [] {
    std::vector<ChebyshevPoints> points;
    for (std::size_t k = 1; k <= kMostChebyshevDegree; ++k) points.emplace_back(k);
    return points;
  }();
  return kPoints[n - 1];
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

// The prediction of one of the points of `wanted` from some of `known`: Lagrange's weights.
PointPrediction prediction(const ChebyshevPoints& wanted, std::size_t point,
                           const ChebyshevPoints& known, const std::vector<std::size_t>& from) {
  PointPrediction p{point, from, std::vector<double>(from.size(), 1)};
  for (std::size_t i = 0; i < from.size(); ++i)
    for (const std::size_t k : from)
      if (k != from[i])
        p.weights[i] *=
            (wanted.place(point) - known.place(k)) / (known.place(from[i]) - known.place(k));
  return p;
}

// The middle from the ends, then every other point from these three, then the rest from all those.
std::vector<PointPrediction> make_points_in_turn(std::size_t n) {
  const ChebyshevPoints& points = chebyshev_points(n);
  std::vector<std::size_t> known{0, n};
  std::vector<PointPrediction> order;
  const auto predict = [&](std::size_t first, std::size_t step) {
    const std::vector<std::size_t> from = known;
    for (std::size_t j = first; j < n; j += step) {
      if (std::ranges::find(from, j) != from.end()) continue;
      order.push_back(prediction(points, j, points, from));
      known.push_back(j);
    }
  };
  predict(n / 2, n);
  predict(2, 2);
  predict(1, 1);
  return order;
}

std::vector<PointPrediction> make_points_from(std::size_t known, std::size_t wanted) {
  std::vector<std::size_t> from(known + 1);
  std::iota(from.begin(), from.end(), std::size_t{0});
  std::vector<PointPrediction> all;
  for (std::size_t j = 0; j <= wanted; ++j) {
    const std::vector<std::size_t> same{j * known / wanted};
    all.push_back(prediction(chebyshev_points(wanted), j, chebyshev_points(known),
                             j * known % wanted == 0 ? same : from));
  }
  return all;
}

constexpr std::size_t kEvenDegrees = kMostChebyshevDegree / 2;

}  // namespace

const std::vector<PointPrediction>& points_in_turn(std::size_t n) {
  static const auto kOrders = [] {
    std::array<std::vector<PointPrediction>, kEvenDegrees> orders;
    for (std::size_t k = 0; k < orders.size(); ++k) orders[k] = make_points_in_turn(2 * (k + 1));
    return orders;
  }();
  return kOrders[n / 2 - 1];
}

const std::vector<PointPrediction>& points_from(std::size_t known, std::size_t wanted) {
  static const auto kAll = [] {
    std::array<std::array<std::vector<PointPrediction>, kEvenDegrees>, kEvenDegrees> all;
    for (std::size_t k = 0; k < kEvenDegrees; ++k)
      for (std::size_t w = 0; w < kEvenDegrees; ++w)
        all[k][w] = make_points_from(2 * (k + 1), 2 * (w + 1));
    return all;
  }();
  return kAll[known / 2 - 1][wanted / 2 - 1];
}

}  // namespace hiac
