#pragma once

#include <array>
#include <cstddef>

#include "hiac/frame/projection.hpp"
#include "hiac/geometry/extended_vector.hpp"
#include "hiac/geometry/inverse_map.hpp"
#include "hiac/mesh/cell_kind.hpp"

namespace hiac {

// Directions are unit vectors in the camera's frame: right, up, forward.

/// The direction of the ray through a point of the screen, away from the eye.
std::array<double, 3> ray_through(const Projector& projector, double x, double y);
/// The same where the ray's scale, Projector::ray_scale, is known.
std::array<double, 3> ray_through(const Projector& projector, double x, double y, double scale);

/// The normal of a plane between two directions in it, in the world. A face without area is seen
/// from no side: any normal does.
std::array<double, 3> normal_between(const Projector& projector, const ExtendedVector& a,
                                     const ExtendedVector& b);

/// A cell's isoparametric map.
struct MappedCell {
  CellKind kind;
  std::array<CellMap::Point, CellMap::kMostNodes> nodes;  ///< relative_positions
};

/// The normal of a curved face at a point of it, in reference coordinates.
std::array<double, 3> normal_at(const Projector& projector, const MappedCell& cell,
                                std::size_t face, const std::array<double, 3>& reference);

/// Whether a curved face turns one side to the ray of pixel (x, y) all the way between two of its
/// points, in reference coordinates.
bool is_one_side(const Projector& projector, const MappedCell& cell, std::size_t face,
                 const std::array<double, 3>& from, const std::array<double, 3>& to, int x, int y);

}  // namespace hiac
