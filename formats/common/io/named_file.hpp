#pragma once

#include <cstddef>
#include <string>

namespace hiac::formats {

/// Enough for every format's first words, an XML declaration and comments included.
inline constexpr std::size_t kHeadBytes = 4096;

/// The first kHeadBytes of a file, or all of it. Throws InputError when it cannot be read.
std::string file_head(const std::string& path);

/// Which files a mesh's file may name. Set once, before anything is read; where it is not set,
/// files that lie in the folder of the file that names them.
struct NamedFiles {
  std::string folder;        ///< files that lie in it, as their names say, may be read
  bool outside_too = false;  ///< so may all others
};
void set_named_files(const NamedFiles& allowed);

/// Throws InputError(path, ...) when the file `named`, which the file `path` names, is not one that
/// may be read (NamedFiles). Symbolic links are not followed: what lies in the folder is the
/// user's.
void require_local(const std::string& path, const std::string& named);

/// The path of a file that the file `path` names, relative to where that is. Throws
/// InputError(path, ...) when it may not be read (require_local), when the name holds characters
/// that no message of one line can show, or is that of a pipe or a device.
std::string file_beside(const std::string& path, const std::string& named);

}  // namespace hiac::formats
