#include "hiac/tetrahedralize/meshing/child_process.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include "hiac/base/error.hpp"

namespace hiac {
namespace {

void silence(int descriptor) {
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0) return;
  dup2(nowhere, descriptor);
  close(nowhere);
}

bool write_all(int pipe, const std::string& bytes) {
  std::size_t written = 0;
  while (written < bytes.size()) {
    const ssize_t n = write(pipe, bytes.data() + written, bytes.size() - written);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    written += static_cast<std::size_t>(n);
  }
  return true;
}

// Never returns; destructors of the parent do not run.
[[noreturn]] void be_the_child(int pipe, const std::function<std::string()>& work) {
  silence(STDOUT_FILENO);
  silence(STDERR_FILENO);
  int code = 1;
  try {
    if (write_all(pipe, work())) code = 0;
  } catch (...) {
    code = 1;  // the parent notices the missing bytes
  }
  _exit(code);
}

std::string read_all(int pipe) {
  std::string bytes;
  std::array<char, 1 << 16> part;
  for (;;) {
    const ssize_t n = read(pipe, part.data(), part.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return bytes;
    bytes.append(part.data(), static_cast<std::size_t>(n));
  }
}

}  // namespace

std::optional<std::string> in_child_process(const std::function<std::string()>& work) {
  std::array<int, 2> ends;
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
    throw Error(ExitCode::internal, fmt::format("no pipe ({})", std::strerror(errno)));
  std::fflush(nullptr);  // the parent writes its own buffers
  const pid_t child = fork();
  if (child == 0) be_the_child(ends[1], work);
  close(ends[1]);
  if (child < 0) {
    close(ends[0]);
    throw Error(ExitCode::internal, fmt::format("no child process ({})", std::strerror(errno)));
  }
  std::string bytes = read_all(ends[0]);
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) return std::nullopt;
  return bytes;
}

}  // namespace hiac
