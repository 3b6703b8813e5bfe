#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace hiac {

/// Text in DejaVu Sans, whose outlines are part of the program, so that a picture does not depend
/// on what fonts a machine has. Glyphs are not hinted: they only depend on FreeType's rasterizer.
class Text {
 public:
  /// `size`: pixels an em.
  explicit Text(int size);
  ~Text();
  Text(const Text&) = delete;
  Text& operator=(const Text&) = delete;

  /// How far a line of UTF-8 goes, pixels. What is not valid UTF-8 counts as U+FFFD, and a
  /// character that the font does not have as its box.
  [[nodiscard]] double width(std::string_view line) const;

  /// The line, or as much of its start as fits with an ellipsis.
  [[nodiscard]] std::string shortened(std::string_view line, double width) const;

  /// Receives a pixel (column, row) and which share of it a glyph covers, more than 0.
  using Paint = std::function<void(std::int64_t x, std::int64_t y, double coverage)>;

  /// Paints the line's glyphs, one after the other. The line starts at `x` and stands on
  /// `baseline`, the upper edge of that row of pixels.
  void draw(double x, std::int64_t baseline, std::string_view line, const Paint& paint) const;

 private:
  struct Font;
  std::unique_ptr<Font> font_;
};

}  // namespace hiac
