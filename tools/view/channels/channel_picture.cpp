#include "tools/view/channels/channel_picture.hpp"

#include <algorithm>
#include <cmath>

namespace hiac::view {

std::optional<std::array<double, 2>> finite_range(const Image& image, std::size_t channel) {
  std::optional<std::array<double, 2>> range;
  for (std::size_t at = channel; at < image.values().size(); at += image.channel_count()) {
    const double value = image.values()[at];
    if (!std::isfinite(value)) continue;
    if (!range) range = {value, value};
    (*range)[0] = std::min((*range)[0], value);
    (*range)[1] = std::max((*range)[1], value);
  }
  return range;
}

std::vector<std::uint8_t> channel_bytes(const Image& image, std::size_t channel,
                                        const std::array<double, 2>& range, bool logarithmic) {
  const auto placed = [&](double value) { return logarithmic ? std::log(value) : value; };
  const double low = placed(range[0]), high = placed(range[1]);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(3 * image.width() * image.height());
  for (std::size_t at = channel; at < image.values().size(); at += image.channel_count()) {
    const double place = placed(image.values()[at]);
    if (!std::isfinite(place)) {
      bytes.insert(bytes.end(), {255, 0, 0});
      continue;
    }
    const double share = high > low ? std::clamp((place - low) / (high - low), 0.0, 1.0) : 0.5;
    bytes.insert(bytes.end(), 3, static_cast<std::uint8_t>(std::lround(255 * share)));
  }
  return bytes;
}

}  // namespace hiac::view
