#pragma once

#include <cstdint>

#include "hiac/scene/scene.hpp"

namespace hiac {

/// A part of a picture: columns x to x + width, rows y to y + height, counted from the top left.
struct PixelRect {
  std::uint32_t x = 0, y = 0, width = 0, height = 0;

  bool operator==(const PixelRect&) const = default;
};

/// How a pixel is computed from its samples: as their mean, or as a mean weighted by the
/// biquadratic B-spline three pixels wide (Williams, Max, Stein 1998, section 5.3).
enum class SampleFilter : std::uint8_t { box, bspline };

/// `samples` x `samples` rays per pixel, through the centres of equal squares.
struct Supersampling {
  std::uint32_t samples = 1;
  SampleFilter filter = SampleFilter::box;
};

/// The part that is the whole picture.
PixelRect whole_picture(ImageSize size);

/// Throws UsageError if the part is empty or reaches beyond the picture.
void require_inside(const PixelRect& part, ImageSize size);

}  // namespace hiac
