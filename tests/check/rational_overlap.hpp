#pragma once

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac::test {

/// Whether the interiors of two convex cells with planar faces have a point in common, in rational
/// numbers and by brute force: every point where three planes of their faces meet, kept where it is
/// on the inner side of all planes or on them, is a corner of what the cells have in common; that
/// has an interior where the corners do not all lie in one plane.
bool interiors_meet(const ZooMesh& mesh, CellId a, CellId b);

}  // namespace hiac::test
