#include "hiac/annotate/text.hpp"

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

// font.S
extern "C" const unsigned char hiac_font_begin[];
extern "C" const unsigned char hiac_font_end[];

namespace hiac {
namespace {

constexpr char32_t kReplacement = 0xfffd;

/// The character that starts a text, and how many bytes it has.
struct Decoded {
  char32_t character;
  std::size_t bytes;
};

/// UTF-8 as RFC 3629 has it: no overlong forms, no surrogates.
Decoded first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  constexpr char32_t kSmallest[] = {0, 0, 0x80, 0x800, 0x10000};
  if (lead < 0xc0 || lead > 0xf4 || text.size() < length) return {kReplacement, 1};
  char32_t character = lead & (0x7fU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return {kReplacement, 1};
    character = character << 6 | (byte(i) & 0x3fU);
  }
  const bool surrogate = character >= 0xd800 && character < 0xe000;
  if (character < kSmallest[length] || character > 0x10ffff || surrogate) return {kReplacement, 1};
  return {character, length};
}

void require_success(FT_Error error) {
  if (error != 0) throw std::runtime_error("FreeType fails with error " + std::to_string(error));
}

}  // namespace

struct Text::Font {
  explicit Font(int size) {
    require_success(FT_Init_FreeType(&library));
    require_success(FT_New_Memory_Face(
        library, hiac_font_begin, static_cast<FT_Long>(hiac_font_end - hiac_font_begin), 0, &face));
    require_success(FT_Set_Pixel_Sizes(face, 0, static_cast<FT_UInt>(size)));
  }
  ~Font() { FT_Done_FreeType(library); }
  Font(const Font&) = delete;
  Font& operator=(const Font&) = delete;

  /// Loads a character's outline; returns how far it goes, pixels.
  double load(char32_t character) const {
    require_success(FT_Load_Glyph(face, FT_Get_Char_Index(face, character),
                                  FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP));
    return static_cast<double>(face->glyph->linearHoriAdvance) / 65536;
  }

  FT_Library library = nullptr;
  FT_Face face = nullptr;
};

Text::Text(int size) : font_(std::make_unique<Font>(size)) {}
Text::~Text() = default;

double Text::width(std::string_view line) const {
  double sum = 0;
  while (!line.empty()) {
    const auto [character, bytes] = first_character(line);
    sum += font_->load(character);
    line.remove_prefix(bytes);
  }
  return sum;
}

std::string Text::shortened(std::string_view line, double width) const {
  if (this->width(line) <= width) return std::string(line);
  const std::string ellipsis = "\u2026";
  double sum = this->width(ellipsis);
  std::size_t kept = 0;
  while (kept < line.size()) {
    const auto [character, bytes] = first_character(line.substr(kept));
    sum += font_->load(character);
    if (sum > width) break;
    kept += bytes;
  }
  return std::string(line.substr(0, kept)) + ellipsis;
}

void Text::draw(double x, std::int64_t baseline, std::string_view line, const Paint& paint) const {
  while (!line.empty()) {
    const auto [character, bytes] = first_character(line);
    line.remove_prefix(bytes);
    const double advance = font_->load(character);
    const double column = std::floor(x);
    FT_GlyphSlot glyph = font_->face->glyph;
    FT_Outline_Translate(&glyph->outline, std::lround((x - column) * 64), 0);
    require_success(FT_Render_Glyph(glyph, FT_RENDER_MODE_NORMAL));
    const FT_Bitmap& bitmap = glyph->bitmap;
    const auto left = static_cast<std::int64_t>(column) + glyph->bitmap_left;
    const std::int64_t top = baseline - glyph->bitmap_top;
    for (std::int64_t j = 0; j < bitmap.rows; ++j)
      for (std::int64_t i = 0; i < bitmap.width; ++i)
        if (const auto level = bitmap.buffer[j * bitmap.pitch + i]; level > 0)
          paint(left + i, top + j, level / 255.0);
    x += advance;
  }
}

}  // namespace hiac
