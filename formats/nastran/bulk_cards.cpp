#include "formats/nastran/bulk_cards.hpp"

#include <algorithm>

namespace hiac::formats::nastran {
namespace {

constexpr std::size_t kSmall = 8;
constexpr std::size_t kLarge = 16;
constexpr std::size_t kFieldsOfSmall = 8;
constexpr std::size_t kFieldsOfLarge = 4;

/// A comma in the first field marks a line in free format.
bool is_free(std::string_view line) {
  return line.substr(0, kSmall + 2).find(',') != std::string_view::npos;
}

bool is_blank_or_comment(std::string_view line) {
  const std::string_view rest = trimmed(line);
  return rest.empty() || rest.starts_with('$');
}

/// The line up to a dollar sign, which begins a comment anywhere.
std::string_view without_comment(std::string_view line) { return line.substr(0, line.find('$')); }

bool continues(std::string_view line) {
  if (line.starts_with('+') || line.starts_with('*')) return true;
  // the first field is blank, whether it ends at a comma or at its eighth column
  const std::size_t comma = line.substr(0, kSmall + 2).find(',');
  if (comma != std::string_view::npos) return trimmed(line.substr(0, comma)).empty();
  return line.size() > kSmall && trimmed(line.substr(0, kSmall)).empty();
}

/// The name of the entry: letters and digits, and a star for large fields; "=" for a replicated
/// entry.
std::string_view name_of(std::string_view line) {
  line = trimmed(line);
  if (line.starts_with('=')) return line.substr(0, 1);
  const std::size_t end = line.find_first_of(", \t=");
  return line.substr(0, std::min(end, kSmall));
}

}  // namespace

const Card* CardReader::next() {
  expanded_.clear();
  card_.fields.clear();
  while (true) {
    if (cursor_.at_end()) return nullptr;
    card_.offset = cursor_.offset();
    const std::string_view line = cursor_.line();
    if (is_blank_or_comment(line)) continue;
    card_.name = name_of(line);
    if (starts_with_upper(card_.name, "ENDDATA")) return nullptr;
    add_fields(without_comment(line));
    break;
  }
  if (card_.name.ends_with('*')) card_.name.remove_suffix(1);
  while (!cursor_.at_end()) {
    const std::string_view line = cursor_.peek_line();
    if (!is_blank_or_comment(line) && !continues(without_comment(line))) break;
    cursor_.line();
    if (!is_blank_or_comment(line)) add_fields(without_comment(line));
  }
  return &card_;
}

std::string_view CardReader::without_tabs(std::string_view line) {
  if (line.find('\t') == std::string_view::npos) return line;
  std::string& copy = expanded_.emplace_back();
  for (const char c : line) {
    copy += c == '\t' ? ' ' : c;
    while (c == '\t' && copy.size() % kSmall != 0) copy += ' ';
  }
  return copy;
}

void CardReader::add_free(std::string_view line) {
  const std::size_t comma = line.find(',');
  const bool large = trimmed(line.substr(0, comma)).ends_with('*');
  std::size_t missing = large ? kFieldsOfLarge : kFieldsOfSmall;
  line.remove_prefix(comma + 1);
  while (missing > 0 && !line.empty()) {
    const std::size_t end = std::min(line.find(','), line.size());
    card_.fields.push_back(trimmed(line.substr(0, end)));
    line.remove_prefix(std::min(end + 1, line.size()));
    --missing;
  }
  card_.fields.resize(card_.fields.size() + missing);
}

void CardReader::add_fields(std::string_view line) {
  if (is_free(line)) return add_free(line);
  line = without_tabs(line);
  const bool large = line.substr(0, kSmall).find('*') != std::string_view::npos;
  const std::size_t width = large ? kLarge : kSmall;
  const std::size_t count = large ? kFieldsOfLarge : kFieldsOfSmall;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = kSmall + width * i;
    card_.fields.push_back(at < line.size() ? trimmed(line.substr(at, width)) : std::string_view());
  }
}

}  // namespace hiac::formats::nastran
