#include "formats/tecplot/data_numbers.hpp"

#include <cctype>

namespace hiac::formats::tecplot {

double DataNumbers::value() {
  if (repeats_ > 0) {
    --repeats_;
    return repeated_;
  }
  tokens_.skip();
  const std::size_t start = cursor_.offset();
  const std::string_view line = cursor_.peek_line();
  const std::size_t star = line.substr(0, line.find_first_of(" \t,")).find('*');
  if (star == std::string_view::npos) return unrepeated();
  const auto count = to_integer(line.substr(0, star));
  if (!count || *count < 1) cursor_.fail_at(start, "a repeated value N*VALUE expected");
  cursor_.move_to(start + star + 1);
  repeated_ = unrepeated();
  repeats_ = static_cast<std::size_t>(*count) - 1;
  return repeated_;
}

double DataNumbers::unrepeated() {
  const std::string_view line = cursor_.peek_line();
  const std::size_t comma = line.substr(0, line.find_first_of(" \t")).find(',');
  if (comma == std::string_view::npos) return cursor_.real("a value");
  const auto value = to_real(line.substr(0, comma));
  if (!value) cursor_.refuse_word("a value");
  cursor_.bytes(comma, "");
  return *value;
}

std::int64_t DataNumbers::integer(std::string_view what) {
  tokens_.skip();
  return cursor_.integer(what);
}

void DataNumbers::skip_integers() {
  while (tokens_.skip() &&
         (std::isdigit(static_cast<unsigned char>(tokens_.front())) != 0 || tokens_.front() == '-'))
    cursor_.word();
}

}  // namespace hiac::formats::tecplot
