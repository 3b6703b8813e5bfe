#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hiac/image/image.hpp"

namespace hiac {

/// How far the values a of one channel of an image are from the values b of a reference.
///
/// Two values that are the same differ by 0, also where both are NaN or the same infinity. A NaN or
/// an infinity differs infinitely from any other value: such values are counted, not averaged.
struct Difference {
  std::string channel;
  double rmse = 0;           ///< sqrt(mean (a - b)^2)
  double relative_mse = 0;   ///< mean (a - b)^2 / (|b| + 0.01)^2, as pbrt-v4's imgtool has it
  double mean_absolute = 0;  ///< mean |a - b|
  double largest = 0;        ///< max |a - b|
  std::size_t x = 0;         ///< the first pixel, row by row from the top, that differs the most
  std::size_t y = 0;
  std::uint64_t infinite = 0;  ///< number of values that differ infinitely
};

/// |a - b| as a Difference counts it.
double absolute_difference(double a, double b);

/// One entry for every channel that both images have, in the first one's order.
/// Throws std::invalid_argument when the images are not of one size.
std::vector<Difference> channel_differences(const Image& image, const Image& reference);

/// Peak signal-to-noise ratio, -10 log10(mean (a - b)^2) in dB over R, G and B (or Y) of both
/// images, for a signal between 0 and 1; linear values as they are. Infinite for equal images;
/// none where the images have no colour in common. Throws as channel_differences.
std::optional<double> peak_signal_to_noise(const Image& image, const Image& reference);

/// The largest absolute difference among the channels that both images have, pixel by pixel: one
/// channel, "difference". Throws as channel_differences.
Image difference_map(const Image& image, const Image& reference);

}  // namespace hiac
