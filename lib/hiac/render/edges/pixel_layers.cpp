#include "hiac/render/edges/pixel_layers.hpp"

#include <algorithm>
#include <cstddef>

namespace hiac {
namespace {

// So many layers of lines let less than this through, and more of them change nothing.
constexpr double kLeastTransparency = 1e-4;

}  // namespace

double PixelLayers::add(const PixelSamples& covered, double share, double opacity) {
  if (!(transparency_ > 0)) return 1;
  if (opacity == 0) return 0;
  // what reaches the layer where it is, in the mean
  double reaches = transparency_;
  if (const int all = covered_.empty() ? 0 : count(covered); all > 0) {
    double sum = 0, through = 1;
    int left = all;
    for (const PixelSamples& level : covered_) {
      const int below = count_common(covered, level);
      sum += through * (left - below);
      left = below;
      through *= 1 - opacity;
    }
    if (through > kLeastTransparency) sum += through * left;
    reaches = sum / all;
  }
  const double taken = std::min(opacity * share * reaches, transparency_);
  const double result = taken / transparency_;
  transparency_ -= taken;
  // deepest first: what one more layer covers now
  double through = 1;
  std::size_t levels = 0;
  while (levels <= covered_.size() && through > kLeastTransparency) {
    ++levels;
    through *= 1 - opacity;
  }
  covered_.resize(levels);
  for (std::size_t m = levels - 1; m > 0; --m)
    for (std::size_t k = 0; k < PixelSamples::kRows; ++k)
      covered_[m].rows[k] |= covered_[m - 1].rows[k] & covered.rows[k];
  covered_[0] |= covered;
  return result;
}

double PixelLayers::add(std::span<const CoveringStrip> strips, double x, double y, double opacity) {
  PixelSamples covered = strip_samples(strips.front().strip, x, y);
  double share = strips.front().share;
  if (strips.size() > 1) {
    int samples = count(covered);
    for (const CoveringStrip& s : strips.subspan(1)) {
      const PixelSamples of_strip = strip_samples(s.strip, x, y);
      samples += count(of_strip);
      covered |= of_strip;
      share += s.share;
    }
    if (samples > 0) share *= static_cast<double>(count(covered)) / samples;
  }
  return add(covered, std::min(share, 1.0), opacity);
}

}  // namespace hiac
