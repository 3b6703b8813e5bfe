#pragma once

#include <cstdint>

#include "hiac/scene/scene.hpp"

namespace hiac {

/// A part of a picture: columns x to x + width, rows y to y + height, counted from the top left.
struct PixelRect {
  std::uint32_t x = 0, y = 0, width = 0, height = 0;

  bool operator==(const PixelRect&) const = default;
};

/// All of a picture.
PixelRect whole_picture(ImageSize size);

/// Throws UsageError when the part is empty or reaches beyond the picture.
void require_inside(const PixelRect& part, ImageSize size);

}  // namespace hiac
