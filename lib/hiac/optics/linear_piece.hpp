#pragma once

namespace hiac {

/// The effect of one linear piece of a ray: I = c_front front + c_back back is the radiance that
/// leaves its front, and `transparency` is the fraction of the light behind it that passes.
struct LinearPieceWeights {
  double transparency;
  double front;
  double back;
};

// A linear piece is a stretch of a ray on which extinction and colour are linear in the distance.
// It is given by dimensionless numbers: b = tau_front L and a = tau_back L, the extinction
// coefficients at its two ends times its length L. With u from 0 (front) to 1 (back),
//     A(u) = b u + (a - b) u^2 / 2,    zeta = exp(-A(1)),
//     Psi = int_0^1 exp(-A),           Psi_1 = int_0^1 u exp(-A).
//
// Both functions accept finite b, a >= 0, equal, zero and denormal numbers included. The relative
// error of every result, and of the sum front + back, is at most 1e-14 for b, a <= 1e6 (for
// denormal results: at most two units of the smallest denormal, absolute). Densities above 1e150,
// infinite ones included, count as 1e150.
// Williams, Max, Stein 1998, equation (8) and appendix B, reformulated so that nothing overflows or
// cancels; the methods are in linear_piece_series.hpp (thin and medium) and linear_piece.cpp.

/// Chromaticity glow dI/dt = kappa tau - tau I: front = 1 - Psi weighs kappa_front, back =
/// Psi - zeta weighs kappa_back. front + back is the piece's opacity 1 - zeta.
LinearPieceWeights linear_piece_weights(double b, double a);

/// Emission glow dI/dt = g - tau I: front = Psi - Psi_1 weighs L g_front, back = Psi_1 weighs
/// L g_back. front + back is Psi.
LinearPieceWeights linear_piece_emission(double b, double a);

}  // namespace hiac
