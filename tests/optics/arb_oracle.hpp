#pragma once

#include <cstddef>
#include <vector>

namespace hiac::test {

/// The integrals of a linear piece (hiac/optics/linear_piece.hpp), each correctly rounded or off by
/// one unit in the last place at most.
template <class Real>
struct BasicExactPiece {
  Real zeta;
  Real alpha;  ///< 1 - zeta
  Real psi;
  Real front;  ///< 1 - Psi
  Real back;   ///< Psi - zeta
  Real psi0;   ///< Psi - Psi_1
  Real psi1;
};
using ExactPiece = BasicExactPiece<double>;
using ExtendedExactPiece = BasicExactPiece<long double>;

/// From the closed forms in error functions, in Arb's ball arithmetic, at a precision that is
/// raised until every ball is narrower than 2^-70 of its value.
ExactPiece exact_linear_piece(double b, double a);
ExtendedExactPiece extended_exact_piece(double b, double a);

/// The functions of hiac/optics/special_functions.hpp, in ball arithmetic likewise.
double exact_erfcx(double x);
double exact_ierfcx(double x);
double exact_dawson(double x);
double exact_dawson_derivative(double x);

/// erfcx, ierfcx, dawson and dawson_derivative, each divided by its weight: s, s^2, x s^2 and s^2
/// with s = 2 / (x + 2) = 1 - t.
enum class WeightedFunction { erfcx, ierfcx, dawson, dawson_derivative };

/// Coefficients, by powers of y from -1 to 1, of the first `degree` + 1 terms of the series in
/// Chebyshev polynomials of a weighted function on t = (low + high) / 2 + y (high - low) / 2; the
/// series is that of its interpolant in 28 points. 0 <= low < high <= 1.
std::vector<double> exact_powers(WeightedFunction function, double low, double high,
                                 std::size_t degree);

}  // namespace hiac::test
