#include "formats/vtk/number_type.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <utility>

namespace hiac::formats::vtk {
namespace {

using Family = NumberType::Family;
using NamedType = std::pair<std::string_view, NumberType>;

constexpr std::array<NamedType, 18> kLegacyTypes{{
    {"bit", {Family::bit, 0}},
    {"char", {Family::signed_integer, 1}},
    {"signed_char", {Family::signed_integer, 1}},
    {"unsigned_char", {Family::unsigned_integer, 1}},
    {"short", {Family::signed_integer, 2}},
    {"unsigned_short", {Family::unsigned_integer, 2}},
    {"vtkidtype", {Family::signed_integer, 4}},  // written as int, whatever it is in memory
    {"int", {Family::signed_integer, 4}},
    {"unsigned_int", {Family::unsigned_integer, 4}},
    {"long", {Family::signed_integer, 8}},
    {"unsigned_long", {Family::unsigned_integer, 8}},
    {"vtktypeint64", {Family::signed_integer, 8}},
    {"vtktypeuint64", {Family::unsigned_integer, 8}},
    {"float", {Family::real, 4}},
    {"double", {Family::real, 8}},
    {"string", {Family::text, 0}},
    {"utf8_string", {Family::text, 0}},
    {"variant", {Family::variant, 0}},
}};

constexpr std::array<NamedType, 11> kXmlTypes{{
    {"Int8", {Family::signed_integer, 1}},
    {"UInt8", {Family::unsigned_integer, 1}},
    {"Int16", {Family::signed_integer, 2}},
    {"UInt16", {Family::unsigned_integer, 2}},
    {"Int32", {Family::signed_integer, 4}},
    {"UInt32", {Family::unsigned_integer, 4}},
    {"Int64", {Family::signed_integer, 8}},
    {"UInt64", {Family::unsigned_integer, 8}},
    {"Float32", {Family::real, 4}},
    {"Float64", {Family::real, 8}},
    {"String", {Family::text, 0}},
}};

template <std::size_t N>
std::optional<NumberType> find(const std::array<NamedType, N>& types, std::string_view name) {
  const auto found = std::find_if(types.begin(), types.end(),
                                  [&](const NamedType& type) { return type.first == name; });
  if (found == types.end()) return std::nullopt;
  return found->second;
}

template <typename Integer>
AsciiNumber judge_integer(std::string_view word, Integer low, Integer high) {
  Integer number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  const bool whole = error == std::errc() && end == word.data() + word.size();
  return whole && low <= number && number <= high ? AsciiNumber::fine : AsciiNumber::malformed;
}

AsciiNumber judge_real(std::string_view word, std::size_t bytes, double& value) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size()) return AsciiNumber::malformed;
  if (error == std::errc::result_out_of_range) {
    // an underflow is harmless; after an overflow the word is not a number of this type
    value = std::strtod(std::string(word).c_str(), nullptr);
    if (std::isinf(value)) return AsciiNumber::malformed;
  } else if (error != std::errc()) {
    return AsciiNumber::malformed;
  }
  if (!std::isfinite(value)) return AsciiNumber::not_finite;
  const bool fits = bytes == 8 || std::abs(value) <= double{std::numeric_limits<float>::max()};
  return fits ? AsciiNumber::fine : AsciiNumber::malformed;
}

}  // namespace

std::optional<NumberType> legacy_number_type(std::string_view name) {
  std::string lower(name);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return find(kLegacyTypes, lower);
}

std::optional<NumberType> xml_number_type(std::string_view name) { return find(kXmlTypes, name); }

AsciiNumber judge_ascii_number(std::string_view word, const NumberType& type, double& value) {
  if (word.size() > 1 && word.front() == '+' && word[1] != '-') word.remove_prefix(1);
  switch (type.family) {
    case Family::real:
      return judge_real(word, type.bytes, value);
    case Family::unsigned_integer: {
      const std::uint64_t high = ~std::uint64_t{0} >> (64 - 8 * type.bytes);
      return judge_integer<std::uint64_t>(word, 0, high);
    }
    case Family::signed_integer: {
      const std::int64_t high = std::numeric_limits<std::int64_t>::max() >> (64 - 8 * type.bytes);
      return judge_integer<std::int64_t>(word, -high - 1, high);
    }
    case Family::bit:
      return judge_integer<std::int64_t>(word, 0, 1);
    case Family::text:
    case Family::variant:
      break;
  }
  return AsciiNumber::malformed;
}

}  // namespace hiac::formats::vtk
