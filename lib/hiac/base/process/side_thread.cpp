#include "hiac/base/process/side_thread.hpp"

#include <csignal>
#include <latch>
#include <memory>
#include <utility>

#include <pthread.h>
#include <unistd.h>

#include "hiac/base/parallel.hpp"

namespace hiac {

std::thread start_side_thread(std::function<void()> run) {
  const auto held = keep_from_forking();
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, &before);
  const auto running = std::make_shared<std::latch>(1);
  std::thread thread([running, run = std::move(run)] {
    running->count_down();
    run();
  });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  running->wait();
  return thread;
}

std::unique_lock<std::mutex> keep_from_forking() {
  static std::mutex forking;
  return std::unique_lock(forking);
}

pid_t fork_undisturbed() {
  const auto held = keep_from_forking();
  end_waiting_threads();
  return fork();  // the child has a copy of the lock, and unlocks that
}

}  // namespace hiac
