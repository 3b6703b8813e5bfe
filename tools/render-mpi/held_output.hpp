#pragma once

namespace hiac::tools {

/// Holds back what the process writes to stdout, for good, and to stderr.
class HeldOutput {
 public:
  HeldOutput();
  ~HeldOutput();
  HeldOutput(const HeldOutput&) = delete;
  HeldOutput& operator=(const HeldOutput&) = delete;

  /// Waits, so that a process that meets the same error may tell it and end all; then writes what
  /// went to stderr.
  void tell_after_a_while();

 private:
  int stderr_, held_;
};

}  // namespace hiac::tools
