#include "hiac/base/process/child_process.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "hiac/base/error.hpp"
#include "hiac/base/process/side_thread.hpp"

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

// Bytes of private memory that the process may write to now, whether or not it has.
rlim_t allocated_bytes() {
  std::ifstream pages("/proc/self/statm");
  rlim_t total = 0, resident = 0, shared = 0, text = 0, library = 0, data = 0;
  pages >> total >> resident >> shared >> text >> library >> data;
  return data * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

void set_limits(const ChildLimits& limits) {
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  if (limits.memory_bytes > 0) {
    const rlim_t most = allocated_bytes() + limits.memory_bytes;
    const rlimit memory{most, most};
    setrlimit(RLIMIT_DATA, &memory);
  }
  if (limits.seconds > 0) {
    const rlimit time{limits.seconds, limits.seconds};
    setrlimit(RLIMIT_CPU, &time);
  }
}

// The parent's end, whatever it is, is the child's. An interrupt is the parent's to hear.
void follow(pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);
  std::signal(SIGINT, SIG_IGN);
  for (const int fatal : {SIGTERM, SIGHUP, SIGSEGV, SIGBUS, SIGFPE, SIGABRT, SIGILL})
    std::signal(fatal, SIG_DFL);
}

// Never returns; no destructor of the parent's runs.
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

std::optional<std::string> in_child_process(const std::function<std::string()>& work,
                                            const ChildLimits& limits) {
  std::array<int, 2> ends;
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
    throw Error(ExitCode::internal, fmt::format("no pipe ({})", std::strerror(errno)));
  std::fflush(nullptr);  // what is buffered is the parent's to write
  const pid_t parent = getpid();
  const pid_t child = fork_undisturbed();
  if (child == 0) {
    follow(parent);
    set_limits(limits);
    be_the_child(ends[1], work);
  }
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
