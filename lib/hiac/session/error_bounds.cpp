#include "hiac/session/error_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "hiac/frame/channels.hpp"

namespace hiac {

std::optional<double> largest_error_bound(const Image& picture) {
  const auto channel = picture.channel_index(channel_name(Channel::error));
  if (!channel) return std::nullopt;
  double largest = 0;
  for (std::size_t y = 0; y < picture.height(); ++y)
    for (std::size_t x = 0; x < picture.width(); ++x)
      largest = std::max(largest, picture.at(x, y, *channel));
  return std::isfinite(largest) ? std::optional(largest) : std::nullopt;
}

}  // namespace hiac
