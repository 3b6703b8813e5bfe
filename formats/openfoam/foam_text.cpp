#include "formats/openfoam/foam_text.hpp"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "hiac/base/error.hpp"

namespace hiac::formats::openfoam {
namespace {

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

bool ends_word(char c) {
  return is_space(c) || c == ';' || c == '(' || c == ')' || c == '{' || c == '}';
}

}  // namespace

void FoamText::fail(const std::string& problem) const {
  const auto line = std::count(text_.begin(), text_.begin() + static_cast<long>(at_), '\n') + 1;
  throw InputError(
      binary_ ? fmt::format("{}: byte {}", path_, at_) : fmt::format("{}:{}", path_, line),
      problem);
}

void FoamText::skip_space() {
  while (at_ < text_.size()) {
    if (is_space(text_[at_])) {
      ++at_;
    } else if (text_.substr(at_).starts_with("//")) {
      at_ = std::min(text_.find('\n', at_), text_.size());
    } else if (text_.substr(at_).starts_with("/*")) {
      const std::size_t end = text_.find("*/", at_ + 2);
      at_ = end == std::string_view::npos ? text_.size() : end + 2;
    } else {
      return;
    }
  }
}

char FoamText::peek() {
  skip_space();
  return at_ < text_.size() ? text_[at_] : '\0';
}

void FoamText::expect(char c) {
  if (peek() != c)
    fail(at_ < text_.size() ? fmt::format("'{}' expected", c)
                            : fmt::format("ended where '{}' is expected", c));
  ++at_;
}

std::string_view FoamText::word() {
  skip_space();
  const std::size_t begin = at_;
  if (at_ < text_.size() && text_[at_] == '"') {
    const std::size_t end = text_.find('"', at_ + 1);
    at_ = end == std::string_view::npos ? text_.size() : end + 1;
    return text_.substr(begin, at_ - begin);
  }
  while (at_ < text_.size() && !ends_word(text_[at_])) ++at_;
  return text_.substr(begin, at_ - begin);
}

double FoamText::real() {
  skip_space();
  double value = 0;
  const char* end = text_.data() + text_.size();
  const auto [next, error] = std::from_chars(text_.data() + at_, end, value);
  if (error != std::errc()) fail("a number expected");
  at_ = static_cast<std::size_t>(next - text_.data());
  return value;
}

std::int64_t FoamText::whole() {
  skip_space();
  std::int64_t value = 0;
  const char* end = text_.data() + text_.size();
  const auto [next, error] = std::from_chars(text_.data() + at_, end, value);
  if (error != std::errc()) fail("a whole number expected");
  at_ = static_cast<std::size_t>(next - text_.data());
  return value;
}

std::size_t FoamText::count(std::size_t bytes_each) {
  const std::int64_t value = whole();
  const std::size_t most = (text_.size() - at_) / bytes_each;
  if (value < 0 || static_cast<std::uint64_t>(value) > most)
    fail(fmt::format("a count that fits the file expected (at most {}; {} found)", most, value));
  return static_cast<std::size_t>(value);
}

std::string_view FoamText::raw(std::size_t bytes) {
  if (bytes > text_.size() - at_) fail(fmt::format("ended before {} bytes of a list", bytes));
  const std::string_view part = text_.substr(at_, bytes);
  at_ += bytes;
  return part;
}

void FoamText::skip_dictionary() {
  expect('{');
  for (int depth = 1; depth > 0; ++at_) {
    if (peek() == '\0') fail("ended within a dictionary");
    if (text_[at_] == '{') ++depth;
    if (text_[at_] == '}') --depth;
  }
}

void FoamText::skip_entry() {
  int depth = 0;
  while (at_ < text_.size() && !(depth == 0 && text_[at_] == ';')) {
    if (text_[at_] == '{') ++depth;
    if (text_[at_] == '}' && --depth == 0) break;
    ++at_;
  }
  if (at_ < text_.size()) ++at_;
}

void FoamText::skip_line() { at_ = std::min(text_.find('\n', at_), text_.size()); }

}  // namespace hiac::formats::openfoam
