#pragma once

#include <string>

#include "hiac/base/temporary_file.hpp"

namespace hiac::tools {

/// All that a stream brings, in a temporary file that readers can open and seek in.
class SpooledInput {
 public:
  /// The file's name has the extension of `subject`, which may tell the format. Throws InputError
  /// naming `subject`.
  SpooledInput(int descriptor, const std::string& subject);

  /// A text with the subject in place of the file's name.
  [[nodiscard]] std::string told(std::string text) const;

  [[nodiscard]] const std::string& path() const { return file_.path(); }

 private:
  std::string subject_;
  TemporaryFile file_;
};

}  // namespace hiac::tools
