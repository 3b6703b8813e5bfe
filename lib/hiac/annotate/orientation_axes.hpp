#pragma once

#include <array>

#include "hiac/annotate/annotation_part.hpp"

namespace hiac {

/// A unit vector along an axis of the world as it is seen at the camera's look_at.
struct SeenAxis {
  double x, y;  ///< on the screen: to the right, down; (0, 0) along the view direction
  double away;  ///< from the viewer, -1 to 1
};

/// The axes x, y and z. At the picture's centre, perspective and parallel projection show the same
/// directions.
std::array<SeenAxis, 3> seen_axes(const Camera& camera, ImageSize size);

/// Three arrows with their names from the centre of a square; an arrow that points at the viewer or
/// away from it is a dot.
AnnotationPart orientation_axes(const AxesAnnotation& wanted, const Scene& scene,
                                Lettering lettering);

}  // namespace hiac
