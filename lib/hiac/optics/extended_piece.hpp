#pragma once

namespace hiac {

/// LinearPieceWeights (linear_piece.hpp) in extended precision.
struct ExtendedPieceWeights {
  long double transparency, front, back;
};

/// Returns the weights of chromaticity and of emission for finite b, a >= 0, with errors of up to
/// 2e-18 of the sum of the two weights (for the transparency: 2e-18 times 1 + the optical depth).
/// The piece is divided into parts of optical depth up to 1/4, on which exp(-A) is a power series;
/// parts behind opaque ones are neglected.
ExtendedPieceWeights extended_piece_weights(long double b, long double a);
ExtendedPieceWeights extended_piece_emission(long double b, long double a);

}  // namespace hiac
