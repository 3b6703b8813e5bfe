#include "hiac/tetrahedralize/winding_number.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "hiac/geometry/predicates.hpp"

namespace hiac {
namespace {

using Position = std::array<double, 3>;

constexpr Position kAlongX{1, 0, 0};

int sign(double x) { return (x > 0) - (x < 0); }

// The side of the directed edge from a to b on which the moved point is, as seen from ahead, with x
// towards the eye: 1 to its left, -1 to its right; 0 when the edge is seen as a point.
int side_of_edge(const Position& a, const Position& b, const Position& p) {
  if (const int side = orientation_towards(a, b, p, kAlongX); side != 0) return side;
  // cross((b - a), (dy, dz)) in the plane of y and z: first for the move along y, then along z
  if (b[2] != a[2]) return -sign(b[2] - a[2]);
  return sign(b[1] - a[1]);
}

// 1 where the ray leaves through the triangle, -1 where it enters, 0 where it misses it.
int crossing(const Position& a, const Position& b, const Position& c, const Position& p) {
  if (std::max({a[0], b[0], c[0]}) < p[0]) return 0;
  for (const std::size_t axis : {std::size_t{1}, std::size_t{2}}) {
    const auto [low, high] = std::minmax({a[axis], b[axis], c[axis]});
    if (p[axis] < low || p[axis] > high) return 0;
  }
  const int turn = orientation_towards(a, b, c, kAlongX);
  if (turn == 0) return 0;
  if (side_of_edge(a, b, p) != turn || side_of_edge(b, c, p) != turn ||
      side_of_edge(c, a, p) != turn)
    return 0;
  // the plane is ahead where the point is on the side that looks back
  return orientation(a, b, c, p) == -turn ? turn : 0;
}

std::uint32_t root_of(std::vector<std::uint32_t>& parent, std::uint32_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

// An edge of a triangle, with the lesser point first.
struct TriangleEdge {
  std::uint32_t low, high;
  std::uint32_t triangle;
  int direction;  // 1 where the triangle runs from the lesser point to the other, else -1

  [[nodiscard]] bool same(const TriangleEdge& other) const {
    return low == other.low && high == other.high;
  }
};

// Edges with the same points follow one another.
std::vector<TriangleEdge> sorted_edges(const Surface& surface) {
  std::vector<TriangleEdge> edges;
  edges.reserve(3 * surface.facets.size());
  for (std::uint32_t t = 0; t < surface.facets.size(); ++t) {
    const auto& corners = surface.facets[t].polygons[0];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = corners[k], b = corners[(k + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), t, a < b ? 1 : -1});
    }
  }
  std::ranges::sort(edges, {}, [](const TriangleEdge& e) { return std::pair(e.low, e.high); });
  return edges;
}

}  // namespace

SurfaceOrientation surface_orientation(const Surface& surface) {
  SurfaceOrientation found;
  std::vector<std::uint32_t> parent(surface.facets.size());
  std::iota(parent.begin(), parent.end(), 0U);
  const std::vector<TriangleEdge> edges = sorted_edges(surface);
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    int balance = 0;
    for (; end < edges.size() && edges[end].same(edges[begin]); ++end) {
      balance += edges[end].direction;
      parent[root_of(parent, edges[end].triangle)] = root_of(parent, edges[begin].triangle);
    }
    found.opposed_edges += balance != 0 ? 1 : 0;
    found.single_shell &= end - begin == 2;
  }
  for (std::uint32_t t = 0; t < surface.facets.size(); ++t)
    found.single_shell &= root_of(parent, t) == root_of(parent, 0);
  return found;
}

int winding_number(const Surface& surface, const Position& point) {
  int winding = 0;
  for (const Facet& facet : surface.facets) {
    const auto at = [&](std::size_t k) -> const Position& {
      return surface.points[facet.polygons[0][k]];
    };
    winding += crossing(at(0), at(1), at(2), point);
  }
  return winding;
}

}  // namespace hiac
