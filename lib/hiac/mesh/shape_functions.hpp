#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "hiac/mesh/cell_kind.hpp"

namespace hiac {

/// The largest number of nodes of any kind.
inline constexpr std::size_t kMaxNodesPerCell = 32;

/// Reference coordinates of a kind's nodes, in the nodes' order. The reference cell is the convex
/// polyhedron of the first corner_count(kind) of them; its faces are planar and it is positively
/// oriented; the other nodes divide its edges evenly (and centre the cubic tetrahedron's faces).
///
///     tetrahedron   0 <= x, y, z;  x + y + z <= 1
///     pyramid       0 <= x, y, z;  x + z <= 1,  y + z <= 1
///     prism         0 <= x, y;  x + y <= 1;  0 <= z <= 1
///     wedge         0 <= x <= 2 - y - z;  0 <= y, z <= 1
///     brick         0 <= x, y, z <= 1
///
/// These are VTK's parametric coordinates, but for the prism (node 1 at (0,1,0), node 2 at (1,0,0),
/// so that it is positively oriented: see ShapeTopology), the pyramid (VTK's are those of a brick
/// with a collapsed face, (x, y) / (1 - z) here) and the wedge, which VTK does not have.
std::span<const std::array<double, 3>> reference_nodes(CellKind kind);

/// The shape functions N_i of a kind at a point of the reference cell: values[i] is that of node i.
///
/// They are 1 at their own node and 0 at the others, sum to 1, and reproduce linear fields
/// (sum N_i(xi) xi_i = xi), so that the isoparametric map of an affine image of the reference cell
/// is that affine map. On a face they depend on the face's own nodes alone, in the same way for
/// every shape: bilinear and serendipity on quadrilaterals, P1 and P2 on triangles, and on
/// triangles of cubic kinds P3 without the centre (whose value is a quarter of the edge nodes'
/// minus a sixth of the corners'). The cubic tetrahedron alone has the centre and all of P3.
/// Complete are: tetrahedra of every order; to degree 1 the linear kinds, to degree 2 the other
/// quadratic and cubic kinds, to degree 3 also the cubic brick; but the wedge to degree 1 always,
/// since its trapezoidal faces, taken as serendipity quadrilaterals, are not complete either.
///
/// Requires values.size() >= node_count(kind). Real is double or long double. Points outside the
/// reference cell are evaluated by the same formulae.
template <typename Real>
void shape_functions(CellKind kind, const std::array<Real, 3>& xi, std::span<Real> values);

/// Their gradients in reference coordinates: gradients[i][j] is dN_i / dxi_j.
///
/// At a pyramid's apex and a wedge's node 6 the gradient depends on the direction in which one
/// comes there; the one given is that of the direction through the middle of the opposite faces.
template <typename Real>
void shape_gradients(CellKind kind, const std::array<Real, 3>& xi,
                     std::span<std::array<Real, 3>> gradients);

}  // namespace hiac
