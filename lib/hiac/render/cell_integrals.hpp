#pragma once

#include <cstdint>
#include <vector>

#include "hiac/render/cell_polynomials.hpp"
#include "hiac/render/frame.hpp"

namespace hiac {

/// Intervals of transfer tables in which the fields of a cell lie, inclusive.
struct CellIntervals {
  std::size_t color_low, color_high, extinction_low, extinction_high;
};

/// Segments of rays in one cell: structure of arrays, of `count` and more places.
struct CellSegments {
  static constexpr std::size_t kPadding = 7;  ///< most places of a vector behind the last one

  std::size_t count = 0;
  std::vector<double> x, y;                       ///< of pixels' centres
  std::vector<double> front, back;                ///< ray parameters
  bool known = false;                             ///< whether there are known_u, known_v, known_w
  std::vector<double> known_u, known_v, known_w;  ///< collapsed coordinates near the front
  std::vector<double> length;                     ///< world units
  std::vector<double> allowed;                    ///< absolute error of colours and transparency
  std::vector<double> red, green, blue, transparency;  ///< results
  std::vector<std::uint8_t> done;                      ///< whether there are results

  /// Makes place for `most` segments and their padding; there are none yet.
  void start(std::size_t most, bool with_known);
};

/// Integrates segments, behind which it writes kPadding without meaning, of a cell of any kind
/// many at a time: fields along rays as in field_along_ray.hpp, radiance as in
/// polynomial_piece.hpp, both without bounds of rounding. `intervals`: of the transfer functions,
/// in which the fields are in the cell. Segments whose places in the cell Newton's iteration does
/// not find from nearby, or whose fields too short pieces would have to be interpolated on, are not
/// done.
void integrate_cell_segments(const Frame& frame, const CellPolynomials& cell,
                             const CellIntervals& intervals, CellSegments& segments);

}  // namespace hiac
