#include "hiac/base/process/isolated_process.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <new>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "hiac/base/error.hpp"
#include "hiac/base/process/side_thread.hpp"

namespace hiac {
namespace {

constexpr rlim_t kLeastSeconds = 600;
constexpr std::uintmax_t kBytesPerSecond = 1'000'000;

/// A file descriptor, closed by the destructor.
class Descriptor {
 public:
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {
    if (descriptor_ < 0) throw std::bad_alloc();
  }
  ~Descriptor() { close(descriptor_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int get() const { return descriptor_; }

 private:
  int descriptor_;
};

// ---- what the two processes say to each other

enum class Outcome : std::uint64_t { done, failed, no_memory };

/// How a request ended, and where in the memory its answer is.
struct Head {
  Outcome outcome{};
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
};

/// Exactly `size` bytes; false when the other side is gone.
bool receive(int socket, void* data, std::size_t size) {
  auto* at = static_cast<char*>(data);
  while (size > 0) {
    const ssize_t got = recv(socket, at, size, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    at += got;
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

bool send_all(int socket, const void* data, std::size_t size) {
  const auto* at = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t sent = send(socket, at, size, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    at += sent;
    size -= static_cast<std::size_t>(sent);
  }
  return true;
}

bool send_text(int socket, const std::string& text) {
  const std::uint64_t size = text.size();
  return send_all(socket, &size, sizeof size) && send_all(socket, text.data(), text.size());
}

bool receive_text(int socket, std::string& text) {
  std::uint64_t size = 0;
  if (!receive(socket, &size, sizeof size)) return false;
  text.resize(size);
  return receive(socket, text.data(), text.size());
}

// ---- the process that reads files

/// More processor time for one file.
void extend_limit(const std::string& path) {
  struct rusage used {};
  getrusage(RUSAGE_SELF, &used);
  std::error_code failed;
  const std::uintmax_t size = std::filesystem::file_size(path, failed);
  const rlim_t seconds = static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
                         kLeastSeconds + (failed ? 0 : size / kBytesPerSecond);
  struct rlimit time {};
  getrlimit(RLIMIT_CPU, &time);
  time.rlim_cur = std::min(seconds, time.rlim_max);
  setrlimit(RLIMIT_CPU, &time);
}

void silence() {
  const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
  if (nowhere < 0) _exit(1);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, stream);
}

/// One answer: what `work` packs, or the error that it throws.
template <typename Work>
Head answer_of(const SharedMemory& memory, const Work& work) {
  // the reader may still hold parts of the answers before
  const std::uint64_t begin = (memory.size() + kPackPage - 1) / kPackPage * kPackPage;
  try {
    PackWriter out(memory.descriptor(), begin);
    work(out);
    return {Outcome::done, begin, out.end()};
  } catch (const Error& error) {
    PackWriter out(memory.descriptor(), begin);
    out.number(static_cast<std::uint64_t>(error.exit_code()));
    out.text(error.what());
    return {Outcome::failed, begin, out.end()};
  } catch (const std::bad_alloc&) {
    return {Outcome::no_memory, 0, 0};
  }
}

[[noreturn]] void serve_requests(int socket, const SharedMemory& memory,
                                 const IsolatedProcess::Serve& serve) {
  // an interrupt ends the parent process, and this process with it
  signal(SIGINT, SIG_IGN);
  for (const int fatal : {SIGTERM, SIGHUP, SIGSEGV, SIGBUS, SIGFPE, SIGABRT, SIGILL})
    signal(fatal, SIG_DFL);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  silence();
  try {
    std::string path;
    std::string request;
    while (receive_text(socket, path) && receive_text(socket, request)) {
      extend_limit(path);
      const Head head =
          answer_of(memory, [&](PackWriter& answer) { serve(path, request, answer); });
      if (!send_all(socket, &head, sizeof head)) break;
    }
  } catch (...) {
    _exit(1);
  }
  _exit(0);
}

[[noreturn]] void throw_error(PackReader& in) {
  const auto code = static_cast<ExitCode>(in.number());
  const std::string message = in.text();
  if (code == ExitCode::usage) throw UsageError(message);
  throw InputError(message);
}

}  // namespace

// ---- the process that requests

struct IsolatedProcess::Link {
  explicit Link(const SharedMemory& memory, const Serve& serve) {
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
      throw std::bad_alloc();
    socket = std::make_unique<Descriptor>(ends[0]);
    const Descriptor other(ends[1]);
    const pid_t parent = getpid();
    child = fork_undisturbed();
    if (child < 0) throw std::bad_alloc();
    if (child > 0) return;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(1);
    close(ends[0]);
    serve_requests(ends[1], memory, serve);
  }
  ~Link() {
    if (child < 0) return;
    kill(child, SIGKILL);
    wait();
  }
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;

  void wait() {
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
    child = -1;
  }

  std::unique_ptr<Descriptor> socket;
  pid_t child = -1;
  int status = 0;
};

IsolatedProcess::IsolatedProcess(std::string library, Serve serve)
    : library_(std::move(library)),
      serve_(std::move(serve)),
      memory_(std::make_shared<SharedMemory>()),
      link_(std::make_unique<Link>(*memory_, serve_)) {}

IsolatedProcess::~IsolatedProcess() = default;

PackedAnswer IsolatedProcess::answer(const std::string& path, const std::string& request) {
  Head head;
  if (link_->child < 0 || !send_text(link_->socket->get(), path) ||
      !send_text(link_->socket->get(), request) ||
      !receive(link_->socket->get(), &head, sizeof head)) {
    if (link_->child >= 0) link_->wait();
    const int end = link_->status;
    if (WIFSIGNALED(end) && (WTERMSIG(end) == SIGXCPU || WTERMSIG(end) == SIGKILL))
      throw InputError(
          path, fmt::format("{} does not come to an end with it (a damaged file)", library_));
    throw InputError(path, fmt::format("{} breaks down on it (a damaged file; {} {})", library_,
                                       WIFSIGNALED(end) ? "signal" : "status",
                                       WIFSIGNALED(end) ? WTERMSIG(end) : WEXITSTATUS(end)));
  }
  if (head.outcome == Outcome::no_memory) throw std::bad_alloc();
  if (head.outcome == Outcome::done) return PackedAnswer(memory_, head.begin, head.end);
  const PackedAnswer error(memory_, head.begin, head.end);
  PackReader in(error.bytes(), path);
  throw_error(in);
}

}  // namespace hiac
