#pragma once

#include <cstddef>

#include "hiac/annotate/annotation_part.hpp"
#include "hiac/scene/annotation.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac::test {

/// A scene of one field, of a size.
inline Scene colored_scene(ImageSize size) {
  Scene scene;
  scene.image = size;
  scene.camera.eye = {3, -7, 4};
  scene.camera.look_at = {0.5, 0.25, -0.125};
  scene.camera.up = {0.1, 0.2, 1};
  scene.camera.fov = 30;
  scene.volume.color = {"t", {{-2, {0.1, 0.2, 0.9}}, {1, {0.3, 2, 0}}, {3, {0.9, 0.1, 0.1}}}};
  return scene;
}

/// Every part at its default place.
inline Annotation whole_annotation() {
  Annotation annotation;
  annotation.title.emplace().text = "Flow around a cylinder";
  annotation.time.emplace().value = 0.25;
  annotation.axes.emplace();
  annotation.scale.emplace();
  annotation.color_bar.emplace().logarithmic = false;
  return annotation;
}

/// The alpha of a pixel of a canvas.
inline double alpha(const Canvas& canvas, int x, int y) {
  return canvas.image().at(static_cast<std::size_t>(x), static_cast<std::size_t>(y), 3);
}

/// A part as it is drawn with black ink.
inline Canvas drawn(const AnnotationPart& part) {
  Canvas canvas(part.width, part.height);
  part.draw(canvas, ink_on(1, std::nullopt));
  return canvas;
}

}  // namespace hiac::test
