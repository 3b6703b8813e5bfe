#pragma once

#include "hiac/element/face_interpolant.hpp"
#include "hiac/frame/projection.hpp"

namespace hiac {

/// Of the largest offset on a face: where an isosurface's field is less than this off its value on
/// a tetrahedron's face, rounding may give it the wrong sign, and face_value decides.
inline constexpr double kOffsetDoubt = 0x1p-36;

/// The offset at the point where the ray of the screen point (x, y) crosses the face, at the ray
/// parameter t: the interpolant of the face's own nodes. It depends on the face and the point
/// alone, in whichever order the face's corners are listed: the cells on its two sides find the
/// same number, to the bit. It decides on which side of an isosurface a point lies that is on it to
/// within rounding.
double face_value(const ZooMesh& mesh, const Projector& projector, const FaceOffsets& face,
                  double x, double y, double t);

}  // namespace hiac
