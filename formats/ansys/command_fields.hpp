#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "formats/common/io/comma_fields.hpp"
#include "formats/common/io/text_cursor.hpp"

namespace hiac::formats::ansys {

/// The fields of one command of a deck, one after the other.
class CommandFields {
 public:
  /// `start`: where the command's line begins. `cursor` must outlive this.
  CommandFields(CommaFields fields, const TextCursor& cursor, std::size_t start)
      : fields_(fields), cursor_(cursor), start_(start) {}

  [[nodiscard]] std::size_t start() const { return start_; }
  [[nodiscard]] bool at_end() { return fields_.at_end(); }
  /// The next field in capitals; empty when there is none.
  std::string word() { return upper(fields_.field()); }
  /// The next field in capitals, which stays the next.
  [[nodiscard]] std::string peek() const {
    CommaFields ahead = fields_;
    return upper(ahead.field());
  }
  void skip(int fields) {
    for (; fields > 0; --fields) fields_.field();
  }
  /// The next field as a whole number, or `otherwise` when it is empty. Throws InputError:
  /// "FILE:LINE: `what` expected (the line found)".
  std::int64_t whole(std::string_view what, std::optional<std::int64_t> otherwise = std::nullopt);
  /// The next field as a real; 0 when it is empty.
  double real();
  /// Throws InputError as whole does when the next field is neither empty nor 0.
  void require_zero(std::string_view what);

  /// Throws InputError: "FILE:LINE: `what` expected (the line found)".
  [[noreturn]] void refuse(std::string_view what) const;

 private:
  CommaFields fields_;
  const TextCursor& cursor_;
  std::size_t start_;
};

/// The same for the command whose line begins at `start`.
[[noreturn]] void refuse_command(const TextCursor& cursor, std::size_t start,
                                 std::string_view what);

}  // namespace hiac::formats::ansys
