#include "tools/common/plain_text.hpp"

namespace hiac::tools {
namespace {

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

// The second byte of U+0080 to U+009F, of which the first is 0xC2.
bool is_high_control(char first, char second) {
  return first == '\xc2' && static_cast<unsigned char>(second) < 0xa0;
}

}  // namespace

std::string plain_text(std::string text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (is_control(text[i]) && text[i] != '\n' && text[i] != '\t') text[i] = ' ';
    if (i > 0 && is_high_control(text[i - 1], text[i])) text[i - 1] = text[i] = ' ';
  }
  return text;
}

std::string plain_line(std::string text) {
  text = plain_text(std::move(text));
  for (char& c : text)
    if (is_control(c)) c = ' ';
  return text;
}

}  // namespace hiac::tools
