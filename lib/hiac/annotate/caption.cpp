#include "hiac/annotate/caption.hpp"

#include <memory>

namespace hiac {

AnnotationPart caption(const std::string& name, AnnotationPlace place, const std::string& line,
                       Lettering lettering, int most) {
  const auto text = std::make_shared<const Text>(lettering.em);
  const int halo = lettering.halo();
  const std::string shown = text->shortened(line, std::max(0, most - 2 * halo));
  const int width = static_cast<int>(std::ceil(text->width(shown))) + 2 * halo;
  return {name, place, width, lettering.height() + 2 * halo, [=](Canvas& canvas, const Ink& ink) {
            canvas.write(*text, halo, 0, halo + lettering.ascent(), shown, ink.text);
          }};
}

}  // namespace hiac
