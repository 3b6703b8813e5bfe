#include "hiac/annotate/color_legend.hpp"

#include <memory>

#include "hiac/annotate/scalar_axis.hpp"

namespace hiac {
namespace {

bool is_upright(AnnotationPlace place) {
  return place == AnnotationPlace::left || place == AnnotationPlace::right;
}

/// What is drawn, and where.
struct Legend {
  std::shared_ptr<const Text> text;
  Lettering lettering;
  bool upright;
  PiecewiseLinear<3> function;
  ScalarAxis axis;
  std::vector<Tick> ticks;
  double widest;  ///< of the numbers
  LegendLayout box;
  int width, height;  ///< of the whole
  std::string label;

  [[nodiscard]] int tick_length() const { return lettering.at_least(2, 0.3); }
  [[nodiscard]] int gap() const { return lettering.at_least(2, 0.25); }
};

double widest_of(const std::vector<Tick>& ticks, const Text& text) {
  double widest = 0;
  for (const Tick& tick : ticks) widest = std::max(widest, text.width(typeset(tick.label)));
  return widest;
}

Legend legend_of(const ColorBarAnnotation& wanted, const Scene& scene, const std::string& label,
                 Lettering lettering) {
  const auto text = std::make_shared<const Text>(lettering.em);
  const bool upright = is_upright(wanted.place);
  const int length = std::max(2, static_cast<int>(std::lround(wanted.size.pixels(scene.image))));
  const ColorTransfer& color = *scene.volume.color;
  const ScalarAxis axis =
      axis_over(scalars_of(color), wanted.logarithmic.value_or(false), "annotation.colorbar.scale");
  std::vector<Tick> ticks = axis.ticks([&](const std::vector<Tick>& some) {
    const double each = upright ? 1.6 * lettering.em : widest_of(some, *text) + lettering.em;
    return each * static_cast<double>(some.size() - 1) < length;
  });
  const double widest = widest_of(ticks, *text);
  Legend legend{text, lettering, upright, color.function(), axis, std::move(ticks), widest, {},
                0,    0,         {}};
  const int halo = lettering.halo(), line = lettering.line();
  const int thickness = lettering.at_least(4, 1.1);
  const int numbers = static_cast<int>(std::ceil(widest));
  if (upright) {
    // half a number may stand above the bar and below it
    const int above = halo + std::max(line, lettering.at_least(1, 0.6));
    legend.box = {halo + line, above, thickness, length};
    legend.width = legend.box.x + thickness + line + legend.tick_length() + legend.gap() + numbers +
                   (label.empty() ? 0 : legend.gap() + lettering.height()) + halo;
    legend.height = length + 2 * above;
  } else {
    const int beside = halo + std::max(line, (numbers + 1) / 2);
    const int above = halo + (label.empty() ? 0 : lettering.height() + legend.gap()) + line;
    legend.box = {beside, above, length, thickness};
    legend.width = length + 2 * beside;
    legend.height = above + thickness + line + legend.tick_length() + lettering.height() + halo;
  }
  legend.label = text->shortened(label, (upright ? legend.height : legend.width) - 2 * halo);
  return legend;
}

void draw_colors(Canvas& canvas, const Legend& l) {
  const int length = l.upright ? l.box.height : l.box.width;
  for (int k = 0; k < length; ++k) {
    const Color color = display_color(l.function(l.axis.value_at((k + 0.5) / length)));
    if (l.upright)
      canvas.fill(l.box.x, l.box.y + length - 1 - k, l.box.width, 1, color);
    else
      canvas.fill(l.box.x + k, l.box.y, 1, l.box.height, color);
  }
}

void draw_upright_ticks(Canvas& canvas, const Legend& l, const Color& ink) {
  const int line = l.lettering.line();
  const double start = l.box.x + l.box.width + line;
  const double numbers = start + l.tick_length() + l.gap();
  for (const Tick& tick : l.ticks) {
    const double y = l.box.y + (1 - l.axis.position_of(tick.value)) * l.box.height;
    canvas.rectangle({start, y - line / 2.0}, {start + l.tick_length(), y + line / 2.0}, ink);
    const int baseline = static_cast<int>(std::lround(y + 0.36 * l.lettering.em));
    canvas.write(*l.text, numbers, 0, baseline, typeset(tick.label), ink);
  }
}

void draw_level_ticks(Canvas& canvas, const Legend& l, const Color& ink) {
  const int line = l.lettering.line();
  const double start = l.box.y + l.box.height + line;
  const int baseline = l.box.y + l.box.height + line + l.tick_length() + l.lettering.ascent();
  for (const Tick& tick : l.ticks) {
    const double x = l.box.x + l.axis.position_of(tick.value) * l.box.width;
    canvas.rectangle({x - line / 2.0, start}, {x + line / 2.0, start + l.tick_length()}, ink);
    canvas.write(*l.text, x, 0.5, baseline, typeset(tick.label), ink);
  }
}

void draw(Canvas& canvas, const Legend& l, const Ink& ink) {
  draw_colors(canvas, l);
  canvas.frame(l.box.x, l.box.y, l.box.width, l.box.height, l.lettering.line(), ink.text);
  const int halo = l.lettering.halo();
  if (l.upright) {
    draw_upright_ticks(canvas, l, ink.text);
    // the label's descenders are at the right edge
    const int baseline = l.width - halo - (l.lettering.height() - l.lettering.ascent());
    canvas.write_upwards(*l.text, baseline, l.box.y + l.box.height / 2.0, l.label, ink.text);
  } else {
    draw_level_ticks(canvas, l, ink.text);
    canvas.write(*l.text, l.width / 2.0, 0.5, halo + l.lettering.ascent(), l.label, ink.text);
  }
}

}  // namespace

AnnotationPart color_legend(const ColorBarAnnotation& wanted, const Scene& scene,
                            const std::string& label, Lettering lettering) {
  const auto legend = std::make_shared<const Legend>(legend_of(wanted, scene, label, lettering));
  return {"colorbar", wanted.place, legend->width, legend->height,
          [legend](Canvas& canvas, const Ink& ink) { draw(canvas, *legend, ink); }};
}

LegendLayout legend_layout(const ColorBarAnnotation& wanted, const Scene& scene,
                           const std::string& label, Lettering lettering) {
  return legend_of(wanted, scene, label, lettering).box;
}

}  // namespace hiac
