#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hiac/element/cell_polynomials.hpp"
#include "hiac/element/field_along_ray.hpp"
#include "hiac/frame/frame.hpp"
#include "hiac/render/cells/cell_segments.hpp"

namespace hiac {

/// Fields along segments of one cell, each in polynomial pieces.
struct SegmentPieces {
  std::vector<FieldAlongRay::Piece> pieces;  ///< segment by segment, front to back
  std::vector<std::size_t> first;            ///< of a segment's, and behind the last one's

  /// Of segment k; none where they were not found.
  [[nodiscard]] std::span<const FieldAlongRay::Piece> of(std::size_t k) const {
    return std::span(pieces).subspan(first[k], first[k + 1] - first[k]);
  }
};

/// Finds the fields along segments, behind which it writes kPadding without meaning, of a cell of
/// any kind many at a time, as FieldAlongRay does one at a time. There are none of segments whose
/// places in the cell Newton's iteration does not find from nearby, or whose fields too short
/// pieces would have to be interpolated on.
void interpolate_cell_segments(const Frame& frame, const CellPolynomials& cell,
                               CellSegments& segments, SegmentPieces& found);

}  // namespace hiac
