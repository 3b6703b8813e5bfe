#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace hiac::test {

/// A polynomial on [-1, 1] by its Chebyshev coefficients, in extended precision.
struct ChebyshevSeries {
  using Real = long double;
  static constexpr std::size_t kMostDegree = 32;

  std::size_t degree = 0;
  std::array<Real, kMostDegree + 1> c{};

  /// The polynomial that takes values[j] at place(degree, j).
  static ChebyshevSeries through(std::size_t degree, const Real* values);
  /// The j-th Chebyshev point, from -1 (j = 0) to 1.
  static Real place(std::size_t degree, std::size_t j);

  [[nodiscard]] Real at(Real x) const;
  /// The integral from -1 to x; of a polynomial of degree below kMostDegree.
  [[nodiscard]] ChebyshevSeries integral() const;

  /// Appends every place in (-1, 1) at which the polynomial takes a value, passing it, ascending:
  /// on parts on which the coefficients show that it is monotonic, or away from the value.
  void append_crossings(Real value, std::vector<Real>& places) const;
};

}  // namespace hiac::test
