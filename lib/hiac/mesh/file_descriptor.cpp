#include "hiac/mesh/file_descriptor.hpp"

#include <algorithm>
#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include "hiac/base/error.hpp"

namespace hiac {
namespace {

/// A system call transfers at most about 2 GiB; smaller steps respond to an interrupt sooner.
constexpr std::size_t kLargestStep = std::size_t{1} << 26;

std::string reason(int error) { return std::generic_category().message(error); }

/// Returns whether to retry a failed transfer; waits if the descriptor is non-blocking.
bool may_retry(int error, int descriptor, short events) {
  if (error == EINTR) return true;
  if (error != EAGAIN && error != EWOULDBLOCK) return false;
  pollfd ready{descriptor, events, 0};
  return ::poll(&ready, 1, -1) >= 0 || errno == EINTR;
}

}  // namespace

FileDescriptor::~FileDescriptor() {
  if (number_ >= 0) ::close(number_);
}

void FileDescriptor::close(const std::string& subject) {
  if (::close(std::exchange(number_, -1)) != 0)
    throw InputError(subject, fmt::format("cannot be written ({})", reason(errno)));
}

FileDescriptor open_to_read(const std::string& path) {
  const int number = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (number < 0) throw InputError(path, fmt::format("cannot be opened ({})", reason(errno)));
  return FileDescriptor(number);
}

FileDescriptor open_to_write(const std::string& path) {
  const int number = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (number < 0) throw InputError(path, fmt::format("cannot be written ({})", reason(errno)));
  return FileDescriptor(number);
}

std::size_t read_fully(int descriptor, std::span<std::uint8_t> buffer, const std::string& subject) {
  std::size_t filled = 0;
  while (filled < buffer.size()) {
    const std::size_t step = std::min(buffer.size() - filled, kLargestStep);
    const ssize_t got = ::read(descriptor, buffer.data() + filled, step);
    if (got == 0) break;
    if (got > 0) {
      filled += static_cast<std::size_t>(got);
    } else if (const int error = errno; !may_retry(error, descriptor, POLLIN)) {
      throw InputError(subject, fmt::format("cannot be read ({})", reason(error)));
    }
  }
  return filled;
}

void write_fully(int descriptor, std::span<const std::uint8_t> bytes, const std::string& subject) {
  while (!bytes.empty()) {
    const std::size_t step = std::min(bytes.size(), kLargestStep);
    const ssize_t put = ::write(descriptor, bytes.data(), step);
    if (put >= 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(put));
    } else if (const int error = errno; !may_retry(error, descriptor, POLLOUT)) {
      throw InputError(subject, fmt::format("cannot be written ({})", reason(error)));
    }
  }
}

}  // namespace hiac
