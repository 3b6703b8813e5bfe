#include "tools/convert/spooled_input.hpp"

#include <array>
#include <cstdint>
#include <span>

#include "hiac/mesh/file_descriptor.hpp"

namespace hiac::tools {

SpooledInput::SpooledInput(int descriptor, const std::string& subject)
    : file_(temporary_name(), subject) {
  FileDescriptor copy = open_to_write(file_.path());
  std::array<std::uint8_t, 1 << 16> buffer{};
  for (;;) {
    const std::size_t count = read_fully(descriptor, buffer, subject);
    write_fully(copy.number(), std::span(buffer).first(count), file_.path());
    if (count < buffer.size()) break;
  }
  copy.close(file_.path());
}

}  // namespace hiac::tools
