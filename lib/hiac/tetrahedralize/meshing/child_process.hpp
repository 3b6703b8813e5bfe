#pragma once

#include <functional>
#include <optional>
#include <string>

namespace hiac {

/// Calls `work` in a child process whose stdout and stderr are discarded, and returns the bytes
/// that `work` returns: for libraries that print, or that end the process on bad input. Returns
/// none if the child ended in any other way (a crash, an exit, an exception). Throws Error
/// (internal) if no child can be created. The caller's other threads must be idle, as the child has
/// none of them.
std::optional<std::string> in_child_process(const std::function<std::string()>& work);

}  // namespace hiac
