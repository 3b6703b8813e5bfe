#pragma once

#include <functional>
#include <string>

namespace hiac {

/// Writes a file completely or not at all. `write` gets a descriptor to write to. When it returns,
/// its output replaces `path` in one step; when it throws, `path` is unchanged and no temporary
/// file remains (see OutputFile).
///
/// A symbolic link stays a link and its target is replaced; a pipe or a device is written to
/// directly. Throws InputError naming `path`, and every exception of `write`.
void write_atomically(const std::string& path, const std::function<void(int descriptor)>& write);

}  // namespace hiac
