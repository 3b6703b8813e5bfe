#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace hiac {

/// Returns the Delaunay tetrahedra of points, positively oriented (CGAL's Delaunay triangulation
/// with exact predicates: GPL, see LICENSES-OF-BINARIES.md). Corners are indices of the points; of
/// several points at one place, one is used. There are no tetrahedra if all points lie in one
/// plane.
std::vector<std::array<std::uint32_t, 4>> delaunay_tetrahedra(
    std::span<const std::array<double, 3>> points);

}  // namespace hiac
