#include "hiac/annotate/color_bar.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include <fmt/format.h>

#include "hiac/annotate/canvas.hpp"
#include "hiac/annotate/scalar_axis.hpp"
#include "hiac/annotate/text.hpp"
#include "hiac/base/error.hpp"

namespace hiac {
namespace {

using Layout = ColorBarLayout;

constexpr int kTitleSize = 22, kNumberSize = 18;  // pixels an em
constexpr Color kPaper{1, 1, 1}, kLetters{0, 0, 0};
constexpr Color kLine{0.25, 0.25, 0.25};  // encoded
constexpr double kShade = 0.62;           // of the area under a curve; encoded

/// One part: a title, a box that `paint(canvas, top, column, value)` fills, ticks below it.
struct Part {
  std::string title;
  ScalarAxis axis;
  int box_height;
  std::function<void(Canvas&, int, int, double)> paint;
  bool is_graph;

  [[nodiscard]] int height() const {
    return Layout::kTitleHeight + box_height + Layout::kTicksHeight + Layout::kMargin;
  }
};

/// Whether ticks have room for their numbers.
bool have_room(const std::vector<Tick>& ticks, const Text& numbers) {
  double widest = 0;
  for (const Tick& tick : ticks) widest = std::max(widest, numbers.width(typeset(tick.label)));
  return (widest + kNumberSize) * static_cast<double>(ticks.size() - 1) < Layout::kPlotWidth;
}

void draw_ticks(Canvas& canvas, const Part& part, int bottom) {
  const Text numbers(kNumberSize);
  const auto fit = [&](const std::vector<Tick>& ticks) { return have_room(ticks, numbers); };
  for (const Tick& tick : part.axis.ticks(fit)) {
    const double x = Layout::kLeft + part.axis.position_of(tick.value) * Layout::kPlotWidth;
    const int column = std::min(static_cast<int>(x), Layout::kLeft + Layout::kPlotWidth - 1);
    canvas.fill(column, bottom + 1, 1, 7, kLine);
    canvas.write(numbers, x, 0.5, bottom + 28, typeset(tick.label), kLetters);
  }
}

/// The scale of a graph from 0 to 1, at its left.
void draw_scale(Canvas& canvas, const Part& part, int top) {
  const Text numbers(kNumberSize);
  for (const double value : {0.0, 0.5, 1.0}) {
    const int y = top + static_cast<int>(std::lround((1 - value) * part.box_height));
    canvas.fill(Layout::kLeft - 8, std::min(y, top + part.box_height), 7, 1, kLine);
    canvas.write(numbers, Layout::kLeft - 12, 1, y + 6, fmt::format("{}", value), kLetters);
  }
}

void draw_part(Canvas& canvas, const Part& part, int top) {
  const Text titles(kTitleSize);
  canvas.write(titles, Layout::kLeft, 0, top + 30,
               titles.shortened(part.title, Layout::kWidth - Layout::kLeft - Layout::kMargin),
               kLetters);
  const int box = top + Layout::kTitleHeight;
  for (int i = 0; i < Layout::kPlotWidth; ++i)
    part.paint(canvas, box, Layout::kLeft + i, part.axis.value_at((i + 0.5) / Layout::kPlotWidth));
  canvas.frame(Layout::kLeft, box, Layout::kPlotWidth, part.box_height, 1, kLine);
  draw_ticks(canvas, part, box + part.box_height);
  if (part.is_graph) draw_scale(canvas, part, box);
}

Part color_part(const Volume& volume, const std::string& label, const ScalarAxis& axis) {
  const auto function = volume.color->function();
  const char* meaning = volume.glow == Glow::emission ? ": emission per unit of length" : "";
  return {label + meaning, axis, Layout::kBarHeight,
          [function](Canvas& canvas, int top, int column, double value) {
            canvas.fill(column, top, 1, Layout::kBarHeight, display_color(function(value)));
          },
          false};
}

Part opacity_part(const Volume& volume, const std::string& label, const ScalarAxis& axis,
                  double length) {
  const auto function = volume.extinction->function();
  return {
      fmt::format("{}: opacity over a length of {:g}", label, length), axis, Layout::kGraphHeight,
      [function, length](Canvas& canvas, int top, int column, double value) {
        const double opacity = -std::expm1(-function(value)[0] * length);
        for (int y = 0; y < Layout::kGraphHeight; ++y) {
          // how much of this pixel lies under the curve
          const double covered =
              std::clamp(opacity * Layout::kGraphHeight - (Layout::kGraphHeight - 1 - y), 0.0, 1.0);
          const double grey = 1 - covered * (1 - kShade);
          canvas.blend(column, top + y, {grey, grey, grey}, 1);
        }
      },
      true};
}

}  // namespace

Image draw_color_bar(const Volume& volume, const ColorBarLabels& labels, double length,
                     bool logarithmic) {
  if (!volume.color && !volume.extinction)
    throw UsageError("the specification has neither colour nor extinction to show");
  std::array<double, 2> color{}, opacity{};
  if (volume.color) color = scalars_of(*volume.color);
  if (volume.extinction) opacity = scalars_of(*volume.extinction);
  const bool same_field =
      volume.color && volume.extinction && volume.color->field == volume.extinction->field;
  // no logarithm reaches down to an extinction's point at zero
  const bool shared = same_field && !(logarithmic && opacity[0] <= 0);
  if (shared) {
    color = {std::min(color[0], opacity[0]), std::max(color[1], opacity[1])};
    opacity = color;
  }
  const std::string key = "volume.color.scale";
  std::vector<Part> parts;
  if (volume.color)
    parts.push_back(color_part(volume, labels.color, axis_over(color, logarithmic, key)));
  if (volume.extinction)
    parts.push_back(opacity_part(volume, labels.extinction,
                                 axis_over(opacity, shared && logarithmic, key), length));
  int height = Layout::kMargin;
  for (const Part& part : parts) height += part.height();
  Canvas canvas(Layout::kWidth, height, kPaper);
  int top = Layout::kMargin;
  for (const Part& part : parts) {
    draw_part(canvas, part, top);
    top += part.height();
  }
  return canvas.linear();
}

}  // namespace hiac
