#pragma once

#include "hiac/tetrahedralize/surface.hpp"

namespace hiac::test {

/// The surface of a box in twelve triangles that turn counter-clockwise seen from outside.
inline Surface box_surface(const std::array<double, 3>& low, const std::array<double, 3>& high) {
  Surface surface;
  for (const double z : {low[2], high[2]})
    for (const double y : {low[1], high[1]})
      for (const double x : {low[0], high[0]}) surface.points.push_back({x, y, z});
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    surface.facets.push_back({{{a, b, c}}, {}});
    surface.facets.push_back({{{a, c, d}}, {}});
  };
  add(0, 2, 3, 1), add(4, 5, 7, 6), add(0, 1, 5, 4), add(2, 6, 7, 3), add(0, 4, 6, 2),
      add(1, 3, 7, 5);
  return surface;
}

/// Both surfaces in one, sharing no point.
inline Surface with(Surface a, const Surface& b) {
  const auto offset = static_cast<std::uint32_t>(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (Facet facet : b.facets) {
    for (auto& polygon : facet.polygons)
      for (std::uint32_t& corner : polygon) corner += offset;
    a.facets.push_back(facet);
  }
  return a;
}

}  // namespace hiac::test
