#pragma once

#include <string>

#include "hiac/image/image.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

/// What the axes of a colour bar are called: the fields' names, with their units where known.
struct ColorBarLabels {
  std::string color;
  std::string extinction;
};

/// Where the parts of a colour bar lie, pixels.
struct ColorBarLayout {
  static constexpr int kWidth = 800;
  static constexpr int kLeft = 80;  ///< of the bar and of the graph
  static constexpr int kPlotWidth = 640;
  static constexpr int kTitleHeight = 44;
  static constexpr int kBarHeight = 40;
  static constexpr int kGraphHeight = 120;
  static constexpr int kTicksHeight = 40;
  static constexpr int kMargin = 12;  ///< above, between and below the two parts
};

/// A picture that explains a volume's transfer functions: the colour map as a bar, below it the
/// opacity 1 - exp(-extinction x length) that a piece of the medium of that length has, each over
/// its field's values with ticks and numbers, black on white. Both parts have one range where they
/// are of one field; a part that the volume does not have is left out. Colours above 1 are shown as
/// a display does, cut at 1. Channels R G B, linear.
///
/// Column i of a part shows the value low + (i + 1/2) / kPlotWidth (high - low).
/// `logarithmic`: the part of the colour is even in the scalar's logarithm, and that of the opacity
/// where they share a range; at (i + 1/2) / kPlotWidth between the logarithms then.
/// Throws UsageError when the volume has neither colour nor extinction, InputError when a
/// logarithmic part would have scalars that are not positive.
Image draw_color_bar(const Volume& volume, const ColorBarLabels& labels, double length,
                     bool logarithmic = false);

}  // namespace hiac
