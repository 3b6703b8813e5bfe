#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "hiac/scene/scene.hpp"

namespace hiac {

/// What is drawn on a finished picture, the table [annotation] of a specification. Engines do not
/// know it: it is no part of a Scene, and changes no order, no channel and no hash.

/// Where a part of the annotation is: at a corner, or in the middle of an edge.
enum class AnnotationPlace : std::uint8_t {
  top_left,
  top,
  top_right,
  left,
  right,
  bottom_left,
  bottom,
  bottom_right
};

/// A length in a picture: pixels, or a share of its height (of its width, if that is less).
struct PictureLength {
  double value = 0;
  bool in_pixels = false;

  [[nodiscard]] double pixels(ImageSize size) const {
    return in_pixels ? value : value * std::min(size.width, size.height);
  }
  bool operator==(const PictureLength&) const = default;
};

/// The colours of [volume.color] along a bar, with numbers and a label.
struct ColorBarAnnotation {
  AnnotationPlace place = AnnotationPlace::right;  ///< left, right, top or bottom
  PictureLength size{0.5};                         ///< length of the bar
  std::optional<std::string> label;                ///< none: the field's name and unit
  /// Whether the bar is even in the scalar's logarithm. None: as [volume.color], which the parser
  /// resolves.
  std::optional<bool> logarithmic;

  bool operator==(const ColorBarAnnotation&) const = default;
};

/// The directions of the world's axes as the camera sees them at its look_at.
struct AxesAnnotation {
  AnnotationPlace place = AnnotationPlace::bottom_left;
  PictureLength size{0.2};  ///< side of the square that contains them

  bool operator==(const AxesAnnotation&) const = default;
};

/// A line of text.
struct TitleAnnotation {
  std::string text;
  AnnotationPlace place = AnnotationPlace::top;
  PictureLength size{0.045};  ///< of the letters, an em

  bool operator==(const TitleAnnotation&) const = default;
};

/// The time of the mesh.
struct TimeAnnotation {
  AnnotationPlace place = AnnotationPlace::top;
  PictureLength size{0.035};    ///< of the letters, an em
  std::optional<double> value;  ///< none: the time that the mesh has
  std::string unit;             ///< follows the number; empty: none

  bool operator==(const TimeAnnotation&) const = default;
};

/// A bar of a stated length in the world: parallel to the screen, in perspective in the plane
/// through look_at.
struct LengthAnnotation {
  AnnotationPlace place = AnnotationPlace::bottom_right;
  PictureLength size{0.25};      ///< the longest that the bar may be
  std::optional<double> length;  ///< world units; none: the largest of 1, 2, 5 times 10^n that fits
  std::string unit;              ///< follows the number; empty: none

  bool operator==(const LengthAnnotation&) const = default;
};

struct Annotation {
  PictureLength text_size{0.03};  ///< of numbers and labels, an em
  PictureLength margin{0.02};     ///< between the parts and the picture's edges
  std::optional<Color> color;     ///< of text and lines, linear; none: black or white
  bool in_float_formats = false;  ///< drawn into pictures of floating-point numbers, too
  /// The bar of the colours is even in the scalar's logarithm, where it is alone (draw_color_bar).
  bool bar_is_logarithmic = false;
  std::optional<TitleAnnotation> title;
  std::optional<TimeAnnotation> time;
  std::optional<AxesAnnotation> axes;
  std::optional<LengthAnnotation> scale;
  std::optional<ColorBarAnnotation> color_bar;

  /// Whether there is anything to draw.
  [[nodiscard]] bool draws() const { return title || time || axes || scale || color_bar; }
  bool operator==(const Annotation&) const = default;
};

}  // namespace hiac
