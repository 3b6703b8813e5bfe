#pragma once

#include <span>

namespace hiac {

/// Where a batch of pieces leaves its results; all spans as long as the batch.
struct LinearPieceOutput {
  std::span<double> transparency;
  std::span<double> front;
  std::span<double> back;
};

/// linear_piece_weights (linear_piece.hpp) of the pieces (b[i], a[i]), with the widest vectors that
/// the processor has. Element i depends on b[i] and a[i] alone, so it does not matter how pieces
/// are dealt out to batches. Outputs must not overlap inputs.
/// Throws std::invalid_argument when the spans differ in length.
void linear_piece_weights(std::span<const double> b, std::span<const double> a,
                          const LinearPieceOutput& out);

/// The same for linear_piece_emission.
void linear_piece_emission(std::span<const double> b, std::span<const double> a,
                           const LinearPieceOutput& out);

}  // namespace hiac
