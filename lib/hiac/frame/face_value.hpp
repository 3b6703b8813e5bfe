#pragma once

#include "hiac/element/face_interpolant.hpp"
#include "hiac/frame/projection.hpp"

namespace hiac {

/// Relative to the largest offset on a tetrahedron's face: rounding may change the sign of smaller
/// offsets from an isosurface's value, and face_value decides.
inline constexpr double kOffsetDoubt = 0x1p-36;

/// The offset at the point where the ray of the screen point (x, y) crosses the face, at the ray
/// parameter t: the interpolant of the face's own nodes. It depends only on the face and the point,
/// not on the order of the face's corners: the cells on its two sides find the same number, to the
/// bit. It decides on which side of an isosurface a point lies that is within rounding of it.
double face_value(const ZooMesh& mesh, const Projector& projector, const FaceOffsets& face,
                  double x, double y, double t);

}  // namespace hiac
