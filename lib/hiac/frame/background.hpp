#pragma once

#include "hiac/scene/scene.hpp"

namespace hiac {

/// The background's colour at a pixel: solid, checker (squares of `size` pixels, `color` at the
/// top left), grid (lines one pixel wide in `color2`, every `size` pixels), or gradient (from
/// `color` at the top row to `color2` at the bottom row).
Color background_at(const Background& background, ImageSize size, std::uint32_t x, std::uint32_t y);

}  // namespace hiac
