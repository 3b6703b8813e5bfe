#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "hiac/base/temporary_file.hpp"

namespace hiac {

/// A file that is written completely or not at all: it is written under a temporary name beside its
/// destination, and `commit` renames it. Nothing remains when the object is destroyed without
/// commit or when SIGINT, SIGTERM or SIGHUP ends the process.
///
/// A regular file is replaced and keeps its mode; a symbolic link stays a link and its target is
/// replaced. A device, a pipe or a socket is never replaced: the file is written in the folder for
/// temporary files ($TMPDIR, /tmp), and `commit` copies it there.
class OutputFile {
 public:
  /// Creates the temporary file. Throws InputError naming `path` when that cannot be done, when
  /// `path` is a folder, and when it is a file without permission to write.
  explicit OutputFile(std::string path);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// The name to write to until commit.
  [[nodiscard]] const std::string& temporary_path() const { return temporary_->path(); }
  /// Throws InputError, which says why nothing more can be written to the temporary file (no space,
  /// a limit), or `otherwise` when more can: for libraries that only tell that they failed.
  [[noreturn]] void fail(const std::string& otherwise) const;
  /// Renames the file to its destination, or copies it to a device, a pipe or a socket. Throws
  /// InputError when that cannot be done.
  void commit();
  /// Commits several files together, none of which goes to a device, a pipe or a socket: when one
  /// of them cannot be renamed, all destinations are again what they were. No signal comes between.
  static void commit_all(std::span<const std::unique_ptr<OutputFile>> files);

 private:
  class Replacement;
  void copy_to_stream() const;

  std::string path_;
  bool stream_;
  std::string destination_;  ///< the path without symbolic links, unless it is a stream's
  std::optional<TemporaryFile> temporary_;
};

/// Whether output to the path cannot replace what is there: a device, a pipe, a socket, or an open
/// file under its name in /proc.
bool is_stream(const std::string& path);

/// Throws InputError, as OutputFile does, when an output to the path is bound to fail.
void require_writable(const std::string& path);

}  // namespace hiac
