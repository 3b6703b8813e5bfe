#include "python/core/work.hpp"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

#include "hiac/base/cancellation.hpp"
#include "hiac/base/process/side_thread.hpp"

namespace hiac::python {
namespace {

using namespace std::chrono_literals;
constexpr auto kSignalPause = 20ms;
constexpr int kPausesPerReport = 5;

// The end of work on another thread.
class Ending {
 public:
  void announce() {
    const std::lock_guard lock(mutex_);
    done_ = true;
    changed_.notify_all();
  }
  // Whether it has come within the time.
  template <typename Duration>
  bool wait_for(Duration time) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, time, [&] { return done_; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool done_ = false;
};

bool is_main_thread() {
  const py::module_ threading = py::module_::import("threading");
  return threading.attr("current_thread")().is(threading.attr("main_thread")());
}

void report(const Watch& watch, const py::object& progress) {
  if (progress.is_none()) return;
  const Progress::State state = watch.progress.state();
  if (!state.stage.empty()) progress(state.stage, state.done, state.total);
}

// Looks at signals, tells of the progress, and passes a request to stop on, until the work ends.
// Returns what Python threw meanwhile. Is called without the GIL.
std::exception_ptr attend(Watch& watch, const Listener& listener, bool hears_signals,
                          Ending& ending) {
  std::exception_ptr thrown;
  for (int pauses = 1; !ending.wait_for(kSignalPause); ++pauses) {
    if (listener.cancellation && listener.cancellation->requested()) watch.cancellation.request();
    const bool reports = !listener.progress.is_none() && pauses % kPausesPerReport == 0;
    if (thrown || !(hears_signals || reports)) continue;
    const py::gil_scoped_acquire held;
    try {
      if (hears_signals && PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (reports) report(watch, listener.progress);
    } catch (...) {
      thrown = std::current_exception();
      watch.cancellation.request();
    }
  }
  return thrown;
}

}  // namespace

void run_watched(Watch& watch, const Listener& listener, const std::function<void()>& work) {
  watch.cancellation.reset();
  if (listener.cancellation && listener.cancellation->requested()) throw Cancelled();
  const bool hears_signals = is_main_thread();
  std::exception_ptr failure, thrown;
  {
    const py::gil_scoped_release released;
    Ending ending;
    std::thread thread = start_side_thread([&] {
      const CancellationScope scope(&watch.cancellation);
      try {
        work();
      } catch (...) {
        failure = std::current_exception();
      }
      ending.announce();
    });
    thrown = attend(watch, listener, hears_signals, ending);
    thread.join();
  }
  if (thrown) std::rethrow_exception(thrown);
  if (failure) std::rethrow_exception(failure);
  report(watch, listener.progress);
}

void bind_work(py::module_& module) {
  py::class_<Cancellation, std::shared_ptr<Cancellation>>(
      module, "Cancellation",
      "A request to stop work, which any thread may make: pass it as cancel=, call request().")
      .def(py::init<>())
      .def("request", &Cancellation::request,
           "Stops the work that has this object: it ends by raising hiac.Cancelled.")
      .def_property_readonly("requested", &Cancellation::requested, "Whether that was requested.")
      .def("reset", &Cancellation::reset, "Withdraws the request.");
}

}  // namespace hiac::python
