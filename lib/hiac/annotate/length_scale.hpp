#pragma once

#include "hiac/annotate/annotation_part.hpp"

namespace hiac {

/// A bar of a length in the world, which is stated above it. In perspective that holds in the plane
/// through look_at parallel to the screen, and the text says so.
AnnotationPart length_scale(const LengthAnnotation& wanted, const Scene& scene,
                            Lettering lettering);

/// Pixels per world unit, parallel to the screen, at the camera's look_at.
double pixels_per_unit(const Scene& scene);

}  // namespace hiac
