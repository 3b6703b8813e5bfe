#include "hiac/image/plane_filter.hpp"

#include <algorithm>
#include <cmath>

#include "hiac/base/parallel.hpp"

namespace hiac {
namespace {

/// Clamps positions before 0 to 0 and those from `count` on to the last.
std::size_t clamped(std::size_t position, std::size_t radius, std::size_t count) {
  return std::min(position < radius ? 0 : position - radius, count - 1);
}

}  // namespace

Plane filtered(const Plane& plane, std::span<const double> along_x,
               std::span<const double> along_y) {
  constexpr std::size_t kGrain = 8;
  const std::size_t width = plane.width, height = plane.height;
  Plane rows{width, height, std::vector<double>(plane.values.size())};
  parallel_for(height, kGrain, [&](IndexRange range) {
    for (std::size_t y = range.begin; y < range.end; ++y)
      for (std::size_t x = 0; x < width; ++x) {
        double sum = 0;
        for (std::size_t i = 0; i < along_x.size(); ++i)
          sum += along_x[i] * plane.values[y * width + clamped(x + i, along_x.size() / 2, width)];
        rows.values[y * width + x] = sum;
      }
  });
  Plane result{width, height, std::vector<double>(plane.values.size())};
  parallel_for(height, kGrain, [&](IndexRange range) {
    for (std::size_t y = range.begin; y < range.end; ++y)
      for (std::size_t j = 0; j < along_y.size(); ++j) {
        const double* const row = &rows.values[clamped(y + j, along_y.size() / 2, height) * width];
        for (std::size_t x = 0; x < width; ++x) result.values[y * width + x] += along_y[j] * row[x];
      }
  });
  return result;
}

std::vector<double> gaussian(std::size_t radius, double sigma) {
  std::vector<double> values(2 * radius + 1);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double x = static_cast<double>(i) - static_cast<double>(radius);
    values[i] = std::exp(-x * x / (2 * sigma * sigma));
  }
  return values;
}

}  // namespace hiac
