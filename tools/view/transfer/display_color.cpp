#include "tools/view/transfer/display_color.hpp"

#include <QRegularExpression>
#include <QStringList>
#include <algorithm>
#include <array>
#include <cmath>

#include "hiac/scene/colormaps/color_space.hpp"

namespace hiac::view {

QColor on_screen(const Color& color) {
  std::array<int, 3> rgb{};
  for (std::size_t c = 0; c < 3; ++c)
    rgb[c] = static_cast<int>(
        std::lround(255 * color_space::gamma_encoded(std::clamp(color[c], 0.0, 1.0))));
  return {rgb[0], rgb[1], rgb[2]};
}

Color from_screen(const QColor& color) {
  return {color_space::gamma_decoded(color.red() / 255.0),
          color_space::gamma_decoded(color.green() / 255.0),
          color_space::gamma_decoded(color.blue() / 255.0)};
}

QString color_text(const Color& color) {
  const QColor shown = on_screen(color);
  if (from_screen(shown) == color) return shown.name();
  return QStringLiteral("%1 %2 %3")
      .arg(color[0], 0, 'g', 6)
      .arg(color[1], 0, 'g', 6)
      .arg(color[2], 0, 'g', 6);
}

std::optional<Color> color_from(const QString& text) {
  static const QRegularExpression kBlank(QStringLiteral("[\\s,]+"));
  const QStringList parts = text.split(kBlank, Qt::SkipEmptyParts);
  if (parts.size() == 3) {
    Color color{};
    for (std::size_t c = 0; c < 3; ++c) {
      bool is_number = false;
      color[c] = parts[static_cast<qsizetype>(c)].toDouble(&is_number);
      if (!is_number || !(color[c] >= 0 && color[c] <= kLargestColor)) return std::nullopt;
    }
    return color;
  }
  const QColor named(text.trimmed());
  if (parts.size() != 1 || !named.isValid()) return std::nullopt;
  return from_screen(named);
}

QColor mixed(const QColor& a, const QColor& b, double share) {
  const auto part = [&](int x, int y) {
    return static_cast<int>(std::lround(std::lerp(x, y, share)));
  };
  return {part(a.red(), b.red()), part(a.green(), b.green()), part(a.blue(), b.blue())};
}

}  // namespace hiac::view
