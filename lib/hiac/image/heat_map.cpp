#include "hiac/image/heat_map.hpp"

#include <algorithm>
#include <cmath>

#include "hiac/image/srgb.hpp"

namespace hiac {
namespace {

constexpr std::array<double, 3> kNotFinite{1, 0, 0};

/// Returns kViridis at t in [0, 1], interpolated linearly in sRGB values.
std::array<double, 3> viridis(double t) {
  constexpr std::size_t kLast = kViridis.size() - 1;
  const auto first = std::min(static_cast<std::size_t>(t * kLast), kLast - 1);
  const double weight = t * kLast - static_cast<double>(first);
  std::array<double, 3> color{};
  for (std::size_t c = 0; c < 3; ++c)
    color[c] =
        srgb_decode(((1 - weight) * kViridis[first][c] + weight * kViridis[first + 1][c]) / 255);
  return color;
}

}  // namespace

Image heat_map(const Image& map, double largest) {
  Image colors(map.width(), map.height(), {"R", "G", "B"});
  for (std::size_t y = 0; y < map.height(); ++y)
    for (std::size_t x = 0; x < map.width(); ++x) {
      const double value = map.at(x, y, 0);
      const double t = largest > 0 ? std::clamp(value / largest, 0.0, 1.0) : 0;
      const auto color = std::isfinite(value) ? viridis(t) : kNotFinite;
      std::copy(color.begin(), color.end(), colors.pixel(x, y).begin());
    }
  return colors;
}

}  // namespace hiac
