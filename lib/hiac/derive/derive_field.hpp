#pragma once

#include <string>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// Returns the field that a formula, NAME=EXPRESSION, defines over the fields of a mesh.
///
/// An expression is computed for every node, cell or corner by itself (muParser's operators and
/// functions: + - * / ^, comparisons, && || and c ? a : b, sqrt, exp, ln, sin, min ...). Its names:
///
///     NAME, NAME:x, NAME:xx, NAME:von_mises   a scalar, as scalar_field takes it; "any name":x
///     magnitude(NAME), von_mises(NAME) ...    the same as NAME:magnitude, NAME:von_mises ...
///     node_average(NAME), cell_average(NAME)  a scalar at the nodes or cells (averages.hpp)
///     x, y, z, pi                             coordinates (of a cell: the mean of its nodes),
///     unless
///                                             a field has that name
///
/// A formula may also be one of these as a whole, which have several components:
///
///     vector(a, b, c), tensor(xx, yy, zz, xy, yz, xz)      of expressions
///     deviator(NAME), principal(NAME)                      of a tensor; principal values descend
///     node_average(NAME), cell_average(NAME)               of any field
///
/// Values belong to corners if one of the fields' do, else to nodes or to cells; fields of nodes
/// and of cells are not combined. The unit is that of the field where the formula names one alone.
/// Throws UsageError if the formula is not understood, a name is unknown, or the mesh already has a
/// field NAME at that location.
Field derive_field(const ZooMesh& mesh, const std::string& formula);

}  // namespace hiac
