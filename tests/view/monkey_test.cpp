// Random events, as a monkey at mouse and keyboard makes them: the window neither crashes nor does
// it save a file that is wrong. HIAC_MONKEY_EVENTS says how many there are.

#include <QAction>
#include <QApplication>
#include <QDockWidget>
#include <QTest>
#include <QTimer>
#include <QWheelEvent>
#include <array>
#include <cstdlib>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "hiac/scene/specification.hpp"
#include "tests/view/open_window.hpp"

namespace hiac::view::test {
namespace {

const std::string kSample = std::string(HIAC_SOURCE_DIR) + "/samples/reactor-pool/flow.vtu";

int events() {
  const char* const given = std::getenv("HIAC_MONKEY_EVENTS");
  return given != nullptr ? std::atoi(given) : hiac::test::kInstrumented ? 200 : 500;
}

class Monkey {
 public:
  Monkey(OpenWindow& window, std::uint64_t seed) : window_(window), random_(seed) {}

  void act() {
    Viewport& viewport = window_->viewport();
    switch (below(12)) {
      case 0:
      case 1:
        return press(viewport);
      case 2:
      case 3:
      case 4:
        return move(viewport);
      case 5:
        return QTest::mouseRelease(&viewport, button_, {}, place(viewport));
      case 6:
        return QTest::mouseDClick(&viewport, Qt::LeftButton, {}, place(viewport));
      case 7:
        return wheel(viewport);
      case 8:
      case 9:
        return action();
      case 10:
        return child();
      default:
        return QCoreApplication::processEvents(QEventLoop::AllEvents, 30);
    }
  }

 private:
  int below(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }
  QPoint place(const QWidget& widget) { return {below(widget.width()), below(widget.height())}; }

  void press(Viewport& viewport) {
    constexpr std::array kButtons{Qt::LeftButton, Qt::MiddleButton, Qt::RightButton};
    constexpr std::array<Qt::KeyboardModifier, 3> kModifiers{Qt::NoModifier, Qt::ShiftModifier,
                                                             Qt::ControlModifier};
    button_ = kButtons[static_cast<std::size_t>(below(3))];
    QTest::mousePress(&viewport, button_, kModifiers[static_cast<std::size_t>(below(3))],
                      place(viewport));
  }

  void move(Viewport& viewport) {
    const QPointF at = place(viewport);
    QMouseEvent event(QEvent::MouseMove, at, viewport.mapToGlobal(at), Qt::NoButton, button_, {});
    QCoreApplication::sendEvent(&viewport, &event);
  }

  void wheel(Viewport& viewport) {
    const QPointF at = place(viewport);
    QWheelEvent event(at, viewport.mapToGlobal(at), {}, {0, 120 * (below(7) - 3)}, Qt::NoButton, {},
                      Qt::NoScrollPhase, false);
    QCoreApplication::sendEvent(&viewport, &event);
  }

  // Every action that asks nothing of the user, and does not end the window.
  void action() {
    constexpr std::array kNames{"undo",
                                "redo",
                                "reset",
                                "axis_views",
                                "projection",
                                "color_bar",
                                "fit_window",
                                "play",
                                "record_keyframe",
                                "copy_command",
                                "help",
                                "look_from_plus_x",
                                "look_from_minus_z",
                                "explain_pixel"};
    const char* const name = kNames[static_cast<std::size_t>(below(kNames.size()))];
    auto* action = window_->findChild<QAction*>(QLatin1String(name));
    ASSERT_NE(action, nullptr) << name;
    action->trigger();
  }

  // A key, or a click, into any widget of the docks.
  void child() {
    QList<QWidget*> shown;
    for (QDockWidget* dock : window_->findChildren<QDockWidget*>())
      for (QWidget* widget : dock->findChildren<QWidget*>())
        if (widget->isVisible() && widget->isEnabled() && widget->width() > 0 &&
            widget->height() > 0)
          shown << widget;
    if (shown.isEmpty()) return;
    QWidget* widget = shown[below(static_cast<int>(shown.size()))];
    constexpr std::array kKeys{Qt::Key_Up,        Qt::Key_Down, Qt::Key_Left,
                               Qt::Key_Right,     Qt::Key_Tab,  Qt::Key_5,
                               Qt::Key_Backspace, Qt::Key_Home, Qt::Key_End};
    if (below(2) == 0)
      QTest::mouseClick(widget, Qt::LeftButton, {}, place(*widget));
    else
      QTest::keyClick(widget, kKeys[static_cast<std::size_t>(below(kKeys.size()))]);
  }

  OpenWindow& window_;
  std::mt19937_64 random_;
  Qt::MouseButton button_ = Qt::LeftButton;
};

TEST(Monkey, NeitherCrashesTheWindowNorSpoilsAFile) {
  OpenWindow window;
  ASSERT_TRUE(window.open(kSample));
  window->view().set_size({120, 90});
  Monkey monkey(window, 2026);
  // a dialog that a button opens waits for an answer: the monkey's is to close it
  QTimer dismissal;
  QObject::connect(&dismissal, &QTimer::timeout, [] {
    if (QWidget* dialog = QApplication::activeModalWidget()) dialog->close();
  });
  dismissal.start(20);
  const std::string saved = window.file("monkey.toml");
  const int count = events();
  for (int event = 0; event < count; ++event) {
    monkey.act();
    if (window->document().scene().image.width > 400) window->view().set_size({120, 90});
    if (event % 50 != 49) continue;
    ASSERT_TRUE(window->files().save_to(QString::fromStdString(saved)));
    EXPECT_EQ(hiac::test::bytes_of(saved), window->document().text());
    EXPECT_NO_THROW(read_scene(saved)) << "event " << event;
    EXPECT_EQ(with_field_ranges(read_scene(saved), *window->document().mesh()).scene,
              window->document().scene());
  }
  window->document().undo_stack().clear();
}

}  // namespace
}  // namespace hiac::view::test
