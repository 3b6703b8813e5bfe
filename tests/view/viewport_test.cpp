// The picture in the window: where its pixels are, and what mouse and wheel do to the camera.

#include "tools/view/viewport/viewport.hpp"

#include <QApplication>
#include <QMouseEvent>
#include <QSettings>
#include <QThread>
#include <QWheelEvent>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "hiac/scene/camera_motion.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/view/recorded_paint.hpp"

namespace hiac::view {
namespace {

using test::Drawn;
using test::RecordedPaint;

struct Moved {
  Camera camera;
  QString label;
  bool goes_on;
};

class ViewportTest : public ::testing::Test {
 protected:
  ViewportTest() {
    camera_.eye = {3, -7, 4};
    camera_.look_at = {0.5, 0.25, -0.125};
    camera_.up = {0.1, 0.2, 1};
    camera_.fov = 30;
    viewport_.set_camera(camera_);
    viewport_.resize(400, 300);
    viewport_.show();
    const auto note = [this](const char* name) {
      return [this, name](QPoint pixel) {
        told_ << QStringLiteral("%1 %2,%3").arg(QLatin1String(name)).arg(pixel.x()).arg(pixel.y());
      };
    };
    QObject::connect(&viewport_, &Viewport::pixel_chosen, &viewport_, note("pixel"));
    QObject::connect(&viewport_, &Viewport::centre_chosen, &viewport_, note("centre"));
    QObject::connect(&viewport_, &Viewport::bump_chosen, &viewport_, note("bump"));
    QObject::connect(&viewport_, &Viewport::camera_moved, &viewport_,
                     [this](const Camera& camera, const QString& label, bool goes_on) {
                       moved_.push_back({camera, label, goes_on});
                     });
    QObject::connect(&viewport_, &Viewport::hovered, &viewport_,
                     [this](std::optional<QPoint> pixel) { hovered_.push_back(pixel); });
  }

  void show(std::uint32_t width, std::uint32_t height) {
    auto picture = std::make_shared<Painted>();
    picture->size = {width, height};
    for (std::uint32_t k = 0; k < 3 * width * height; ++k)
      picture->bytes.push_back(static_cast<std::uint8_t>(k % 251));
    viewport_.show_picture(picture);
  }
  void mouse(QEvent::Type type, const QPointF& at, Qt::MouseButton button = Qt::LeftButton,
             Qt::KeyboardModifiers keys = Qt::NoModifier) {
    const bool is_move = type == QEvent::MouseMove, is_up = type == QEvent::MouseButtonRelease;
    QMouseEvent event(type, at, viewport_.mapToGlobal(at), is_move ? Qt::NoButton : button,
                      is_up ? Qt::NoButton : button, keys);
    QCoreApplication::sendEvent(&viewport_, &event);
  }
  void click(const QPointF& at, Qt::MouseButton button = Qt::LeftButton,
             Qt::KeyboardModifiers keys = Qt::NoModifier) {
    mouse(QEvent::MouseButtonPress, at, button, keys);
    mouse(QEvent::MouseButtonRelease, at, button, keys);
  }
  void wheel(int angle) {
    const QPointF at(200, 150);
    QWheelEvent event(at, viewport_.mapToGlobal(at), {}, {0, angle}, Qt::NoButton, Qt::NoModifier,
                      Qt::NoScrollPhase, false);
    QCoreApplication::sendEvent(&viewport_, &event);
  }
  void expect_moved(std::size_t index, const Camera& expected, const char* label, bool goes_on) {
    ASSERT_GT(moved_.size(), index);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(moved_[index].camera.eye[c], expected.eye[c], 1e-9) << label << " " << c;
      EXPECT_NEAR(moved_[index].camera.look_at[c], expected.look_at[c], 1e-9) << label;
      EXPECT_NEAR(moved_[index].camera.up[c], expected.up[c], 1e-9) << label;
    }
    EXPECT_NEAR(moved_[index].camera.fov, expected.fov, 1e-9);
    EXPECT_EQ(moved_[index].label, QLatin1String(label));
    EXPECT_EQ(moved_[index].goes_on, goes_on);
  }

