#pragma once

#include <stdexcept>
#include <string>

namespace hiac {

/// Exit codes of every tool.
enum class ExitCode : int {
  done = 0,       ///< the work was done
  judgement = 1,  ///< the input was read and checked, and fails the check
  usage = 2,      ///< wrong options or arguments
  input = 3,      ///< unreadable or malformed input, or output that cannot be written
  internal = 4    ///< anything else (out of memory, a defect)
};

/// Base of the errors that hiac throws. `what()` is one line without the tool's name, in the form
/// `SUBJECT: what is wrong (what was expected, what was found)`; SUBJECT is a file or an option.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  [[nodiscard]] ExitCode exit_code() const { return code_; }

 private:
  ExitCode code_;
};

/// The user asked for something that does not exist or does not fit together.
class UsageError : public Error {
 public:
  explicit UsageError(const std::string& message) : Error(ExitCode::usage, message) {}
};

/// A file or stream cannot be read, is malformed, or cannot be written.
class InputError : public Error {
 public:
  explicit InputError(const std::string& message) : Error(ExitCode::input, message) {}
  InputError(const std::string& subject, const std::string& message)
      : Error(ExitCode::input, subject + ": " + message) {}
};

/// The input was understood and checked, and fails the check.
class JudgementError : public Error {
 public:
  explicit JudgementError(const std::string& message) : Error(ExitCode::judgement, message) {}
};

}  // namespace hiac
