#include "hiac/scene/toml/keyed_text.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/toml/spec_text.hpp"

namespace hiac {

bool starts_with(KeyParts path, KeyParts prefix) {
  return path.size() >= prefix.size() && std::equal(prefix.begin(), prefix.end(), path.begin());
}

KeyedText::KeyedText(std::string_view text, std::string_view key) : text_(text), shown_(key) {
  parse_toml(text, "view");
  const std::optional<SpecPath> path = spec_path(key);
  if (!path) refuse("malformed key (expected one such as camera.fov)");
  path_ = *path;
  sections_ = sections_of(text);
  const std::size_t first_end = text.find('\n');
  if (first_end != std::string_view::npos && first_end > 0 && text[first_end - 1] == '\r')
    line_end_ = "\r\n";
}

void KeyedText::refuse(const std::string& what) const {
  throw UsageError(in_one_line(fmt::format("key `{}`: {}", shown_, what)));
}

void KeyedText::refuse_bad_value(std::string_view value) const {
  try {
    // the end of the line ends a comment, too, which would swallow what follows the value
    const toml::table parsed = parse_toml(fmt::format("v = [{}]", value), "");
    const toml::array* list = parsed["v"].as_array();
    if (parsed.size() == 1 && list != nullptr && list->size() == 1) return;
  } catch (const InputError&) {
    // told below
  }
  refuse(fmt::format("no value in TOML (found {})", value));
}

std::string KeyedText::replaced(TextSpan span, std::string_view by) const {
  return fmt::format("{}{}{}", text_.substr(0, span.begin), by, text_.substr(span.end));
}

std::size_t KeyedText::start_of_line(std::size_t at) const {
  const std::size_t end = text_.substr(0, at).rfind('\n');
  return end == std::string_view::npos ? 0 : end + 1;
}

std::string_view KeyedText::indent_at(std::size_t at) const {
  const std::string_view line = text_.substr(start_of_line(at));
  return line.substr(0, line.find_first_not_of(" \t"));
}

bool KeyedText::has_own_line(TextSpan span) const {
  const std::size_t behind = text_.find_first_not_of(" \t\r", span.end);
  return start_of_line(span.begin) + indent_at(span.begin).size() == span.begin &&
         behind != std::string_view::npos && (text_[behind] == '\n' || text_[behind] == '#');
}

std::size_t KeyedText::checked_index(std::string_view part, std::size_t size,
                                     std::size_t limit) const {
  const std::optional<std::size_t> index = as_index(part);
  if (!index || *index >= limit)
    refuse(fmt::format("no element `{}` (the list has {}, counted from 0)", part, size));
  return *index;
}

// Follows the key below the place as far as the text has values there.
void KeyedText::descend(Place& place) const {
  while (!place.below.empty()) {
    const char opening = text_[place.value.begin];
    if (opening != '[' && opening != '{')
      refuse(fmt::format("`{}` lies below a plain value", place.below[0]));
    const std::vector<TextElement> elements = elements_of(text_, place.value.begin);
    std::size_t found = elements.size(), used = 1;
    if (opening == '[') {
      found = checked_index(place.below[0], elements.size(), elements.size() + 1);
    } else {
      for (std::size_t i = 0; i < elements.size(); ++i)
        if (starts_with(place.below, elements[i].key)) found = i;
      if (found < elements.size()) used = elements[found].key.size();
    }
    if (found == elements.size()) return;
    place.parent = {place.value.begin, found};
    place.value = elements[found].value;
    place.below = place.below.subspan(used);
  }
}

std::optional<KeyedText::Place> KeyedText::place() const {
  for (const TextSection& section : sections_) {
    if (!starts_with(path_, section.path)) continue;
    const KeyParts rest = KeyParts(path_).subspan(section.path.size());
    for (const KeyLine& line : section.keys) {
      if (!starts_with(rest, line.key)) continue;
      Place found{&line, line.value, rest.subspan(line.key.size()), {}};
      descend(found);
      return found;
    }
  }
  return std::nullopt;
}

bool KeyedText::names_tables() const {
  return std::any_of(sections_.begin(), sections_.end(), [&](const TextSection& section) {
    if (starts_with(section.path, path_)) return true;
    if (!starts_with(path_, section.path)) return false;
    const KeyParts rest = KeyParts(path_).subspan(section.path.size());
    return std::any_of(section.keys.begin(), section.keys.end(), [&](const KeyLine& line) {
      return line.key.size() > rest.size() && starts_with(line.key, rest);
    });
  });
}

bool KeyedText::has() const {
  const std::optional<Place> found = place();
  return (found && found->below.empty()) || names_tables();
}

}  // namespace hiac
