// What changes the look of a widget has it painted again.

#include <QCoreApplication>
#include <QMouseEvent>
#include <QSettings>
#include <QWheelEvent>
#include <functional>

#include <gtest/gtest.h>

#include "hiac/scene/toml/edited_text.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/view/open_window.hpp"
#include "tests/view/small_view.hpp"
#include "tools/view/pixel/depth_curve.hpp"
#include "tools/view/transfer/transfer_curve.hpp"
#include "tools/view/viewport/viewport.hpp"

namespace hiac::view {
namespace {

/// Counts how often a widget is painted.
class Paints : public QObject {
 public:
  explicit Paints(QWidget& widget) : widget_(widget) {
    widget.resize(400, 300);
    widget.show();
    widget.installEventFilter(this);
    EXPECT_TRUE(test::wait_until([&] { return count_ > 0; }));
  }
  /// Whether an action leads to the widget being painted.
  bool after(const std::function<void()>& action) {
    for (int k = 0; k < 3; ++k) QCoreApplication::processEvents();
    count_ = 0;
    action();
    for (int k = 0; k < 3; ++k) QCoreApplication::processEvents();
    return count_ > 0;
  }
  bool after_mouse(QEvent::Type type, const QPointF& at, Qt::MouseButton button) {
    return after([&] {
      QMouseEvent event(type, at, widget_.mapToGlobal(at), button, button, Qt::NoModifier);
      QCoreApplication::sendEvent(&widget_, &event);
    });
  }

 protected:
  bool eventFilter(QObject* /*watched*/, QEvent* event) override {
    if (event->type() == QEvent::Paint) ++count_;
    return false;
  }

 private:
  QWidget& widget_;
  int count_ = 0;
};

const std::string kRepaintedView = test::kSmallView + R"([volume.extinction]
field = "f"
points = [[0.0, 0.5], [1.0, 8.0]]
)";

TEST(Repaint, FollowsWhatIsSeenOfTransferFunctions) {
  Document document;
  TransferCurve curve(document);
  Paints paints(curve);
  EXPECT_FALSE(paints.after([] {}));
  EXPECT_TRUE(paints.after([&] { document.open_text(kRepaintedView, "", ""); }));
  EXPECT_TRUE(paints.after([&] { curve.show_field("f", {0, 1}); }));
  EXPECT_TRUE(paints.after([&] {
    curve.show_histogram(
        std::make_shared<const VolumeHistogram>(VolumeHistogram{{0, 1}, {1}, {}, 0}));
  }));
  EXPECT_TRUE(paints.after([&] { curve.set_log_counts(true); }));
  EXPECT_TRUE(paints.after([&] { curve.set_log_values(true); }));
  EXPECT_TRUE(paints.after([&] { curve.show_all_values(); }));
  EXPECT_TRUE(paints.after([&] {
    document.edit(QStringLiteral("set"),
                  with_key(document.text(), "volume.extinction.points.0.1", "0.75"));
  }));
  EXPECT_TRUE(paints.after([&] { curve.choose(ChosenHandle{Handle::extinction, 1}); }));
  EXPECT_FALSE(paints.after([&] { curve.choose(ChosenHandle{Handle::extinction, 1}); }));
  EXPECT_TRUE(paints.after_mouse(QEvent::MouseMove, {200, 100}, Qt::NoButton));
  EXPECT_TRUE(paints.after_mouse(QEvent::MouseButtonRelease, {200, 100}, Qt::LeftButton));
  EXPECT_TRUE(paints.after([&] {
    QEvent leave(QEvent::Leave);
    QCoreApplication::sendEvent(&curve, &leave);
  }));
  EXPECT_TRUE(paints.after([&] {
    QWheelEvent event(QPointF(200, 100), QPointF(200, 100), {}, {0, 120}, Qt::NoButton,
                      Qt::NoModifier, Qt::NoScrollPhase, false);
    QCoreApplication::sendEvent(&curve, &event);
  }));
}

TEST(Repaint, FollowsThePixelThatIsExplained) {
  DepthCurve curve;
  Paints paints(curve);
  EXPECT_TRUE(paints.after([&] { curve.show_pixel(nullptr); }));
}

TEST(Repaint, FollowsThePictureItsTextAndItsMark) {
  const hiac::test::ScratchFolder folder;
  QSettings settings(QString::fromStdString(folder.file("s.ini")), QSettings::IniFormat);
  QStringList faults;
  const Bindings bindings(settings, faults);
  Viewport viewport(bindings);
  Paints paints(viewport);
  EXPECT_TRUE(paints.after([&] { viewport.show_text(QStringLiteral("none")); }));
  auto picture = std::make_shared<Painted>();
  picture->size = {4, 3};
  picture->bytes.resize(36);
  EXPECT_TRUE(paints.after([&] { viewport.show_picture(picture); }));
  EXPECT_TRUE(paints.after([&] { viewport.mark(QPoint(1, 1)); }));
}

}  // namespace
}  // namespace hiac::view
