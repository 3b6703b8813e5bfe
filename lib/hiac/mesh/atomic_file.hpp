#pragma once

#include <functional>
#include <string>

namespace hiac {

/// Writes a file whole or not at all: `write` gets a descriptor to write to; when it returns, what
/// it wrote takes the place of `path` in one step; when it throws, `path` is as it was and nothing
/// is left beside it (see OutputFile).
///
/// A symbolic link stays one and its target is replaced; a pipe or a device is written to directly.
/// Throws InputError naming `path`, and what `write` throws.
void write_atomically(const std::string& path, const std::function<void(int descriptor)>& write);

}  // namespace hiac
