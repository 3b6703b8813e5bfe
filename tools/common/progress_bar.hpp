#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

#include "hiac/base/progress.hpp"

namespace hiac::tools {

/// What there is to be told of a run's progress: how many of its frames are done (total 0: it has
/// none), and how far the present stage is.
struct Shown {
  Progress::State frames, stage;
};

/// A short text: "frame 13 of 36, tiles 45 %, about 2 min 10 s left", "adjacency, 7 s".
std::string progress_text(const Shown& shown);

/// The same for a terminal, with a bar when the remaining work is known: one line of at most
/// `columns` characters.
std::string progress_line(const std::string& tool, const Shown& shown, std::size_t columns);

/// Shows on stderr how far a run is, from a second after its start until it is destroyed: on a
/// terminal in a line that is drawn again and again and leaves no trace, else in a log line every
/// ten seconds. It asks by itself; the work is not held up.
class ProgressBar {
 public:
  /// Both have to outlive the bar.
  ProgressBar(std::string tool, const Progress& frames, const Progress& stage);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Writes text to stderr where the bar is not in its way.
  void print(std::string_view text);

 private:
  void show_until_stopped();
  void draw();
  void erase();

  std::string tool_;
  const Progress& frames_;
  const Progress& stage_;
  bool terminal_;
  bool drawn_ = false;
  bool stopped_ = false;
  std::mutex mutex_;
  std::condition_variable stop_;
  std::thread thread_;
};

}  // namespace hiac::tools
