#include "hiac/base/output_file.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <deque>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <linux/magic.h>
#include <sys/stat.h>
#include <sys/statfs.h>
#include <unistd.h>

#include "hiac/base/error.hpp"

namespace hiac {
namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw InputError(path, "cannot be written (" + why + ")");
}
[[noreturn]] void refuse(const std::string& path, int error) {
  refuse(path, std::string(std::strerror(error)));
}

std::optional<struct stat> status_of(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) return std::nullopt;
  return status;
}

// Where a path leads through its symbolic links; `proc`: through one in /proc, which stands for an
// open file.
struct Destination {
  std::string path;
  bool proc = false;
};

Destination destination_of(const std::string& path) {
  namespace fs = std::filesystem;
  constexpr int kMostLinks = 40;  // as the system has it
  fs::path at = path;
  std::error_code error;
  for (int links = 0; links < kMostLinks; ++links) {
    if (!fs::is_symlink(fs::symlink_status(at, error))) return {at.string()};
    const fs::path folder = at.has_parent_path() ? at.parent_path() : fs::path(".");
    struct statfs system {};
    if (statfs(folder.c_str(), &system) == 0 && system.f_type == PROC_SUPER_MAGIC)
      return {path, true};
    const fs::path next = fs::read_symlink(at, error);
    if (error) break;
    at = next.is_absolute() ? next : folder / next;
  }
  return {path};
}

// Errors leave their number in errno.
bool write_all(int file, const char* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t written = write(file, bytes, count);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes += written;
    count -= static_cast<std::size_t>(written);
  }
  return true;
}

bool copy_all(int from, int to) {
  std::array<char, 1 << 16> buffer{};
  for (;;) {
    const ssize_t count = read(from, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return count == 0;
    if (!write_all(to, buffer.data(), static_cast<std::size_t>(count))) return false;
  }
}

// A file that replaces another belongs to the same user where that is possible, and has its mode.
void take_mode(const std::string& path, const std::optional<struct stat>& replaced) {
  if (!replaced) {
    const mode_t mask = umask(0);
    umask(mask);
    chmod(path.c_str(), 0666 & ~mask);
    return;
  }
  // only a user with the right to do so can give a file away
  if (chown(path.c_str(), replaced->st_uid, replaced->st_gid) != 0) errno = 0;
  chmod(path.c_str(), replaced->st_mode & 07777);
}

}  // namespace

OutputFile::OutputFile(std::string path)
    : path_(std::move(path)), stream_(is_stream(path_)), destination_(path_) {
  const auto found = status_of(path_);
  if (found && S_ISDIR(found->st_mode)) refuse(path_, EISDIR);
  if (found && faccessat(AT_FDCWD, path_.c_str(), W_OK, AT_EACCESS) != 0) refuse(path_, errno);
  if (!stream_) destination_ = destination_of(path_).path;
  temporary_.emplace(stream_ ? temporary_name() : destination_, path_);
  if (!stream_) take_mode(temporary_path(), found);
}

void OutputFile::fail(const std::string& otherwise) const {
  constexpr std::size_t kEnough = 1 << 20;  // what a library has not written yet may fit
  const int file = open(temporary_path().c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  const bool written = file >= 0 && write_all(file, std::string(kEnough, '\0').data(), kEnough);
  const int error = errno;
  if (file >= 0) close(file);
  if (file >= 0 && !written) refuse(path_, error);
  refuse(path_, otherwise);
}

void OutputFile::commit() {
  if (stream_) return copy_to_stream();
  if (std::rename(temporary_path().c_str(), destination_.c_str()) != 0) refuse(path_, errno);
  temporary_->keep();
}

// Renames one of several files, and takes that back unless it is told to keep it.
class OutputFile::Replacement {
 public:
  explicit Replacement(OutputFile& file) : file_(file), old_(file.temporary_path() + ".old") {
    const char* destination = file.destination_.c_str();
    const auto found = status_of(file.destination_);
    if (found && S_ISDIR(found->st_mode)) refuse(file.path_, EISDIR);
    // without a second name, where there are none, the destination is gone for a moment
    had_old_ = found.has_value();
    if (had_old_ && link(destination, old_.c_str()) != 0 &&
        std::rename(destination, old_.c_str()) != 0)
      refuse(file.path_, errno);
    if (std::rename(file.temporary_path().c_str(), destination) == 0) return;
    const int error = errno;
    restore();
    refuse(file.path_, error);
  }
  ~Replacement() {
    if (!kept_) restore();
  }
  Replacement(const Replacement&) = delete;
  Replacement& operator=(const Replacement&) = delete;

  void keep() {
    kept_ = true;
    file_.temporary_->keep();
    if (had_old_) unlink(old_.c_str());
  }

 private:
  void restore() const {
    const char* destination = file_.destination_.c_str();
    if (!had_old_)
      unlink(destination);
    else if (std::rename(old_.c_str(), destination) == 0)
      unlink(old_.c_str());  // which is left where both names are still one file's
  }

  OutputFile& file_;
  std::string old_;
  bool had_old_ = false, kept_ = false;
};

void OutputFile::commit_all(std::span<const std::unique_ptr<OutputFile>> files) {
  const UnbrokenStep step;
  std::deque<Replacement> replacements;
  for (const std::unique_ptr<OutputFile>& file : files) replacements.emplace_back(*file);
  for (Replacement& replacement : replacements) replacement.keep();
}

void OutputFile::copy_to_stream() const {
  const int from = open(temporary_path().c_str(), O_RDONLY | O_CLOEXEC);
  const int to = path_ == "/dev/stdout"
                     ? dup(STDOUT_FILENO)
                     : open(path_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC | O_NOCTTY);
  int error = from < 0 || to < 0 || !copy_all(from, to) ? errno : 0;
  if (from >= 0) close(from);
  if (to >= 0 && close(to) != 0 && error == 0) error = errno;
  if (error != 0) refuse(path_, error);
}

bool is_stream(const std::string& path) {
  const auto found = status_of(path);
  if (!found || S_ISDIR(found->st_mode)) return false;
  return !S_ISREG(found->st_mode) || destination_of(path).proc;
}

void require_writable(const std::string& path) { const OutputFile trial(path); }

}  // namespace hiac
