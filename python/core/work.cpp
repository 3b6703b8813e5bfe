#include "python/core/work.hpp"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "hiac/base/cancellation.hpp"
#include "hiac/base/process/side_thread.hpp"

namespace hiac::python {
namespace {

using namespace std::chrono_literals;
constexpr auto kSignalPause = 20ms;
constexpr int kPausesPerReport = 5;

// Work on a thread, which owns it together with its caller.
class Job {
 public:
  Job(std::shared_ptr<Watch> watch, std::function<void()> work)
      : watch_(std::move(watch)), work_(std::move(work)) {}

  [[nodiscard]] Watch& watch() { return *watch_; }

  void run() {
    const CancellationScope scope(&watch_->cancellation);
    std::exception_ptr failure;
    try {
      work_();
    } catch (...) {
      failure = std::current_exception();
    }
    work_ = {};  // what it owned is freed by this thread
    const std::lock_guard lock(mutex_);
    failure_ = failure;
    done_ = true;
    changed_.notify_all();
  }

  // Whether the end has come within the time.
  template <typename Duration>
  bool wait_for(Duration time) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, time, [&] { return done_; });
  }

  // Throws what the work has thrown.
  void rethrow() {
    const std::lock_guard lock(mutex_);
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::shared_ptr<Watch> watch_;
  std::function<void()> work_;
  std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  bool done_ = false;
  std::exception_ptr failure_;
};

// The threads whose work goes on ending although nobody waits for it.
class EndingThreads {
 public:
  void add(std::thread thread, std::shared_ptr<Job> job) {
    const std::lock_guard lock(mutex_);
    std::erase_if(threads_, [](Ending& ending) {
      if (!ending.job->wait_for(0s)) return false;
      ending.thread.join();
      return true;
    });
    threads_.push_back({std::move(thread), std::move(job)});
  }
  void join() {
    const std::lock_guard lock(mutex_);
    for (Ending& ending : threads_) ending.thread.join();
    threads_.clear();
  }

 private:
  struct Ending {
    std::thread thread;
    std::shared_ptr<Job> job;
  };
  std::mutex mutex_;
  std::vector<Ending> threads_;
};

EndingThreads& ending_threads() {
  static EndingThreads threads;
  return threads;
}

bool is_main_thread() {
  const py::module_ threading = py::module_::import("threading");
  return threading.attr("current_thread")().is(threading.attr("main_thread")());
}

void report(const Watch& watch, const py::object& progress) {
  if (progress.is_none()) return;
  const Progress::State state = watch.progress.state();
  if (!state.stage.empty()) progress(state.stage, state.done, state.total);
}

// Looks at signals, tells of the progress, and hears requests to stop, until the work ends. Throws
// what stops it. Is called without the GIL.
void attend(Job& job, const Listener& listener, bool hears_signals) {
  for (int pauses = 1; !job.wait_for(kSignalPause); ++pauses) {
    if (listener.cancellation && listener.cancellation->requested()) throw Cancelled();
    const bool reports = !listener.progress.is_none() && pauses % kPausesPerReport == 0;
    if (!hears_signals && !reports) continue;
    const py::gil_scoped_acquire held;
    if (hears_signals && PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (reports) report(job.watch(), listener.progress);
  }
}

}  // namespace

void run_watched(std::shared_ptr<Watch> watch, const Listener& listener,
                 std::function<void()> work) {
  watch->cancellation.reset();
  if (listener.cancellation && listener.cancellation->requested()) throw Cancelled();
  const bool hears_signals = is_main_thread();
  const auto job = std::make_shared<Job>(std::move(watch), std::move(work));
  {
    const py::gil_scoped_release released;
    std::thread thread = start_side_thread([job] { job->run(); });
    try {
      attend(*job, listener, hears_signals);
    } catch (...) {
      job->watch().cancellation.request();
      ending_threads().add(std::move(thread), job);
      throw;
    }
    thread.join();
  }
  job->rethrow();
  report(job->watch(), listener.progress);
}

void bind_work(py::module_& module) {
  py::module_::import("atexit").attr("register")(
      py::cpp_function([] { ending_threads().join(); }, py::call_guard<py::gil_scoped_release>()));
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
