#include "tests/preview/drawn.hpp"

#include <algorithm>
#include <cmath>

#include "hiac/frame/frame.hpp"
#include "hiac/preview/context.hpp"
#include "hiac/preview/float_target.hpp"
#include "hiac/preview/methods/method_painter.hpp"
#include "hiac/render/engine.hpp"
#include "hiac/scene/view_of.hpp"
#include "tests/support/sorting.hpp"

namespace hiac::test {

std::vector<CellId> back_to_front(const ZooMesh& mesh, const Scene& scene) {
  const VisibilityOrder order = sorted(mesh, view_of(scene.camera)).order;
  const auto cells = order.cells.view();
  return {cells.rbegin(), cells.rend()};
}

Drawn drawn(const ZooMesh& mesh, const Scene& scene, preview::Method method,
            std::optional<PixelRect> part) {
  static const preview::Context context;
  const Projector projector(scene.camera, scene.image);
  const Frame frame(mesh, scene, projector);
  const PixelRect all = part.value_or(whole_picture(scene.image));
  preview::FloatTarget target(context, all.width, all.height);
  target.begin(all);
  preview::MethodPainter painter(context, frame, method);
  Drawn result{Image(all.width, all.height, {"R", "G", "B", "A"}),
               painter.draw(all, back_to_front(mesh, scene))};
  target.read(all, all, result.image);
  return result;
}

Image accurate(const ZooMesh& mesh, const Scene& scene) {
  return render(mesh, sorted(mesh, view_of(scene.camera)).order, scene, false).image;
}

Errors errors(const Image& a, const Image& b) {
  Errors result;
  double sum = 0;
  for (std::size_t y = 0; y < a.height(); ++y)
    for (std::size_t x = 0; x < a.width(); ++x)
      for (std::size_t c = 0; c < 4; ++c) {
        const double error = std::abs(a.pixel(x, y)[c] - b.pixel(x, y)[c]);
        // not a number is the largest error of all
        if (!(error <= result.largest)) result.largest = error;
        sum += error * error;
      }
  result.rms = std::sqrt(sum / (4.0 * static_cast<double>(a.width() * a.height())));
  return result;
}

Scene smooth_scene(Projection projection, Glow glow) {
  Scene scene;
  scene.image = {160, 120};
  scene.camera.projection = projection;
  scene.camera.eye = {2.1, -1.7, 1.9};
  scene.camera.look_at = {0.5, 0.5, 0.5};
  scene.camera.up = {0, 0, 1};
  scene.camera.fov = 32;
  scene.camera.height = 1.7;
  scene.volume.glow = glow;
  scene.volume.color = ColorTransfer{"f", {{-1, {0.1, 0.3, 1}}, {2, {1, 0.5, 0}}}};
  scene.volume.extinction = ExtinctionTransfer{"f", {{-1, {0.2}}, {2, {5}}}};
  return scene;
}

}  // namespace hiac::test
