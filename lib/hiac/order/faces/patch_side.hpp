#pragma once

#include <array>

#include "hiac/geometry/face_form.hpp"
#include "hiac/geometry/vector.hpp"
#include "hiac/geometry/view.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// The side of a face that rays cross both ways.
inline constexpr int kBothSides = 2;

/// Returns which way rays cross a bilinear patch with its corners in order, as eye_side does: +1,
/// -1, 0 (none crosses it), or kBothSides. The sign of (P - e).(P_u x P_v) is that of a bilinear
/// function of u and v, and so is bounded by its signs at the corners, each the exact orientation
/// of one corner's triangle. If the signs differ, rays cross both ways, unless the patch is planar
/// to within `planarity` and seen edge-on but for the rounding of its coordinates. (Choosing an
/// arrow by the plane of some of the corners would be arbitrary, and many such arrows form cycles.)
int eye_side_of_patch(const std::array<Point3, 4>& corners, const View& view, double planarity);

/// Returns the same for a face with curved edges (form.shape.degree above 1) whose corners have the
/// orientation of the kind's table. Never 0: a face that is seen edge-on may be crossed both ways.
int eye_side_of_curved_face(const ZooMesh& mesh, CellId cell, std::size_t face,
                            const FaceForm& form, const View& view);

}  // namespace hiac
