#pragma once

#include <string>

namespace hiac::tools {

/// All that a stream brings, in an unnamed temporary file that readers can open and seek in.
class SpooledInput {
 public:
  /// Throws InputError naming `subject`.
  SpooledInput(int descriptor, const std::string& subject);
  ~SpooledInput();
  SpooledInput(const SpooledInput&) = delete;
  SpooledInput& operator=(const SpooledInput&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  int file_ = -1;
  std::string path_;
};

}  // namespace hiac::tools
