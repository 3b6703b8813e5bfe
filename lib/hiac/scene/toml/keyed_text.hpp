#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hiac/scene/toml/spec_path.hpp"
#include "hiac/scene/toml/text_layout.hpp"

namespace hiac {

/// Parts of a key.
using KeyParts = std::span<const std::string>;

bool starts_with(KeyParts path, KeyParts prefix);

/// A text in TOML, and one key: where in the text the key stands, or would.
class KeyedText {
 public:
  /// Throws as edited_text.hpp says.
  KeyedText(std::string_view text, std::string_view key);

  /// A value in the text, and what of the key leads below it.
  struct Place {
    const KeyLine* line;
    TextSpan value;
    KeyParts below;
    std::optional<std::pair<std::size_t, std::size_t>> parent;  // value's begin, element's number
  };
  /// The value that the key names or leads into.
  [[nodiscard]] std::optional<Place> place() const;
  /// Whether the key is a table, or a list of them, that headers or dotted keys make.
  [[nodiscard]] bool names_tables() const;
  /// Whether the text has a value or a table of this key.
  [[nodiscard]] bool has() const;

  [[nodiscard]] std::string_view text() const { return text_; }
  [[nodiscard]] KeyParts path() const { return path_; }
  [[nodiscard]] std::span<const TextSection> sections() const { return sections_; }
  /// As the text ends its lines.
  [[nodiscard]] std::string_view line_end() const { return line_end_; }

  [[nodiscard]] std::string replaced(TextSpan span, std::string_view by) const;
  [[nodiscard]] std::size_t start_of_line(std::size_t at) const;
  /// The blanks before the first thing in the line.
  [[nodiscard]] std::string_view indent_at(std::size_t at) const;
  /// Whether nothing but a comment stands beside the span.
  [[nodiscard]] bool has_own_line(TextSpan span) const;

  /// Throws UsageError with the key.
  [[noreturn]] void refuse(const std::string& what) const;
  /// Throws UsageError if the value is no TOML.
  void refuse_bad_value(std::string_view value) const;
  /// The number that a part is. Throws UsageError if it is none below `limit`; `size`: that of its
  /// list.
  std::size_t checked_index(std::string_view part, std::size_t size, std::size_t limit) const;

 private:
  void descend(Place& place) const;

  std::string_view text_, shown_;
  std::string line_end_ = "\n";
  SpecPath path_;
  std::vector<TextSection> sections_;
};

}  // namespace hiac
