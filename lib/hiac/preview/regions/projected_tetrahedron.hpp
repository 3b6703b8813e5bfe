#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "hiac/preview/regions/screen_predicates.hpp"

namespace hiac::preview {

/// The projection of a tetrahedron as triangles around the point where it is seen thickest (P.
/// Shirley, A. Tuchman, "A Polygonal Approximation to Direct Scalar Volume Rendering", 1990).
///
/// The projected corners satisfy one affine relation (Radon's): a mean of the corners with one sign
/// is a mean of those with the other. That point is where two opposite edges cross (class 2, four
/// triangles), or a corner in front of a face (class 1, three), in front of an edge (class 3, two)
/// or in front of a corner (class 4, one): one triangle for each pair of corners of opposite sign,
/// with the two other corners as its rim.
///
/// Two of these triangles have one outline with the thickest point on a side of it, three with the
/// point inside: the outline of the whole is one triangle or, in class 2, two.
struct ProjectedTetrahedron {
  unsigned count;                                      ///< of triangles: 0 (no area) to 4
  unsigned outlines;                                   ///< 0 to 2
  std::array<std::array<std::uint8_t, 3>, 2> outline;  ///< of their corners
  ScreenPoint at;                                      ///< the thickest point
  std::array<double, 4> front, back;                   ///< it as a mean of the corners
  bool outline_is_front;  ///< whether the outlines' own faces are on the side of `front`
  double front_depth, back_depth;
};

/// The signs are exact for the coordinates as given.
ProjectedTetrahedron project_tetrahedron(std::span<const ScreenPoint, 4> points,
                                         std::span<const double, 4> depths);

}  // namespace hiac::preview
