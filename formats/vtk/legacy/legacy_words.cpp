#include "formats/vtk/legacy/legacy_words.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>

#include <fmt/format.h>

#include "hiac/base/error.hpp"

namespace hiac::formats::vtk {
namespace {

bool is_blank(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

std::string lower(std::string_view word) {
  std::string result(word);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

/// A word in a form for messages: short and printable.
std::string shown(std::string_view word) {
  std::string result(word.substr(0, 40));
  for (char& c : result)
    if (std::isprint(static_cast<unsigned char>(c)) == 0) c = '?';
  return word.size() > 40 ? result + "..." : result;
}

/// VTK's reader cuts longer words of headers in two.
constexpr std::size_t kLongestWord = 255;

}  // namespace

std::string_view LegacyWords::word() {
  while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
  last_ = at_;
  while (at_ < text_.size() && !is_blank(text_[at_])) ++at_;
  return text_.substr(last_, at_ - last_);
}

std::string LegacyWords::keyword(const std::string& what) {
  const std::string_view next = word();
  if (next.empty()) fail(fmt::format("the file ends too soon ({} expected)", what));
  if (next.size() > kLongestWord)
    fail(fmt::format("'{}': the word is too long ({} of at most {} characters expected, {} found)",
                     shown(next), what, kLongestWord, next.size()));
  return lower(next);
}

std::string_view LegacyWords::name() {
  const std::size_t before = at_;
  keyword("a name");
  std::string_view name = text_.substr(before, at_ - before);
  name.remove_prefix(std::min(name.find_first_not_of(" \t\r\n\v\f"), name.size()));
  return name;
}

std::size_t LegacyWords::count(const std::string& what) {
  const std::string_view next = word();
  if (next.empty()) fail(fmt::format("the file ends too soon ({} expected)", what));
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(next.data(), next.data() + next.size(), value);
  // the bound keeps products of counts and sizes from overflowing
  if (error != std::errc() || end != next.data() + next.size() || value >> 40 != 0)
    fail(fmt::format("wrong count ({} expected, '{}' found)", what, shown(next)));
  return value;
}

double LegacyWords::number(const std::string& what) {
  const std::string_view next = word();
  double value = 0;
  constexpr NumberType kDouble{NumberType::Family::real, 8};
  if (judge_ascii_number(next, kDouble, value) != AsciiNumber::fine)
    fail(fmt::format("wrong number ({} expected, '{}' found)", what, shown(next)));
  return value;
}

std::string_view LegacyWords::line() {
  last_ = at_;
  const std::size_t end = std::min(text_.find('\n', at_), text_.size());
  std::string_view result = text_.substr(at_, end - at_);
  at_ = std::min(end + 1, text_.size());
  if (result.ends_with('\r')) result.remove_suffix(1);
  return result;
}

bool LegacyWords::goes_on_with(std::string_view keyword) {
  while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
  return lower(text_.substr(at_, keyword.size())) == keyword;
}

void LegacyWords::to_binary_values() {
  const std::string_view rest = line();
  if (at_ == 0 || text_[at_ - 1] != '\n') fail("the file ends too soon (binary values expected)");
  if (rest.size() >= kLongestWord || !std::all_of(rest.begin(), rest.end(), is_blank))
    fail(fmt::format("binary values must begin on a line of their own ('{}' found before them)",
                     shown(rest)));
}

void LegacyWords::fail_at(std::size_t at, const std::string& what) const {
  if (binary_) throw InputError(subject_, fmt::format("byte {}: {}", at, what));
  const auto newlines = std::count(text_.begin(), text_.begin() + static_cast<long>(at), '\n');
  throw InputError(subject_, fmt::format("line {}: {}", newlines + 1, what));
}

std::int64_t IntegerStream::next() {
  if (!binary_) {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
    if (at_ < text_.size() && text_[at_] == '+') ++at_;
    std::int64_t value = 0;
    const auto [end, error] =
        std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    at_ = static_cast<std::size_t>(end - text_.data());
    return value;
  }
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < type_.bytes; ++i)
    bits = bits << 8 | static_cast<unsigned char>(text_[at_ + i]);
  at_ += type_.bytes;
  const std::size_t unused = 64 - 8 * type_.bytes;
  if (type_.family == NumberType::Family::unsigned_integer) return static_cast<std::int64_t>(bits);
  return static_cast<std::int64_t>(bits << unused) >> unused;
}

}  // namespace hiac::formats::vtk
