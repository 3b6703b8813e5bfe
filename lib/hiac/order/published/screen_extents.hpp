#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hiac/geometry/view.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// Bounds on a window that runs from -1 to 1 in x and y, widened by more than rounding: cells whose
/// bounds are apart in x, y, x + y or x - y are met by no common ray through the window.
struct ScreenExtent {
  float x_low, x_high, y_low, y_high;
  float sum_low, sum_high, difference_low, difference_high;
};

/// The cells that a window sees, by ascending rank.
struct WindowCells {
  std::vector<std::uint32_t> ranks;
  std::vector<ScreenExtent> extents;
};

/// The x and y extents of the first two tests of Obstructs (Williams, Max, Stein 1998, section 6),
/// of cells given by rank. On one window when all of the mesh lies well before the eye, or the view
/// is a parallel one; else on six, the sides of a cube around the eye: every ray goes through one
/// of them, and cells on it meet there or not at all.
std::vector<WindowCells> screen_extents(const ZooMesh& mesh, const View& view,
                                        std::span<const CellId> cells);

}  // namespace hiac
