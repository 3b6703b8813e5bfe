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
/// ended. Throws what the work throws. Meanwhile a pending signal of Python's (Ctrl-C) is looked
/// for every 20 ms, if this is the main thread.
///
/// Where a signal, the listener's progress or its cancellation stops the work, this throws at once:
/// the work is asked to end, and does so in the background. So it owns whatever it uses, and
/// nothing of that is Python's. The watch may be used again when the work has ended.
void run_watched(std::shared_ptr<Watch> watch, const Listener& listener,
                 std::function<void()> work);

/// The same for work that returns something and has a new watch: it is called with the watch.
template <typename Work>
auto result_of(const Listener& listener, Work work) {
  const auto watch = std::make_shared<Watch>();
  const auto result = std::make_shared<std::optional<decltype(work(*watch))>>();
  run_watched(watch, listener,
              [watch, result, work = std::move(work)] { result->emplace(work(*watch)); });
  return std::move(**result);
}

void bind_work(py::module_& module);

}  // namespace hiac::python
