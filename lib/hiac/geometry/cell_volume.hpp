#pragma once

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// Returns the volume of a cell with its curved faces, in world units cubed; negative if the cell
/// is left-handed. It is the integral of the Jacobian determinant of the cell's isoparametric map:
/// what is turned inside out counts negatively.
///
/// By the divergence theorem it is a third of the sum over the faces of the integral of
/// x . (x_u x x_v) du dv, which is a polynomial on every face (bezier_patch.hpp): in closed form
/// for triangles and bilinear faces, by a rule of Gauss that is exact for it otherwise.
double signed_volume(const ZooMesh& mesh, CellId cell);

}  // namespace hiac
