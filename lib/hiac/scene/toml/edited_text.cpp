#include "hiac/scene/toml/edited_text.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/toml/spec_key.hpp"
#include "hiac/scene/toml/spec_path.hpp"
#include "hiac/scene/toml/spec_text.hpp"
#include "hiac/scene/toml/text_layout.hpp"

namespace hiac {
namespace {

using Parts = std::span<const std::string>;

bool starts_with(Parts path, Parts prefix) {
  return path.size() >= prefix.size() && std::equal(prefix.begin(), prefix.end(), path.begin());
}

/// A key as TOML writes it: bare if it can be.
std::string key_text(std::string_view name) {
  constexpr std::string_view kBare =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
  return name.find_first_not_of(kBare) == std::string_view::npos ? std::string(name)
                                                                 : toml_text(name);
}

/// Parts as a dotted key.
std::string dotted(Parts parts) {
  std::string text;
  for (const std::string& part : parts) {
    if (!text.empty()) text += '.';
    text += key_text(part);
  }
  return text;
}

/// One edit of one text.
class TextEditor {
 public:
  TextEditor(std::string_view text, std::string_view key) : text_(text), shown_(key) {
    parse_toml(text, "view");
    const std::optional<SpecPath> path = spec_path(key);
    if (!path) refuse("malformed key (expected one such as camera.fov)");
    path_ = *path;
    sections_ = sections_of(text);
    const std::size_t first_end = text.find('\n');
    if (first_end != std::string_view::npos && first_end > 0 && text[first_end - 1] == '\r')
      line_end_ = "\r\n";
  }

  std::string set(std::string_view value);
  std::string insert(std::string_view value);
  std::string remove();
  std::string remove_table();
  [[nodiscard]] bool has() const;

 private:
  /// A value in the text, and what of the key leads below it.
  struct Place {
    const KeyLine* line;
    TextSpan value;
    Parts below;
    std::optional<std::pair<std::size_t, std::size_t>> parent;  // value's begin, element's number
  };

  [[noreturn]] void refuse(const std::string& what) const {
    throw UsageError(in_one_line(fmt::format("key `{}`: {}", shown_, what)));
  }
  void refuse_bad_value(std::string_view value) const;
  [[nodiscard]] std::string replaced(TextSpan span, std::string_view by) const {
    return fmt::format("{}{}{}", text_.substr(0, span.begin), by, text_.substr(span.end));
  }

  [[nodiscard]] std::size_t start_of_line(std::size_t at) const {
    const std::size_t end = text_.substr(0, at).rfind('\n');
    return end == std::string_view::npos ? 0 : end + 1;
  }
  /// The blanks before the first thing in the line.
  [[nodiscard]] std::string_view indent_at(std::size_t at) const {
    const std::string_view line = text_.substr(start_of_line(at));
    return line.substr(0, line.find_first_not_of(" \t"));
  }
  [[nodiscard]] bool has_own_line(TextSpan span) const;

  [[nodiscard]] std::optional<Place> place() const;
  void descend(Place& place) const;
  std::size_t checked_index(std::string_view part, std::size_t size, std::size_t limit) const;
  [[nodiscard]] bool names_tables() const;

  [[nodiscard]] std::string nested(Parts parts, std::string_view value) const;
  [[nodiscard]] std::string in_braces(Parts parts, std::string_view value) const;
  [[nodiscard]] std::string assignment(Parts parts, std::string_view value) const {
    return fmt::format("{} = {}", key_text(parts[0]), nested(parts.subspan(1), value));
  }
  [[nodiscard]] std::string in_table(std::span<const TextElement> elements, Parts parts,
                                     std::string_view value) const;
  [[nodiscard]] std::string with_part(const Place& place, std::string_view value) const;
  [[nodiscard]] std::string with_line(const TextSection& section, const KeyLine* behind,
                                      const std::string& line) const;
  [[nodiscard]] std::string with_header(std::size_t known, std::string_view value) const;
  [[nodiscard]] std::string with_new_key(std::string_view value) const;
  [[nodiscard]] std::size_t end_of_relatives(Parts ancestor) const;
  [[nodiscard]] std::size_t elements_at(Parts list) const;
  [[nodiscard]] std::string without_part(const Place& place) const;
  [[nodiscard]] std::string without_lines(std::vector<TextSpan> spans) const;

