#include "formats/surface/tetgen_text.hpp"

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <sstream>

#include <fmt/format.h>

#include "formats/surface/plain_number.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats {

TetgenLines::TetgenLines(const std::string& path) : path_(path), file_(path) {
  if (!file_) throw InputError(path, fmt::format("cannot be opened ({})", std::strerror(errno)));
}

std::span<const std::string> TetgenLines::next_or_none() {
  words_.clear();
  for (std::string line; words_.empty() && std::getline(file_, line);) {
    ++line_;
    line.erase(std::min(line.find('#'), line.size()));
    for (char& c : line)
      if (c == ',') c = ' ';
    std::istringstream text(line);
    for (std::string word; text >> word;) words_.push_back(word);
  }
  return words_;
}

std::span<const std::string> TetgenLines::next(const char* expected) {
  if (next_or_none().empty())
    throw InputError(path_,
                     fmt::format("ends too soon ({} expected after line {})", expected, line_));
  return words_;
}

void TetgenLines::fail(const std::string& message) const {
  throw InputError(fmt::format("{}:{}", path_, line_), message);
}

double TetgenLines::real(std::size_t word, const char* what) const {
  if (word < words_.size()) {
    const auto value = plain_number(words_[word]);
    if (value && std::isfinite(*value)) return *value;
  }
  fail(fmt::format("{} expected as word {} ({} found)", what, word + 1,
                   word < words_.size() ? "'" + words_[word] + "'" : "the line's end"));
}

std::uint64_t TetgenLines::whole(std::size_t word, const char* what) const {
  std::uint64_t value = 0;
  if (word < words_.size()) {
    const std::string& text = words_[word];
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc() && end == text.data() + text.size()) return value;
  }
  fail(fmt::format("{} expected as word {}, a whole number ({} found)", what, word + 1,
                   word < words_.size() ? "'" + words_[word] + "'" : "the line's end"));
}

std::uint64_t TetgenLines::whole_or(std::size_t word, const char* what,
                                    std::uint64_t otherwise) const {
  return word < words_.size() ? whole(word, what) : otherwise;
}

std::array<double, 3> TetgenLines::point(std::size_t word, const char* what) const {
  return {real(word, what), real(word + 1, what), real(word + 2, what)};
}

TetgenNodes read_tetgen_nodes(TetgenLines& lines) {
  lines.next("the number of points");
  const std::uint64_t count = lines.whole(0, "the number of points");
  const std::uint64_t dimension = lines.whole_or(1, "the dimension", 3);
  if (dimension != 3)
    lines.fail(fmt::format("points of 3 dimensions expected ({} found)", dimension));
  TetgenNodes nodes;
  nodes.attribute_count = lines.whole_or(2, "the number of attributes", 0);
  for (std::uint64_t i = 0; i < count; ++i) {
    lines.next("a point");
    const std::uint64_t number = lines.whole(0, "a point's number");
    if (i == 0) nodes.first = number;
    if (number != nodes.first + i || nodes.first > 1)
      lines.fail(
          fmt::format("points numbered one after another from 0 or 1 expected ({} found)", number));
    nodes.points.push_back(lines.point(1, "a coordinate"));
    for (std::size_t k = 0; k < nodes.attribute_count; ++k)
      nodes.attributes.push_back(lines.real(4 + k, "an attribute"));
  }
  return nodes;
}

}  // namespace hiac::formats
