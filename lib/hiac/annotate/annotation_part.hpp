#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "hiac/annotate/canvas.hpp"
#include "hiac/annotate/ink.hpp"
#include "hiac/scene/annotation.hpp"

namespace hiac {

/// Something that is drawn on a picture.
struct AnnotationPart {
  std::string name;  ///< its key in [annotation]
  AnnotationPlace place;
  int width, height;  ///< pixels, with room for the halo
  /// Draws onto a canvas of that size.
  std::function<void(Canvas&, const Ink&)> draw;
};

/// Sizes that follow from that of the letters, pixels.
struct Lettering {
  int em;

  [[nodiscard]] int halo() const { return at_least(1, 0.1); }
  [[nodiscard]] int line() const { return at_least(1, 1.0 / 16); }  ///< thickness of lines
  [[nodiscard]] int height() const { return at_least(1, 1.2); }     ///< of a line of text
  [[nodiscard]] int ascent() const { return at_least(1, 0.93); }  ///< from its top to its baseline
  [[nodiscard]] int at_least(int least, double share) const {
    return std::max(least, static_cast<int>(std::lround(share * em)));
  }
};

}  // namespace hiac
