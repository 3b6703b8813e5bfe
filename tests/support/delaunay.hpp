#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace hiac::test {

/// The Delaunay tetrahedra of distinct points, positively oriented (CGAL's Delaunay triangulation:
/// GPL, in tests and benchmarks alone).
std::vector<std::array<std::uint32_t, 4>> delaunay_tetrahedra(
    const std::vector<std::array<double, 3>>& points);

}  // namespace hiac::test
