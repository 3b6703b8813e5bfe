#pragma once

#include <array>

#include "hiac/geometry/face_form.hpp"
#include "hiac/geometry/vector.hpp"
#include "hiac/geometry/view.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// Rays cross a face both ways.
inline constexpr int kBothSides = 2;

/// Which way rays cross a bilinear patch, its corners in order: as eye_side says it, +1, -1, 0
/// (none do), or kBothSides. The sign of (P - e).(P_u x P_v) is bilinear in u, v and so is bounded
/// by its signs at the corners, each the exact orientation of one corner's triangle. With signs of
/// both kinds rays cross both ways, unless the patch is planar to within `planarity` and seen
/// edge-on but for the rounding of its coordinates. (An arrow by the plane of some of its corners
/// would be a throw of dice: many make cycles.)
int eye_side_of_patch(const std::array<Point3, 4>& corners, const View& view, double planarity);

/// The same of a face with curved edges (form.shape.degree above 1), whose corners turn as the
/// kind's table lists them. Never 0: what is seen edge-on may be crossed both ways.
int eye_side_of_curved_face(const ZooMesh& mesh, CellId cell, std::size_t face,
                            const FaceForm& form, const View& view);

/// The points whose convex hull holds a curved face: its control points.
PatchNet<Vector> hull_of_face(const ZooMesh& mesh, CellId cell, std::size_t face,
                              const FaceForm& form);

}  // namespace hiac
