#pragma once

#include <array>

#include "hiac/geometry/bezier_patch.hpp"

namespace hiac {

/// Returns the sign of det(P, P_u, P_v) on a patch: +1 or -1 if the patch, seen from the
/// coordinates' origin, turns the same way everywhere, 0 if it may turn both ways. P holds a
/// point's coordinates relative to the eye, or the homogeneous coordinates of its projection, (x w,
/// y w, w), which are (x, y, 1) in a parallel view.
///
/// The determinant is a polynomial. For degree 1 it is of degree 1 in u and in v, and its corners
/// decide; for higher degrees, Bernstein coefficients that all have one sign by more than rounding
/// are a proof. `nets`: the three coordinates.
int patch_facing(const PatchShape& shape, const std::array<PatchNet<double>, 3>& nets);

}  // namespace hiac
