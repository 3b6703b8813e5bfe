#pragma once

#include "hiac/scene/annotation.hpp"

namespace hiac {

/// The colours of lines and letters, as display values.
struct Ink {
  Color text{};   ///< of text and lines
  Color halo{};   ///< around them: black or white, whichever differs more from `text`
  bool is_light;  ///< the text is nearer to white
};

/// Relative luminance (ITU-R BT.709) of a linear colour whose components are cut at 1.
double luminance(const Color& linear);

/// The contrast of two luminances: (lighter + 0.05) / (darker + 0.05), 1 to 21 (WCAG 2.1).
double contrast(double a, double b);

/// Black or white, whichever has more contrast to a background of that luminance: at least 4.5.
/// `chosen`: this linear colour instead.
Ink ink_on(double background, const std::optional<Color>& chosen);

}  // namespace hiac
