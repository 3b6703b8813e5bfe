#include "formats/common/io/mapped_file.hpp"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "hiac/base/error.hpp"

namespace hiac::formats {
namespace {

[[noreturn]] void fail(const std::string& path, std::string_view what) {
  throw InputError(path, fmt::format("{} ({})", what, std::strerror(errno)));
}

void write_all(int descriptor, std::string_view bytes, std::size_t at, const std::string& subject) {
  while (!bytes.empty()) {
    const ssize_t written = pwrite(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail(subject, "cannot be copied into memory");
    bytes.remove_prefix(static_cast<std::size_t>(written));
    at += static_cast<std::size_t>(written);
  }
}

}  // namespace

MappedFile::MappedFile(const std::string& path) {
  // opens a pipe without waiting for a writer; the check below refuses it
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) fail(path, "cannot be opened");
  struct stat status {};
  const bool known = fstat(descriptor, &status) == 0;
  if (!known || !S_ISREG(status.st_mode)) {
    close(descriptor);
    throw InputError(path, "is not a regular file (this format is not read from a stream)");
  }
  size_ = static_cast<std::size_t>(status.st_size);
  void* data = size_ == 0 ? nullptr : mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, descriptor, 0);
  const int error = errno;
  close(descriptor);
  if (data == MAP_FAILED) {
    errno = error;
    fail(path, "cannot be mapped into memory");
  }
  data_ = static_cast<const char*>(data);
}

MappedFile::~MappedFile() {
  if (data_ != nullptr) munmap(const_cast<char*>(data_), size_);
}

MemoryFile::MemoryFile(std::string_view text, const std::string& subject)
    : path_(fmt::format("/proc/self/fd/{}", memory_.descriptor())), subject_(subject) {
  write_all(memory_.descriptor(), text, 0, subject_);
}

void MemoryFile::put_zero(std::size_t at, std::size_t length) {
  std::string word(length, ' ');
  word.front() = '0';
  write_all(memory_.descriptor(), word, at, subject_);
}

void MemoryFile::put_blanks(std::size_t at, std::size_t length) {
  write_all(memory_.descriptor(), std::string(length, ' '), at, subject_);
}

}  // namespace hiac::formats
