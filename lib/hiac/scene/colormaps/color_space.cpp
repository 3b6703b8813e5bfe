#include "hiac/scene/colormaps/color_space.hpp"

#include <algorithm>

namespace hiac::color_space {
namespace {

double lab_forward(double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0; }

}  // namespace

Triple rgb_to_lab(const Triple& rgb) {
  const double r = gamma_decoded(rgb[0]);
  const double g = gamma_decoded(rgb[1]);
  const double b = gamma_decoded(rgb[2]);
  const double fx = lab_forward((0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505);
  const double fy = lab_forward(0.2126 * r + 0.7152 * g + 0.0722 * b);
  const double fz = lab_forward((0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.089);
  return {116 * fy - 16, 500 * (fx - fy), 200 * (fy - fz)};
}

Triple rgb_to_hsv(const Triple& rgb) {
  const auto [r, g, b] = rgb;
  const double largest = std::max({r, g, b});
  const double spread = largest - std::min({r, g, b});
  if (!(spread > 0)) return {0, 0, largest};
  double hue = 0;  // in sixths of the circle
  if (r == largest)
    hue = (g - b) / spread;
  else if (g == largest)
    hue = 2 + (b - r) / spread;
  else
    hue = 4 + (r - g) / spread;
  if (hue < 0) hue += 6;
  return {hue / 6, spread / largest, largest};
}

Triple lab_to_msh(const Triple& lab) {
  constexpr double kNoColor = 0.001;
  const double magnitude = std::hypot(lab[0], lab[1], lab[2]);
  const double saturation = magnitude > kNoColor ? std::acos(lab[0] / magnitude) : 0;
  const double hue = saturation > kNoColor ? std::atan2(lab[2], lab[1]) : 0;
  return {magnitude, saturation, hue};
}

}  // namespace hiac::color_space
