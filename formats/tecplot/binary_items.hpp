#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "formats/common/io/byte_stream.hpp"

namespace hiac::formats::tecplot {

// The items of a binary data file. `what` names the item in an error. All throw InputError naming
// the byte.

std::int32_t read_integer(ByteStream& stream, std::string_view what);
/// That many integers. Allocates memory only when the file is large enough for them.
std::vector<std::int32_t> read_integers(ByteStream& stream, std::size_t amount,
                                        std::string_view what);
/// A count of items that take at least `bytes` each.
std::size_t read_count(ByteStream& stream, std::string_view what, std::size_t bytes);
/// An extent of a zone; its size is checked when the data are read.
std::size_t read_extent(ByteStream& stream, std::string_view what);
/// A text that stores an integer for every character, ended by a zero.
std::string read_text(ByteStream& stream, std::string_view what);

}  // namespace hiac::formats::tecplot
