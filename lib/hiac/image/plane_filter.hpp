#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace hiac {

/// One channel of an image: value (x, y) is values[y * width + x].
struct Plane {
  std::size_t width = 0;
  std::size_t height = 0;
  std::vector<double> values;
};

/// Correlates a plane with the separable kernel along_x(i) along_y(j); both have odd length and
/// their middle at 0. Values beyond the borders are the nearest ones inside.
Plane filtered(const Plane& plane, std::span<const double> along_x,
               std::span<const double> along_y);

/// Returns exp(-x^2 / (2 sigma^2)) at x = -radius ... radius, not normalised.
std::vector<double> gaussian(std::size_t radius, double sigma);

}  // namespace hiac
