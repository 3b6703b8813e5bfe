#pragma once

#include <functional>
#include <mutex>
#include <thread>

#include <sys/types.h>

namespace hiac {

/// Threads that stand beside the work, in a process that may fork (IsolatedProcess).
///
/// The child of a fork has the forking thread alone. A lock that another thread held at that
/// moment, of an allocator or of a stream, stays locked in the child for ever. So a thread beside
/// the work starts by start_side_thread, and does what takes such locks while it holds
/// keep_from_forking. The threads of parallel_for, which take locks while they start and fall
/// asleep, are ended before a fork.

/// Starts a thread that leaves signals to the other threads, and returns when it runs: a thread
/// that starts allocates memory.
std::thread start_side_thread(std::function<void()> run);

/// While this is held, fork_undisturbed waits.
[[nodiscard]] std::unique_lock<std::mutex> keep_from_forking();

/// Returns what fork() does, called when nothing keeps this process from forking and the threads of
/// parallel_for have ended (end_waiting_threads).
pid_t fork_undisturbed();

}  // namespace hiac
