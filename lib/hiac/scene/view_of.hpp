#pragma once

#include "hiac/geometry/view.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

/// The view of a camera: the part that decides a visibility order.
inline View view_of(const Camera& camera) {
  return {camera.projection == Projection::perspective, camera.eye, view_direction(camera)};
}

}  // namespace hiac
