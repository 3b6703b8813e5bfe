#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "hiac/annotate/text.hpp"
#include "hiac/image/image.hpp"
#include "hiac/scene/scene.hpp"

namespace hiac {

/// A point of a canvas: pixels from its upper left corner, pixel (i, j) spans i to i + 1, j to
/// j + 1.
struct CanvasPoint {
  double x, y;
};

/// The display value of a linear colour, as integer formats store it: cut at 1, sRGB-encoded.
Color display_color(const Color& linear);

/// A picture being drawn: R G B A, sRGB-encoded, straight alpha, because ink on paper is mixed as
/// the eye sees it. What lies outside of the canvas is left out.
class Canvas {
 public:
  /// Transparent.
  Canvas(int width, int height);
  /// Filled.
  Canvas(int width, int height, const Color& paper);

  [[nodiscard]] int width() const { return static_cast<int>(image_.width()); }
  [[nodiscard]] int height() const { return static_cast<int>(image_.height()); }
  [[nodiscard]] const Image& image() const { return image_; }

  /// Puts ink on a share of a pixel.
  void blend(std::int64_t x, std::int64_t y, const Color& ink, double coverage);
  /// Whole pixels.
  void fill(int x, int y, int width, int height, const Color& ink);
  /// A border around a box, `width` pixels wide.
  void frame(int x, int y, int box_width, int box_height, int width, const Color& ink);
  /// A rectangle, every pixel by the area that is covered.
  void rectangle(CanvasPoint low, CanvasPoint high, const Color& ink);
  /// A line of a thickness with round ends.
  void segment(CanvasPoint from, CanvasPoint to, double thickness, const Color& ink);
  /// A convex polygon, corners clockwise as seen.
  void polygon(std::span<const CanvasPoint> corners, const Color& ink);
  /// Text whose middle (0.5), start (0) or end (1) is at x.
  void write(const Text& text, double x, double anchor, int baseline, const std::string& line,
             const Color& ink);
  /// Text that runs upwards, its baseline to the right of the letters, its middle at y.
  void write_upwards(const Text& text, int baseline, double y, const std::string& line,
                     const Color& ink);

  /// A canvas without transparency as a picture: R G B, linear.
  [[nodiscard]] Image linear() const;

 private:
  Image image_;
};

}  // namespace hiac
