#pragma once

#include <span>

namespace hiac {

/// The output arrays for a batch of pieces; all spans are as long as the batch.
struct LinearPieceOutput {
  std::span<double> transparency;
  std::span<double> front;
  std::span<double> back;
};

/// Computes linear_piece_weights (linear_piece.hpp) of the pieces (b[i], a[i]), with the widest
/// vectors that the processor has. Element i depends only on b[i] and a[i], so that the division
/// into batches does not matter. Outputs must not overlap inputs. Throws std::invalid_argument if
/// the spans differ in length.
void linear_piece_weights(std::span<const double> b, std::span<const double> a,
                          const LinearPieceOutput& out);

/// Computes linear_piece_emission likewise.
void linear_piece_emission(std::span<const double> b, std::span<const double> a,
                           const LinearPieceOutput& out);

/// Computes PieceRule::mean_color with chromaticity glow likewise.
void linear_piece_mean_color(std::span<const double> b, std::span<const double> a,
                             const LinearPieceOutput& out);

}  // namespace hiac
