#include "tools/convert/spooled_input.hpp"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include <fmt/format.h>
#include <unistd.h>

#include "hiac/base/error.hpp"

namespace hiac::tools {
namespace {

int unnamed_file(const std::string& subject) {
  const char* folder = std::getenv("TMPDIR");
  std::string name = fmt::format("{}/hiac-XXXXXX", folder == nullptr ? "/tmp" : folder);
  const int file = mkstemp(name.data());
  if (file < 0)
    throw InputError(subject, fmt::format("cannot be kept in {} ({})", name, std::strerror(errno)));
  unlink(name.c_str());
  return file;
}

void write_all(int file, std::string_view bytes, const std::string& subject) {
  while (!bytes.empty()) {
    const ssize_t written = write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0)
      throw InputError(
          subject, fmt::format("cannot be kept in a temporary file ({})", std::strerror(errno)));
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

}  // namespace

SpooledInput::SpooledInput(int descriptor, const std::string& subject)
    : file_(unnamed_file(subject)), path_(fmt::format("/proc/self/fd/{}", file_)) {
  std::array<char, 1 << 16> buffer{};
  for (;;) {
    const ssize_t count = read(descriptor, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      const int error = errno;
      close(file_);
      throw InputError(subject, fmt::format("cannot be read ({})", std::strerror(error)));
    }
    if (count == 0) return;
    try {
      write_all(file_, {buffer.data(), static_cast<std::size_t>(count)}, subject);
    } catch (...) {
      close(file_);
      throw;
    }
  }
}

SpooledInput::~SpooledInput() { close(file_); }

}  // namespace hiac::tools
