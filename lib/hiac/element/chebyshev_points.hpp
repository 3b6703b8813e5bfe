#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace hiac {

/// Largest number of intervals between Chebyshev points that fields are interpolated in.
inline constexpr std::size_t kMostChebyshevDegree = 20;

/// The Chebyshev points x_j = cos(pi j / n) and the transform from values there to coefficients.
class ChebyshevPoints {
 public:
  explicit ChebyshevPoints(std::size_t n);

  [[nodiscard]] std::size_t degree() const { return n_; }

  /// The j-th point from the front, in [0, 1].
  [[nodiscard]] double place(std::size_t j) const { return place_[j]; }
  /// The weight in coefficient k of the value at the j-th point from the front.
  [[nodiscard]] double transform(std::size_t k, std::size_t j) const { return transform_[k][j]; }
  /// The weight of the value at the j-th point from the front in the coefficient of x^k of the
  /// polynomial through the values.
  [[nodiscard]] double power(std::size_t k, std::size_t j) const { return power_[k][j]; }

  /// Computes the coefficients. `values[j * stride]`: the value at the j-th point from the front.
  void coefficients(const double* values, std::size_t stride, double* c) const;

 private:
  std::size_t n_;
  std::array<double, kMostChebyshevDegree + 1> place_{};
  std::array<std::array<double, kMostChebyshevDegree + 1>, kMostChebyshevDegree + 1> transform_{},
      power_{};
};

/// The points for n intervals, 1 <= n <= kMostChebyshevDegree.
const ChebyshevPoints& chebyshev_points(std::size_t n);

/// Chebyshev polynomials in powers, up to that of degree kMostChebyshevDegree + 1: the coefficient
/// of z^i in T_k is [k][i].
using ChebyshevPowers =
    std::array<std::array<double, kMostChebyshevDegree + 2>, kMostChebyshevDegree + 2>;
const ChebyshevPowers& chebyshev_powers();

/// How a value at a point is predicted from known points: by the polynomial through the known
/// values.
struct PointPrediction {
  std::size_t point;              ///< index of the predicted point
  std::vector<std::size_t> from;  ///< indices of known points
  std::vector<double> weights;    ///< of these
};

/// The Chebyshev points, without the ends, of an even n <= kMostChebyshevDegree, in an order in
/// which each can be predicted from the previous ones and the ends.
const std::vector<PointPrediction>& points_in_turn(std::size_t n);

/// The points of `wanted`, all predicted from those of `known`; both numbers are even and at most
/// kMostChebyshevDegree. A point that is itself known is predicted from that point alone.
const std::vector<PointPrediction>& points_from(std::size_t known, std::size_t wanted);

}  // namespace hiac
