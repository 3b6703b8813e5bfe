#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include "hiac/element/cell_field.hpp"
#include "hiac/frame/interval_range.hpp"
#include "hiac/frame/transfer_table.hpp"
#include "hiac/optics/polynomial_roots.hpp"
#include "hiac/render/bounds/error_bound.hpp"

namespace hiac {

/// One field in one cell, and the intervals of its transfer function that it may reach there.
struct CellScalars {
  CellField nodes;
  IntervalRange intervals;

  [[nodiscard]] bool constant() const { return nodes.least == nodes.most; }
};

template <std::size_t N>
CellScalars cell_scalars(const ZooMesh& mesh, CellId cell, const FrameField& field,
                         const TransferTable<N>& table) {
  const CellField nodes = cell_field(mesh, cell, field);
  return {nodes, {classify_value(nodes.least, table).low, classify_value(nodes.most, table).high}};
}

/// Whether a transfer function has one value in the whole cell.
template <std::size_t N>
bool is_flat(const TransferTable<N>& table, const CellScalars& scalars) {
  if (scalars.constant()) return true;
  const auto [low, high] = scalars.intervals;
  return low == high &&
         std::ranges::all_of(table.slope, [k = low](const auto& slope) { return slope[k] == 0; });
}

/// The steepest slope of a transfer function on some intervals; infinite where it jumps there.
template <std::size_t N>
double steepest_slope(const TransferTable<N>& table, IntervalRange range) {
  double steepest = 0;
  for (std::size_t c = 0; c < N; ++c)
    for (std::size_t k = range.low; k <= range.high; ++k) {
      steepest = std::max(steepest, std::abs(table.slope[c][k]));
      if (k == range.low) continue;
      const auto at_breakpoint = [&](std::size_t piece) {
        return table.value[c][piece] +
               table.slope[c][piece] * (table.lower[k] - table.anchor[piece]);
      };
      const double before = at_breakpoint(k - 1), after = at_breakpoint(k);
      const double rounding =
          8 * std::numeric_limits<double>::epsilon() * (std::abs(before) + std::abs(after));
      if (std::abs(after - before) > rounding) return std::numeric_limits<double>::infinity();
    }
  return steepest;
}

/// Sets the error that the polynomials of both fields may have in a cell (CellField::allowed), such
/// that it changes a pixel by at most `share`. `length`: that of the longest ray through the mesh.
void set_allowed_errors(const Frame& frame, double length, double share, CellScalars& color,
                        CellScalars& extinction);

/// The length of the part of [0, 1] on which a polynomial is within `error` of a value. `roots`:
/// scratch. `Real`: double or long double.
template <class Real>
Real doubtful_part(const BasicBernstein<Real>& f, std::type_identity_t<Real> value,
                   std::type_identity_t<Real> error, std::vector<BasicRootEnclosure<Real>>& roots);

/// The doubt about a field that is given by polynomials along a segment: its `error`, and the sum
/// of its transfer function's jumps in the cell, each times the length on which the field is within
/// its error of the jump. `which`: the field's index in a piece; `rounding`: that of the function's
/// values in the cell.
template <std::size_t N, class Piece, class Real>
FieldDoubt polynomial_doubt(const TransferTable<N>& table, double rounding,
                            const CellScalars& scalars, const std::vector<Piece>& pieces,
                            std::size_t which, double error, double length,
                            std::vector<BasicRootEnclosure<Real>>& roots) {
  FieldDoubt doubt{error, 0};
  for (std::size_t k = std::max<std::size_t>(scalars.intervals.low, 1); k <= scalars.intervals.high;
       ++k) {
    const double jump = table.lower[k] < scalars.nodes.least ? 0 : jump_at(table, k, rounding);
    if (jump == 0) continue;
    for (const Piece& piece : pieces)
      doubt.jumped +=
          jump * length *
          static_cast<double>((piece.end - piece.begin) *
                              doubtful_part(piece.fields[which], table.lower[k], error, roots));
  }
  return doubt;
}

}  // namespace hiac
