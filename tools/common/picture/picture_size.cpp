#include "tools/common/picture/picture_size.hpp"

#include <charconv>
#include <system_error>

#include <fmt/format.h>

#include "hiac/base/error.hpp"

namespace hiac::tools {

ImageSize parse_size(const std::string& text) {
  ImageSize size;
  const char *at = text.data(), *end = text.data() + text.size();
  const auto [cross, first] = std::from_chars(at, end, size.width);
  const bool has_cross = first == std::errc() && cross != end && *cross == 'x';
  const auto [last, second] = std::from_chars(has_cross ? cross + 1 : end, end, size.height);
  if (!has_cross || second != std::errc() || last != end)
    throw UsageError("--size: expected WIDTHxHEIGHT, as 1024x768 (found " + text + ")");
  for (const std::uint32_t side : {size.width, size.height})
    if (side < 1 || side > kMaxImageSide)
      throw UsageError(
          fmt::format("--size: expected 1 to {} pixels (found {})", kMaxImageSide, side));
  return size;
}

}  // namespace hiac::tools
