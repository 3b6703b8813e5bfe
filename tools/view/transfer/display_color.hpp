#pragma once

#include <QColor>
#include <QString>
#include <optional>

#include "hiac/scene/scene.hpp"

namespace hiac::view {

/// A linear colour as a screen shows it: encoded by sRGB's function, cut off at 1.
QColor on_screen(const Color& color);
/// The linear colour that a screen shows so.
Color from_screen(const QColor& color);

/// A colour as text: #rrggbb if those are its numbers, otherwise its linear red, green and blue.
QString color_text(const Color& color);
/// Reads what color_text writes, and the names of colours; nothing for any other text, and for
/// negative numbers.
std::optional<Color> color_from(const QString& text);

/// A colour between two of a palette, so that it suits light and dark; `share` of the second.
QColor mixed(const QColor& a, const QColor& b, double share);

}  // namespace hiac::view
