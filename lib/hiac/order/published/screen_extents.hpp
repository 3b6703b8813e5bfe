#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hiac/geometry/view.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// Bounds of a cell on a window that runs from -1 to 1 in x and y, widened by more than rounding:
/// no ray through the window meets two cells whose bounds are disjoint in x, y, x + y or x - y.
struct ScreenExtent {
  float x_low, x_high, y_low, y_high;
  float sum_low, sum_high, difference_low, difference_high;
};

/// The cells that a window sees, by ascending rank.
struct WindowCells {
  std::vector<std::uint32_t> ranks;
  std::vector<ScreenExtent> extents;
};

/// Returns the x and y extents for the first two tests of Obstructs (Williams, Max, Stein 1998,
/// section 6) of cells given by rank. There is one window if all of the mesh lies well in front of
/// the eye or the view is a parallel one. Otherwise there are six, the sides of a cube around the
/// eye: every ray passes through one of them, and two cells on that ray overlap there.
std::vector<WindowCells> screen_extents(const ZooMesh& mesh, const View& view,
                                        std::span<const CellId> cells);

}  // namespace hiac
