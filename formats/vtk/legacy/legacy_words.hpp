#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "formats/vtk/number_type.hpp"

namespace hiac::formats::vtk {

/// Reads a legacy VTK file word by word and line by line, as VTK's reader does, and knows its
/// position for error messages.
class LegacyWords {
 public:
  LegacyWords(std::string_view text, std::string subject)
      : text_(text), subject_(std::move(subject)) {}

  [[nodiscard]] std::size_t at() const { return at_; }
  [[nodiscard]] std::size_t left() const { return text_.size() - at_; }
  [[nodiscard]] std::string_view text() const { return text_; }
  void set_binary() { binary_ = true; }
  [[nodiscard]] bool binary() const { return binary_; }
  void move_to(std::size_t at) { at_ = at; }

  /// The next word, or an empty one at the end of the file.
  std::string_view word();
  /// The next word in lower case; `what` names what was expected in the error at the file's end.
  std::string keyword(const std::string& what);
  /// The next word as a name, with its case kept.
  std::string_view name();
  /// The next word as a count.
  std::size_t count(const std::string& what);
  /// The next word as a finite number.
  double number(const std::string& what);
  /// The rest of the line, without its end.
  std::string_view line();
  /// Skips blanks and line ends, then returns whether the file ends there.
  bool at_end() { return goes_on_with("") && left() == 0; }
  /// Skips blanks and line ends, then returns whether `keyword` (lower case) comes next.
  bool goes_on_with(std::string_view keyword);
  /// Moves past the end of the current line, where binary values begin.
  void to_binary_values();

  /// Throws InputError naming the line or byte where the last word began.
  [[noreturn]] void fail(const std::string& what) const { fail_at(last_, what); }
  [[noreturn]] void fail_at(std::size_t at, const std::string& what) const;

 private:
  std::string_view text_;
  std::string subject_;
  std::size_t at_ = 0;
  std::size_t last_ = 0;
  bool binary_ = false;
};

/// The integers of one array, one after the other, from text or from big-endian bytes.
class IntegerStream {
 public:
  IntegerStream(std::string_view text, std::size_t at, const NumberType& type, bool binary)
      : text_(text), at_(at), type_(type), binary_(binary) {}

  /// The next integer. The array has been checked before, so the integer exists and is valid.
  std::int64_t next();
  [[nodiscard]] std::size_t at() const { return at_; }

 private:
  std::string_view text_;
  std::size_t at_;
  NumberType type_;
  bool binary_;
};

}  // namespace hiac::formats::vtk
