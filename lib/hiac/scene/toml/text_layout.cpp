#include "hiac/scene/toml/text_layout.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <toml++/toml.h>

namespace hiac {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t'; }

/// Returns the position of the line's end, or the end of the text.
std::size_t end_of_line(std::string_view text, std::size_t at) {
  return std::min(text.find('\n', at), text.size());
}

/// The whole lines around a span.
TextSpan lines_around(std::string_view text, TextSpan span) {
  const std::size_t before = text.substr(0, span.begin).rfind('\n');
  const std::size_t end = end_of_line(text, span.end);
  return {before == std::string_view::npos ? 0 : before + 1, std::min(end + 1, text.size())};
}

/// Returns the position behind the key, blanks before what follows it included.
std::size_t skip_key(std::string_view text, std::size_t at) {
  while (at < text.size() && text[at] != '=' && text[at] != ']')
    at = text[at] == '"' || text[at] == '\'' ? skip_string(text, at) : at + 1;
  return at;
}

/// The parts of a key as written. Quotes and escapes are the parser's business.
SpecPath key_parts(std::string_view written) {
  SpecPath parts;
  const toml::table parsed = toml::parse(std::string(written) + "= 0");
  for (const toml::table* table = &parsed; table != nullptr && !table->empty();) {
    const auto first = table->begin();
    parts.emplace_back(first->first.str());
    table = first->second.as_table();
  }
  return parts;
}

TextSpan trimmed(std::string_view text, TextSpan span) {
  while (span.end > span.begin && is_blank(text[span.end - 1])) --span.end;
  return span;
}

std::size_t skip_value(std::string_view text, std::size_t at);

/// Returns the position behind a list or a table in braces.
std::size_t skip_bracket(std::string_view text, std::size_t at) {
  const std::vector<TextElement> elements = elements_of(text, at);
  std::size_t end = skip_space(text, elements.empty() ? at + 1 : elements.back().span.end);
  if (end < text.size() && text[end] == ',') end = skip_space(text, end + 1);
  return std::min(end + 1, text.size());
}

std::size_t skip_value(std::string_view text, std::size_t at) {
  const char c = text[at];
  if (c == '"' || c == '\'') return skip_string(text, at);
  if (c == '[' || c == '{') return skip_bracket(text, at);
  // a date and its time may have a blank between them
  const std::size_t end = std::min(text.find_first_of(",]}#\r\n", at), text.size());
  return trimmed(text, {at, end}).end;
}

KeyLine key_line_at(std::string_view text, std::size_t at) {
  KeyLine line;
  const std::size_t equals = skip_key(text, at);
  line.written = trimmed(text, {at, equals});
  line.key = key_parts(line.written.of(text));
  const std::size_t value = skip_space(text, equals + 1);
  line.value = {value, skip_value(text, value)};
  line.lines = lines_around(text, {at, line.value.end});
  return line;
}

/// The number of elements that each list of tables has so far.
using ElementCounts = std::map<SpecPath, std::size_t>;

TextSection section_at(std::string_view text, std::size_t at, ElementCounts& counts) {
  TextSection section;
  section.is_element = text.substr(at, 2) == "[[";
  const std::size_t begin = at + (section.is_element ? 2 : 1);
  const std::size_t end = skip_key(text, begin);
  section.header = lines_around(text, {at, end});
  const SpecPath names = key_parts(text.substr(begin, end - begin));
  for (std::size_t i = 0; i < names.size(); ++i) {
    section.path.push_back(names[i]);
    const bool is_new_element = section.is_element && i + 1 == names.size();
    const auto count =
        is_new_element ? counts.try_emplace(section.path, 0).first : counts.find(section.path);
    if (count == counts.end()) continue;
    if (is_new_element) ++count->second;
    section.path.push_back(std::to_string(count->second - 1));
  }
  return section;
}

}  // namespace

std::size_t skip_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const std::string three(3, quote);
  const bool multiline = text.substr(at, 3) == three;
  std::size_t i = at + (multiline ? 3 : 1);
  while (i < text.size()) {
    if (text[i] == '\\' && quote == '"') {
      i += 2;
    } else if (multiline && text.substr(i, 3) == three) {
      i += 3;
      // up to two quotes may stand before the three that end the string
      for (int extra = 0; extra < 2 && i < text.size() && text[i] == quote; ++extra) ++i;
      return i;
    } else if (!multiline && text[i] == quote) {
      return i + 1;
    } else if (text[i] == '\n' && !multiline) {
      return i;
    } else {
      ++i;
    }
  }
  return text.size();
}

std::size_t skip_space(std::string_view text, std::size_t at) {
  while (at < text.size()) {
    if (text[at] == '#')
      at = end_of_line(text, at);
    else if (is_blank(text[at]) || text[at] == '\n' || text[at] == '\r')
      ++at;
    else
      break;
  }
  return at;
}

std::vector<TextElement> elements_of(std::string_view text, std::size_t begin) {
  std::vector<TextElement> elements;
  const bool is_table = text[begin] == '{';
  if (!is_table && text[begin] != '[') return elements;
  const char closing = is_table ? '}' : ']';
  std::size_t at = skip_space(text, begin + 1);
  while (at < text.size() && text[at] != closing) {
    TextElement& element = elements.emplace_back();
    std::size_t value = at;
    if (is_table) {
      const std::size_t equals = skip_key(text, at);
      element.key = key_parts(text.substr(at, equals - at));
      value = skip_space(text, equals + 1);
    }
    element.value = {value, skip_value(text, value)};
    element.span = {at, element.value.end};
    at = skip_space(text, element.value.end);
    if (at < text.size() && text[at] == ',') at = skip_space(text, at + 1);
  }
  return elements;
}

std::vector<TextSection> sections_of(std::string_view text) {
  std::vector<TextSection> sections(1);
  ElementCounts counts;
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  std::size_t at = text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
  sections[0].header = {at, at};
  while ((at = skip_space(text, at)) < text.size()) {
    if (text[at] == '[') {
      sections.push_back(section_at(text, at, counts));
      at = sections.back().header.end;
    } else {
      sections.back().keys.push_back(key_line_at(text, at));
      at = sections.back().keys.back().lines.end;
    }
  }
  return sections;
}

}  // namespace hiac
