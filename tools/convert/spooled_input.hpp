#pragma once

#include <string>

#include "hiac/base/temporary_file.hpp"

namespace hiac::tools {

/// All that a stream brings, in a temporary file that readers can open and seek in.
class SpooledInput {
 public:
  /// Throws InputError naming `subject`.
  SpooledInput(int descriptor, const std::string& subject);

  [[nodiscard]] const std::string& path() const { return file_.path(); }

 private:
  TemporaryFile file_;
};

}  // namespace hiac::tools
