#include "hiac/frame/background.hpp"

#include <cmath>

namespace hiac {

Color background_at(const Background& background, ImageSize size, std::uint32_t x,
                    std::uint32_t y) {
  const Color &first = background.color, &second = background.color2;
  switch (background.pattern) {
    case BackgroundPattern::solid:
      return first;
    case BackgroundPattern::checker: {
      const double column = std::floor(x / background.size), row = std::floor(y / background.size);
      return std::fmod(column + row, 2) == 0 ? first : second;
    }
    case BackgroundPattern::grid:
      return std::fmod(x, background.size) < 1 || std::fmod(y, background.size) < 1 ? second
                                                                                    : first;
    case BackgroundPattern::gradient: {
      const double u = size.height > 1 ? static_cast<double>(y) / (size.height - 1) : 0;
      Color mixed;
      for (std::size_t c = 0; c < 3; ++c) mixed[c] = first[c] + (second[c] - first[c]) * u;
      return mixed;
    }
  }
  return first;
}

}  // namespace hiac
