#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hiac/base/error.hpp"

namespace hiac::preview {

/// The graphics driver is missing, too small, or failed: exit code 4.
class DriverError : public Error {
 public:
  explicit DriverError(const std::string& message) : Error(ExitCode::internal, message) {}
};

/// A way to an OpenGL 4.5 context without a window.
struct Device {
  std::string name;      ///< GL_RENDERER: "llvmpipe (LLVM 15.0.6, 256 bits)", "NVIDIA H100 ..."
  std::string platform;  ///< how EGL reaches it: "device 0", "surfaceless"
};

/// The devices that give an OpenGL 4.5 context, in the order in which they are tried: EGL's device
/// platform, hardware before software, then Mesa's surfaceless platform. Needs no display server.
/// Afterwards no context is current in this thread.
std::vector<Device> list_devices();

/// What a driver allows.
struct Limits {
  std::uint32_t picture_side = 0;         ///< pixels of a target's side
  std::uint64_t storage_block_bytes = 0;  ///< of one shader storage buffer
};

/// An OpenGL 4.5 context. It is current in the thread that makes it as long as it lives; a thread
/// can have one at a time.
class Context {
 public:
  /// `wanted`: empty (the first device that works), a number of list_devices(), or a part of a
  /// device's name (case does not matter). Throws DriverError of one line that says what was tried
  /// and which package helps; UsageError, which names the devices, when `wanted` is none of them.
  explicit Context(const std::string& wanted = "");
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  [[nodiscard]] const Device& device() const;
  [[nodiscard]] const Limits& limits() const;

  /// Throws DriverError("NAME: ... while WORK") when a call failed, memory ran out or the context
  /// was lost since the last check. Waits for nothing.
  void check(const std::string& work) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace hiac::preview
