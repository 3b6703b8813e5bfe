#include "hiac/tetrahedralize/surface_parts.hpp"

#include <cstdint>
#include <map>
#include <numeric>

namespace hiac {
namespace {

std::uint32_t root_of(std::vector<std::uint32_t>& parent, std::uint32_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

// Six times the volume of the tetrahedron from an origin to a triangle (the divergence theorem).
double six_volumes(const Surface& surface, const std::vector<std::uint32_t>& triangle,
                   const std::array<double, 3>& origin) {
  std::array<std::array<double, 3>, 3> e{};
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t c = 0; c < 3; ++c) e[k][c] = surface.points[triangle[k]][c] - origin[c];
  return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) +
         e[0][1] * (e[1][2] * e[2][0] - e[1][0] * e[2][2]) +
         e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

}  // namespace

std::vector<double> enclosed_volumes(const Surface& surface) {
  std::vector<std::uint32_t> parent(surface.points.size());
  std::iota(parent.begin(), parent.end(), 0U);
  for (const Facet& facet : surface.facets)
    for (const std::uint32_t corner : facet.polygons[0])
      parent[root_of(parent, corner)] = root_of(parent, facet.polygons[0][0]);
  std::map<std::uint32_t, std::size_t> part_of_root;
  std::vector<double> volumes;
  for (const Facet& facet : surface.facets) {
    const std::uint32_t root = root_of(parent, facet.polygons[0][0]);
    const auto [part, is_new] = part_of_root.emplace(root, volumes.size());
    if (is_new) volumes.push_back(0);
    volumes[part->second] += six_volumes(surface, facet.polygons[0], surface.points[root]) / 6;
  }
  return volumes;
}

}  // namespace hiac
