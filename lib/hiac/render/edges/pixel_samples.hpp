#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hiac/render/edges/strip_coverage.hpp"

namespace hiac {

/// 64 x 64 samples of a pixel, evenly spaced: a bit each, row by row.
struct PixelSamples {
  static constexpr std::size_t kRows = 64;
  std::array<std::uint64_t, kRows> rows{};

  void operator|=(const PixelSamples& other);
};

/// The samples of the pixel around (x, y) that a strip covers.
PixelSamples strip_samples(const Strip& strip, double x, double y);

/// The number of samples.
int count(const PixelSamples& samples);
/// The number of those that are in both.
int count_common(const PixelSamples& a, const PixelSamples& b);

}  // namespace hiac
