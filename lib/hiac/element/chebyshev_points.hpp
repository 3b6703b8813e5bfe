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
  /// What coefficient k has of the value at the j-th point from the front.
  [[nodiscard]] double transform(std::size_t k, std::size_t j) const { return transform_[k][j]; }
  /// What the coefficient of x^k has of the value at the j-th point from the front, in the
  /// polynomial through them.
  [[nodiscard]] double power(std::size_t k, std::size_t j) const { return power_[k][j]; }

  /// `values[j * stride]`: at the j-th point from the front.
  void coefficients(const double* values, std::size_t stride, double* c) const;

 private:
  std::size_t n_;
  std::array<double, kMostChebyshevDegree + 1> place_{};
  std::array<std::array<double, kMostChebyshevDegree + 1>, kMostChebyshevDegree + 1> transform_{},
      power_{};
};

/// 1 <= n <= kMostChebyshevDegree.
const ChebyshevPoints& chebyshev_points(std::size_t n);

/// Chebyshev polynomials in powers, up to that of degree kMostChebyshevDegree + 1: the coefficient
/// of z^i in T_k is [k][i].
using ChebyshevPowers =
    std::array<std::array<double, kMostChebyshevDegree + 2>, kMostChebyshevDegree + 2>;
const ChebyshevPowers& chebyshev_powers();

/// How points between known ones are found from these: by polynomials through what is known.
struct PointPrediction {
  std::size_t point;              ///< of what is wanted
  std::vector<std::size_t> from;  ///< of what is known
  std::vector<double> weights;    ///< of these
};

/// The Chebyshev points of an even n <= kMostChebyshevDegree but for the ends, in an order in which
/// each can be predicted from those before it and the ends.
const std::vector<PointPrediction>& points_in_turn(std::size_t n);

/// Those of `wanted`, all predicted from those of `known`; both even and at most
/// kMostChebyshevDegree. What is among the known ones is from that alone.
const std::vector<PointPrediction>& points_from(std::size_t known, std::size_t wanted);

}  // namespace hiac
