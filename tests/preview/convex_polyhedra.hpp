#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "hiac/preview/regions/subdivision.hpp"

namespace hiac::test {

/// A polyhedron that is convex exactly: the hull of points, found by brute force with exact signs.
struct HullPolyhedron {
  std::vector<std::array<double, 3>> corners;
  /// Each counter-clockwise seen from outside; coplanar triangles are one face.
  std::vector<std::vector<std::uint16_t>> faces;

  [[nodiscard]] std::vector<preview::PolyhedronEdge> edges() const;
  /// The corners seen along z.
  [[nodiscard]] std::vector<preview::ScreenPoint> projected() const;
};

/// Empty when the points lie in one plane. At most 65535 points.
HullPolyhedron hull_of(const std::vector<std::array<double, 3>>& points);

/// A hull of at most `points` random points: of a lattice with `side` points along an edge or, with
/// side 0, anywhere in the unit cube. Every third one is a prism along z, with walls seen edge-on.
HullPolyhedron random_polyhedron(std::mt19937_64& random, std::size_t points, unsigned side);

}  // namespace hiac::test
