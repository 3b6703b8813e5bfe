#include "hiac/annotate/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "hiac/image/srgb.hpp"

namespace hiac {
namespace {

/// How much of [i, i + 1] lies between low and high.
double overlap(std::int64_t i, double low, double high) {
  const auto at = static_cast<double>(i);
  return std::clamp(std::min(high, at + 1) - std::max(low, at), 0.0, 1.0);
}

double distance_to_segment(double x, double y, CanvasPoint a, CanvasPoint b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double square = dx * dx + dy * dy;
  const double t =
      square > 0 ? std::clamp(((x - a.x) * dx + (y - a.y) * dy) / square, 0.0, 1.0) : 0;
  return std::hypot(x - a.x - t * dx, y - a.y - t * dy);
}

}  // namespace

Color display_color(const Color& linear) {
  Color encoded;
  for (std::size_t c = 0; c < 3; ++c) encoded[c] = srgb_encode(std::clamp(linear[c], 0.0, 1.0));
  return encoded;
}

Canvas::Canvas(int width, int height)
    : image_(static_cast<std::size_t>(width), static_cast<std::size_t>(height), rgba_channels()) {}

Canvas::Canvas(int width, int height, const Color& paper) : Canvas(width, height) {
  fill(0, 0, width, height, paper);
}

void Canvas::blend(std::int64_t x, std::int64_t y, const Color& ink, double coverage) {
  if (x < 0 || y < 0 || x >= width() || y >= height() || !(coverage > 0)) return;
  const std::span<double> pixel =
      image_.pixel(static_cast<std::size_t>(x), static_cast<std::size_t>(y));
  const double kept = (1 - coverage) * pixel[3];
  const double alpha = coverage + kept;
  for (std::size_t c = 0; c < 3; ++c) pixel[c] = (coverage * ink[c] + kept * pixel[c]) / alpha;
  pixel[3] = alpha;
}

void Canvas::fill(int x, int y, int width, int height, const Color& ink) {
  for (int j = y; j < y + height; ++j)
    for (int i = x; i < x + width; ++i) blend(i, j, ink, 1);
}

void Canvas::frame(int x, int y, int box_width, int box_height, int width, const Color& ink) {
  fill(x - width, y - width, box_width + 2 * width, width, ink);
  fill(x - width, y + box_height, box_width + 2 * width, width, ink);
  fill(x - width, y, width, box_height, ink);
  fill(x + box_width, y, width, box_height, ink);
}

void Canvas::rectangle(CanvasPoint low, CanvasPoint high, const Color& ink) {
  for (auto j = static_cast<std::int64_t>(std::floor(low.y)); static_cast<double>(j) < high.y; ++j)
    for (auto i = static_cast<std::int64_t>(std::floor(low.x)); static_cast<double>(i) < high.x;
         ++i)
      blend(i, j, ink, overlap(i, low.x, high.x) * overlap(j, low.y, high.y));
}

void Canvas::segment(CanvasPoint from, CanvasPoint to, double thickness, const Color& ink) {
  for (int j = 0; j < height(); ++j)
    for (int i = 0; i < width(); ++i) {
      const double away = distance_to_segment(i + 0.5, j + 0.5, from, to);
      blend(i, j, ink, std::clamp(thickness / 2 + 0.5 - away, 0.0, 1.0));
    }
}

void Canvas::polygon(std::span<const CanvasPoint> corners, const Color& ink) {
  for (int j = 0; j < height(); ++j)
    for (int i = 0; i < width(); ++i) {
      double coverage = 1;
      for (std::size_t k = 0; k < corners.size(); ++k) {
        const CanvasPoint &a = corners[k], &b = corners[(k + 1) % corners.size()];
        const double inside = ((b.x - a.x) * (j + 0.5 - a.y) - (b.y - a.y) * (i + 0.5 - a.x)) /
                              std::hypot(b.x - a.x, b.y - a.y);
        coverage = std::min(coverage, std::clamp(inside + 0.5, 0.0, 1.0));
      }
      blend(i, j, ink, coverage);
    }
}

void Canvas::write(const Text& text, double x, double anchor, int baseline, const std::string& line,
                   const Color& ink) {
  text.draw(x - anchor * text.width(line), baseline, line,
            [&](std::int64_t i, std::int64_t j, double coverage) { blend(i, j, ink, coverage); });
}

void Canvas::write_upwards(const Text& text, int baseline, double y, const std::string& line,
                           const Color& ink) {
  // a quarter turn: what runs to the right runs upwards, what is above the baseline is left of it
  const auto start = static_cast<std::int64_t>(std::lround(y + text.width(line) / 2));
  text.draw(0, 0, line, [&](std::int64_t i, std::int64_t j, double coverage) {
    blend(baseline + j, start - 1 - i, ink, coverage);
  });
}

Image Canvas::linear() const {
  Image picture(image_.width(), image_.height(), {"R", "G", "B"});
  for (std::size_t y = 0; y < picture.height(); ++y)
    for (std::size_t x = 0; x < picture.width(); ++x)
      for (std::size_t c = 0; c < 3; ++c) picture.at(x, y, c) = srgb_decode(image_.at(x, y, c));
  return picture;
}

}  // namespace hiac
