#include "formats/gmsh/gmsh_stream.hpp"

#include <fmt/format.h>

#include "hiac/base/error.hpp"

namespace hiac::formats::gmsh {

void MshStream::fail(const std::string& what) const {
  if (!binary_) cursor_.fail(what);
  throw InputError(cursor_.subject(), fmt::format("at byte {}: {}", cursor_.offset(), what));
}

std::size_t MshStream::checked(std::int64_t value, std::string_view what, std::size_t bytes) const {
  // a number and the blank after it
  constexpr std::size_t kTextBytes = 2;
  const std::size_t limit = cursor_.left() / (binary_ ? bytes : kTextBytes) + 1;
  if (value < 0 || static_cast<std::uint64_t>(value) > limit)
    fail(fmt::format("{}: impossible (0 to {} expected, {} found)", what, limit, value));
  return static_cast<std::size_t>(value);
}

}  // namespace hiac::formats::gmsh
