#pragma once

#include <cstddef>
#include <vector>

#include "hiac/frame/frame.hpp"
#include "hiac/frame/surfaces/skin_sides.hpp"
#include "hiac/frame/tiles/tile.hpp"

namespace hiac {

/// A pixel whose ray passes an edge or the outline of the skin to within rounding.
struct OutlineDoubt {
  std::size_t at;  ///< the pixel's index in the tile's planes
  /// Where the ray meets one of two planar faces, and rounding decides which: the angle between
  /// their normals. Infinite where it may miss the skin, or meet any of several faces.
  double angle;
  const SkinSide* other;  ///< of these two the face that is not the cell's; null if any
};

/// Appends the pixels of a tile that are in doubt about the skin of a cell. `displaced`: how far
/// the cell's faces may be off, world units (RayDisplacement::at_ends). Needs FrameSkin::sides.
///
/// In doubt are rays that pass edges of the skin, and those that graze a curved face: the face
/// comes as near to them as it may be off at a place where it may turn over. Bernstein coefficients
/// exclude this for all others, part by part.
void append_outline_doubts(const Frame& frame, CellId cell, const TileRect& tile, double displaced,
                           std::vector<OutlineDoubt>& doubts);

}  // namespace hiac
