#pragma once

#include <cstdint>
#include <vector>

#include "hiac/frame/crop.hpp"
#include "hiac/image/image.hpp"
#include "hiac/preview/context.hpp"
#include "hiac/preview/gl_objects.hpp"

namespace hiac::preview {

/// A picture of four 32-bit floats a pixel to draw into. Window coordinates are the frame's pixel
/// coordinates less the part's corner, y down: row 0 is the top row.
class FloatTarget {
 public:
  /// Throws DriverError when the driver cannot draw into such a picture.
  FloatTarget(const Context& context, std::uint32_t width, std::uint32_t height);

  /// Makes it what is drawn into, from now on as that part of the picture, which must not be
  /// larger than it; clears it; and composites what is drawn from now on over what is there:
  /// colours premultiplied by alpha, back to front.
  void begin(const PixelRect& part);

  /// Waits for the drawing to end; writes the part's pixels to an image of the rectangle `whole`,
  /// as the first four channels. Throws DriverError when anything failed since the last check.
  void read(const PixelRect& part, const PixelRect& whole, Image& image) const;

 private:
  const Context& context_;
  TextureName color_;
  FramebufferName framebuffer_;
};

/// A rectangle cut into parts of at most `side` pixels each way, row by row.
std::vector<PixelRect> parts_of(const PixelRect& whole, std::uint32_t side);

}  // namespace hiac::preview
