#include "hiac/scene/toml/spec_key.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include <fmt/format.h>

namespace hiac {
namespace {

/// Returns Levenshtein's distance: the number of insertions, deletions and replacements that turn
/// one word into the other.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

std::string suggestion(std::string_view found, std::span<const std::string_view> known) {
  // a name that is much longer than every key is no misspelling
  if (found.size() > 40) return "";
  const auto nearest = std::min_element(known.begin(), known.end(), [&](auto a, auto b) {
    return edit_distance(found, a) < edit_distance(found, b);
  });
  const std::size_t tolerated = std::max<std::size_t>(1, nearest->size() / 3);
  if (edit_distance(found, *nearest) <= tolerated)
    return fmt::format("; did you mean `{}`?", *nearest);
  return fmt::format(" (known here: {})", fmt::join(known, ", "));
}

}  // namespace

void refuse_unknown_keys(const SpecValue& table, std::span<const std::string_view> known) {
  // the first in the text, not in the alphabet
  const toml::key* first = nullptr;
  for (const auto& [key, node] : table.table()) {
    if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
    if (first == nullptr || key.source().begin < first->source().begin) first = &key;
  }
  if (first != nullptr) table.fail_at(first->str(), "unknown key" + suggestion(*first, known));
}

std::string toml_text(double value) {
  std::string text = fmt::format("{}", value);
  const bool whole = text.find_first_not_of("-0123456789") == std::string::npos;
  return whole ? text + ".0" : text;
}

std::string toml_text(std::string_view value) {
  std::string text = "\"";
  for (const char c : value) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      text += {'\\', c};
    else if (code < 0x20 || code == 0x7f)
      text += fmt::format("\\u{:04X}", code);
    else
      text += c;
  }
  return text + '"';
}

std::string toml_text(std::span<const double> values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + toml_text(value);
  return "[" + text + "]";
}

}  // namespace hiac
