#include "hiac/annotate/length_scale.hpp"

#include <memory>
#include <utility>

#include <fmt/format.h>

#include "hiac/annotate/ticks.hpp"
#include "hiac/base/error.hpp"
#include "hiac/frame/projection.hpp"

namespace hiac {

double pixels_per_unit(const Scene& scene) {
  const Projector projector(scene.camera, scene.image);
  const double scale = projector.pixels_per_unit();
  return projector.perspective() ? scale / projector.parameter(scene.camera.look_at) : scale;
}

AnnotationPart length_scale(const LengthAnnotation& wanted, const Scene& scene,
                            Lettering lettering) {
  const double per_unit = pixels_per_unit(scene);
  const double length =
      wanted.length.value_or(round_below(wanted.size.pixels(scene.image) / per_unit));
  const double bar = length * per_unit;
  if (!(bar <= scene.image.width))
    throw InputError("key `annotation.scale`",
                     fmt::format("a length of {} is {:.6g} pixels long (the picture has {})",
                                 length, bar, scene.image.width));
  std::string label = typeset(fmt::format("{}", length));
  if (!wanted.unit.empty()) label += " " + wanted.unit;
  if (scene.camera.projection == Projection::perspective) label += " at the centre";
  const auto text = std::make_shared<const Text>(lettering.em);
  const double widest = std::max(bar, text->width(label));
  const int halo = lettering.halo();
  const int thickness = lettering.at_least(2, 0.16), cap = lettering.at_least(4, 0.6);
  const int top = halo + lettering.height() + lettering.at_least(1, 0.1);
  const double start = halo + std::floor((widest - bar) / 2);
  return {"scale", wanted.place, static_cast<int>(std::ceil(widest)) + 2 * halo, top + cap + halo,
          [=](Canvas& canvas, const Ink& ink) {
            const double end = start + bar, line = std::min<double>(lettering.line() + 1, bar);
            const double middle = top + (cap - thickness) / 2;  // whole pixels
            canvas.write(*text, halo + widest / 2, 0.5, halo + lettering.ascent(), label, ink.text);
            canvas.rectangle({start, middle}, {end, middle + thickness}, ink.text);
            // caps above the bar and below it: no pixel gets ink twice
            for (const auto& [low, high] : {std::pair{double(top), middle},
                                            std::pair{middle + thickness, double(top + cap)}}) {
              canvas.rectangle({start, low}, {start + line, high}, ink.text);
              canvas.rectangle({end - line, low}, {end, high}, ink.text);
            }
          }};
}

}  // namespace hiac
