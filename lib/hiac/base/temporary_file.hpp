#pragma once

#include <csignal>
#include <cstddef>
#include <string>

namespace hiac {

/// A file of a name that nothing else has, empty at first. It is removed when the object is
/// destroyed, or when SIGINT, SIGTERM or SIGHUP ends the process.
class TemporaryFile {
 public:
  /// Its name is `beginning`, a dot, six characters and `ending`; only its owner may read it.
  /// Throws InputError naming `subject` when it cannot be made.
  TemporaryFile(const std::string& beginning, const std::string& subject,
                const std::string& ending = "");
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }
  /// Gives the file up: it has been renamed.
  void keep();

 private:
  void forget();

  std::string path_;
  std::size_t slot_;
};

/// While one lives, SIGINT, SIGTERM and SIGHUP do not end the process: its own thread hears no
/// signal, and where another one does, removing the temporary files waits for it.
class UnbrokenStep {
 public:
  UnbrokenStep();
  ~UnbrokenStep();
  UnbrokenStep(const UnbrokenStep&) = delete;
  UnbrokenStep& operator=(const UnbrokenStep&) = delete;

 private:
  sigset_t before_{};
};

/// Removes every TemporaryFile and lets no further one begin: for a process that is about to end.
void remove_temporary_files();

/// The beginning of a TemporaryFile's name in the folder for temporary files ($TMPDIR, /tmp).
std::string temporary_name();

}  // namespace hiac
