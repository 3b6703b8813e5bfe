#include "formats/openfoam/foam_file.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "hiac/base/error.hpp"

namespace hiac::formats::openfoam {
namespace {

bool is_regular(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored);
}

std::string existing(const std::string& path) {
  return !is_regular(path) && is_regular(path + ".gz") ? path + ".gz" : path;
}

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

bool ends_word(char c) {
  return is_space(c) || c == ';' || c == '(' || c == ')' || c == '{' || c == '}';
}

/// Components of the types that fields' lists are of.
std::size_t components_of(std::string_view type) {
  if (type == "scalar") return 1;
  if (type == "vector") return 3;
  if (type == "symmTensor") return 6;
  if (type == "tensor") return 9;
  if (type == "sphericalTensor") return 1;
  return 0;
}

template <typename Stored, typename T>
void append(std::string_view bytes, std::vector<T>& values) {
  for (std::size_t i = 0; i < bytes.size(); i += sizeof(Stored)) {
    Stored value{};
    std::memcpy(&value, bytes.data() + i, sizeof value);
    values.push_back(static_cast<T>(value));
  }
}

}  // namespace

bool FoamFile::exists(const std::string& path) { return is_regular(existing(path)); }

FoamFile::FoamFile(const std::string& path) : input_(existing(path)), text_(input_.text()) {
  read_header();
}

void FoamFile::fail(const std::string& problem) const {
  const auto line = std::count(text_.begin(), text_.begin() + static_cast<long>(at_), '\n') + 1;
  throw InputError(binary_ ? fmt::format("{}: byte {}", input_.path(), at_)
                           : fmt::format("{}:{}", input_.path(), line),
                   problem);
}

