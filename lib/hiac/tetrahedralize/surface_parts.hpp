#pragma once

#include <vector>

#include "hiac/tetrahedralize/surface.hpp"

namespace hiac {

/// The volume that each connected part of a surface of triangles encloses, in the order of the
/// parts' first facets: positive where its triangles go around counter-clockwise as seen from
/// outside, negative where as seen from inside (around a cavity). Requires surface.triangulated().
/// Parts are connected by points that they share. World units cubed; rounded.
std::vector<double> enclosed_volumes(const Surface& surface);

}  // namespace hiac
