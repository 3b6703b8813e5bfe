#include "hiac/base/temporary_file.hpp"

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "hiac/base/error.hpp"

namespace hiac {
namespace {

// Names of the temporary files that exist now. A signal handler may only read what is lock-free
// and may only call what is async-signal-safe: a fixed table of atomic pointers, and unlink. It has
// places for all files of a parted mesh; those that are not used take no memory.
constexpr std::size_t kFileSlots = std::size_t{1} << 17;
std::array<std::atomic<const char*>, kFileSlots> open_files{};
std::atomic<std::size_t> highest{0};  // all slots in use are below it
std::atomic<std::size_t> likely{0};   // where the search for a free one begins

// A file that is being made and not yet in the table would survive a signal. So the handler waits
// for steps under way, in other threads, and lets no further one begin.
std::atomic<int> steps{0};
std::atomic<bool> dying{false};

void remove_all() {
  dying.store(true);
  while (steps.load() > 0) continue;
  for (std::size_t i = 0; i < highest.load(); ++i) {
    const char* name = open_files[i].load();
    if (name != nullptr) unlink(name);
  }
}

extern "C" void remove_temporaries_and_die(int signal_number) {
  remove_all();
  std::signal(signal_number, SIG_DFL);
  std::raise(signal_number);
}

void install_handlers() {
  static std::once_flag once;
  std::call_once(once, [] {
    for (const int signal_number : {SIGINT, SIGTERM, SIGHUP}) {
      struct sigaction old {};
      if (sigaction(signal_number, nullptr, &old) == 0 && old.sa_handler == SIG_IGN) continue;
      struct sigaction action {};
      action.sa_handler = remove_temporaries_and_die;
      sigaction(signal_number, &action, nullptr);
    }
  });
}

std::size_t claim_slot(const char* name) {
  for (std::size_t k = 0; k < kFileSlots; ++k) {
    const std::size_t i = (likely.load() + k) % kFileSlots;
    const char* expected = nullptr;
    if (!open_files[i].compare_exchange_strong(expected, name)) continue;
    likely.store(i + 1);
    for (std::size_t most = highest.load(); most <= i;) highest.compare_exchange_weak(most, i + 1);
    return i;
  }
  return kFileSlots;  // more files at once than the handler can clean up: still correct without
                      // signals
}

}  // namespace

UnbrokenStep::UnbrokenStep() {
  sigset_t all;
  sigfillset(&all);
  // in its own thread the handler would wait for it forever
  pthread_sigmask(SIG_BLOCK, &all, &before_);
  ++steps;
  if (!dying.load()) return;
  --steps;
  for (;;) pause();
}

UnbrokenStep::~UnbrokenStep() {
  --steps;
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

TemporaryFile::TemporaryFile(const std::string& beginning, const std::string& subject,
                             const std::string& ending)
    : path_(beginning + ".XXXXXX" + ending), slot_(kFileSlots) {
  install_handlers();
  const UnbrokenStep step;
  const int descriptor = mkostemps(path_.data(), static_cast<int>(ending.size()), O_CLOEXEC);
  if (descriptor < 0)
    throw InputError(subject, std::string("cannot be written (") + std::strerror(errno) + ")");
  close(descriptor);
  slot_ = claim_slot(path_.c_str());
}

TemporaryFile::~TemporaryFile() {
  if (path_.empty()) return;
  unlink(path_.c_str());
  forget();
}

void TemporaryFile::keep() {
  forget();
  path_.clear();
}

void TemporaryFile::forget() {
  if (slot_ == kFileSlots) return;
  open_files[slot_].store(nullptr);
  likely.store(slot_);
}

void remove_temporary_files() { remove_all(); }

std::string temporary_name() {
  const char* folder = std::getenv("TMPDIR");
  const bool given = folder != nullptr && folder[0] != '\0';
  return std::string(given ? folder : "/tmp") + "/hiac";
}

}  // namespace hiac
