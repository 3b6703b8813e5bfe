#pragma once

#include <cmath>

#include "hiac/base/rounding.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// A node of a mesh for rays: its place on the screen and its depth (ProjectedNode), and its value
/// of the field.
struct alignas(32) RayNode {
  double x, y, depth, field;
};

/// Shewchuk's bound A, relative, of a 2 x 2 determinant of rounded differences ("Adaptive Precision
/// Floating-Point Arithmetic and Fast Robust Geometric Predicates", 1997, section 4.2).
inline constexpr double kSideError = (3.0 + 16.0 * kUnit) * kUnit;
/// Products below this may have lost digits to underflow.
inline constexpr double kLeastSide = 0x1p-900;

/// is_left where the filter does not decide.
bool is_left_exactly(const RayNode& a, NodeId id_a, const RayNode& b, NodeId id_b, double x,
                     double y);

/// Whether (a - p) x (b - p) > 0 on the screen, p being the point (x, y). Never undecided, and
/// exact: p counts as moved to the right by an infinitesimal amount and down by a much smaller one,
/// and of two nodes in one place the one with the smaller number counts as moved down by an
/// amount smaller still (H. Edelsbrunner, E. Muecke, "Simulation of Simplicity", 1990). So
/// exchanging a and b negates the result, and p lies in just two faces of every tetrahedron that
/// covers it, in none of any other.
inline bool is_left(const RayNode& a, NodeId id_a, const RayNode& b, NodeId id_b, double x,
                    double y) {
  const double one = (a.x - x) * (b.y - y), two = (a.y - y) * (b.x - x);
  const double side = one - two;
  if (std::abs(side) > kSideError * (std::abs(one) + std::abs(two)) + kLeastSide) return side > 0;
  return is_left_exactly(a, id_a, b, id_b, x, y);
}

}  // namespace hiac
