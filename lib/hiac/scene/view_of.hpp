#pragma once

#include "hiac/geometry/view.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

/// Returns the part of a camera that decides a visibility order.
inline View view_of(const Camera& camera) {
  return {camera.projection == Projection::perspective, camera.eye, view_direction(camera)};
}

}  // namespace hiac
