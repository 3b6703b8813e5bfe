#include "hiac/annotate/stamp.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "hiac/annotate/ink.hpp"
#include "hiac/image/srgb.hpp"

namespace hiac {
namespace {

constexpr double kHaloStrength = 0.75;

/// The canvas' coverage spread by a radius: at every pixel the largest nearby, less towards the
/// rim.
class Spread {
 public:
  Spread(const Image& canvas, int radius)
      : width_(static_cast<int>(canvas.width())),
        height_(static_cast<int>(canvas.height())),
        values_(canvas.width() * canvas.height()) {
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x)
        if (const double alpha = alpha_at(canvas, x, y); alpha > 0 && !is_inside(canvas, x, y))
          grow(x, y, alpha, radius);
  }

  [[nodiscard]] double at(int x, int y) const { return values_[index(x, y)]; }

 private:
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }
  static double alpha_at(const Image& canvas, int x, int y) {
    return canvas.at(static_cast<std::size_t>(x), static_cast<std::size_t>(y), 3);
  }
  /// Whether the pixel and its neighbours are covered: its halo is not seen.
  [[nodiscard]] bool is_inside(const Image& canvas, int x, int y) const {
    if (x == 0 || y == 0 || x + 1 == width_ || y + 1 == height_) return false;
    return std::min({alpha_at(canvas, x, y), alpha_at(canvas, x - 1, y), alpha_at(canvas, x + 1, y),
                     alpha_at(canvas, x, y - 1), alpha_at(canvas, x, y + 1)}) >= 1;
  }
  void grow(int x, int y, double alpha, int radius) {
    for (int j = std::max(0, y - radius); j <= std::min(height_ - 1, y + radius); ++j)
      for (int i = std::max(0, x - radius); i <= std::min(width_ - 1, x + radius); ++i) {
        const double away = std::hypot(i - x, j - y);
        const double there = alpha * std::clamp(radius + 0.5 - away, 0.0, 1.0);
        values_[index(i, j)] = std::max(values_[index(i, j)], there);
      }
  }

  int width_, height_;
  std::vector<double> values_;
};

/// Mixes ink, a display value, into one pixel of a picture.
class Blender {
 public:
  Blender(Image& picture, bool opaque)
      : picture_(picture),
        colors_(color_channels(picture)),
        alpha_(picture.channel_index("A")),
        opaque_(opaque || !alpha_) {}

  void mix(std::size_t x, std::size_t y, const Color& ink, double coverage) {
    if (!colors_ || !(coverage > 0)) return;
    const std::span<double> pixel = picture_.pixel(x, y);
    const double before = opaque_ ? 1 : std::clamp(pixel[*alpha_], 0.0, 1.0);
    const double after = coverage + (1 - coverage) * before;
    const bool is_grey = (*colors_)[0] == (*colors_)[1];
    for (std::size_t c = 0; c < (is_grey ? 1 : 3); ++c) {
      double& value = pixel[(*colors_)[c]];
      const double straight = before > 0 ? srgb_encode(std::max(0.0, value / before)) : 0;
      const double level = is_grey ? srgb_encode(luminance_of(ink)) : ink[c];
      const double mixed = (coverage * level + (1 - coverage) * before * straight) / after;
      value = after * srgb_decode(mixed);
    }
    if (alpha_) pixel[*alpha_] += coverage * (1 - pixel[*alpha_]);
  }

 private:
  static double luminance_of(const Color& ink) {
    return luminance({srgb_decode(ink[0]), srgb_decode(ink[1]), srgb_decode(ink[2])});
  }

  Image& picture_;
  std::optional<std::array<std::size_t, 3>> colors_;
  std::optional<std::size_t> alpha_;
  bool opaque_;
};

}  // namespace

void stamp(Image& picture, const Canvas& canvas, std::int64_t x, std::int64_t y, int radius,
           const Color& halo, bool opaque) {
  const Spread spread(canvas.image(), radius);
  Blender blender(picture, opaque);
  for (int j = 0; j < canvas.height(); ++j)
    for (int i = 0; i < canvas.width(); ++i) {
      const std::int64_t px = x + i, py = y + j;
      if (px < 0 || py < 0 || px >= static_cast<std::int64_t>(picture.width()) ||
          py >= static_cast<std::int64_t>(picture.height()))
        continue;
      const auto column = static_cast<std::size_t>(px), row = static_cast<std::size_t>(py);
      const std::span<const double> ink =
          canvas.image().pixel(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
      if (ink[3] < 1) blender.mix(column, row, halo, kHaloStrength * spread.at(i, j));
      blender.mix(column, row, {ink[0], ink[1], ink[2]}, ink[3]);
    }
}

}  // namespace hiac
