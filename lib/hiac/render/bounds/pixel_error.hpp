#pragma once

#include "hiac/render/pixels/pixel_details.hpp"

namespace hiac {

/// pixel_error (error_bound.hpp) where there is no frame: of one it needs Frame::largest_light.
double pixel_error(double largest_light, const PixelDetails& pixel, double transparency, bool ended,
                   double background);

}  // namespace hiac
