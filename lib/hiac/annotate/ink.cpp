#include "hiac/annotate/ink.hpp"

#include <algorithm>
#include <cstddef>

#include "hiac/annotate/canvas.hpp"

namespace hiac {

namespace {

constexpr Color kBlack{0, 0, 0}, kWhite{1, 1, 1};

/// Whichever differs more from a luminance.
const Color& opposite(double level) {
  return contrast(level, 0) >= contrast(level, 1) ? kBlack : kWhite;
}

}  // namespace

double luminance(const Color& linear) {
  constexpr Color kWeights{0.2126, 0.7152, 0.0722};
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) sum += kWeights[c] * std::clamp(linear[c], 0.0, 1.0);
  return sum;
}

double contrast(double a, double b) {
  constexpr double kFlare = 0.05;
  return (std::max(a, b) + kFlare) / (std::min(a, b) + kFlare);
}

Ink ink_on(double background, const std::optional<Color>& chosen) {
  const Color text = chosen ? *chosen : opposite(background);
  const Color& halo = opposite(luminance(text));
  return {display_color(text), halo, halo == kBlack};
}

}  // namespace hiac
