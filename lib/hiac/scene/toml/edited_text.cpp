#include "hiac/scene/toml/edited_text.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/toml/keyed_text.hpp"
#include "hiac/scene/toml/new_key.hpp"
#include "hiac/scene/toml/spec_text.hpp"

namespace hiac {
namespace {

// Removes an element with its comma, and its line with the comment there if it has one of its own.
std::string without_part(const KeyedText& keyed, const KeyedText::Place& place) {
  const std::string_view text = keyed.text();
  const std::vector<TextElement> elements = elements_of(text, place.parent->first);
  const std::size_t number = place.parent->second;
  TextSpan gone = elements[number].span;
  const std::size_t next = skip_space(text, gone.end);
  const bool has_comma = next < text.size() && text[next] == ',';
  // a comment before the comma stays
  const std::string_view between = text.substr(gone.end, has_comma ? next - gone.end : 0);
  const std::string_view kept = between.find('#') == std::string_view::npos ? "" : between;
  if (has_comma) gone.end = next + 1;
  if (kept.empty() && keyed.has_own_line(gone))
    gone = {keyed.start_of_line(gone.begin),
            std::min(text.find('\n', gone.end), text.size() - 1) + 1};
  else
    while (has_comma && gone.end < text.size() && text[gone.end] == ' ') ++gone.end;
  std::string edited = keyed.replaced(gone, kept);
  if (has_comma || number == 0) return edited;
  // the last one: the comma before it goes, too
  const std::size_t comma = skip_space(text, elements[number - 1].span.end);
  const std::string_view blank = text.substr(comma + 1, gone.begin - comma - 1);
  const bool is_blank = blank.find_first_not_of(' ') == std::string_view::npos;
  return edited.erase(comma, is_blank ? gone.begin - comma : 1);
}

// Removes lines, and one of two empty lines that then meet.
std::string without_lines(std::string text, std::vector<TextSpan> spans) {
  std::sort(spans.begin(), spans.end(),
            [](const TextSpan& a, const TextSpan& b) { return a.begin > b.begin; });
  for (const TextSpan& span : spans) {
    text.erase(span.begin, span.end - span.begin);
    const std::string_view before = std::string_view(text).substr(0, span.begin);
    const std::string_view behind = std::string_view(text).substr(span.begin);
    if (!before.empty() && !before.ends_with("\n\n") && !before.ends_with("\n\r\n")) continue;
    if (behind.starts_with("\n") || behind.starts_with("\r\n"))
      text.erase(span.begin, behind[0] == '\n' ? 1 : 2);
  }
  return text;
}

}  // namespace

std::string with_key(std::string_view text, std::string_view key, std::string_view value) {
  const KeyedText keyed(text, key);
  keyed.refuse_bad_value(value);
  if (keyed.names_tables()) keyed.refuse("is a table (its keys can be set)");
  const std::optional<KeyedText::Place> found = keyed.place();
  if (!found) return NewKey(keyed, value).in_table();
  return found->below.empty() ? keyed.replaced(found->value, value)
                              : NewKey(keyed, value).in_value(*found);
}

std::string without_key(std::string_view text, std::string_view key) {
  const KeyedText keyed(text, key);
  if (keyed.names_tables()) keyed.refuse("is a table with a header");
  const std::optional<KeyedText::Place> found = keyed.place();
  if (!found || !found->below.empty()) return std::string(text);
  return found->parent ? without_part(keyed, *found) : keyed.replaced(found->line->lines, "");
}

std::string with_element(std::string_view text, std::string_view element, std::string_view value) {
  const KeyedText keyed(text, element);
  keyed.refuse_bad_value(value);
  const std::optional<KeyedText::Place> found = keyed.place();
  const bool is_new = found && found->below.size() == 1 && text[found->value.begin] == '[';
  if (is_new) return NewKey(keyed, value).in_value(*found);
  if (!found || !found->below.empty() || !found->parent || text[found->parent->first] != '[')
    keyed.refuse("no element of a list in brackets");
  const std::size_t at = found->value.begin;
  // elements on lines of their own stay so
  const std::string_view indent = keyed.indent_at(at);
  const bool is_first = keyed.start_of_line(at) + indent.size() == at;
  return keyed.replaced({at, at}, is_first ? fmt::format("{},{}{}", value, keyed.line_end(), indent)
                                           : fmt::format("{}, ", value));
}

std::string with_table(std::string_view text, std::string_view table,
                       std::span<const std::pair<std::string, std::string>> keys) {
  if (KeyedText(text, table).has())
    throw UsageError(in_one_line(fmt::format("key `{}`: exists", table)));
  std::string edited(text);
  for (const auto& [key, value] : keys)
    edited = with_key(edited, fmt::format("{}.{}", table, key), value);
  return edited;
}

std::string without_table(std::string_view text, std::string_view table) {
  const KeyedText keyed(text, table);
  const std::optional<KeyedText::Place> found = keyed.place();
  if (found && found->below.empty()) return without_key(text, table);
  std::vector<TextSpan> spans;
  for (const TextSection& section : keyed.sections()) {
    if (starts_with(section.path, keyed.path())) {
      const bool has_keys = !section.keys.empty();
      spans.push_back(
          {section.header.begin, has_keys ? section.keys.back().lines.end : section.header.end});
    } else if (starts_with(keyed.path(), section.path)) {
      const KeyParts rest = keyed.path().subspan(section.path.size());
      for (const KeyLine& line : section.keys)
        if (starts_with(line.key, rest)) spans.push_back(line.lines);
    }
  }
  return without_lines(std::string(text), std::move(spans));
}

}  // namespace hiac
