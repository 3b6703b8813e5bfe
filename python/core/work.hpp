#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include <pybind11/pybind11.h>

#include "hiac/base/progress.hpp"

namespace hiac::python {

namespace py = pybind11;

/// How one piece of work is watched and stopped.
struct Watch {
  Progress progress;
  Cancellation cancellation;
};

/// What the caller wants to be told, and how it may stop the work.
struct Listener {
  /// None, or called about ten times a second as progress(stage, done, total), total 0 where it is
  /// unknown; an exception stops the work and is passed on.
  py::object progress;
  /// May be null. Another thread requests it.
  std::shared_ptr<const Cancellation> cancellation;
};

/// Runs work on a thread of its own, without the GIL, which the caller holds; returns when it has
/// ended. Meanwhile a pending signal of Python's (Ctrl-C) is looked for every 20 ms, if this is
/// the main thread: its exception stops the work, and is thrown when the work has ended. Throws
/// what the work throws. The watch may be used again.
void run_watched(Watch& watch, const Listener& listener, const std::function<void()>& work);

/// The same for work that returns something.
template <typename Work>
auto result_of(Watch& watch, const Listener& listener, Work&& work) {
  std::optional<decltype(work())> result;
  run_watched(watch, listener, [&] { result.emplace(std::forward<Work>(work)()); });
  return std::move(*result);
}

void bind_work(py::module_& module);

}  // namespace hiac::python
