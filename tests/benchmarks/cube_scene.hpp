#pragma once

#include <cstdint>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/order/visibility_order.hpp"
#include "hiac/scene/scene.hpp"
#include "hiac/scene/view_of.hpp"

namespace hiac {

/// A parallel view of the unit cube, side x side pixels, and transfer functions of a field `f` from
/// 0 to 1: four colour points, six extinction points.
inline Scene cube_scene(std::uint32_t side) {
  Scene scene;
  scene.image = {side, side};
  scene.camera.projection = Projection::orthographic;
  scene.camera.eye = {3.1, 2.3, 2.7};
  scene.camera.look_at = {0.5, 0.5, 0.5};
  scene.camera.up = {0, 0, 1};
  scene.camera.height = 1.75;
  scene.camera.fov = 27;
  scene.volume.color = ColorTransfer{"f",
                                     {{0.0, {0.1, 0.2, 0.9}},
                                      {0.35, {0.2, 0.9, 0.3}},
                                      {0.6, {0.95, 0.8, 0.1}},
                                      {1, {0.9, 0.1, 0.1}}}};
  scene.volume.extinction = ExtinctionTransfer{
      "f", {{0.0, {0.2}}, {0.25, {0.6}}, {0.45, {4}}, {0.55, {0.5}}, {0.8, {6}}, {1, {1}}}};
  return scene;
}

/// Requires that the mesh has its adjacency.
inline OrderResult order_of(const ZooMesh& mesh, const Scene& scene) {
  return exact_order(mesh, *mesh.adjacency, view_of(scene.camera), scene.render.planarity);
}

}  // namespace hiac
