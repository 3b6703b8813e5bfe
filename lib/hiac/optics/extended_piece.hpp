#pragma once

namespace hiac {

/// LinearPieceWeights (linear_piece.hpp) in extended precision.
struct ExtendedPieceWeights {
  long double transparency, front, back;
};

/// For b, a >= 0, both finite: the weights of chromaticity and of emission, to 2e-18 of the sum of
/// the two (of the transparency: to 2e-18 times 1 + the optical depth). The piece is cut in parts
/// of optical depths up to 1/4, on which exp(-A) is its power series; what lies behind parts that
/// let nothing through is left out.
ExtendedPieceWeights extended_piece_weights(long double b, long double a);
ExtendedPieceWeights extended_piece_emission(long double b, long double a);

}  // namespace hiac
