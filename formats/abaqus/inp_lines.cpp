#include "formats/abaqus/inp_lines.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace hiac::formats::abaqus {
namespace {

std::string_view without_blanks_before(std::string_view line) {
  while (!line.empty() && TextCursor::is_space(line.front())) line.remove_prefix(1);
  return line;
}

std::string without_quotes(std::string_view text) {
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"')
    text = text.substr(1, text.size() - 2);
  return std::string(text);
}

/// Blanks in parameter names are ignored (OLD SET, OLDSET).
std::string parameter_name(std::string_view text) {
  std::string name = upper(text);
  name.erase(std::remove_if(name.begin(), name.end(), TextCursor::is_space), name.end());
  return name;
}

void add_parameters(std::string_view text, Keyword& keyword) {
  CommaFields fields(text);
  while (!fields.at_end()) {
    const std::string_view field = fields.field();
    const std::size_t equals = field.find('=');
    const std::string_view value =
        equals == std::string_view::npos ? std::string_view() : trimmed(field.substr(equals + 1));
    keyword.parameters.emplace_back(parameter_name(field.substr(0, equals)), without_quotes(value));
  }
}

}  // namespace

const std::string* Keyword::value(std::string_view parameter) const {
  for (const auto& [key, value] : parameters)
    if (key == parameter) return &value;
  return nullptr;
}

bool Keyword::has_flag(std::string_view parameter) const {
  constexpr std::size_t kLetters = 3;
  for (const auto& [key, value] : parameters)
    if (key.size() >= kLetters && parameter.starts_with(key)) return true;
  return false;
}

bool is_comment(std::string_view line) { return without_blanks_before(line).starts_with("**"); }

bool is_keyword(std::string_view line) {
  const std::string_view rest = without_blanks_before(line);
  return rest.starts_with('*') && !rest.starts_with("**");
}

Keyword read_keyword(TextCursor& cursor) {
  Keyword keyword;
  keyword.offset = cursor.offset();
  std::string_view line = trimmed(cursor.line()).substr(1);
  const std::size_t comma = line.find(',');
  keyword.name = upper(trimmed(line.substr(0, comma)));
  if (comma == std::string_view::npos) return keyword;
  add_parameters(line.substr(comma + 1), keyword);
  while (line.ends_with(',') && !cursor.at_end() && !is_keyword(cursor.peek_line())) {
    const std::string_view next = cursor.line();
    if (is_comment(next)) continue;
    line = trimmed(next);
    add_parameters(line, keyword);
  }
  return keyword;
}

std::string required(const Keyword& keyword, std::string_view parameter, const TextCursor& cursor) {
  const std::string* value = keyword.value(parameter);
  if (value == nullptr || value->empty())
    cursor.fail_at(keyword.offset, fmt::format("*{} without {}", keyword.name, parameter));
  return *value;
}

std::optional<std::string_view> data_line_or_blank(TextCursor& cursor) {
  while (!cursor.at_end()) {
    const std::string_view line = cursor.peek_line();
    if (is_keyword(line)) return std::nullopt;
    cursor.line();
    if (!is_comment(line)) return line;
  }
  return std::nullopt;
}

std::optional<std::string_view> data_line(TextCursor& cursor) {
  while (const auto line = data_line_or_blank(cursor))
    if (!trimmed(*line).empty()) return line;
  return std::nullopt;
}

void refuse(const TextCursor& cursor, std::string_view line, std::string_view what) {
  cursor.fail_at(static_cast<std::size_t>(line.data() - cursor.text().data()),
                 fmt::format("{} expected ({} found)", what, shown(line)));
}

double real_in(CommaFields& fields, const TextCursor& cursor, std::string_view line) {
  const auto value = fields.real();
  if (!value) refuse(cursor, line, "a real number");
  return *value;
}

std::int64_t integer_in(CommaFields& fields, const TextCursor& cursor, std::string_view line,
                        std::string_view what) {
  const auto value = fields.integer();
  if (!value) refuse(cursor, line, what);
  return *value;
}

}  // namespace hiac::formats::abaqus
