#pragma once

#include <array>
#include <cstdint>

#include "hiac/geometry/bezier_patch.hpp"
#include "hiac/geometry/patch_zeros.hpp"

namespace hiac {

/// One curved face of a cell on the screen, in homogeneous coordinates: a point lies at (x / w,
/// y / w), at the ray parameter t.
struct CurvedFace {
  PatchShape shape;
  std::uint8_t number;                // of the cell
  std::array<std::uint8_t, 4> edges;  // of the cell's surface, around the face
  std::array<bool, 4> along;          // whether the edge's own direction agrees with the face's
  std::array<std::array<double, 3>, 4> reference;  // coordinates of the corners
  PatchNet<double> x, y, w, t;
  double rounding;  // that of the coordinates
  int turns;        // patch_facing, or 0
  std::array<double, 2> guess;
  // of the current row
  PatchNet<double> height;  // of the control points above the row
  bool in_row;
  int first, last;  // columns

  /// Where the ray of the pixel whose centre is `center` meets the face.
  PatchZeros crossings(double center, int winding);
  /// The ray parameter of a crossing.
  [[nodiscard]] double parameter(const PatchZero& zero) const;
  /// Reference coordinates of a point.
  [[nodiscard]] std::array<double, 3> reference_at(double u, double v) const;

  /// How far the ray parameter of the computed crossing (u, v) may be from that of the point where
  /// the ray meets the true face, if that is displaced continuously, and on the screen nowhere by
  /// more than `moved` in the units of x and y. The residual of the computed point is included.
  ///
  /// The bound is proven. Let J be the Jacobian, at the point, of the distances (a, b) of the face
  /// from the ray. Second derivatives in Bernstein form bound how far the map is from linear on a
  /// box around the point; if the Newton map with J^-1 takes the box into itself, then by Brouwer's
  /// theorem the displaced face meets the ray in the box (the existence test of R. Krawczyk, 1969).
  /// Returns infinity if a box of twice the linear map's size fails this test: then the ray touches
  /// the face to within rounding.
  [[nodiscard]] double moved_along(double u, double v, double center, double moved) const;
};

}  // namespace hiac