  std::string_view text_, shown_;
  std::string line_end_ = "\n";
  SpecPath path_;
  std::vector<TextSection> sections_;
};

/// Whether nothing but a comment stands beside the span.
bool TextEditor::has_own_line(TextSpan span) const {
  const std::size_t behind = text_.find_first_not_of(" \t\r", span.end);
  return start_of_line(span.begin) + indent_at(span.begin).size() == span.begin &&
         behind != std::string_view::npos && (text_[behind] == '\n' || text_[behind] == '#');
}

void TextEditor::refuse_bad_value(std::string_view value) const {
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

std::size_t TextEditor::checked_index(std::string_view part, std::size_t size,
                                      std::size_t limit) const {
  const std::optional<std::size_t> index = as_index(part);
  if (!index || *index >= limit)
    refuse(fmt::format("no element `{}` (the list has {}, counted from 0)", part, size));
  return *index;
}

/// Follows the key below the place as far as the text has values there.
void TextEditor::descend(Place& place) const {
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

/// The value that the key names or leads into.
std::optional<TextEditor::Place> TextEditor::place() const {
  for (const TextSection& section : sections_) {
    if (!starts_with(path_, section.path)) continue;
    const Parts rest = Parts(path_).subspan(section.path.size());
    for (const KeyLine& line : section.keys) {
      if (!starts_with(rest, line.key)) continue;
      Place found{&line, line.value, rest.subspan(line.key.size()), {}};
      descend(found);
      return found;
    }
  }
  return std::nullopt;
}

/// Whether the key is a table, or a list of them, that headers or dotted keys make.
bool TextEditor::names_tables() const {
  return std::any_of(sections_.begin(), sections_.end(), [&](const TextSection& section) {
    if (starts_with(section.path, path_)) return true;
    if (!starts_with(path_, section.path)) return false;
    const Parts rest = Parts(path_).subspan(section.path.size());
    return std::any_of(section.keys.begin(), section.keys.end(), [&](const KeyLine& line) {
      return line.key.size() > rest.size() && starts_with(line.key, rest);
    });
  });
}

bool TextEditor::has() const {
  const std::optional<Place> found = place();
  return (found && found->below.empty()) || names_tables();
}

/// What `parts` of a new key make of a value: tables in braces, and a list where a number follows a
/// name.
std::string TextEditor::nested(Parts parts, std::string_view value) const {
  if (parts.empty()) return std::string(value);
  if (!as_index(parts[0])) return in_braces(parts, value);
  checked_index(parts[0], 0, 1);
  const Parts rest = parts.subspan(1);
  return fmt::format("[{}]", rest.empty() ? std::string(value) : in_braces(rest, value));
}

std::string TextEditor::in_braces(Parts parts, std::string_view value) const {
  return fmt::format("{{ {} }}", assignment(parts, value));
}

/// The new key of a table in braces: one of a table that dotted keys make continues them.
std::string TextEditor::in_table(std::span<const TextElement> elements, Parts parts,
                                 std::string_view value) const {
  const auto has_relative = [&](Parts known) {
    return std::any_of(elements.begin(), elements.end(),
                       [&](const TextElement& element) { return starts_with(element.key, known); });
  };
  if (has_relative(parts)) refuse("is a table (its keys can be set)");
  std::size_t known = parts.size() - 1;
  while (known > 0 && !has_relative(parts.first(known))) --known;
  const std::string added = assignment(parts.subspan(known), value);
  return known == 0 ? added : fmt::format("{}.{}", dotted(parts.first(known)), added);
}

/// Adds to the list or the table in braces at a place.
std::string TextEditor::with_part(const Place& place, std::string_view value) const {
  const std::size_t begin = place.value.begin;
  const std::vector<TextElement> elements = elements_of(text_, begin);
  const bool is_list = text_[begin] == '[';
  const bool is_plain = place.below.size() == 1;
  const std::string added = !is_list   ? in_table(elements, place.below, value)
                            : is_plain ? std::string(value)
                                       : in_braces(place.below.subspan(1), value);
  if (elements.empty())
    return replaced({begin + 1, begin + 1}, is_list ? added : fmt::format(" {} ", added));
  const std::size_t end = elements.back().span.end;
  const std::size_t next = skip_space(text_, end);
  const bool has_comma = text_[next] == ',';
  const TextSpan last{elements.back().span.begin, has_comma ? next + 1 : end};
  if (!is_list || !has_own_line(last)) return replaced({end, end}, fmt::format(", {}", added));
  const std::size_t line_end = text_.find('\n', last.end) + 1;
  return fmt::format("{}{}{}{}{},{}{}", text_.substr(0, end), has_comma ? "" : ",",
                     text_.substr(end, line_end - end), indent_at(last.begin), added, line_end_,
                     text_.substr(line_end));
}

/// Adds a line to a section, behind one of its lines (null: behind the header).
std::string TextEditor::with_line(const TextSection& section, const KeyLine* behind,
                                  const std::string& line) const {
  const std::size_t at = behind != nullptr ? behind->lines.end : section.header.end;
  const std::string_view indent = behind != nullptr ? indent_at(behind->written.begin) : "";
  const bool line_ended = at == 0 || text_[at - 1] == '\n' || at == sections_[0].header.end;
  return replaced({at, at},
                  fmt::format("{}{}{}{}", line_ended ? "" : line_end_, indent, line, line_end_));
}

/// Where the last section at or below a table ends: before the comment that stands right above the
/// next header.
std::size_t TextEditor::end_of_relatives(Parts ancestor) const {
  std::size_t last = sections_.size() - 1;
  while (last > 0 && !starts_with(sections_[last].path, ancestor)) --last;
  if (last + 1 == sections_.size()) return text_.size();
  std::size_t at = sections_[last + 1].header.begin;
  const std::size_t least = sections_[last].keys.empty() ? sections_[last].header.end
                                                         : sections_[last].keys.back().lines.end;
  while (at > least) {
    const std::size_t begin = start_of_line(at - 1);
    const std::string_view line = text_.substr(begin, at - begin);
    const std::size_t first = line.find_first_not_of(" \t");
    if (begin < least || first == std::string_view::npos || line[first] != '#') break;
    at = begin;
  }
  return at;
}

/// The number of elements that headers make of a list of tables.
std::size_t TextEditor::elements_at(Parts list) const {
  return static_cast<std::size_t>(
      std::count_if(sections_.begin(), sections_.end(), [&](const TextSection& section) {
        return section.is_element && section.path.size() == list.size() + 1 &&
               starts_with(section.path, list);
      }));
}

/// Adds a table with a header for the key: its first `known` parts are a table with a header, or
/// lie above one.
std::string TextEditor::with_header(std::size_t known, std::string_view value) const {
  const Parts path = path_;
  // names up to the header's end, and behind them the number of a new element
  std::size_t names = known;
  const std::size_t elements = elements_at(path.first(known));
  if (elements == 0)
    while (names + 1 < path.size() && (names == known || !as_index(path[names]))) ++names;
  const bool ends_in_number = names > known && as_index(path[names]).has_value();
  const bool is_plain_list = ends_in_number && names + 1 == path.size();
  if (is_plain_list) --names;
  const bool is_element = elements > 0 || (ends_in_number && !is_plain_list);
  if (is_element) checked_index(path[names], elements, elements + 1);
  if (names + 1 == path.size() && is_element) refuse("an element of a list of tables is a table");
  SpecPath header;
  for (std::size_t i = 0; i < names; ++i)
    if (i >= known || i == 0 || !elements_at(path.first(i))) header.push_back(path[i]);
  const Parts rest = path.subspan(names + (is_element ? 1 : 0));
  const std::size_t at = end_of_relatives(path.first(known));
  const auto ends_with = [&](std::string_view end) {
    return text_.substr(0, at).ends_with(end) || at == 0;
  };
  const std::string before = !ends_with("\n")                           ? line_end_ + line_end_
                             : ends_with("\n\n") || ends_with("\n\r\n") ? ""
                                                                        : line_end_;
  return replaced(
      {at, at}, fmt::format("{}{}{}{}{}{}{}{}", before, is_element ? "[[" : "[", dotted(header),
                            is_element ? "]]" : "]", line_end_, assignment(rest, value), line_end_,
                            at < text_.size() ? line_end_ : ""));
}

std::string TextEditor::with_new_key(std::string_view value) const {
  const Parts path = path_;
  for (std::size_t known = path.size() - 1;; --known) {
    const Parts table = path.first(known);
    for (const TextSection& section : sections_) {
      if (!starts_with(table, section.path)) continue;
      const KeyLine* last = section.keys.empty() ? nullptr : &section.keys.back();
      const Parts rest = path.subspan(section.path.size());
      const std::size_t prefix = known - section.path.size();
      if (prefix == 0) {
        const bool is_plain_list = rest.size() == 2 && as_index(rest[1]);
        if (rest.size() == 1 || is_plain_list)
          return with_line(section, last, assignment(rest, value));
        return with_header(known, value);
      }
      const KeyLine* relative = nullptr;
      for (const KeyLine& line : section.keys)
        if (starts_with(line.key, rest.first(prefix))) relative = &line;
      if (relative != nullptr)
        return with_line(section, relative,
                         fmt::format("{}.{}", dotted(rest.first(prefix)),
                                     assignment(rest.subspan(prefix), value)));
    }
    const bool lies_above =
        std::any_of(sections_.begin(), sections_.end(),
                    [&](const TextSection& section) { return starts_with(section.path, table); });
    if (lies_above) return with_header(known, value);
  }
}

std::string TextEditor::set(std::string_view value) {
  refuse_bad_value(value);
  if (names_tables()) refuse("is a table (its keys can be set)");
  const std::optional<Place> found = place();
  if (!found) return with_new_key(value);
  return found->below.empty() ? replaced(found->value, value) : with_part(*found, value);
}

std::string TextEditor::insert(std::string_view value) {
  refuse_bad_value(value);
  const std::optional<Place> found = place();
  const bool is_new = found && found->below.size() == 1 && text_[found->value.begin] == '[';
  if (is_new) return with_part(*found, value);
  if (!found || !found->below.empty() || !found->parent || text_[found->parent->first] != '[')
    refuse("no element of a list in brackets");
  const std::size_t at = found->value.begin;
  // elements on lines of their own stay so
  const std::string_view indent = indent_at(at);
  const bool is_first = start_of_line(at) + indent.size() == at;
  return replaced({at, at}, is_first ? fmt::format("{},{}{}", value, line_end_, indent)
                                     : fmt::format("{}, ", value));
}

/// Removes an element with its comma, and its line with the comment there if it has one of its own.
std::string TextEditor::without_part(const Place& place) const {
  const std::vector<TextElement> elements = elements_of(text_, place.parent->first);
  const std::size_t number = place.parent->second;
  TextSpan gone = elements[number].span;
  const std::size_t next = skip_space(text_, gone.end);
  const bool has_comma = next < text_.size() && text_[next] == ',';
  // a comment before the comma stays
  const std::string_view between = text_.substr(gone.end, has_comma ? next - gone.end : 0);
  const std::string_view kept = between.find('#') == std::string_view::npos ? "" : between;
  if (has_comma) gone.end = next + 1;
  if (kept.empty() && has_own_line(gone))
    gone = {start_of_line(gone.begin), std::min(text_.find('\n', gone.end), text_.size() - 1) + 1};
  else
    while (has_comma && gone.end < text_.size() && text_[gone.end] == ' ') ++gone.end;
  std::string edited = replaced(gone, kept);
  if (has_comma || number == 0) return edited;
  // the last one: the comma before it goes, too
  const std::size_t comma = skip_space(text_, elements[number - 1].span.end);
  const std::string_view blank = text_.substr(comma + 1, gone.begin - comma - 1);
  const bool is_blank = blank.find_first_not_of(' ') == std::string_view::npos;
  return edited.erase(comma, is_blank ? gone.begin - comma : 1);
}

std::string TextEditor::remove() {
  if (names_tables()) refuse("is a table with a header");
  const std::optional<Place> found = place();
  if (!found || !found->below.empty()) return std::string(text_);
  return found->parent ? without_part(*found) : replaced(found->line->lines, "");
}

/// Removes lines, and one of two empty lines that then meet.
std::string TextEditor::without_lines(std::vector<TextSpan> spans) const {
  std::string text(text_);
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

std::string TextEditor::remove_table() {
  const std::optional<Place> found = place();
  if (found && found->below.empty()) return remove();
  std::vector<TextSpan> spans;
  for (const TextSection& section : sections_) {
    if (starts_with(section.path, path_)) {
      const bool has_keys = !section.keys.empty();
      spans.push_back(
          {section.header.begin, has_keys ? section.keys.back().lines.end : section.header.end});
    } else if (starts_with(path_, section.path)) {
      const Parts rest = Parts(path_).subspan(section.path.size());
      for (const KeyLine& line : section.keys)
        if (starts_with(line.key, rest)) spans.push_back(line.lines);
    }
  }
  return without_lines(std::move(spans));
}

}  // namespace

std::string with_key(std::string_view text, std::string_view key, std::string_view value) {
  return TextEditor(text, key).set(value);
}

std::string without_key(std::string_view text, std::string_view key) {
  return TextEditor(text, key).remove();
}

std::string with_element(std::string_view text, std::string_view element, std::string_view value) {
  return TextEditor(text, element).insert(value);
}

std::string with_table(std::string_view text, std::string_view table,
                       std::span<const std::pair<std::string, std::string>> keys) {
  if (TextEditor(text, table).has())
    throw UsageError(in_one_line(fmt::format("key `{}`: exists", table)));
  std::string edited(text);
  for (const auto& [key, value] : keys)
    edited = with_key(edited, fmt::format("{}.{}", table, key), value);
  return edited;
}

std::string without_table(std::string_view text, std::string_view table) {
  return TextEditor(text, table).remove_table();
}

}  // namespace hiac
