#pragma once

#include <string>

namespace hiac {

/// A file that is written completely or not at all: it is written under a temporary name beside its
/// destination, and `commit` renames it. Nothing remains when the object is destroyed without
/// commit or when SIGINT, SIGTERM or SIGHUP ends the process.
class OutputFile {
 public:
  /// Creates the temporary file. Throws InputError with `path` if that fails.
  explicit OutputFile(std::string path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// The name of the file until commit.
  [[nodiscard]] const std::string& temporary_path() const { return temporary_; }
  /// Renames the file to its destination. Throws InputError if that fails.
  void commit();

 private:
  std::string path_;
  std::string temporary_;
  std::size_t slot_;
};

}  // namespace hiac
