#include "hiac/image/composite.hpp"

#include <cmath>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

namespace hiac {

void composite_over(Image& front, const Image& back) {
  if (front.width() != back.width() || front.height() != back.height())
    throw std::invalid_argument("images of different sizes");
  const auto front_colors = color_channels(front), back_colors = color_channels(back);
  const auto front_alpha = front.channel_index("A"), back_alpha = back.channel_index("A");
  if (!front.channel_index("R") || !front_colors || !front_alpha || !back_colors)
    throw std::invalid_argument("images without colour, or a front image without alpha");
  for (std::size_t y = 0; y < front.height(); ++y)
    for (std::size_t x = 0; x < front.width(); ++x) {
      const double transparency = 1 - front.at(x, y, *front_alpha);
      for (std::size_t c = 0; c < 3; ++c)
        front.at(x, y, (*front_colors)[c]) += transparency * back.at(x, y, (*back_colors)[c]);
      front.at(x, y, *front_alpha) +=
          transparency * (back_alpha ? back.at(x, y, *back_alpha) : 1.0);
    }
}

std::optional<std::string> not_finite_in(const Image& back) {
  const auto colors = color_channels(back);
  if (!colors) return std::nullopt;
  std::vector<std::size_t> used(colors->begin(), colors->end());
  if (const auto alpha = back.channel_index("A")) used.push_back(*alpha);
  for (std::size_t y = 0; y < back.height(); ++y)
    for (std::size_t x = 0; x < back.width(); ++x)
      for (const std::size_t channel : used)
        if (const double value = back.at(x, y, channel); !std::isfinite(value))
          return fmt::format(
              "pixel {},{}: channel {} is not finite (a finite number expected, {} "
              "found)",
              x, y, back.channels()[channel], value);
  return std::nullopt;
}

}  // namespace hiac
