#include "tools/render/color_bar.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/image/srgb.hpp"
#include "tools/render/text.hpp"
#include "tools/render/ticks.hpp"

namespace hiac::tools {
namespace {

using Layout = ColorBarLayout;

constexpr int kTitleSize = 22, kNumberSize = 18;  // pixels an em
constexpr int kMaxTicks = 7;
constexpr double kInk = 0.25, kShade = 0.62;  // of lines, and of the area under a curve; encoded

struct Range {
  double low, high;
};

template <std::size_t N>
Range range_of(const TransferFunction<N>& transfer) {
  return {transfer.points.front().scalar, transfer.points.back().scalar};
}

/// A function that is the same everywhere, or whose points are too near to each other for round
/// numbers between them, has a range of its own making.
Range widened(const Range& range) {
  constexpr double kNarrowest = 1e-12, kSmallest = 1e-290;
  const double size = std::max(std::fabs(range.low), std::fabs(range.high));
  if (range.high / 2 - range.low / 2 > std::max(kNarrowest * size, kSmallest)) return range;
  const double by = size <= kSmallest ? 1 : size / 2;
  return {range.low - by, range.high + by};
}

/// A picture being drawn, sRGB-encoded: ink on paper is mixed as the eye sees it.
class Canvas {
 public:
  explicit Canvas(int height)
      : image_(Layout::kWidth, static_cast<std::size_t>(height), {"R", "G", "B"}) {
    std::fill(image_.values().begin(), image_.values().end(), 1.0);
  }

  void set(int x, int y, const Color& encoded) {
    std::copy(encoded.begin(), encoded.end(),
              image_.pixel(static_cast<std::size_t>(x), static_cast<std::size_t>(y)).begin());
  }
  void fill(int x, int y, int width, int height, double grey) {
    for (int j = y; j < y + height; ++j)
      for (int i = x; i < x + width; ++i) set(i, j, {grey, grey, grey});
  }
  void frame(int x, int y, int width, int height) {
    fill(x - 1, y - 1, width + 2, 1, kInk);
    fill(x - 1, y + height, width + 2, 1, kInk);
    fill(x - 1, y, 1, height, kInk);
    fill(x + width, y, 1, height, kInk);
  }
  /// Text whose middle (0.5), start (0) or end (1) is at x.
  void write(const Text& text, double x, double anchor, int baseline, const std::string& line) {
    text.draw(image_, x - anchor * text.width(line), baseline, line);
  }

  [[nodiscard]] Image linear() && {
    for (double& value : image_.values()) value = srgb_decode(value);
    return std::move(image_);
  }

 private:
  Image image_;
};

/// One part: a title, a box that `paint(canvas, top, column, value)` fills, ticks below it.
struct Part {
  std::string title;
  Range range;
  int box_height;
  std::function<void(Canvas&, int, int, double)> paint;
  bool is_graph;

