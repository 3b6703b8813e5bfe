#include "formats/ansys/command_fields.hpp"

#include <fmt/format.h>

#include "formats/common/io/deck_numbers.hpp"

namespace hiac::formats::ansys {

std::int64_t CommandFields::whole(std::string_view what, std::optional<std::int64_t> otherwise) {
  const std::string_view field = fields_.at_end() ? std::string_view() : fields_.field();
  if (field.empty() && otherwise) return *otherwise;
  const auto value = whole_number(field);
  if (!value) refuse(what);
  return *value;
}

double CommandFields::real() {
  if (fields_.at_end()) return 0;
  const auto value = fields_.real();
  if (!value) refuse("a real number");
  return *value;
}

void CommandFields::require_zero(std::string_view what) {
  if (!fields_.at_end() && real() != 0) refuse(what);
}

void CommandFields::refuse(std::string_view what) const { refuse_command(cursor_, start_, what); }

void refuse_command(const TextCursor& cursor, std::size_t start, std::string_view what) {
  const std::string_view line = cursor.text().substr(start);
  cursor.fail_at(start, fmt::format("{} expected ({} found)", what,
                                    shown(line.substr(0, line.find_first_of("\r\n")))));
}

}  // namespace hiac::formats::ansys
