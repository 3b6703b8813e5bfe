#include "hiac/mesh/atomic_file.hpp"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "hiac/base/error.hpp"
#include "hiac/mesh/file_descriptor.hpp"

namespace hiac {
namespace {

namespace fs = std::filesystem;

constexpr mode_t kMode = 0666;  // the user's mask takes the rest away

[[noreturn]] void refuse(const std::string& path, const char* what) {
  throw InputError(path, fmt::format("{} ({})", what, std::generic_category().message(errno)));
}

/// The path that is to be replaced: a symbolic link's target where it exists.
std::string replaced_path(const std::string& path) {
  std::error_code failed;
  const fs::path target = fs::canonical(path, failed);
  return failed ? path : target.string();
}

/// Whether `path` is there and not a regular file: nothing to rename over.
bool is_special(const std::string& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode);
}

/// A name beside `path` that no other writer of this machine uses now.
std::string name_beside(const std::string& path) {
  static std::atomic<unsigned> count = 0;
  return fmt::format("{}.{}-{}.part", path, ::getpid(), count++);
}

/// Removes a name with the object unless it was renamed.
class TemporaryName {
 public:
  explicit TemporaryName(std::string name) : name_(std::move(name)) {}
  ~TemporaryName() {
    if (!name_.empty()) ::unlink(name_.c_str());
  }
  TemporaryName(const TemporaryName&) = delete;
  TemporaryName& operator=(const TemporaryName&) = delete;

  void rename_to(const std::string& target, const std::string& path) {
    if (::rename(name_.c_str(), target.c_str()) != 0) refuse(path, "cannot be replaced");
    name_.clear();
  }

 private:
  std::string name_;
};

FileDescriptor open_special(const std::string& path) {
  const int number = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (number < 0) refuse(path, "cannot be opened to be written");
  return FileDescriptor(number);
}

/// A file without a name in the folder of `target`, or none where the file system has no such
/// thing.
std::optional<FileDescriptor> open_unnamed(const std::string& target) {
  const fs::path folder = fs::path(target).parent_path();
  const int number =
      ::open(folder.empty() ? "." : folder.c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, kMode);
  if (number < 0) return std::nullopt;
  return FileDescriptor(number);
}

bool link_unnamed(const FileDescriptor& file, const std::string& name) {
  const std::string source = fmt::format("/proc/self/fd/{}", file.number());
  return ::linkat(AT_FDCWD, source.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
}

FileDescriptor open_named(const std::string& name, const std::string& path) {
  const int number = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kMode);
  if (number < 0) refuse(path, "cannot be created");
  return FileDescriptor(number);
}

}  // namespace

void write_atomically(const std::string& path, const std::function<void(int descriptor)>& write) {
  if (is_special(path)) {
    FileDescriptor file = open_special(path);
    write(file.number());
    return file.close(path);
  }
  const std::string target = replaced_path(path);
  const std::string name = name_beside(target);
  if (std::optional<FileDescriptor> file = open_unnamed(target)) {
    write(file->number());
    if (!link_unnamed(*file, name)) refuse(path, "cannot be created");
    TemporaryName temporary(name);
    file->close(path);
    return temporary.rename_to(target, path);
  }
  FileDescriptor file = open_named(name, path);
  TemporaryName temporary(name);
  write(file.number());
  file.close(path);
  temporary.rename_to(target, path);
}

}  // namespace hiac
