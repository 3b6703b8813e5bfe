#include "formats/tecplot/binary_items.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace hiac::formats::tecplot {

std::int32_t read_integer(ByteStream& stream, std::string_view what) {
  return stream.read<std::int32_t>(what);
}

std::vector<std::int32_t> read_integers(ByteStream& stream, std::size_t amount,
                                        std::string_view what) {
  if (amount > stream.left() / 4) stream.skip(4 * amount, what);
  std::vector<std::int32_t> result(amount);
  for (std::int32_t& value : result) value = read_integer(stream, what);
  return result;
}

std::size_t read_count(ByteStream& stream, std::string_view what, std::size_t bytes) {
  const std::int32_t value = read_integer(stream, what);
  if (value < 0 ||
      static_cast<std::size_t>(value) > stream.left() / std::max<std::size_t>(bytes, 1))
    stream.fail(fmt::format("{}: {} is more than the file holds", what, value));
  return static_cast<std::size_t>(value);
}

std::size_t read_extent(ByteStream& stream, std::string_view what) {
  const std::int32_t value = read_integer(stream, what);
  if (value < 0) stream.fail(fmt::format("{}: not a count ({} found)", what, value));
  return static_cast<std::size_t>(value);
}

std::string read_text(ByteStream& stream, std::string_view what) {
  std::string result;
  while (const std::int32_t c = read_integer(stream, what)) result += static_cast<char>(c);
  return result;
}

}  // namespace hiac::formats::tecplot
