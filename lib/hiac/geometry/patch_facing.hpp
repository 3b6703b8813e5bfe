#pragma once

#include <array>

#include "hiac/geometry/bezier_patch.hpp"

namespace hiac {

/// The sign of det(P, P_u, P_v) on a patch: as seen from the coordinates' origin it turns one way
/// everywhere (+1, -1), or it may turn both ways (0). P may be a point's coordinates from the eye,
/// or homogeneous ones of its projection, (x w, y w, w); in a parallel view (x, y, 1).
///
/// The determinant is a polynomial: of degree 1 in u and v for degree 1, where its corners decide;
/// else its Bernstein coefficients, all of one sign by more than rounding, are a proof. `nets`: the
/// three coordinates.
int patch_facing(const PatchShape& shape, const std::array<PatchNet<double>, 3>& nets);

}  // namespace hiac
