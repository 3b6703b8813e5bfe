#include "hiac/frame/surfaces/skin.hpp"

#include <algorithm>

#include "hiac/frame/surfaces/boundary_faces.hpp"

namespace hiac {
FrameSkin make_skin(const ZooMesh& mesh, const Scene& scene, const Projector& projector) {
  FrameSkin result;
  if (!scene.skin) return result;
  const Skin& skin = *scene.skin;
  result.faces = boundary_faces(mesh);
  result.look = look_of(skin);
  result.lights = frame_lights(scene.lights, projector);
  result.largest_light = largest_light(skin, scene.lights);
  if (!skin.color_by) return result;
  const Field field = scalar_field(mesh, skin.color_by->field);
  const bool polynomial = scene.render.interpolation == Interpolation::polynomial;
  result.field = FrameField{{field.values, field.location, polynomial}, {}};
  result.colors = skin.color_by->function();
  return result;
}

double largest_light(const Skin& skin, std::span<const Light> lights) {
  SurfaceLook look = look_of(skin);
  if (!skin.color_by) return largest_light(look, lights);
  look.color = {};
  for (const auto& point : skin.color_by->points)
    for (std::size_t c = 0; c < 3; ++c) look.color[c] = std::max(look.color[c], point.value[c]);
  return largest_light(look, lights);
}

}  // namespace hiac