  [[nodiscard]] int height() const {
    return Layout::kTitleHeight + box_height + Layout::kTicksHeight + Layout::kMargin;
  }
};

/// As many ticks as have room for their numbers.
std::vector<Tick> ticks_with_room(const Range& range, const Text& numbers) {
  for (int count = kMaxTicks;; --count) {
    std::vector<Tick> ticks = round_ticks(range.low, range.high, count);
    double widest = 0;
    for (const Tick& tick : ticks) widest = std::max(widest, numbers.width(tick.label));
    if (count == 2 || (widest + kNumberSize) * (count - 1) < Layout::kPlotWidth) return ticks;
  }
}

void draw_ticks(Canvas& canvas, const Part& part, int bottom) {
  const Text numbers(kNumberSize);
  for (const Tick& tick : ticks_with_room(part.range, numbers)) {
    // halves, because the range may be wider than a number can be
    const double t =
        (tick.value / 2 - part.range.low / 2) / (part.range.high / 2 - part.range.low / 2);
    const double x = Layout::kLeft + t * Layout::kPlotWidth;
    const int column = std::min(static_cast<int>(x), Layout::kLeft + Layout::kPlotWidth - 1);
    canvas.fill(column, bottom + 1, 1, 7, kInk);
    canvas.write(numbers, x, 0.5, bottom + 28, tick.label);
  }
}

/// The scale of a graph from 0 to 1, at its left.
void draw_scale(Canvas& canvas, const Part& part, int top) {
  const Text numbers(kNumberSize);
  for (const double value : {0.0, 0.5, 1.0}) {
    const int y = top + static_cast<int>(std::lround((1 - value) * part.box_height));
    canvas.fill(Layout::kLeft - 8, std::min(y, top + part.box_height), 7, 1, kInk);
    canvas.write(numbers, Layout::kLeft - 12, 1, y + 6, fmt::format("{}", value));
  }
}

void draw_part(Canvas& canvas, const Part& part, int top) {
  const Text titles(kTitleSize);
  canvas.write(titles, Layout::kLeft, 0, top + 30,
               titles.shortened(part.title, Layout::kWidth - Layout::kLeft - Layout::kMargin));
  const int box = top + Layout::kTitleHeight;
  for (int i = 0; i < Layout::kPlotWidth; ++i) {
    const double t = (i + 0.5) / Layout::kPlotWidth;
    part.paint(canvas, box, Layout::kLeft + i, (1 - t) * part.range.low + t * part.range.high);
  }
  canvas.frame(Layout::kLeft, box, Layout::kPlotWidth, part.box_height);
  draw_ticks(canvas, part, box + part.box_height);
  if (part.is_graph) draw_scale(canvas, part, box);
}

Part color_part(const Volume& volume, const std::string& label, const Range& range) {
  const auto function = volume.color->function();
  const char* meaning = volume.glow == Glow::emission ? ": emission per unit of length" : "";
  return {label + meaning, range, Layout::kBarHeight,
          [function](Canvas& canvas, int top, int column, double value) {
            Color color = function(value);
            for (double& component : color) component = srgb_encode(std::min(component, 1.0));
            for (int y = top; y < top + Layout::kBarHeight; ++y) canvas.set(column, y, color);
          },
          false};
}

Part opacity_part(const Volume& volume, const std::string& label, const Range& range,
                  double length) {
  const auto function = volume.extinction->function();
  return {
      fmt::format("{}: opacity over a length of {:g}", label, length), range, Layout::kGraphHeight,
      [function, length](Canvas& canvas, int top, int column, double value) {
        const double opacity = -std::expm1(-function(value)[0] * length);
        for (int y = 0; y < Layout::kGraphHeight; ++y) {
          // how much of this pixel lies under the curve
          const double covered =
              std::clamp(opacity * Layout::kGraphHeight - (Layout::kGraphHeight - 1 - y), 0.0, 1.0);
          const double grey = 1 - covered * (1 - kShade);
          canvas.set(column, top + y, {grey, grey, grey});
        }
      },
      true};
}

}  // namespace

Image draw_color_bar(const Volume& volume, const ColorBarLabels& labels, double length) {
  if (!volume.color && !volume.extinction)
    throw UsageError("--colorbar: the specification has neither colour nor extinction to show");
  std::optional<Range> color, opacity;
  if (volume.color) color = range_of(*volume.color);
  if (volume.extinction) opacity = range_of(*volume.extinction);
  if (color && opacity && volume.color->field == volume.extinction->field) {
    color = Range{std::min(color->low, opacity->low), std::max(color->high, opacity->high)};
    opacity = color;
  }
  std::vector<Part> parts;
  if (color) parts.push_back(color_part(volume, labels.color, widened(*color)));
  if (opacity) parts.push_back(opacity_part(volume, labels.extinction, widened(*opacity), length));
  int height = Layout::kMargin;
  for (const Part& part : parts) height += part.height();
  Canvas canvas(height);
  int top = Layout::kMargin;
  for (const Part& part : parts) {
    draw_part(canvas, part, top);
    top += part.height();
  }
  return std::move(canvas).linear();
}

}  // namespace hiac::tools
