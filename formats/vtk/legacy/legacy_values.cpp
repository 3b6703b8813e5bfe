#include "formats/vtk/legacy/legacy_values.hpp"

#include <charconv>
#include <cstdint>

#include <fmt/format.h>

namespace hiac::formats::vtk {
namespace {

using Family = NumberType::Family;

constexpr std::size_t kMostComponents = 1'000'000;

LegacyValues walk_binary_values(LegacyWords& words, const NumberType& type, std::size_t count) {
  if (count == 0) return {words.at(), words.at()};
  words.to_binary_values();
  const std::size_t begin = words.at();
  const bool bits = type.family == Family::bit;
  const std::size_t bytes = bits ? (count + 7) / 8 : count * type.bytes;
  // the division comes first, because the product could overflow
  if (count / 8 > words.left() || bytes > words.left())
    words.fail_at(begin, fmt::format("the file ends too soon ({} values of {} expected, {} bytes "
                                     "found)",
                                     count, bits ? "1 bit" : fmt::format("{} bytes", type.bytes),
                                     words.left()));
  words.move_to(begin + bytes);
  return {begin, words.at()};
}

LegacyValues walk_ascii_values(LegacyWords& words, const NumberType& type, std::size_t count,
                               bool may_be_not_finite) {
  if (count > 0 && count > (words.left() + 1) / 2)
    words.fail(fmt::format("the file ends too soon ({} values expected, {} bytes found)", count,
                           words.left()));
  LegacyValues values{words.at()};
  double value = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string_view word = words.word();
    const AsciiNumber verdict = judge_ascii_number(word, type, value);
    if (verdict == AsciiNumber::fine) continue;
    if (word.empty())
      words.fail(fmt::format("the file ends too soon ({} values expected, {} found)", count, i));
    if (verdict != AsciiNumber::not_finite || !may_be_not_finite)
      words.fail(fmt::format("wrong value {} of {} (a {} expected, '{}' found)", i, count,
                             type.family == Family::real ? "finite number" : "fitting integer",
                             word.substr(0, 40)));
    values.has_not_finite = true;
  }
  values.end = words.at();
  return values;
}

/// A text of binary data: its length in 1, 2, 4 or 8 big-endian bytes, selected by the two highest
/// bits of the first byte (3, 2, 1, 0), and then its characters.
void skip_binary_text(LegacyWords& words) {
  const std::string_view rest = words.text().substr(words.at());
  const unsigned tag = rest.empty() ? 0 : static_cast<unsigned char>(rest[0]) >> 6;
  const std::size_t header = std::size_t{1} << (3 - tag);
  if (rest.size() < header) words.fail_at(words.at(), "the file ends too soon (a text expected)");
  std::uint64_t length = 0;
  for (std::size_t i = 0; i < header; ++i)
    length = length << 8 | static_cast<unsigned char>(rest[i]);
  length &= ~std::uint64_t{0} >> (64 - 8 * header + (tag == 0 ? 0 : 2));
  if (length > rest.size() - header)
    words.fail_at(words.at(), fmt::format("the file ends too soon (a text of {} bytes expected, {} "
                                          "found)",
                                          length, rest.size() - header));
  words.move_to(words.at() + header + length);
}

LegacyValues walk_texts(LegacyWords& words, std::size_t count) {
  LegacyValues values{words.at()};
  if (count > words.left())
    words.fail(fmt::format("the file ends too soon ({} texts expected)", count));
  if (words.binary()) {
    words.to_binary_values();
    for (std::size_t i = 0; i < count; ++i) skip_binary_text(words);
  } else {
    for (std::size_t i = 0; i <= count; ++i) {  // the rest of the header's line, then the texts
      if (words.left() == 0 && count > 0)
        words.fail(fmt::format("the file ends too soon ({} texts expected)", count));
      words.line();
    }
  }
  values.end = words.at();
  return values;
}

/// METADATA may follow any array: component names and information keys up to an empty line.
void skip_metadata(LegacyWords& words, std::size_t components) {
  const std::size_t before = words.at();
  if (!words.goes_on_with("metadata")) {
    words.move_to(before);
    return;
  }
  words.line();
  while (words.left() > 0) {
    const std::string_view line = words.line();
    if (line.empty()) return;
    if (line.starts_with("COMPONENT_NAMES")) {
      for (std::size_t i = 0; i < components; ++i) words.line();
    } else if (line.starts_with("DATA ")) {
      std::int64_t length = 0;
      std::from_chars(line.data() + 5, line.data() + line.size(), length);
      if (length < 0 || static_cast<std::uint64_t>(length) > words.text().size())
        words.fail(fmt::format("wrong METADATA (a length expected, {} found)", length));
    }
  }
}

}  // namespace

NumberType read_legacy_type(LegacyWords& words, bool numeric) {
  using Family = NumberType::Family;
  const std::string name = words.keyword("a data type");
  const auto type = legacy_number_type(name);
  if (!type) words.fail(fmt::format("unknown data type '{}'", name.substr(0, 40)));
  if (type->family == Family::variant ||
      (numeric && (type->family == Family::text || type->family == Family::bit)))
    words.fail(fmt::format("data type '{}' cannot be read here", name));
  return *type;
}

LegacyValues walk_legacy_values(LegacyWords& words, const NumberType& type, std::size_t count,
                                bool may_be_not_finite) {
  return words.binary() ? walk_binary_values(words, type, count)
                        : walk_ascii_values(words, type, count, may_be_not_finite);
}

LegacyValues walk_legacy_array(LegacyWords& words, const NumberType& type, std::size_t tuples,
                               std::size_t components, bool may_be_not_finite) {
  // counts are below 2^40: the product is below 2^60
  if (components > kMostComponents)
    words.fail(fmt::format("too many components (at most {} expected, {} found)", kMostComponents,
                           components));
  const std::size_t count = tuples * components;
  const LegacyValues values = type.family == Family::text
                                  ? walk_texts(words, count)
                                  : walk_legacy_values(words, type, count, may_be_not_finite);
  skip_metadata(words, components);
  return values;
}

void for_each_not_finite(std::string_view text, std::size_t begin, std::size_t end,
                         const std::function<void(const NotFiniteWord&)>& found) {
  constexpr NumberType kDouble{Family::real, 8};
  LegacyWords words(text.substr(0, end), {});
  words.move_to(begin);
  double value = 0;
  std::size_t index = 0;
  for (std::string_view word = words.word(); !word.empty(); word = words.word(), ++index)
    if (judge_ascii_number(word, kDouble, value) == AsciiNumber::not_finite)
      found({words.at() - word.size(), word.size(), index, value});
}

}  // namespace hiac::formats::vtk
