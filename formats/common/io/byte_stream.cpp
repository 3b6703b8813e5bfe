#include "formats/common/io/byte_stream.hpp"

#include <fmt/format.h>

#include "hiac/base/error.hpp"

namespace hiac::formats {

void ByteStream::fail(const std::string& what) const {
  throw InputError(subject_, fmt::format("at byte {}: {}", at_, what));
}

void ByteStream::fail_at_end(std::string_view what) const {
  fail(fmt::format("the file ends too early ({} expected)", what));
}

}  // namespace hiac::formats
