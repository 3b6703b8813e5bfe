#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "formats/common/io/text_cursor.hpp"
#include "formats/tecplot/tecplot_tokens.hpp"

namespace hiac::formats::tecplot {

/// The numbers of the zones in an ASCII data file, which blanks, commas and comments separate.
/// Throws InputError naming the line.
class DataNumbers {
 public:
  DataNumbers(TextCursor& cursor, Tokens& tokens) : cursor_(cursor), tokens_(tokens) {}

  /// The next value; "3*1.5" stands for three values.
  double value();
  /// Forgets the values that the last "N*VALUE" still stands for: at the end of a zone's values.
  void drop_repeats() { repeats_ = 0; }

  std::int64_t integer(std::string_view what);
  /// Skips integers up to the next word that is not one.
  void skip_integers();

 private:
  double unrepeated();

  TextCursor& cursor_;
  Tokens& tokens_;
  double repeated_ = 0;
  std::size_t repeats_ = 0;
};

}  // namespace hiac::formats::tecplot
