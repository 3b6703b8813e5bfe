#include "formats/tecplot/tecplot_tokens.hpp"

#include <cctype>

namespace hiac::formats::tecplot {

bool Tokens::skip() {
  while (!cursor_.at_end()) {
    const char c = front();
    if (c == '#')
      cursor_.line();
    else if (TextCursor::is_space(c) || c == ',')
      cursor_.bytes(1, "");
    else
      return true;
  }
  return false;
}

std::string Tokens::next() {
  const char c = front();
  if (c == '"' || c == '\'') return quoted_text(c);
  if (c == '(') return bracketed();
  const std::size_t start = cursor_.offset();
  while (!cursor_.at_end() && !TextCursor::is_space(front()) && front() != ',' && front() != '=' &&
         front() != '(' && front() != '"')
    cursor_.bytes(1, "");
  if (cursor_.offset() == start) cursor_.bytes(1, "");
  return since(start);
}

bool Tokens::take(char c) {
  if (!skip() || front() != c) return false;
  cursor_.bytes(1, "");
  return true;
}

std::string Tokens::since(std::size_t start) const {
  return std::string(cursor_.text().substr(start, cursor_.offset() - start));
}
std::string Tokens::quoted_text(char quote) {
  const std::size_t start = cursor_.offset();
  cursor_.bytes(1, "");
  while (!cursor_.at_end() && front() != quote && front() != '\n') cursor_.bytes(1, "");
  if (cursor_.at_end() || front() != quote) cursor_.fail_at(start, "a text without its end");
  std::string text = since(start + 1);
  cursor_.bytes(1, "");
  return text;
}
std::string Tokens::bracketed() {
  const std::size_t start = cursor_.offset();
  int depth = 0;
  do {
    if (cursor_.at_end()) cursor_.fail_at(start, "a list without its end");
    if (front() == '(') ++depth;
    if (front() == ')') --depth;
    cursor_.bytes(1, "");
  } while (depth > 0);
  return since(start);
}

std::vector<std::size_t> number_list(std::string_view text) {
  std::vector<std::size_t> numbers;
  std::size_t at = 0;
  bool range = false;
  constexpr std::size_t kMost = 1 << 16;
  while (at < text.size()) {
    if (std::isdigit(static_cast<unsigned char>(text[at])) == 0) {
      range = text[at] == '-';
      ++at;
      continue;
    }
    std::size_t number = 0;
    while (at < text.size() && std::isdigit(static_cast<unsigned char>(text[at])) != 0 &&
           number < kMost)
      number = 10 * number + static_cast<std::size_t>(text[at++] - '0');
    if (number == 0 || number > kMost) continue;
    if (range && !numbers.empty())
      for (std::size_t n = numbers.back() + 1; n + 1 < number; ++n) numbers.push_back(n);
    numbers.push_back(number - 1);
    range = false;
  }
  return numbers;
}

}  // namespace hiac::formats::tecplot
