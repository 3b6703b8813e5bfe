#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace hiac {

/// What a child may use; 0: as much as there is.
struct ChildLimits {
  std::uint64_t memory_bytes = 0;  ///< that it may allocate, besides what its parent holds
  std::uint64_t seconds = 0;       ///< of processor time
};

/// Calls `work` in a child process, whose stdout and stderr go nowhere, and returns the bytes that
/// it returns: for libraries that print, or that end the process on bad input. None when the child
/// ended in any other way (a crash, an exit, an exception, a limit). It never outlives the parent.
/// Throws Error (internal) when no child can be made. The caller's other threads must be idle: the
/// child has none of them.
std::optional<std::string> in_child_process(const std::function<std::string()>& work,
                                            const ChildLimits& limits = {});

}  // namespace hiac
