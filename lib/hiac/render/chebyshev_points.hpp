#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace hiac {

/// Largest number of intervals between Chebyshev points that fields are interpolated in.
inline constexpr std::size_t kMostChebyshevDegree = 16;

/// The Chebyshev points x_j = cos(pi j / n) and the transform from values there to coefficients.
class ChebyshevPoints {
 public:
  explicit ChebyshevPoints(std::size_t n);

  /// The j-th point from the front, in [0, 1].
  [[nodiscard]] double place(std::size_t j) const { return place_[j]; }
  /// What coefficient k has of the value at the j-th point from the front.
  [[nodiscard]] double transform(std::size_t k, std::size_t j) const { return transform_[k][j]; }

  /// `values[j * stride]`: at the j-th point from the front.
  void coefficients(const double* values, std::size_t stride, double* c) const;

 private:
  std::size_t n_;
  std::array<double, kMostChebyshevDegree + 1> place_{};
  std::array<std::array<double, kMostChebyshevDegree + 1>, kMostChebyshevDegree + 1> transform_{};
};

/// Those for n = 1, 2, 3, 4, 5, 8 or 16.
const ChebyshevPoints& chebyshev_points(std::size_t n);

/// Chebyshev polynomials in powers: the coefficient of z^i in T_k is [k][i].
using ChebyshevPowers =
    std::array<std::array<double, kMostChebyshevDegree + 1>, kMostChebyshevDegree + 1>;
const ChebyshevPowers& chebyshev_powers();

/// The polynomial through values at the points of n = 4 or 8, at those points of 2 n that these are
/// not: [which of them][value], front to back.
const std::vector<std::vector<double>>& between_points(std::size_t n);

}  // namespace hiac
