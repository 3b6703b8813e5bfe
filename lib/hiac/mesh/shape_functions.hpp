#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "hiac/mesh/cell_kind.hpp"

namespace hiac {

/// The largest number of nodes of any kind.
inline constexpr std::size_t kMaxNodesPerCell = 32;

/// Reference coordinates of a kind's nodes, in the nodes' order. The reference cell is the convex
/// hull of the first corner_count(kind) nodes; its faces are planar and it is positively oriented.
/// The other nodes divide its edges evenly; the cubic tetrahedron also has nodes at face centres.
///
///     tetrahedron   0 <= x, y, z;  x + y + z <= 1
///     pyramid       0 <= x, y, z;  x + z <= 1,  y + z <= 1
///     prism         0 <= x, y;  x + y <= 1;  0 <= z <= 1
///     wedge         0 <= x <= 2 - y - z;  0 <= y, z <= 1
///     brick         0 <= x, y, z <= 1
///
/// These are VTK's parametric coordinates with three exceptions: the prism (node 1 at (0,1,0) and
/// node 2 at (1,0,0) make it positively oriented: see ShapeTopology), the pyramid (VTK uses a brick
/// with a collapsed face, (x, y) / (1 - z) here), and the wedge, which VTK does not have.
std::span<const std::array<double, 3>> reference_nodes(CellKind kind);

/// The shape functions N_i of a kind at a point of the reference cell: values[i] belongs to node i.
///
/// They are 1 at their own node and 0 at the others, sum to 1, and reproduce linear fields
/// (sum N_i(xi) xi_i = xi), so that the isoparametric map of an affine image of the reference cell
/// is that affine map. On a face they depend only on the face's own nodes, in the same way for
/// every shape: bilinear and serendipity on quadrilaterals, P1 and P2 on triangles, and on
/// triangles of cubic kinds P3 without the centre (whose value is a quarter of the edge nodes'
/// minus a sixth of the corners'). Only the cubic tetrahedron has the centres and all of P3.
/// Tetrahedra of every order are complete; linear kinds are complete to degree 1, other quadratic
/// and cubic kinds to degree 2, the cubic brick to degree 3. The wedge is complete to degree 1
/// only, because its trapezoidal faces, interpolated as serendipity quadrilaterals, are not
/// complete.
///
/// Requires values.size() >= node_count(kind). Real is double or long double. Points outside the
/// reference cell are evaluated by the same formulae.
template <typename Real>
void shape_functions(CellKind kind, const std::array<Real, 3>& xi, std::span<Real> values);

/// The gradients of the shape functions in reference coordinates: gradients[i][j] is dN_i / dxi_j.
///
/// At a pyramid's apex and a wedge's node 6 the gradient depends on the direction of approach; the
/// result is the limit along the direction through the middle of the opposite faces.
template <typename Real>
void shape_gradients(CellKind kind, const std::array<Real, 3>& xi,
                     std::span<std::array<Real, 3>> gradients);

}  // namespace hiac
