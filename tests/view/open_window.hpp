#pragma once

#include <QCoreApplication>
#include <QElapsedTimer>
#include <QSettings>
#include <QThread>
#include <functional>
#include <string>

#include "tests/support/instrumented.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/view/window/main_window.hpp"

namespace hiac::view::test {

/// Lets a window work until something is true. Returns false if that takes too long.
inline bool wait_until(const std::function<bool()>& done) {
  constexpr qint64 kMost = hiac::test::kInstrumented ? 600000 : 200000;  // milliseconds
  QElapsedTimer clock;
  clock.start();
  while (!done()) {
    if (clock.elapsed() > kMost) return false;
    QCoreApplication::processEvents(QEventLoop::AllEvents, 10);
    QThread::msleep(1);
  }
  return true;
}

/// A window with settings of its own.
class OpenWindow {
 public:
  OpenWindow() {
    window_.resize(900, 700);
    window_.show();
  }

  MainWindow* operator->() { return &window_; }
  MainWindow& operator*() { return window_; }

  /// Opens a mesh, and a specification if one is given; returns when its picture is complete.
  bool open(const std::string& mesh, const std::string& view = "") {
    tools::PictureCommand command;
    command.input = mesh;
    command.view = view;
    window_.files().open(command);
    return wait_until([&] { return !window_.files().is_busy(); }) && rest();
  }

  /// Waits for the complete picture. Returns false if there is none.
  bool rest() {
    return wait_until([&] { return window_.is_at_rest(); }) && window_.picture() != nullptr;
  }

  [[nodiscard]] std::string file(const std::string& name) const { return folder_.file(name); }

  [[nodiscard]] std::string write(const std::string& name, const std::string& text) const {
    return folder_.write(name, text);
  }

 private:
  hiac::test::ScratchFolder folder_;
  tools::Tool tool_{"hiac-view", "", ""};
  QSettings settings_{QString::fromStdString(folder_.file("settings.ini")), QSettings::IniFormat};
  MainWindow window_{tool_, settings_};
};

}  // namespace hiac::view::test
