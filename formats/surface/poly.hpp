#pragma once

#include <string>

#include "hiac/tetrahedralize/surface.hpp"

namespace hiac::formats {

/// TetGen's piecewise linear complexes, .poly and .smesh (H. Si, "TetGen, User's Manual", 1.5,
/// section 5.2): points here or in the .node file beside it, facets, holes, regions. Throws
/// InputError naming the line.
Surface read_poly(const std::string& path);

}  // namespace hiac::formats
