#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hiac/annotate/annotation_part.hpp"

namespace hiac {

/// A rectangle of pixels: x to x + width, y to y + height.
struct PixelBox {
  std::int64_t x = 0, y = 0, width = 0, height = 0;

  [[nodiscard]] bool meets(const PixelBox& other) const {
    return x < other.x + other.width && other.x < x + width && y < other.y + other.height &&
           other.y < y + height;
  }
  bool operator==(const PixelBox&) const = default;
};

/// Where parts are in a picture: parts with the same place one above another, in their order, with
/// `gap` pixels between, those at the lower edge and at the sides ending or centred there. Throws
/// InputError "key `annotation.NAME`: ..." for a part that reaches beyond the picture.
std::vector<PixelBox> part_boxes(std::span<const AnnotationPart> parts, ImageSize size, int margin,
                                 int gap);

}  // namespace hiac
