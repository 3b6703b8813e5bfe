#pragma once

#include <memory>
#include <string>
#include <vector>

namespace hiac::formats::vtk {

/// Captures the messages that VTK would print, for as long as the object lives. One at a time in a
/// process: VTK's output is global (when a nested capture ends, the outer one gets its messages
/// back).
class MessageCapture {
 public:
  MessageCapture();
  ~MessageCapture();
  MessageCapture(const MessageCapture&) = delete;
  MessageCapture& operator=(const MessageCapture&) = delete;

  /// Throws InputError(subject, ...) with VTK's first error if there was one. Generic warnings
  /// count as errors: they are all that VTK's readers report for numbers that they could not read.
  void throw_on_error(const std::string& subject) const;
  /// Whether VTK has reported an error or a generic warning.
  [[nodiscard]] bool any_error() const;
  /// The distinct warnings so far, at most a few.
  [[nodiscard]] std::vector<std::string> warnings() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace hiac::formats::vtk
