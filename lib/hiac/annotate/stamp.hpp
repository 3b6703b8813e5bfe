#pragma once

#include <cstdint>

#include "hiac/annotate/canvas.hpp"

namespace hiac {

/// Puts a canvas on a picture with its upper left corner at pixel (x, y), over a halo of `radius`
/// pixels of the display value `halo`, which keeps letters legible on any picture. R G B (or Y) and
/// A of the pixels below ink change, where `opaque` is set as if the picture had no transparency
/// there; all other values stay as they are to the last bit. What lies outside of the picture is
/// left out.
void stamp(Image& picture, const Canvas& canvas, std::int64_t x, std::int64_t y, int radius,
           const Color& halo, bool opaque);

}  // namespace hiac
