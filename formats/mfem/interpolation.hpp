#pragma once

#include <cstddef>
#include <vector>

#include "formats/mfem/dof_map.hpp"

namespace hiac::formats::mfem {

/// For every evenly spaced point of lattice_points(geometry, cells), the weights of the values at
/// the space's points that give the function's value there: row by row, one column per value. The
/// geometry must allow both orders, and the space's order is at most that of the cells; if they are
/// equal, both have the same points in pyramids. Cubes: products of Lagrange
/// polynomials; simplices: Silvester's polynomials (P. Silvester, 1969) for evenly spaced points;
/// for cubic ones with Gauss-Lobatto points, Lagrange polynomials along the edges, while the
/// centres of the faces coincide. Bernstein's polynomials are evaluated there.
std::vector<std::vector<double>> interpolation(Geometry geometry, const Space& space,
                                               const Space& cells);

/// The Gauss-Lobatto points in [0, 1] at which a polynomial of that order is given.
std::vector<double> gauss_lobatto_points(int order);

}  // namespace hiac::formats::mfem
