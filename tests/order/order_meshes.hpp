#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "hiac/geometry/view.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "tests/support/meshes.hpp"

namespace hiac::test {

/// A view with a name for messages.
struct NamedView {
  std::string name;
  View view;
};

NamedView from_eye(std::string name, const Position& eye);
NamedView along(std::string name, const Position& direction);

/// Views of something in the unit cube: from outside, from inside, from its corners, edges and
/// middle planes; along random directions and along the axes.
std::vector<NamedView> all_views();

/// Those of them that are tried.
std::vector<NamedView> many_views();

/// The one of them that has this name; std::out_of_range where none has.
View view_named(std::string_view name);

/// Turned by a rotation that no coordinate survives, so that planes hold to rounding alone.
Position turned(const Position& p);

/// The mesh torn along the plane x = 0.5 where z > `front`: the cells on either side have nodes of
/// their own there, at the same places. (Of a mesh that has that plane, and nodes at z = front.)
ZooMesh torn(const ZooMesh& mesh, double front);

/// The same cells with their nodes numbered the other way round: inverted, where `which` says.
ZooMesh inverted(const ZooMesh& mesh, const std::function<bool(CellId)>& which);

/// A triangular prism (cell 0) around the z axis and, about it, three bricks (cells 1, 2, 3) whose
/// common faces lean the same way round, so that seen from the axis each is in part in front of the
/// next:
///
///            A1 -------- A0        faces a_k A_k lean against the direction away from the axis
///              \  a1-a0 /          (z from 0 to 1)
///               \  \|  /
///                \ a2 /
///                 A2
ZooMesh pinwheel();

/// Two layers of three bricks each over
///
///             7             the upper one of which has corner 0 in line with 3 and 4; all numbers
///         3   0   4         of a layer are turned so that this corner has the number `in_line`
///         2   1   5         (0 to 7; 6 is not there)
///
ZooMesh corners_in_line(NodeId in_line);

/// Two layers of tetrahedra whose diagonals on the square between them cross, with a flat
/// tetrahedron (cell 0) there that joins them.
ZooMesh flat_between();

/// `sectors` prisms around the z axis, from z = 0 to 1, that go around it `turns` times, each over
/// less than half a turn: the boundary bends outwards at all of its edges.
ZooMesh wound(int sectors, int turns);

}  // namespace hiac::test
