#pragma once

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// Returns a cell's signed volume: the integral of the Jacobian determinant of its isoparametric
/// map over the reference cell. What is turned inside out counts negatively.
///
/// Gauss-Legendre rules in the unit cube, which is collapsed to the other shapes (A. H. Stroud,
/// "Approximate Calculation of Multiple Integrals", 1971, section 2.4), with as many points as make
/// it exact for tetrahedra, prisms and bricks and for linear pyramids.
double signed_volume(const ZooMesh& mesh, CellId cell);

}  // namespace hiac
