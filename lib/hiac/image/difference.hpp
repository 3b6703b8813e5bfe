#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hiac/image/image.hpp"

namespace hiac {

/// The difference of the values a of one image channel from the values b of a reference.
///
/// Equal values differ by 0, also if both are NaN or the same infinity. A NaN or an infinity
/// differs infinitely from any other value: such values are counted, not averaged.
struct Difference {
  std::string channel;
  double rmse = 0;           ///< sqrt(mean (a - b)^2)
  double relative_mse = 0;   ///< mean (a - b)^2 / (|b| + 0.01)^2, as in pbrt-v4's imgtool
  double mean_absolute = 0;  ///< mean |a - b|
  double largest = 0;        ///< max |a - b|
  std::size_t x = 0;         ///< the first pixel, by rows from the top, that differs most
  std::size_t y = 0;
  std::uint64_t infinite = 0;  ///< number of values that differ infinitely
};

/// Returns |a - b| by the rules of Difference.
double absolute_difference(double a, double b);

/// Returns one entry for every channel that both images have, in the first one's order. Throws
/// std::invalid_argument if the images differ in size.
std::vector<Difference> channel_differences(const Image& image, const Image& reference);

/// Returns the peak signal-to-noise ratio, -10 log10(mean (a - b)^2) in dB over the linear values
/// of R, G and B (or Y) in both images, for a signal between 0 and 1. Infinite for equal images;
/// none if the images have no colour in common. Throws as channel_differences.
std::optional<double> peak_signal_to_noise(const Image& image, const Image& reference);

/// Returns the largest absolute difference among the channels that both images have, per pixel: one
/// channel, "difference". Throws as channel_differences.
Image difference_map(const Image& image, const Image& reference);

}  // namespace hiac
