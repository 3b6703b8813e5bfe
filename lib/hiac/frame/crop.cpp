#include "hiac/frame/crop.hpp"

#include <fmt/format.h>

#include "hiac/base/error.hpp"

namespace hiac {

PixelRect whole_picture(ImageSize size) { return {0, 0, size.width, size.height}; }

void require_inside(const PixelRect& part, ImageSize size) {
  const auto fits = [](std::uint32_t first, std::uint32_t count, std::uint32_t all) {
    return count > 0 && first < all && count <= all - first;
  };
  if (fits(part.x, part.width, size.width) && fits(part.y, part.height, size.height)) return;
  throw UsageError(fmt::format(
      "crop: expected a part of the picture, which is {} x {} (found {} x {} pixels at {},{})",
      size.width, size.height, part.width, part.height, part.x, part.y));
}

}  // namespace hiac
