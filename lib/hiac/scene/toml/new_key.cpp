#include "hiac/scene/toml/new_key.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "hiac/scene/toml/spec_key.hpp"

namespace hiac {
namespace {

// A key as TOML writes it: bare if it can be.
std::string key_text(std::string_view name) {
  constexpr std::string_view kBare =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
  return name.find_first_not_of(kBare) == std::string_view::npos ? std::string(name)
                                                                 : toml_text(name);
}

// Parts as a dotted key.
std::string dotted(KeyParts parts) {
  std::string text;
  for (const std::string& part : parts) {
    if (!text.empty()) text += '.';
    text += key_text(part);
  }
  return text;
}

}  // namespace

std::string NewKey::assignment(KeyParts parts) const {
  return fmt::format("{} = {}", key_text(parts[0]), nested(parts.subspan(1)));
}

// What `parts` of a new key make of a value: tables in braces, and a list where a number follows a
// name.
std::string NewKey::nested(KeyParts parts) const {
  if (parts.empty()) return std::string(value_);
  if (!as_index(parts[0])) return in_braces(parts);
  keyed_.checked_index(parts[0], 0, 1);
  const KeyParts rest = parts.subspan(1);
  return fmt::format("[{}]", rest.empty() ? std::string(value_) : in_braces(rest));
}

std::string NewKey::in_braces(KeyParts parts) const {
  return fmt::format("{{ {} }}", assignment(parts));
}

// The new key of a table in braces: one of a table that dotted keys make continues them.
std::string NewKey::table_entry(std::span<const TextElement> elements, KeyParts parts) const {
  const auto has_relative = [&](KeyParts known) {
    return std::any_of(elements.begin(), elements.end(),
                       [&](const TextElement& element) { return starts_with(element.key, known); });
  };
  if (has_relative(parts)) keyed_.refuse("is a table (its keys can be set)");
  std::size_t known = parts.size() - 1;
  while (known > 0 && !has_relative(parts.first(known))) --known;
  const std::string added = assignment(parts.subspan(known));
  return known == 0 ? added : fmt::format("{}.{}", dotted(parts.first(known)), added);
}

// Adds to the list or the table in braces at a place.
std::string NewKey::in_value(const KeyedText::Place& place) const {
  const std::size_t begin = place.value.begin;
  const std::vector<TextElement> elements = elements_of(text_, begin);
  const bool is_list = text_[begin] == '[';
  const bool is_plain = place.below.size() == 1;
  const std::string added = !is_list   ? table_entry(elements, place.below)
                            : is_plain ? std::string(value_)
                                       : in_braces(place.below.subspan(1));
  if (elements.empty())
    return keyed_.replaced({begin + 1, begin + 1}, is_list ? added : fmt::format(" {} ", added));
  const std::size_t end = elements.back().span.end;
  const std::size_t next = skip_space(text_, end);
  const bool has_comma = text_[next] == ',';
  const TextSpan last{elements.back().span.begin, has_comma ? next + 1 : end};
  if (!is_list || !keyed_.has_own_line(last))
    return keyed_.replaced({end, end}, fmt::format(", {}", added));
  const std::size_t line_end = text_.find('\n', last.end) + 1;
  return fmt::format("{}{}{}{}{},{}{}", text_.substr(0, end), has_comma ? "" : ",",
                     text_.substr(end, line_end - end), keyed_.indent_at(last.begin), added,
                     keyed_.line_end(), text_.substr(line_end));
}

// Adds a line to a section, behind one of its lines (null: behind the header).
std::string NewKey::with_line(const TextSection& section, const KeyLine* behind,
                              const std::string& line) const {
  const std::size_t at = behind != nullptr ? behind->lines.end : section.header.end;
  const std::string_view indent = behind != nullptr ? keyed_.indent_at(behind->written.begin) : "";
  const bool line_ended = at == 0 || text_[at - 1] == '\n' || at == sections_[0].header.end;
  return keyed_.replaced({at, at}, fmt::format("{}{}{}{}", line_ended ? "" : keyed_.line_end(),
                                               indent, line, keyed_.line_end()));
}

// Where the last section at or below a table ends: before the comment that stands right above the
// next header.
std::size_t NewKey::end_of_relatives(KeyParts ancestor) const {
  std::size_t last = sections_.size() - 1;
  while (last > 0 && !starts_with(sections_[last].path, ancestor)) --last;
  if (last + 1 == sections_.size()) return text_.size();
  std::size_t at = sections_[last + 1].header.begin;
  const std::size_t least = sections_[last].keys.empty() ? sections_[last].header.end
                                                         : sections_[last].keys.back().lines.end;
  while (at > least) {
    const std::size_t begin = keyed_.start_of_line(at - 1);
    const std::string_view line = text_.substr(begin, at - begin);
    const std::size_t first = line.find_first_not_of(" \t");
    if (begin < least || first == std::string_view::npos || line[first] != '#') break;
    at = begin;
  }
  return at;
}

// The number of elements that headers make of a list of tables.
std::size_t NewKey::elements_at(KeyParts list) const {
  return static_cast<std::size_t>(
      std::count_if(sections_.begin(), sections_.end(), [&](const TextSection& section) {
        return section.is_element && section.path.size() == list.size() + 1 &&
               starts_with(section.path, list);
      }));
}

// Adds a table with a header for the key: its first `known` parts are a table with a header, or
// lie above one.
std::string NewKey::with_header(std::size_t known) const {
  const KeyParts path = keyed_.path();
  // names up to the header's end, and behind them the number of a new element
  std::size_t names = known;
  const std::size_t elements = elements_at(path.first(known));
  if (elements == 0)
    while (names + 1 < path.size() && (names == known || !as_index(path[names]))) ++names;
  const bool ends_in_number = names > known && as_index(path[names]).has_value();
  const bool is_plain_list = ends_in_number && names + 1 == path.size();
  if (is_plain_list) --names;
  const bool is_element = elements > 0 || (ends_in_number && !is_plain_list);
  if (is_element) keyed_.checked_index(path[names], elements, elements + 1);
  if (names + 1 == path.size() && is_element)
    keyed_.refuse("an element of a list of tables is a table");
  SpecPath header;
  for (std::size_t i = 0; i < names; ++i)
    if (i >= known || i == 0 || !elements_at(path.first(i))) header.push_back(path[i]);
  const KeyParts rest = path.subspan(names + (is_element ? 1 : 0));
  const std::size_t at = end_of_relatives(path.first(known));
  const auto ends_with = [&](std::string_view end) {
    return text_.substr(0, at).ends_with(end) || at == 0;
  };
  const std::string before = !ends_with("\n") ? fmt::format("{0}{0}", keyed_.line_end())
                             : ends_with("\n\n") || ends_with("\n\r\n")
                                 ? ""
                                 : std::string(keyed_.line_end());
  return keyed_.replaced(
      {at, at}, fmt::format("{}{}{}{}{}{}{}{}", before, is_element ? "[[" : "[", dotted(header),
                            is_element ? "]]" : "]", keyed_.line_end(), assignment(rest),
                            keyed_.line_end(), at < text_.size() ? keyed_.line_end() : ""));
}

std::string NewKey::in_table() const {
  const KeyParts path = keyed_.path();
  for (std::size_t known = path.size() - 1;; --known) {
    const KeyParts table = path.first(known);
    for (const TextSection& section : sections_) {
      if (!starts_with(table, section.path)) continue;
      const KeyLine* last = section.keys.empty() ? nullptr : &section.keys.back();
      const KeyParts rest = path.subspan(section.path.size());
      const std::size_t prefix = known - section.path.size();
      if (prefix == 0) {
        const bool is_plain_list = rest.size() == 2 && as_index(rest[1]);
        if (rest.size() == 1 || is_plain_list) return with_line(section, last, assignment(rest));
        return with_header(known);
      }
      const KeyLine* relative = nullptr;
      for (const KeyLine& line : section.keys)
        if (starts_with(line.key, rest.first(prefix))) relative = &line;
      if (relative != nullptr)
        return with_line(
            section, relative,
            fmt::format("{}.{}", dotted(rest.first(prefix)), assignment(rest.subspan(prefix))));
    }
    const bool lies_above =
        std::any_of(sections_.begin(), sections_.end(),
                    [&](const TextSection& section) { return starts_with(section.path, table); });
    if (lies_above) return with_header(known);
  }
}

}  // namespace hiac
