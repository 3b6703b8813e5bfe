#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "hiac/scene/toml/keyed_text.hpp"

namespace hiac {

/// A key that a text does not have, and its value: the text with it.
class NewKey {
 public:
  NewKey(const KeyedText& text, std::string_view value)
      : keyed_(text), text_(text.text()), value_(value), sections_(text.sections()) {}

  /// Adds to the list or the table in braces at a place.
  [[nodiscard]] std::string in_value(const KeyedText::Place& place) const;
  /// Adds a line to the key's table, or a table that has it.
  [[nodiscard]] std::string in_table() const;

 private:
  [[nodiscard]] std::string nested(KeyParts parts) const;
  [[nodiscard]] std::string in_braces(KeyParts parts) const;
  [[nodiscard]] std::string assignment(KeyParts parts) const;
  [[nodiscard]] std::string table_entry(std::span<const TextElement> elements,
                                        KeyParts parts) const;
  [[nodiscard]] std::string with_line(const TextSection& section, const KeyLine* behind,
                                      const std::string& line) const;
  [[nodiscard]] std::string with_header(std::size_t known) const;
  [[nodiscard]] std::size_t end_of_relatives(KeyParts ancestor) const;
  [[nodiscard]] std::size_t elements_at(KeyParts list) const;

  const KeyedText& keyed_;
  std::string_view text_, value_;
  std::span<const TextSection> sections_;
};

}  // namespace hiac
