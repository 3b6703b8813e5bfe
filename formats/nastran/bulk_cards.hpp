#pragma once

#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/common/io/text_cursor.hpp"

namespace hiac::formats::nastran {

/// One entry of the bulk data with its continuations.
struct Card {
  std::string_view name;                 ///< as written, without the star of large fields
  std::vector<std::string_view> fields;  ///< those after the name, without blanks at their ends
  std::size_t offset = 0;

  /// Field `i` from 0; empty when the card is shorter.
  [[nodiscard]] std::string_view field(std::size_t i) const {
    return i < fields.size() ? fields[i] : std::string_view();
  }
};

/// Steps through the entries of a bulk data section: small fields of 8 columns, large ones of 16,
/// free ones separated by commas; continuations are the following lines with +, * or blanks in
/// their first field.
class CardReader {
 public:
  explicit CardReader(TextCursor& cursor) : cursor_(cursor) {}

  /// The next entry; its views are valid until the next call. None at the end or after ENDDATA.
  const Card* next();

 private:
  void add_fields(std::string_view line);
  void add_free(std::string_view line);
  /// A tab is replaced by blanks up to the next multiple of eight columns.
  std::string_view without_tabs(std::string_view line);

  TextCursor& cursor_;
  Card card_;
  std::deque<std::string> expanded_;
};

}  // namespace hiac::formats::nastran
