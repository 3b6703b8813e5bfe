#include "formats/openfoam/foam_file.hpp"

#include <array>
#include <cstring>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "formats/common/io/bytes_behind.hpp"

namespace hiac::formats::openfoam {
namespace {

bool is_regular(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored);
}

std::string existing(const std::string& path) {
  return !is_regular(path) && is_regular(path + ".gz") ? path + ".gz" : path;
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

FoamFile::FoamFile(const std::string& path)
    : input_(existing(path)), text_(input_.text(), input_.path()) {
  read_header();
}

bool FoamFile::is_one(const std::string& path) {
  const InputText input(existing(path));
  constexpr std::size_t kHead = 4096;
  const std::string_view head = input.text().substr(0, kHead);
  return head.find("FoamFile") != std::string_view::npos && head.find('\0') > head.find("FoamFile");
}

void FoamFile::read_header() {
  if (text_.word() != "FoamFile") text_.fail("'FoamFile' expected");
  text_.expect('{');
  while (text_.peek() != '}') {
    const std::string_view key = text_.word();
    if (!key.empty() && text_.peek() == '{') {
      text_.skip_dictionary();
      continue;
    }
    const std::string_view value = text_.word();
    if (key.empty() || value.empty()) text_.fail("an entry of the header expected");
    if (key == "format") text_.set_binary(value == "binary");
    if (key == "class") class_ = value;
    if (key == "arch") {
      if (value.find("MSB") != std::string_view::npos)
        text_.fail("numbers of the other byte order (LSB expected)");
      if (value.find("label=64") != std::string_view::npos) label_bytes_ = 8;
      if (value.find("scalar=32") != std::string_view::npos) scalar_bytes_ = 4;
    }
    while (text_.peek() != ';' && !text_.word().empty()) {
    }
    text_.expect(';');
  }
  text_.expect('}');
  body_ = text_.at();
}

std::optional<std::size_t> FoamFile::list_size(std::size_t bytes_each, std::size_t most_equal) {
  if (text_.peek() == '(') return std::nullopt;
  const std::int64_t value = text_.whole();
  // a list of equal entries stores the entry once
  const std::size_t most = text_.peek() == '{' ? most_equal : text_.left() / bytes_each;
  if (value < 0 || static_cast<std::uint64_t>(value) > most)
    text_.fail(
        fmt::format("a count that fits the file expected (at most {}; {} found)", most, value));
  return static_cast<std::size_t>(value);
}

std::vector<std::int64_t> FoamFile::labels(std::size_t most_equal) {
  const std::optional<std::size_t> amount =
      list_size(text_.binary() ? label_bytes_ : 2, most_equal);
  std::vector<std::int64_t> values;
  if (amount && text_.peek() == '{') {
    text_.expect('{');
    values.assign(*amount, text_.whole());
    text_.expect('}');
    return values;
  }
  if (amount == std::size_t{0} && text_.peek() != '(') return values;
  text_.expect('(');
  if (!amount) {
    while (text_.peek() != ')') values.push_back(text_.whole());
  } else if (text_.binary()) {
    const std::string_view bytes = text_.raw(*amount * label_bytes_);
    if (label_bytes_ == 8)
      append<std::int64_t>(bytes, values);
    else
      append<std::int32_t>(bytes, values);
  } else {
    values.reserve(*amount);
    for (std::size_t i = 0; i < *amount; ++i) values.push_back(text_.whole());
  }
  text_.expect(')');
  return values;
}

void FoamFile::faces(std::vector<std::size_t>& starts, std::vector<std::int64_t>& nodes) {
  starts.assign(1, 0);
  if (class_ == "faceCompactList") {
    const std::vector<std::int64_t> offsets = labels(0);
    nodes = labels(0);
    for (std::size_t i = 1; i < offsets.size(); ++i) {
      if (offsets[i] < offsets[i - 1] || static_cast<std::uint64_t>(offsets[i]) > nodes.size())
        text_.fail("offsets of faces that rise within their list expected");
      starts.push_back(static_cast<std::size_t>(offsets[i]));
    }
    return;
  }
  if (text_.binary()) text_.fail(fmt::format("a faceCompactList expected ('{}' found)", class_));
  const std::optional<std::size_t> amount = list_size(4, 0);
  text_.expect('(');
  for (std::size_t f = 0; amount ? f < *amount : text_.peek() != ')'; ++f) {
    const std::size_t corners = text_.count(2);
    text_.expect('(');
    for (std::size_t i = 0; i < corners; ++i) nodes.push_back(text_.whole());
    text_.expect(')');
    starts.push_back(nodes.size());
  }
  text_.expect(')');
}

void FoamFile::note_rest(std::vector<std::string>& notes) {
  if (text_.peek() == 0 && text_.left() == 0) return;
  const std::string name = std::filesystem::path(input_.path()).filename().string();
  note_bytes_behind(text_.left(), fmt::format("the list in '{}'", name), notes);
}

std::vector<Patch> FoamFile::patches() {
  std::vector<Patch> patches(text_.count(4));
  text_.expect('(');
  for (Patch& patch : patches) {
    text_.word();
    text_.expect('{');
    while (text_.peek() != '}') {
      const std::string_view key = text_.word();
      if (key.empty()) text_.fail("an entry of a patch expected");
      if (text_.peek() == '{') {
        text_.skip_dictionary();
        continue;
      }
      if (key == "type") patch.type = text_.word();
      if (key == "nFaces") patch.faces = text_.whole();
      if (key == "startFace") patch.start_face = text_.whole();
      if (key == "neighbProcNo") patch.neighbour = text_.whole();
      while (text_.peek() != ';') {
        if (text_.peek() == '\0') text_.fail("ended within a patch");
        if (text_.peek() == '"')
          text_.word();
        else
          text_.advance();
      }
      text_.expect(';');
    }
    text_.expect('}');
  }
  text_.expect(')');
  return patches;
}

void FoamFile::read_tuple(std::size_t width, std::vector<double>& values) {
  if (width > 1) text_.expect('(');
  for (std::size_t c = 0; c < width; ++c) values.push_back(text_.real());
  if (width > 1) text_.expect(')');
}

std::vector<double> FoamFile::reals(std::size_t width, std::size_t most_equal) {
  const std::optional<std::size_t> amount =
      list_size(text_.binary() ? width * scalar_bytes_ : 2, most_equal);
  std::vector<double> values;
  if (amount && text_.peek() == '{') {
    text_.expect('{');
    std::vector<double> tuple;
    read_tuple(width, tuple);
    text_.expect('}');
    values.reserve(*amount * width);
    for (std::size_t i = 0; i < *amount; ++i)
      values.insert(values.end(), tuple.begin(), tuple.end());
    return values;
  }
  if (amount == std::size_t{0} && text_.peek() != '(') return values;
  text_.expect('(');
  if (!amount) {
    while (text_.peek() != ')') read_tuple(width, values);
  } else if (text_.binary()) {
    const std::string_view bytes = text_.raw(*amount * width * scalar_bytes_);
    if (scalar_bytes_ == 4)
      append<float>(bytes, values);
    else
      append<double>(bytes, values);
  } else {
    values.reserve(*amount * width);
    for (std::size_t i = 0; i < *amount; ++i) read_tuple(width, values);
  }
  text_.expect(')');
  return values;
}

std::vector<double> FoamFile::points() { return reals(3, 0); }

std::vector<double> FoamFile::uniform_value() {
  std::vector<double> value;
  const auto begins_number = [this] {
    const char c = text_.peek();
    return (c >= '0' && c <= '9') || c == '-' || c == '.' || c == 'n' || c == 'i';
  };
  if (begins_number()) return {text_.real()};
  if (text_.peek() != '(') return value;
  text_.expect('(');
  while (begins_number()) value.push_back(text_.real());
  if (text_.peek() != ')') return {};  // macros between the brackets
  text_.expect(')');
  return value;
}

bool FoamFile::find_entry(std::string_view keyword) {
  text_.move_to(body_);
  while (text_.peek() != '\0') {
    const std::string_view found = text_.word();
    if (found == keyword) return true;
    // a directive (#include) ends at the end of its line
    if (found.starts_with('#')) {
      text_.skip_line();
      continue;
    }
    text_.skip_entry();
  }
  return false;
}

std::optional<FieldValues> FoamFile::internal_field(std::size_t amount) {
  if (!find_entry("internalField")) text_.fail("has no internalField");
  FieldValues field;
  std::string_view sort = text_.word();
  if (sort.starts_with('$') || sort.starts_with('#')) return std::nullopt;
  if (sort == "uniform") {
    if (text_.peek() == '$') {
      const std::string_view macro = text_.word();
      if (!find_entry(macro.substr(1))) return std::nullopt;
      if (text_.peek() == 'u') text_.word();
    }
    const std::vector<double> value = uniform_value();
    if (value.empty()) return std::nullopt;
    field.components = value.size();
    if (value.size() > 9) text_.fail("1 to 9 components expected");
    for (std::size_t i = 0; i < amount; ++i)
      field.values.insert(field.values.end(), value.begin(), value.end());
    return field;
  }
  if (sort != "nonuniform") text_.fail("'uniform' or 'nonuniform' expected");
  std::string_view type = text_.word();
  if (!type.starts_with("List<") || !type.ends_with('>'))
    text_.fail(fmt::format("'List<type>' expected ('{}' found)", type));
  type = type.substr(5, type.size() - 6);
  field.components = components_of(type);
  if (field.components == 0) text_.fail(fmt::format("'{}' is no type that is read", type));
  field.values = reals(field.components, amount);
  if (const std::size_t found = field.values.size() / field.components; found != amount)
    text_.fail(fmt::format("{} values expected ({} found)", amount, found));
  return field;
}

std::string FoamFile::unit() {
  if (!find_entry("dimensions")) return {};
  constexpr std::array<const char*, 7> kUnits{"kg", "m", "s", "K", "mol", "A", "cd"};
  std::vector<std::string> parts;
  if (text_.peek() != '[' || !text_.has_ahead(']')) return {};
  text_.advance();
  for (std::size_t i = 0; i < kUnits.size() && text_.peek() != ']'; ++i) {
    const double exponent = text_.real();
    if (exponent == 1) parts.emplace_back(kUnits[i]);
    if (exponent != 0 && exponent != 1) parts.push_back(fmt::format("{}^{}", kUnits[i], exponent));
  }
  return fmt::format("{}", fmt::join(parts, " "));
}

}  // namespace hiac::formats::openfoam
