#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace hiac {

/// A planar facet of a surface: polygons in one plane, and points inside its holes.
struct Facet {
  std::vector<std::vector<std::uint32_t>> polygons;  ///< indices into Surface::points, in order
  std::vector<std::array<double, 3>> holes;
};

/// A part of the enclosed space, identified by a point in it.
struct Region {
  std::array<double, 3> point;
  double attribute = 0;
  double max_volume = -1;  ///< of its tetrahedra; not positive: no limit
};

/// Closed surfaces, and facets inside them: a piecewise linear complex. World units.
struct Surface {
  std::vector<std::array<double, 3>> points;
  std::vector<Facet> facets;
  std::vector<std::array<double, 3>> holes;  ///< a point in every part that stays empty
  std::vector<Region> regions;

  /// Returns whether every facet is a single triangle.
  [[nodiscard]] bool triangulated() const {
    for (const Facet& facet : facets)
      if (facet.polygons.size() != 1 || facet.polygons[0].size() != 3) return false;
    return true;
  }
};

}  // namespace hiac
