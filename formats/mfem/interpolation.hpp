#pragma once

#include <cstddef>
#include <vector>

#include "formats/mfem/dof_map.hpp"

namespace hiac::formats::mfem {

/// For every point of lattice_points(geometry, order) the weights with which the values at those
/// of the space's order make the function's value there: row by row, one column a value. Orders are
/// ones that the geometry can be of, the space's not above `order`. Cubes: products of Lagrange
/// polynomials; simplices: Silvester's (P. Silvester, 1969) at evenly spaced points, and of cubic
/// ones at Gauss-Lobatto points the polynomials along their edges, the face's centre being in its
/// place.
std::vector<std::vector<double>> interpolation(Geometry geometry, const Space& space, int order);

/// The Gauss-Lobatto points in [0, 1] that a polynomial of that order is told by.
std::vector<double> gauss_lobatto_points(int order);

}  // namespace hiac::formats::mfem
