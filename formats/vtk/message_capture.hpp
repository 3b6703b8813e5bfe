#pragma once

#include <memory>
#include <string>
#include <vector>

namespace hiac::formats::vtk {

/// Takes what VTK would print for as long as the object lives. One at a time in a process: VTK's
/// output is global (nested captures give the outer one its messages back when they end).
class MessageCapture {
 public:
  MessageCapture();
  ~MessageCapture();
  MessageCapture(const MessageCapture&) = delete;
  MessageCapture& operator=(const MessageCapture&) = delete;

  /// Throws InputError(subject, ...) with VTK's first error when there was one. Generic warnings
  /// count as errors: of numbers that they could not read, VTK's readers say no more than that.
  void throw_on_error(const std::string& subject) const;
  /// Whether VTK has told an error, or a generic warning.
  [[nodiscard]] bool any_error() const;
  /// The different warnings so far, a few of them.
  [[nodiscard]] std::vector<std::string> warnings() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace hiac::formats::vtk
