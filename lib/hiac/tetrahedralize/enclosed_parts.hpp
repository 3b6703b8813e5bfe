#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// The name of the cell field with the numbers of the parts of space that a surface encloses.
inline constexpr const char* kRegionField = "region";

/// One part of the space that a surface encloses.
struct EnclosedPart {
  std::array<double, 3> point{};  ///< inside it: the middle of its roundest large tetrahedron
  double volume = 0;              ///< world units cubed
};

/// Numbers the parts of a mesh of tetrahedra from 1: `parts` names the part of every cell in any
/// way (not negative), and becomes its number. `surface_points` are those of the surface; nodes are
/// at them exactly, or are further ones. Of two parts that one comes first whose first surface
/// point (by x, then y, then z) comes first; if it is the same, the next points decide in the same
/// way. A part thus comes before those that it surrounds, and numbers depend neither on the file's
/// order nor on the tetrahedra.
void number_parts(const ZooMesh& mesh, std::span<const std::array<double, 3>> surface_points,
                  std::vector<double>& parts);

/// The parts of a mesh of tetrahedra that has the field kRegionField with numbers from 1 on; part n
/// is number n - 1.
std::vector<EnclosedPart> enclosed_parts(const ZooMesh& mesh);

/// The numbers of the parts at a point, rising, from the same field: one number inside a part,
/// several on a face between parts, none outside. On the mesh's boundary, 0 stands for what is
/// outside. Exact for the coordinates as given.
std::vector<std::uint32_t> parts_at(const ZooMesh& mesh, const std::array<double, 3>& point);

}  // namespace hiac
