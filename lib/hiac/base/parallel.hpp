#pragma once

#include <cstddef>
#include <functional>

namespace hiac {

/// Half-open range of indices.
struct IndexRange {
  std::size_t begin;
  std::size_t end;
};

/// Calls `body` on disjoint ranges that together cover [0, count), from any number of threads. The
/// length of every range but the last is a multiple of `grain`; results must not depend on which
/// thread gets which range. An exception that `body` throws is rethrown here.
void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(IndexRange)>& body);

/// Bounds the number of threads that parallel_for uses while the object lives.
/// 0 means one thread for every core that the process may use.
class ThreadLimit {
 public:
  explicit ThreadLimit(unsigned threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Control;
  Control* control_;
};

/// Returns the number of threads that parallel_for may use now.
unsigned thread_count();

/// Ends the threads that wait for the next parallel_for, which starts new ones. They may stay
/// while another thread lives that has called it.
void end_waiting_threads();

}  // namespace hiac
