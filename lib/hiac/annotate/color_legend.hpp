#pragma once

#include "hiac/annotate/annotation_part.hpp"

namespace hiac {

/// The colours of a volume, which has some, along a bar: upwards at the left and right edges of a
/// picture, to the right at the upper and lower ones, with round numbers and a label. The colour at
/// a point of the bar is that of the transfer function, as a display shows it.
///
/// Pixel k along a bar of n, counted from its lower end, shows the scalar at (k + 1/2) / n.
/// Throws InputError where a logarithmic bar would have scalars that are not positive.
AnnotationPart color_legend(const ColorBarAnnotation& wanted, const Scene& scene,
                            const std::string& label, Lettering lettering);

/// Where the bar is in its part: pixels.
struct LegendLayout {
  int x, y, width, height;
};
LegendLayout legend_layout(const ColorBarAnnotation& wanted, const Scene& scene,
                           const std::string& label, Lettering lettering);

}  // namespace hiac
