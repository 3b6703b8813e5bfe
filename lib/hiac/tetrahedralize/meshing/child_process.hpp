#pragma once

#include <functional>
#include <optional>
#include <string>

namespace hiac {

/// Calls `work` in a child process, whose stdout and stderr go nowhere, and returns the bytes that
/// it returns: for libraries that print, or that end the process on bad input. None when the child
/// ended in any other way (a crash, an exit, an exception). Throws Error (internal) when no child
/// can be made. The caller's other threads must be idle: the child has none of them.
std::optional<std::string> in_child_process(const std::function<std::string()>& work);

}  // namespace hiac
