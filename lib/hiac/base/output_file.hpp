#pragma once

#include <string>

namespace hiac {

/// A file that is written whole or not at all: it is written under a temporary name beside its
/// destination and takes its name in `commit`. Destroyed without commit, or when the process is
/// ended by SIGINT, SIGTERM or SIGHUP, it leaves nothing behind.
class OutputFile {
 public:
  /// Creates the temporary file. Throws InputError naming `path` when that cannot be done.
  explicit OutputFile(std::string path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// The name to write to until commit.
  [[nodiscard]] const std::string& temporary_path() const { return temporary_; }
  /// Gives the file its name. Throws InputError when that cannot be done.
  void commit();

 private:
  std::string path_;
  std::string temporary_;
  std::size_t slot_;
};

}  // namespace hiac
