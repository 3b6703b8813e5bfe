#include "tools/common/progress_bar.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "hiac/base/process/side_thread.hpp"

namespace hiac::tools {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kFirst{1000}, kRedraw{100}, kBetweenLines{10000};

// stderr shows a line that is drawn again in its place
bool draws_in_place() {
  const char* kind = std::getenv("TERM");
  return isatty(STDERR_FILENO) != 0 && kind != nullptr && std::string_view(kind) != "dumb";
}

std::size_t terminal_columns() {
  struct winsize size {};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : 80;
}

// How much is done, of frames where there are any; none where nobody knows.
std::optional<double> fraction(const Shown& shown) {
  const Progress::State& of = shown.frames.total > 0 ? shown.frames : shown.stage;
  if (of.total == 0) return std::nullopt;
  return static_cast<double>(of.done) / static_cast<double>(of.total);
}

std::optional<double> left(const Progress::State& state) {
  return seconds_left(static_cast<double>(state.done), static_cast<double>(state.total),
                      state.seconds);
}

}  // namespace

std::string progress_text(const Shown& shown) {
  const auto& [frames, stage] = shown;
  std::string text;
  if (frames.total > 0)
    text = fmt::format("{} {} of {}, ", frames.stage == "steps" ? "step" : "frame",
                       std::min(frames.done + 1, frames.total), frames.total);
  text += stage.stage;
  if (stage.total > 0)
    text += fmt::format(" {:.0f} %", std::floor(100 * static_cast<double>(stage.done) /
                                                static_cast<double>(stage.total)));
  const std::optional<double> rest = left(frames.total > 0 ? frames : stage);
  if (rest) return text + fmt::format(", about {} left", duration_text(*rest));
  return text + fmt::format(", {}", duration_text(stage.seconds));
}

std::string progress_line(const std::string& tool, const Shown& shown, std::size_t columns) {
  constexpr std::size_t kBar = 20;
  std::string line = tool + ": ";
  if (const auto done = fraction(shown)) {
    const auto full = static_cast<std::size_t>(*done * kBar);
    line += '[' + std::string(full, '#') + std::string(kBar - full, '.') + "] ";
  }
  line += progress_text(shown);
  return line.substr(0, columns);
}

ProgressBar::ProgressBar(std::string tool, const Progress& frames, const Progress& stage)
    : tool_(std::move(tool)),
      frames_(frames),
      stage_(stage),
      terminal_(draws_in_place()),
      thread_(start_side_thread([this] { show_until_stopped(); })) {}

ProgressBar::~ProgressBar() {
  {
    const std::scoped_lock lock(mutex_);
    stopped_ = true;
    erase();
  }
  stop_.notify_all();
  thread_.join();
}

void ProgressBar::print(std::string_view text) {
  const std::scoped_lock lock(mutex_);
  erase();
  std::cerr << text << std::flush;
}

void ProgressBar::show_until_stopped() {
  std::unique_lock lock(mutex_);
  milliseconds wait = terminal_ ? kFirst : kBetweenLines;
  while (!stop_.wait_for(lock, wait, [this] { return stopped_; })) {
    draw();
    if (terminal_) wait = kRedraw;
  }
}

void ProgressBar::draw() {
  const auto held = keep_from_forking();  // a text is made, and a stream written to
  const Shown shown{frames_.state(), stage_.state()};
  if (shown.stage.stage.empty()) return;
  if (!terminal_) {
    std::cerr << tool_ << ": " << progress_text(shown) << '\n' << std::flush;
    return;
  }
  erase();
  // the last column stays free: a terminal may go on to the next line behind it
  std::cerr << progress_line(tool_, shown, terminal_columns() - 1) << std::flush;
  drawn_ = true;
}

// Back to the line's begin, and all behind it away (ECMA-48: EL).
void ProgressBar::erase() {
  if (drawn_) std::cerr << "\r\x1b[K" << std::flush;
  drawn_ = false;
}

}  // namespace hiac::tools
