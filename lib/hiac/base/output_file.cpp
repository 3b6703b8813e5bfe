#include "hiac/base/output_file.hpp"

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "hiac/base/error.hpp"

namespace hiac {
namespace {

// Names of the temporary files that exist now. A signal handler may only read what is lock-free
// and may only call what is async-signal-safe: a fixed table of atomic pointers, and unlink.
constexpr std::size_t kSlots = 64;
std::array<std::atomic<const char*>, kSlots> open_files{};

// A file that is created but not yet in the table would survive a signal. The handler therefore
// waits for files that other threads are creating, and lets no further creation start.
std::atomic<int> making{0};
std::atomic<bool> dying{false};

extern "C" void remove_temporaries_and_die(int signal_number) {
  dying.store(true);
  while (making.load() > 0) continue;
  for (auto& slot : open_files) {
    const char* name = slot.load();
    if (name != nullptr) unlink(name);
  }
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
  for (std::size_t i = 0; i < kSlots; ++i) {
    const char* expected = nullptr;
    if (open_files[i].compare_exchange_strong(expected, name)) return i;
  }
  return kSlots;  // more files at once than the handler can clean up: still correct without signals
}

// Exists while a file is created. It blocks signals in its own thread, as a handler there would
// wait for it forever.
class Making {
 public:
  Making() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, &before_);
    ++making;
    if (!dying.load()) return;
    --making;
    for (;;) pause();
  }
  ~Making() {
    --making;
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  Making(const Making&) = delete;
  Making& operator=(const Making&) = delete;

 private:
  sigset_t before_{};
};

}  // namespace

OutputFile::OutputFile(std::string path) : path_(std::move(path)), slot_(kSlots) {
  install_handlers();
  // a symbolic link remains: its target is replaced
  std::error_code not_there;
  const auto target = std::filesystem::canonical(path_, not_there);
  if (!not_there) path_ = target.string();
  std::string name = path_ + ".XXXXXX";
  const Making guard;
  const int descriptor = mkstemp(name.data());
  if (descriptor < 0)
    throw InputError(path_, std::string("cannot be written (") + std::strerror(errno) + ")");
  const mode_t mask = umask(0);
  umask(mask);
  fchmod(descriptor, 0666 & ~mask);
  close(descriptor);
  temporary_ = std::move(name);
  slot_ = claim_slot(temporary_.c_str());
}

OutputFile::~OutputFile() {
  if (temporary_.empty()) return;
  unlink(temporary_.c_str());
  if (slot_ < kSlots) open_files[slot_].store(nullptr);
}

void OutputFile::commit() {
  if (std::rename(temporary_.c_str(), path_.c_str()) != 0)
    throw InputError(path_, std::string("cannot be written (") + std::strerror(errno) + ")");
  if (slot_ < kSlots) open_files[slot_].store(nullptr);
  temporary_.clear();
}

}  // namespace hiac