  hiac::test::ScratchFolder folder_;
  QSettings settings_{QString::fromStdString(folder_.file("s.ini")), QSettings::IniFormat};
  QStringList faults_;
  Bindings bindings_{settings_, faults_};
  Viewport viewport_{bindings_};
  Camera camera_;
  QStringList told_;
  std::vector<Moved> moved_;
  std::vector<std::optional<QPoint>> hovered_;
};

TEST_F(ViewportTest, ShowsPicturesInTheMiddleAndShrinksLargeOnes) {
  struct Case {
    std::uint32_t width, height;
    double scale;
    QRectF place;
  };
  for (const Case& c : {Case{200, 100, 1, {100, 100, 200, 100}},
                        Case{201, 101, 1, {99, 99, 201, 101}},  // corners on whole pixels
                        Case{400, 300, 1, {0, 0, 400, 300}}, Case{800, 300, 0.5, {0, 75, 400, 150}},
                        Case{100, 600, 0.5, {175, 0, 50, 300}}}) {
    show(c.width, c.height);
    EXPECT_EQ(viewport_.scale(), c.scale) << c.width;
    const RecordedPaint paint(viewport_);
    const auto images = paint.of(Drawn::image);
    ASSERT_EQ(images.size(), 1U);
    EXPECT_EQ(images[0].box(), c.place) << c.width;
    const QPoint last(static_cast<int>(c.width) - 1, static_cast<int>(c.height) - 1);
    const QPointF first = c.place.topLeft(), end = c.place.bottomRight();
    EXPECT_EQ(viewport_.pixel_at(first), QPoint(0, 0));
    EXPECT_EQ(viewport_.pixel_at(end - QPointF(0.1, 0.1)), last);
    EXPECT_EQ(viewport_.pixel_at(first - QPointF(0.1, 0)), std::nullopt);
    EXPECT_EQ(viewport_.pixel_at(first - QPointF(0, 0.1)), std::nullopt);
    EXPECT_EQ(viewport_.pixel_at({end.x(), first.y()}), std::nullopt);
    EXPECT_EQ(viewport_.pixel_at({first.x(), end.y()}), std::nullopt);
    // the pixel (3, 7) is where that many pixels of it lie to the left and above
    EXPECT_EQ(viewport_.pixel_at(first + QPointF(3.5, 7.5) * c.scale), QPoint(3, 7));
  }
}

TEST_F(ViewportTest, ShowsATextInsteadOfAPicture) {
  show(200, 100);
  viewport_.show_text(QStringLiteral("nothing yet"));
  const RecordedPaint paint(viewport_);
  EXPECT_EQ(paint.words(), QStringList{QStringLiteral("nothing yet")});
  EXPECT_TRUE(paint.of(Drawn::image).empty());
  EXPECT_EQ(paint.all()[0].brush.color(), viewport_.palette().color(QPalette::Dark));
  EXPECT_EQ(paint.all()[1].pen.color(), viewport_.palette().color(QPalette::BrightText));
  EXPECT_TRUE(viewport_.image().isNull());
  EXPECT_EQ(viewport_.pixel_at({200, 150}), std::nullopt);
  EXPECT_EQ(viewport_.scale(), 1);
  click({200, 150});
  EXPECT_TRUE(told_.isEmpty());
  show(200, 100);
  EXPECT_TRUE(RecordedPaint(viewport_).words().isEmpty());
}

TEST_F(ViewportTest, MarksAPixelByACrossThatIsSeenOnAnything) {
  show(800, 300);
  EXPECT_TRUE(RecordedPaint(viewport_).of(Drawn::polygon).empty());
  viewport_.mark(QPoint(100, 50));
  const QPointF at(0 + 50.25, 75 + 25.25);  // half as large
  const auto lines = RecordedPaint(viewport_).of(Drawn::polygon);
  ASSERT_EQ(lines.size(), 8U);
  const QPointF ways[] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  for (std::size_t k = 0; k < 8; ++k) {
    EXPECT_EQ(lines[k].points, QPolygonF({at + 4 * ways[k % 4], at + 12 * ways[k % 4]})) << k;
    EXPECT_EQ(lines[k].pen.color(), QColor(k < 4 ? Qt::black : Qt::white));
    EXPECT_EQ(lines[k].pen.widthF(), k < 4 ? 3 : 1);
  }
  viewport_.mark(std::nullopt);
  EXPECT_TRUE(RecordedPaint(viewport_).of(Drawn::polygon).empty());
}

TEST_F(ViewportTest, TellsOfThePixelBelowTheMouse) {
  show(200, 100);
  mouse(QEvent::MouseMove, {103.5, 104.5}, Qt::NoButton);
  mouse(QEvent::MouseMove, {3, 4}, Qt::NoButton);
  QEvent leave(QEvent::Leave);
  QCoreApplication::sendEvent(&viewport_, &leave);
  EXPECT_EQ(hovered_, (std::vector<std::optional<QPoint>>{QPoint(3, 4), {}, {}}));
  EXPECT_TRUE(moved_.empty());
}

TEST_F(ViewportTest, ChoosesAPixelByAClick) {
  show(200, 100);
  const QPointF at(103.5, 104.5);
  click(at);
  click(at, Qt::LeftButton, Qt::AltModifier);
  click(at, Qt::LeftButton, Qt::ShiftModifier);
  click(at, Qt::RightButton);
  click({3, 4});
  EXPECT_EQ(told_, (QStringList{QStringLiteral("pixel 3,4"), QStringLiteral("bump 3,4")}));
  mouse(QEvent::MouseButtonDblClick, at);
  mouse(QEvent::MouseButtonRelease, at);  // is no click
  mouse(QEvent::MouseButtonDblClick, at, Qt::RightButton);
  mouse(QEvent::MouseButtonRelease, at, Qt::RightButton);
  EXPECT_EQ(told_.mid(2), QStringList{QStringLiteral("centre 3,4")});
  click(at);
  EXPECT_EQ(told_.size(), 4);
  EXPECT_TRUE(moved_.empty());
}

TEST_F(ViewportTest, MovesTheCameraByWhatTheMouseMovesInPicturesHeights) {
  show(200, 100);
  struct Case {
    Qt::MouseButton button;
    Qt::KeyboardModifier key;
    const char* label;
    std::function<Camera()> expected;  // of a move from (220, 130) by (30, -20)
  };
  const double before = std::atan2(150 - 130, 220 - 200), after = std::atan2(150 - 110, 250 - 200);
  const Case cases[] = {
      {Qt::LeftButton, Qt::NoModifier, "turn", [&] { return orbited(camera_, 54, -36); }},
      {Qt::LeftButton, Qt::ShiftModifier, "pan", [&] { return panned(camera_, 0.3, 0.2); }},
      {Qt::RightButton, Qt::NoModifier, "zoom", [&] { return zoomed(camera_, std::pow(4, 0.2)); }},
      {Qt::LeftButton, Qt::ControlModifier, "roll",
       [&] { return rolled(camera_, (after - before) * 180 / std::acos(-1.0)); }}};
  for (const Case& c : cases) {
    moved_.clear();
    mouse(QEvent::MouseButtonPress, {220, 130}, c.button, c.key);
    mouse(QEvent::MouseMove, {250, 110}, c.button, c.key);
    mouse(QEvent::MouseMove, {252, 110}, c.button, c.key);  // goes on, however short
    mouse(QEvent::MouseButtonRelease, {252, 110}, c.button, c.key);
    mouse(QEvent::MouseMove, {300, 200}, Qt::NoButton);
    ASSERT_EQ(moved_.size(), 2U) << c.label;
    expect_moved(0, c.expected(), c.label, false);
    EXPECT_TRUE(moved_[1].goes_on);
  }
  EXPECT_TRUE(told_.isEmpty());  // none of these is a click
  // the second move begins where the first one ended
  moved_.clear();
  mouse(QEvent::MouseButtonPress, {220, 130});
  mouse(QEvent::MouseMove, {250, 110});
  mouse(QEvent::MouseMove, {260, 130});
  expect_moved(1, orbited(camera_, 18, 36), "turn", true);
  mouse(QEvent::MouseButtonRelease, {260, 130});
  // another gesture is another edit
  mouse(QEvent::MouseButtonPress, {220, 130});
  mouse(QEvent::MouseMove, {250, 110});
  expect_moved(2, orbited(camera_, 54, -36), "turn", false);
}

TEST_F(ViewportTest, TakesAShortMoveForAClick) {
  show(200, 100);
  const int least = QApplication::startDragDistance();
  mouse(QEvent::MouseButtonPress, {220, 130});
  mouse(QEvent::MouseMove, {220.0 + least - 1, 130});
  EXPECT_TRUE(moved_.empty());
  mouse(QEvent::MouseButtonRelease, {220.0 + least - 1, 130});
  EXPECT_EQ(told_.size(), 1);
  mouse(QEvent::MouseButtonPress, {220, 130});
  mouse(QEvent::MouseMove, {220.0 + least, 130});
  EXPECT_EQ(moved_.size(), 1U);
  mouse(QEvent::MouseButtonRelease, {220.0 + least, 130});
  EXPECT_EQ(told_.size(), 1);
}

TEST_F(ViewportTest, MovesByTheWidgetsHeightWhereThereIsNoPicture) {
  mouse(QEvent::MouseButtonPress, {220, 130});
  mouse(QEvent::MouseMove, {250, 70});
  expect_moved(0, orbited(camera_, 18, -36), "turn", false);
  mouse(QEvent::MouseButtonRelease, {250, 70});
  viewport_.set_camera(std::nullopt);
  mouse(QEvent::MouseButtonPress, {220, 130});
  mouse(QEvent::MouseMove, {250, 70});
  wheel(120);
  EXPECT_EQ(moved_.size(), 1U);
}

TEST_F(ViewportTest, ZoomsByATenthANotch) {
  wheel(120);
  wheel(-240);
  wheel(0);
  ASSERT_EQ(moved_.size(), 2U);
  expect_moved(0, zoomed(camera_, 1.1), "zoom", false);
  expect_moved(1, zoomed(camera_, 1 / 1.21), "zoom", true);  // at once: the same gesture
  QThread::msleep(520);
  wheel(120);
  expect_moved(2, zoomed(camera_, 1.1), "zoom", false);
}

}  // namespace
}  // namespace hiac::view