void FoamFile::skip_space() {
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

char FoamFile::peek() {
  skip_space();
  return at_ < text_.size() ? text_[at_] : '\0';
}

void FoamFile::expect(char c) {
  if (peek() != c)
    fail(at_ < text_.size() ? fmt::format("'{}' expected", c)
                            : fmt::format("ended where '{}' is expected", c));
  ++at_;
}

std::string_view FoamFile::word() {
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

double FoamFile::real() {
  skip_space();
  double value = 0;
  const char* end = text_.data() + text_.size();
  const auto [next, error] = std::from_chars(text_.data() + at_, end, value);
  if (error != std::errc()) fail("a number expected");
  at_ = static_cast<std::size_t>(next - text_.data());
  return value;
}

std::int64_t FoamFile::whole() {
  skip_space();
  std::int64_t value = 0;
  const char* end = text_.data() + text_.size();
  const auto [next, error] = std::from_chars(text_.data() + at_, end, value);
  if (error != std::errc()) fail("a whole number expected");
  at_ = static_cast<std::size_t>(next - text_.data());
  return value;
}

std::size_t FoamFile::count(std::size_t bytes_each) {
  const std::int64_t value = whole();
  const std::size_t most = (text_.size() - at_) / bytes_each;
  if (value < 0 || static_cast<std::uint64_t>(value) > most)
    fail(fmt::format("a count that fits the file expected (at most {}; {} found)", most, value));
  return static_cast<std::size_t>(value);
}

std::string_view FoamFile::raw(std::size_t bytes) {
  if (bytes > text_.size() - at_) fail(fmt::format("ended before {} bytes of a list", bytes));
  const std::string_view part = text_.substr(at_, bytes);
  at_ += bytes;
  return part;
}

void FoamFile::read_header() {
  if (word() != "FoamFile") fail("'FoamFile' expected");
  expect('{');
  while (peek() != '}') {
    const std::string_view key = word();
    const std::string_view value = word();
    if (key.empty() || value.empty()) fail("an entry of the header expected");
    if (key == "format") binary_ = value == "binary";
    if (key == "class") class_ = value;
    if (key == "arch") {
      if (value.find("MSB") != std::string_view::npos)
        fail("numbers of the other byte order (LSB expected)");
      if (value.find("label=64") != std::string_view::npos) label_bytes_ = 8;
      if (value.find("scalar=32") != std::string_view::npos) scalar_bytes_ = 4;
    }
    expect(';');
  }
  expect('}');
  body_ = at_;
}

std::vector<std::int64_t> FoamFile::labels() {
  const std::size_t amount = count(binary_ ? label_bytes_ : 2);
  std::vector<std::int64_t> values;
  if (amount == 0) {
    if (peek() == '(') {
      expect('(');
      expect(')');
    }
    return values;
  }
  values.reserve(amount);
  expect('(');
  if (binary_) {
    const std::string_view bytes = raw(amount * label_bytes_);
    if (label_bytes_ == 8)
      append<std::int64_t>(bytes, values);
    else
      append<std::int32_t>(bytes, values);
  } else {
    for (std::size_t i = 0; i < amount; ++i) values.push_back(whole());
  }
  expect(')');
  return values;
}

void FoamFile::faces(std::vector<std::size_t>& starts, std::vector<std::int64_t>& nodes) {
  starts.assign(1, 0);
  if (class_ == "faceCompactList") {
    const std::vector<std::int64_t> offsets = labels();
    nodes = labels();
    for (std::size_t i = 1; i < offsets.size(); ++i) {
      if (offsets[i] < offsets[i - 1] || static_cast<std::uint64_t>(offsets[i]) > nodes.size())
        fail("offsets of faces that rise within their list expected");
      starts.push_back(static_cast<std::size_t>(offsets[i]));
    }
    return;
  }
  if (binary_) fail(fmt::format("a faceCompactList expected ('{}' found)", class_));
  const std::size_t amount = count(4);
  expect('(');
  for (std::size_t f = 0; f < amount; ++f) {
    const std::size_t corners = count(2);
    expect('(');
    for (std::size_t i = 0; i < corners; ++i) nodes.push_back(whole());
    expect(')');
    starts.push_back(nodes.size());
  }
  expect(')');
}

std::vector<double> FoamFile::reals(std::size_t amount, std::size_t width) {
  std::vector<double> values;
  values.reserve(amount * width);
  expect('(');
  if (binary_) {
    const std::string_view bytes = raw(amount * width * scalar_bytes_);
    if (scalar_bytes_ == 4)
      append<float>(bytes, values);
    else
      append<double>(bytes, values);
  } else {
    for (std::size_t i = 0; i < amount; ++i) {
      if (width > 1) expect('(');
      for (std::size_t c = 0; c < width; ++c) values.push_back(real());
      if (width > 1) expect(')');
    }
  }
  expect(')');
  return values;
}

std::vector<double> FoamFile::points() { return reals(count(binary_ ? 3 * scalar_bytes_ : 8), 3); }

bool FoamFile::find_entry(std::string_view keyword) {
  at_ = body_;
  while (peek() != '\0') {
    const std::string_view found = word();
    if (found == keyword) return true;
    // over the entry: to its end, or over a dictionary
    int depth = 0;
    while (at_ < text_.size() && !(depth == 0 && text_[at_] == ';')) {
      if (text_[at_] == '{') ++depth;
      if (text_[at_] == '}' && --depth == 0) break;
      ++at_;
    }
    if (at_ < text_.size()) ++at_;
  }
  return false;
}

FieldValues FoamFile::internal_field(std::size_t amount) {
  if (!find_entry("internalField")) fail("has no internalField");
  FieldValues field;
  const std::string_view sort = word();
  if (sort == "uniform") {
    std::vector<double> value;
    if (peek() == '(') {
      expect('(');
      while (peek() != ')') value.push_back(real());
      expect(')');
    } else {
      value.push_back(real());
    }
    field.components = value.size();
    if (value.empty() || value.size() > 9) fail("1 to 9 components expected");
    for (std::size_t i = 0; i < amount; ++i)
      field.values.insert(field.values.end(), value.begin(), value.end());
    return field;
  }
  if (sort != "nonuniform") fail("'uniform' or 'nonuniform' expected");
  std::string_view type = word();
  if (!type.starts_with("List<") || !type.ends_with('>'))
    fail(fmt::format("'List<type>' expected ('{}' found)", type));
  type = type.substr(5, type.size() - 6);
  field.components = components_of(type);
  if (field.components == 0) fail(fmt::format("'{}' is no type that is read", type));
  const std::size_t found = count(binary_ ? field.components * scalar_bytes_ : 2);
  if (found != amount) fail(fmt::format("{} values expected ({} found)", amount, found));
  field.values = reals(found, field.components);
  return field;
}

std::string FoamFile::unit() {
  if (!find_entry("dimensions")) return {};
  constexpr std::array<const char*, 7> kUnits{"kg", "m", "s", "K", "mol", "A", "cd"};
  std::vector<std::string> parts;
  skip_space();
  const std::size_t end = text_.find(']', at_);
  if (end == std::string_view::npos || peek() != '[') return {};
  ++at_;
  for (std::size_t i = 0; i < kUnits.size() && peek() != ']'; ++i) {
    const double exponent = real();
    if (exponent == 1) parts.emplace_back(kUnits[i]);
    if (exponent != 0 && exponent != 1) parts.push_back(fmt::format("{}^{}", kUnits[i], exponent));
  }
  return fmt::format("{}", fmt::join(parts, " "));
}

}  // namespace hiac::formats::openfoam
