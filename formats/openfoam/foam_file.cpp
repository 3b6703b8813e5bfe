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

/// The number of components of the types in the lists of fields.
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

bool FoamFile::is_one(const std::string& path) {
  const InputText input(existing(path));
  constexpr std::size_t kHead = 4096;
  const std::string_view head = input.text().substr(0, kHead);
  return head.find("FoamFile") != std::string_view::npos && head.find('\0') > head.find("FoamFile");
}

void FoamFile::skip_dictionary() {
  expect('{');
  for (int depth = 1; depth > 0; ++at_) {
    if (peek() == '\0') fail("ended within a dictionary");
    if (text_[at_] == '{') ++depth;
    if (text_[at_] == '}') --depth;
  }
}

void FoamFile::read_header() {
  if (word() != "FoamFile") fail("'FoamFile' expected");
  expect('{');
  while (peek() != '}') {
    const std::string_view key = word();
    if (!key.empty() && peek() == '{') {
      skip_dictionary();
      continue;
    }
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
    while (peek() != ';' && !word().empty()) {
    }
    expect(';');
  }
  expect('}');
  body_ = at_;
}

std::optional<std::size_t> FoamFile::list_size(std::size_t bytes_each, std::size_t most_equal) {
  if (peek() == '(') return std::nullopt;
  const std::int64_t value = whole();
  // a list of equal entries stores the entry once
  const std::size_t most = peek() == '{' ? most_equal : (text_.size() - at_) / bytes_each;
  if (value < 0 || static_cast<std::uint64_t>(value) > most)
    fail(fmt::format("a count that fits the file expected (at most {}; {} found)", most, value));
  return static_cast<std::size_t>(value);
}

std::vector<std::int64_t> FoamFile::labels(std::size_t most_equal) {
  const std::optional<std::size_t> amount = list_size(binary_ ? label_bytes_ : 2, most_equal);
  std::vector<std::int64_t> values;
  if (amount && peek() == '{') {
    expect('{');
    values.assign(*amount, whole());
    expect('}');
    return values;
  }
  if (amount == std::size_t{0} && peek() != '(') return values;
  expect('(');
  if (!amount) {
    while (peek() != ')') values.push_back(whole());
  } else if (binary_) {
    const std::string_view bytes = raw(*amount * label_bytes_);
    if (label_bytes_ == 8)
      append<std::int64_t>(bytes, values);
    else
      append<std::int32_t>(bytes, values);
  } else {
    values.reserve(*amount);
    for (std::size_t i = 0; i < *amount; ++i) values.push_back(whole());
  }
  expect(')');
  return values;
}

void FoamFile::faces(std::vector<std::size_t>& starts, std::vector<std::int64_t>& nodes) {
  starts.assign(1, 0);
  if (class_ == "faceCompactList") {
    const std::vector<std::int64_t> offsets = labels(0);
    nodes = labels(0);
    for (std::size_t i = 1; i < offsets.size(); ++i) {
      if (offsets[i] < offsets[i - 1] || static_cast<std::uint64_t>(offsets[i]) > nodes.size())
        fail("offsets of faces that rise within their list expected");
      starts.push_back(static_cast<std::size_t>(offsets[i]));
    }
    return;
  }
  if (binary_) fail(fmt::format("a faceCompactList expected ('{}' found)", class_));
  const std::optional<std::size_t> amount = list_size(4, 0);
  expect('(');
  for (std::size_t f = 0; amount ? f < *amount : peek() != ')'; ++f) {
    const std::size_t corners = count(2);
    expect('(');
    for (std::size_t i = 0; i < corners; ++i) nodes.push_back(whole());
    expect(')');
    starts.push_back(nodes.size());
  }
  expect(')');
}

std::vector<Patch> FoamFile::patches() {
  std::vector<Patch> patches(count(4));
  expect('(');
  for (Patch& patch : patches) {
    word();
    expect('{');
    while (peek() != '}') {
      const std::string_view key = word();
      if (key.empty()) fail("an entry of a patch expected");
      if (peek() == '{') {
        skip_dictionary();
        continue;
      }
      if (key == "type") patch.type = word();
      if (key == "nFaces") patch.faces = whole();
      if (key == "startFace") patch.start_face = whole();
      if (key == "neighbProcNo") patch.neighbour = whole();
      while (peek() != ';') {
        if (peek() == '\0') fail("ended within a patch");
        if (peek() == '"')
          word();
        else
          ++at_;
      }
      expect(';');
    }
    expect('}');
  }
  expect(')');
  return patches;
}

void FoamFile::read_tuple(std::size_t width, std::vector<double>& values) {
  if (width > 1) expect('(');
  for (std::size_t c = 0; c < width; ++c) values.push_back(real());
  if (width > 1) expect(')');
}

std::vector<double> FoamFile::reals(std::size_t width, std::size_t most_equal) {
  const std::optional<std::size_t> amount =
      list_size(binary_ ? width * scalar_bytes_ : 2, most_equal);
  std::vector<double> values;
  if (amount && peek() == '{') {
    expect('{');
    std::vector<double> tuple;
    read_tuple(width, tuple);
    expect('}');
    values.reserve(*amount * width);
    for (std::size_t i = 0; i < *amount; ++i)
      values.insert(values.end(), tuple.begin(), tuple.end());
    return values;
  }
  if (amount == std::size_t{0} && peek() != '(') return values;
  expect('(');
  if (!amount) {
    while (peek() != ')') read_tuple(width, values);
  } else if (binary_) {
    const std::string_view bytes = raw(*amount * width * scalar_bytes_);
    if (scalar_bytes_ == 4)
      append<float>(bytes, values);
    else
      append<double>(bytes, values);
  } else {
    values.reserve(*amount * width);
    for (std::size_t i = 0; i < *amount; ++i) read_tuple(width, values);
  }
  expect(')');
  return values;
}

std::vector<double> FoamFile::points() { return reals(3, 0); }

std::vector<double> FoamFile::uniform_value() {
  std::vector<double> value;
  const auto begins_number = [this] {
    const char c = peek();
    return (c >= '0' && c <= '9') || c == '-' || c == '.' || c == 'n' || c == 'i';
  };
  if (begins_number()) return {real()};
  if (peek() != '(') return value;
  expect('(');
  while (begins_number()) value.push_back(real());
  if (peek() != ')') return {};  // macros between the brackets
  expect(')');
  return value;
}

bool FoamFile::find_entry(std::string_view keyword) {
  at_ = body_;
  while (peek() != '\0') {
    const std::string_view found = word();
    if (found == keyword) return true;
    // a directive (#include) ends at the end of its line
    if (found.starts_with('#')) {
      at_ = std::min(text_.find('\n', at_), text_.size());
      continue;
    }
    // skips the entry: up to its semicolon, or past its dictionary
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

std::optional<FieldValues> FoamFile::internal_field(std::size_t amount) {
  if (!find_entry("internalField")) fail("has no internalField");
  FieldValues field;
  std::string_view sort = word();
  if (sort.starts_with('$') || sort.starts_with('#')) return std::nullopt;
  if (sort == "uniform") {
    if (peek() == '$') {
      const std::string_view macro = word();
      if (!find_entry(macro.substr(1))) return std::nullopt;
      if (peek() == 'u') word();
    }
    const std::vector<double> value = uniform_value();
    if (value.empty()) return std::nullopt;
    field.components = value.size();
    if (value.size() > 9) fail("1 to 9 components expected");
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
  field.values = reals(field.components, amount);
  if (const std::size_t found = field.values.size() / field.components; found != amount)
    fail(fmt::format("{} values expected ({} found)", amount, found));
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
