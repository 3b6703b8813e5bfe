#pragma once

namespace hiac::test {

/// The integrals of a linear piece (hiac/optics/linear_piece.hpp), each correctly rounded or off by
/// one unit in the last place at most.
struct ExactPiece {
  double zeta;
  double alpha;  ///< 1 - zeta
  double psi;
  double front;  ///< 1 - Psi
  double back;   ///< Psi - zeta
  double psi0;   ///< Psi - Psi_1
  double psi1;
};

/// From the closed forms in error functions, in Arb's ball arithmetic, at a precision that is
/// raised until every ball is narrower than 2^-70 of its value.
ExactPiece exact_linear_piece(double b, double a);

/// The functions of hiac/optics/special_functions.hpp, in ball arithmetic likewise.
double exact_erfcx(double x);
double exact_ierfcx(double x);
double exact_dawson(double x);
double exact_dawson_derivative(double x);

}  // namespace hiac::test
