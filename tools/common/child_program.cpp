#include "tools/common/child_program.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "hiac/base/error.hpp"
#include "hiac/base/process/side_thread.hpp"
#include "tools/common/sibling_program.hpp"

namespace hiac::tools {
namespace {

constexpr int kNoProgram = 127;

}  // namespace

ChildProgram start_program(const std::vector<std::string>& places,
                           std::vector<std::string> arguments, ChildPipe pipe) {
  std::vector<char*> pointers = pointers_to(arguments);
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
    throw Error(ExitCode::internal, fmt::format("no pipe ({})", std::strerror(errno)));
  const bool writes = pipe == ChildPipe::output;
  const int childs = writes ? ends[1] : ends[0], ours = writes ? ends[0] : ends[1];
  FileDescriptor messages(memfd_create("messages", MFD_CLOEXEC));
  const pid_t parent = getpid();
  const pid_t child = fork_undisturbed();
  if (child == 0) {
    // never outlives this process, whose other threads it does not have
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) _exit(1);
    dup2(childs, writes ? STDOUT_FILENO : STDIN_FILENO);
    if (!writes) dup2(messages.number(), STDOUT_FILENO);
    dup2(messages.number(), STDERR_FILENO);
    become(places, pointers);
    _exit(kNoProgram);
  }
  close(childs);
  FileDescriptor stream(ours);
  if (child < 0)
    throw Error(ExitCode::internal, fmt::format("no child process ({})", std::strerror(errno)));
  return {child, std::move(stream), std::move(messages)};
}

ChildEnd end_of(const ChildProgram& program) {
  int status = 0;
  while (waitpid(program.process, &status, 0) < 0 && errno == EINTR) continue;
  if (WIFSIGNALED(status)) return {.exit_code = 0, .signal = WTERMSIG(status)};
  const int code = WEXITSTATUS(status);
  return {.exit_code = code, .signal = 0, .not_found = code == kNoProgram};
}

std::string messages_of(const ChildProgram& program) {
  std::string text;
  std::array<char, 4096> part{};
  for (;;) {
    const ssize_t n =
        pread(program.messages.number(), part.data(), part.size(), static_cast<off_t>(text.size()));
    if (n <= 0) return text;
    text.append(part.data(), static_cast<std::size_t>(n));
  }
}

}  // namespace hiac::tools
