#pragma once

#include <cstddef>
#include <string>

namespace hiac::formats {

/// Enough for every format's first words, an XML declaration and comments included.
inline constexpr std::size_t kHeadBytes = 4096;

/// The first kHeadBytes of a file, or all of it. Throws InputError when it cannot be read.
std::string file_head(const std::string& path);

/// Which files a mesh's file may name. Set once, before anything is read; if it is not set, a file
/// may name files in its own folder.
struct NamedFiles {
  std::string folder;        ///< files that lie in it, as their names say, may be read
  bool outside_too = false;  ///< so may all others
};
void set_named_files(const NamedFiles& allowed);

/// Throws InputError(path, ...) when the file `path` names the file `named` and that may not be
/// read (NamedFiles). Symbolic links are not resolved: the user is responsible for the contents of
/// the folder.
void require_local(const std::string& path, const std::string& named);

/// The path of a file that the file `path` names, relative to the folder of `path`. Throws
/// InputError(path, ...) when it may not be read (require_local), when the name holds characters
/// that a one-line message cannot show, or when it names a pipe or a device.
std::string file_beside(const std::string& path, const std::string& named);

}  // namespace hiac::formats
