#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "hiac/tetrahedralize/surface.hpp"

namespace hiac {

/// The defects because of which a surface of triangles encloses no part of space. Triangles are
/// indices into Surface::facets, edges are pairs of Surface::points.
struct SurfaceDefects {
  struct Edge {
    std::array<std::uint32_t, 2> points;
    std::uint32_t triangle;  ///< a triangle that has it
  };
  std::vector<Edge> open;                                             ///< of a single triangle
  std::vector<std::pair<std::uint32_t, std::uint32_t>> intersecting;  ///< triangles, less first
  std::vector<std::uint32_t> degenerate;                              ///< triangles without area

  [[nodiscard]] bool none() const {
    return open.empty() && intersecting.empty() && degenerate.empty();
  }
};

/// Finds the defects exactly (CGAL's predicates; pairs by its box intersection: GPL). Two triangles
/// intersect if they have more in common than the corner or edge that they share by number.
/// Requires surface.triangulated().
SurfaceDefects find_surface_defects(const Surface& surface);

}  // namespace hiac
