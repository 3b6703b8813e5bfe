#pragma once

#include <string>
#include <vector>

#include "hiac/mesh/boundary_surface.hpp"

namespace hiac::formats {

// All write a file completely or not at all, and return notes on what it cannot hold. They throw
// InputError naming the file.

/// Binary STL. A note tells how far points move at most, as they become single precision.
std::vector<std::string> write_stl(const std::string& path, const BoundarySurface& surface);

/// Binary little-endian PLY in double precision. A component of a field is a property of the
/// vertices, or of the faces if it belongs to triangles: NAME, NAME_x ... or NAME_0 ..., with '_'
/// for what is neither a letter nor a digit.
std::vector<std::string> write_ply(const std::string& path, const BoundarySurface& surface);

/// VTK's XML format of polygons, every number as it is in memory.
std::vector<std::string> write_vtp(const std::string& path, const BoundarySurface& surface);

}  // namespace hiac::formats
