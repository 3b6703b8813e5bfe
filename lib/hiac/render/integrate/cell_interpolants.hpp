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
  std::vector<std::size_t> first;  ///< index of each segment's first piece; one past the end last

  /// The pieces of segment k; empty if they were not found.
  [[nodiscard]] std::span<const FieldAlongRay::Piece> of(std::size_t k) const {
    return std::span(pieces).subspan(first[k], first[k + 1] - first[k]);
  }
};

/// Finds the fields along segments of a cell of any kind many at a time, as FieldAlongRay does one
/// at a time. Overwrites the padding behind the segments. A segment gets no pieces if Newton's
/// iteration from a nearby start does not find its points in the cell, or if its fields would need
/// too short pieces.
void interpolate_cell_segments(const Frame& frame, const CellPolynomials& cell,
                               CellSegments& segments, SegmentPieces& found);

}  // namespace hiac
