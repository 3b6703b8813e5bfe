#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "formats/common/io/text_cursor.hpp"

namespace hiac::formats::tecplot {

/// The tokens of a Tecplot file's header: words, texts in quotes, lists in brackets, single marks.
class Tokens {
 public:
  explicit Tokens(TextCursor& cursor) : cursor_(cursor) {}

  /// Skips blanks, commas and comments; false at the end.
  bool skip();
  [[nodiscard]] char front() const { return cursor_.text()[cursor_.offset()]; }
  /// A quoted text, a list with its brackets, or letters and digits up to a mark. Throws InputError
  /// for a text or a list that does not end.
  std::string next();
  /// Consumes a mark if it comes next.
  bool take(char c);

 private:
  [[nodiscard]] std::string since(std::size_t start) const;
  std::string quoted_text(char quote);
  std::string bracketed();

  TextCursor& cursor_;
};

/// The numbers of "[1-3,5]" or "1,2": indices of variables, counted from 0.
std::vector<std::size_t> number_list(std::string_view text);

}  // namespace hiac::formats::tecplot
