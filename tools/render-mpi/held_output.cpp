#include "tools/render-mpi/held_output.hpp"

#include <array>
#include <chrono>
#include <iostream>
#include <thread>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace hiac::tools {
namespace {

constexpr std::chrono::seconds kWhile{2};

}  // namespace

HeldOutput::HeldOutput()
    : stderr_(fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 0)),
      held_(memfd_create("stderr", MFD_CLOEXEC)) {
  if (held_ >= 0) dup2(held_, STDERR_FILENO);
  if (const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC); nowhere >= 0) {
    dup2(nowhere, STDOUT_FILENO);
    close(nowhere);
  }
}

HeldOutput::~HeldOutput() {
  dup2(stderr_, STDERR_FILENO);
  close(stderr_);
  if (held_ >= 0) close(held_);
}

void HeldOutput::tell_after_a_while() {
  std::cerr.flush();
  std::this_thread::sleep_for(kWhile);
  std::array<char, 4096> part;
  off_t at = 0;
  for (ssize_t got; held_ >= 0 && (got = pread(held_, part.data(), part.size(), at)) > 0; at += got)
    if (write(stderr_, part.data(), static_cast<std::size_t>(got)) != got) return;
}

}  // namespace hiac::tools
