// The plot of the transfer functions under the mouse and the keys.

#include "tools/view/transfer/transfer_curve.hpp"

#include <QAction>
#include <QApplication>
#include <QContextMenuEvent>
#include <QMenu>
#include <QTest>
#include <QTimer>
#include <QWheelEvent>
#include <cmath>

#include <gtest/gtest.h>

#include "hiac/scene/toml/edited_text.hpp"
#include "tests/view/small_view.hpp"

namespace hiac::view {
namespace {

const std::string kCurveView = test::kSmallView + R"([volume.color]
field = "f"
points = [[0.125, 0.0, 0.0, 1.0], [0.875, 1.0, 0.5, 0.0]]
[volume.extinction]
field = "f"
points = [[0.0, 0.5], [0.5, 2.0], [1.0, 8.0]]
[[isosurface]]
field = "f"
value = 0.25
)";

class TransferCurveTest : public ::testing::Test {
 protected:
  TransferCurveTest() {
    QObject::connect(&document_, &Document::message, &curve_,
                     [this](const QString& line) { messages_ << line; });
    QObject::connect(&curve_, &TransferCurve::handle_chosen, &curve_, [this] { ++choices_; });
    QObject::connect(&curve_, &TransferCurve::values_shown, &curve_, [this] { ++axes_shown_; });
    QObject::connect(&curve_, &TransferCurve::color_wanted, &curve_,
                     [this](const ChosenHandle& handle) { wanted_.push_back(handle); });
    curve_.resize(464, 320);
    curve_.show();
    EXPECT_TRUE(document_.open_text(kCurveView, "", ""));
    curve_.show_field("f", {0, 1});
    choices_ = axes_shown_ = 0;
  }

  bool set(const std::string& text) { return document_.edit(QStringLiteral("set"), text); }
  [[nodiscard]] const Volume& volume() const { return document_.scene().volume; }
  [[nodiscard]] std::array<double, 2> point(std::size_t k) const {
    const auto& found = volume().extinction->points.at(k);
    return {found.scalar, found.value[0]};
  }
  [[nodiscard]] QPointF at(Handle kind, std::size_t index) const {
    const Place place = curve_.place_of({kind, index}).value();
    return {place.x, place.y};
  }
  void mouse(QEvent::Type type, const QPointF& place, Qt::MouseButton button = Qt::LeftButton,
             Qt::KeyboardModifiers keys = Qt::NoModifier) {
    const bool is_move = type == QEvent::MouseMove;
    QMouseEvent event(type, place, curve_.mapToGlobal(place), is_move ? Qt::NoButton : button,
                      type == QEvent::MouseButtonRelease ? Qt::NoButton : button, keys);
    QCoreApplication::sendEvent(&curve_, &event);
  }
  void drag(const QPointF& from, const QPointF& by, Qt::KeyboardModifiers keys = Qt::NoModifier) {
    mouse(QEvent::MouseButtonPress, from);
    mouse(QEvent::MouseMove, from + by, Qt::LeftButton, keys);
    mouse(QEvent::MouseButtonRelease, from + by);
  }
  void double_click(const QPointF& place, Qt::MouseButton button = Qt::LeftButton) {
    mouse(QEvent::MouseButtonDblClick, place, button);
  }
  void wheel(double x, int notches) {
    const QPointF place(x, 100);
    QWheelEvent event(place, curve_.mapToGlobal(place), {}, {0, 120 * notches}, Qt::NoButton,
                      Qt::NoModifier, Qt::NoScrollPhase, false);
    QCoreApplication::sendEvent(&curve_, &event);
  }
  /// The entries of the menu at a place; the one that begins with `choice` is chosen.
  QStringList menu(const QPointF& place, const QString& choice = {}) {
    QStringList entries;
    QTimer::singleShot(0, &curve_, [&] {
      auto* shown = qobject_cast<QMenu*>(QApplication::activePopupWidget());
      if (shown == nullptr) return;
      QAction* chosen = nullptr;
      for (QAction* action : shown->actions()) {
        if (!action->isSeparator()) entries << action->text();
        if (!choice.isEmpty() && action->text().startsWith(choice)) chosen = action;
      }
      if (chosen != nullptr) chosen->trigger();
      shown->close();
    });
    QContextMenuEvent event(QContextMenuEvent::Mouse, place.toPoint(),
                            curve_.mapToGlobal(place.toPoint()));
    QCoreApplication::sendEvent(&curve_, &event);
    return entries;
  }
  int edits() { return document_.undo_stack().index(); }
  void undo_all() {
    document_.undo_stack().setIndex(0);
    EXPECT_EQ(document_.text(), kCurveView);
  }

  Document document_;
  TransferCurve curve_{document_};
  QStringList messages_;
  std::vector<ChosenHandle> wanted_;
  int choices_ = 0, axes_shown_ = 0;
};

TEST_F(TransferCurveTest, StepsThroughItsHandlesByKeys) {
  const std::vector<ChosenHandle> all{{Handle::surface, 0},    {Handle::color, 0},
                                      {Handle::color, 1},      {Handle::extinction, 0},
                                      {Handle::extinction, 1}, {Handle::extinction, 2}};
  for (const ChosenHandle& handle : all) {
    QTest::keyClick(&curve_, Qt::Key_Right);
    EXPECT_EQ(curve_.chosen(), handle);
  }
  EXPECT_EQ(choices_, 6);
  QTest::keyClick(&curve_, Qt::Key_Right);  // the last one stays
  EXPECT_EQ(curve_.chosen(), all[5]);
  EXPECT_EQ(choices_, 6);
  QTest::keyClick(&curve_, Qt::Key_Left);
  EXPECT_EQ(curve_.chosen(), all[4]);
  curve_.choose(all[0]);
  QTest::keyClick(&curve_, Qt::Key_Left);
  EXPECT_EQ(curve_.chosen(), all[0]);
  curve_.choose(std::nullopt);
  QTest::keyClick(&curve_, Qt::Key_Left);  // from none to the last one
  EXPECT_EQ(curve_.chosen(), all[5]);
  // up and down step nowhere, and nothing is chosen where nothing is
  QTest::keyClick(&curve_, Qt::Key_Up);
  EXPECT_EQ(curve_.chosen(), all[5]);
  curve_.choose(std::nullopt);
  curve_.show_field("none", {0, 1});
  QTest::keyClick(&curve_, Qt::Key_Right);
  EXPECT_EQ(curve_.chosen(), std::nullopt);
  EXPECT_EQ(edits(), 0);
}

TEST_F(TransferCurveTest, MovesTheChosenPointByAPixelAKey) {
  struct Move {
    Qt::Key key;
    int right, down;
  };
  for (const auto& [key, right, down] : {Move{Qt::Key_Right, 1, 0},
                                         {Qt::Key_Left, -1, 0},
                                         {Qt::Key_Up, 0, -1},
                                         {Qt::Key_Down, 0, 1}}) {
    curve_.choose(ChosenHandle{Handle::extinction, 1});
    const QPointF from = at(Handle::extinction, 1);
    QTest::keyClick(&curve_, key, Qt::ControlModifier);
    const QPointF to = at(Handle::extinction, 1);
    EXPECT_NEAR(to.x() - from.x(), right, 0.06) << key;
    EXPECT_NEAR(to.y() - from.y(), down, 0.06) << key;
    EXPECT_EQ(edits(), 1);
    EXPECT_EQ(curve_.chosen(), (ChosenHandle{Handle::extinction, 1}));
    undo_all();
  }
  // a key that is held down goes on with one edit; one that is pressed again begins another
  for (const bool is_held : {false, true, true, false}) {
    QKeyEvent event(QEvent::KeyPress, Qt::Key_Up, Qt::ControlModifier, QString(), is_held);
    QCoreApplication::sendEvent(&curve_, &event);
  }
  EXPECT_EQ(edits(), 2);
  undo_all();
  curve_.choose(std::nullopt);
  QTest::keyClick(&curve_, Qt::Key_Up, Qt::ControlModifier);
  EXPECT_EQ(edits(), 0);
}

TEST_F(TransferCurveTest, RemovesWhatIsChosenByEitherKey) {
  for (const Qt::Key key : {Qt::Key_Delete, Qt::Key_Backspace}) {
    curve_.choose(ChosenHandle{Handle::extinction, 1});
    QTest::keyClick(&curve_, key);
    EXPECT_EQ(volume().extinction->points.size(), 2U);
    undo_all();
    curve_.choose(std::nullopt);
    QTest::keyClick(&curve_, key);
    EXPECT_EQ(edits(), 0);
  }
  curve_.choose(ChosenHandle{Handle::color, 0});
  curve_.remove_chosen();
  ASSERT_EQ(volume().color->points.size(), 1U);
  EXPECT_EQ(volume().color->points[0].scalar, 0.875);
  curve_.choose(ChosenHandle{Handle::color, 0});
  curve_.remove_chosen();
  EXPECT_EQ(volume().color->points.size(), 1U);
  EXPECT_EQ(
      messages_,
      QStringList{QStringLiteral("the last point stays: a transfer function has one at least")});
  // what is gone is not chosen any more
  undo_all();
  curve_.choose(ChosenHandle{Handle::extinction, 2});
  choices_ = 0;
  curve_.remove_chosen();
  EXPECT_EQ(curve_.chosen(), std::nullopt);
  EXPECT_EQ(choices_, 1);
}

TEST_F(TransferCurveTest, PointsAtHandlesWithAHand) {
  const QPointF handle = at(Handle::extinction, 1);
  for (const auto& [away, shape] : {std::pair(0.0, Qt::PointingHandCursor),
                                    {8.9, Qt::PointingHandCursor},
                                    {9.1, Qt::CrossCursor}}) {
    QMouseEvent event(QEvent::MouseMove, handle + QPointF(0, away), curve_.mapToGlobal(handle),
                      Qt::NoButton, Qt::NoButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&curve_, &event);
    EXPECT_EQ(curve_.cursor().shape(), shape) << away;
  }
}

TEST_F(TransferCurveTest, ChoosesByTheLeftButtonAlone) {
  mouse(QEvent::MouseButtonPress, at(Handle::extinction, 1), Qt::RightButton);
  EXPECT_EQ(curve_.chosen(), std::nullopt);
  mouse(QEvent::MouseButtonPress, at(Handle::extinction, 1));
  mouse(QEvent::MouseButtonRelease, at(Handle::extinction, 1));
  EXPECT_EQ(curve_.chosen(), (ChosenHandle{Handle::extinction, 1}));
  mouse(QEvent::MouseButtonPress, {200, 100}, Qt::RightButton);
  EXPECT_EQ(curve_.chosen(), (ChosenHandle{Handle::extinction, 1}));
  mouse(QEvent::MouseButtonPress, {200, 30});  // beside all of them
  mouse(QEvent::MouseButtonRelease, {200, 30});
  EXPECT_EQ(curve_.chosen(), std::nullopt);
}

TEST_F(TransferCurveTest, BeginsADragAfterThreePixels) {
  const QPointF from = at(Handle::extinction, 1);
  drag(from, {2.9, 0});
  EXPECT_EQ(edits(), 0);
  drag(from, {3.1, 0});
  EXPECT_EQ(edits(), 1);
  EXPECT_NEAR(at(Handle::extinction, 1).x(), from.x() + 3.1, 0.06);
  undo_all();
  // once begun it goes on, back to where it was too; another one is another edit
  mouse(QEvent::MouseButtonPress, from);
  for (const double by : {10.0, 1.0}) mouse(QEvent::MouseMove, from + QPointF(by, 0));
  mouse(QEvent::MouseButtonRelease, from + QPointF(1, 0));
  EXPECT_NEAR(at(Handle::extinction, 1).x(), from.x() + 1, 0.06);
  EXPECT_EQ(edits(), 1);
  drag(at(Handle::extinction, 1), {30, 0});
  EXPECT_EQ(edits(), 2);
}

TEST_F(TransferCurveTest, HoldsAHandleWhereItWasGripped) {
  const QPointF from = at(Handle::extinction, 1);
  drag(from + QPointF(4, -5), {20, 30});
  EXPECT_NEAR(at(Handle::extinction, 1).x(), from.x() + 20, 0.06);
  EXPECT_NEAR(at(Handle::extinction, 1).y(), from.y() + 30, 0.06);
}

TEST_F(TransferCurveTest, MovesAlongOneAxisWithShift) {
  const QPointF from = at(Handle::extinction, 1), grip(3, -2);
  for (const auto& [by, expected] : {std::pair(QPointF(20, 15), QPointF(20, 0)),
                                     {QPointF(-20, 15), QPointF(-20, 0)},
                                     {QPointF(15, 20), QPointF(0, 20)},
                                     {QPointF(15, -20), QPointF(0, -20)}}) {
    drag(from + grip, by, Qt::ShiftModifier);
    const QPointF to = at(Handle::extinction, 1);
    EXPECT_NEAR(to.x() - from.x(), expected.x(), 0.06) << by.x() << " " << by.y();
    EXPECT_NEAR(to.y() - from.y(), expected.y(), 0.06) << by.x() << " " << by.y();
    undo_all();
  }
}

TEST_F(TransferCurveTest, KeepsItsAxesWhileSomethingIsDragged) {
  const auto before = curve_.axes().extinctions();
  const QPointF from = at(Handle::extinction, 2);
  mouse(QEvent::MouseButtonPress, from);
  mouse(QEvent::MouseMove, {from.x(), curve_.axes().box().top});
  EXPECT_EQ(point(2)[1], before[1]);
  EXPECT_EQ(curve_.axes().extinctions(), before);
  mouse(QEvent::MouseButtonRelease, {from.x(), curve_.axes().box().top});
  EXPECT_GT(curve_.axes().extinctions()[1], before[1]);
  mouse(QEvent::MouseMove, {200, 200});  // nothing is pressed any more
  EXPECT_EQ(edits(), 1);
}

TEST_F(TransferCurveTest, DragsColoursBetweenTheirNeighbours) {
  drag(at(Handle::color, 0), {40, 17});
  EXPECT_NEAR(volume().color->points[0].scalar, 0.125 + 40 * 1.04 / 400, 1e-3);
  EXPECT_EQ(volume().color->points[0].value, (Color{0, 0, 1}));
  drag(at(Handle::color, 0), {400, 0});
  EXPECT_EQ(volume().color->points[0].scalar, 0.875);
  undo_all();
}

TEST_F(TransferCurveTest, KeepsTheEndsOfAColourMapApart) {
  ASSERT_TRUE(set(without_table(kCurveView, "volume.color") +
                  "[volume.color]\nfield = 'f'\npreset = 'viridis'\nrange = [0.25, 0.75]\n"));
  const auto ends = [&] {
    return std::array{volume().color->points.front().scalar, volume().color->points.back().scalar};
  };
  drag(at(Handle::color_range, 0), {100, 0});
  EXPECT_NEAR(ends()[0], 0.51, 1e-3);
  EXPECT_EQ(ends()[1], 0.75);
  drag(at(Handle::color_range, 1), {-50, 0});
  EXPECT_NEAR(ends()[1], 0.62, 1e-3);
  const auto before = ends();
  drag(at(Handle::color_range, 1), {-200, 0});
  drag(at(Handle::color_range, 0), {200, 0});
  EXPECT_EQ(ends(), before);
  // a map has no points of its own to add to or to remove
  curve_.choose(ChosenHandle{Handle::color_range, 0});
  const int count = edits();
  curve_.remove_chosen();
  double_click({150, at(Handle::color_range, 0).y()});
  EXPECT_EQ(edits(), count);
  EXPECT_EQ(messages_, QStringList{QStringLiteral(
                           "the colour map has no points of its own (turn it into points first)")});
}

TEST_F(TransferCurveTest, AddsPointsByDoubleClicksOfTheLeftButton) {
  const double bottom = curve_.axes().box().bottom;
  double_click({300, 100}, Qt::RightButton);
  EXPECT_EQ(edits(), 0);
  const std::array<double, 2> there{curve_.axes().value_at(300), curve_.axes().extinction_at(100)};
  double_click({300, 100});
  ASSERT_EQ(volume().extinction->points.size(), 4U);
  EXPECT_EQ(point(2), there);
  EXPECT_EQ(curve_.chosen(), (ChosenHandle{Handle::extinction, 2}));
  undo_all();
  // the strip of colours ends three pixels beside it
  for (const auto& [y, is_strip] : {std::pair(bottom + 8 - 4, false),
                                    {bottom + 8 - 2, true},
                                    {bottom + 26 + 2, true},
                                    {bottom + 26 + 4, false}}) {
    double_click({300, y});
    EXPECT_EQ(volume().color->points.size(), is_strip ? 3U : 2U) << y;
    EXPECT_EQ(volume().extinction->points.size(), is_strip ? 3U : 4U) << y;
    undo_all();
  }
}

TEST_F(TransferCurveTest, WantsAnotherColourForADoubleClickOnOne) {
  double_click(at(Handle::color, 1));
  double_click(at(Handle::surface, 0));
  EXPECT_EQ(wanted_, (std::vector<ChosenHandle>{{Handle::color, 1}, {Handle::surface, 0}}));
  double_click(at(Handle::extinction, 1));
  EXPECT_EQ(wanted_.size(), 2U);
  EXPECT_EQ(edits(), 0);
}

TEST_F(TransferCurveTest, BeginsAnExtinctionWhereThereIsNone) {
  ASSERT_TRUE(set(without_table(kCurveView, "volume.extinction")));
  const std::array<double, 2> there{curve_.axes().value_at(200), curve_.axes().extinction_at(80)};
  double_click({200, 80});
  ASSERT_TRUE(volume().extinction.has_value());
  EXPECT_EQ(volume().extinction->field, "f");
  ASSERT_EQ(volume().extinction->points.size(), 1U);
  EXPECT_EQ(point(0), there);
  // that of another field is not this plot's
  ASSERT_TRUE(set(with_key(kCurveView, "volume.extinction.field", "\"g\"")));
  const std::string before = document_.text();
  double_click({200, 80});
  EXPECT_EQ(document_.text(), before);
  ASSERT_TRUE(set(with_key(kCurveView, "volume.color.field", "\"g\"")));
  const std::string other = document_.text();
  double_click({200, curve_.axes().box().bottom + 17});
  EXPECT_EQ(document_.text(), other);
}

TEST_F(TransferCurveTest, ZoomsAroundTheMouseAndBackToAll) {
  const auto all = curve_.axes().values();
  const double x = curve_.axes().x_of(0.25);
  wheel(x, 1);
  EXPECT_NEAR(curve_.axes().values()[0], 0.25 - 0.8 * (0.25 - all[0]), 1e-12);
  EXPECT_NEAR(curve_.axes().values()[1], 0.25 + 0.8 * (all[1] - 0.25), 1e-12);
  EXPECT_EQ(axes_shown_, 1);
  wheel(x, -2);
  EXPECT_EQ(curve_.axes().values(), all);
  // what begins beside all values is no wider than all of them
  wheel(x, 3);
  wheel(curve_.axes().box().right, -1);
  EXPECT_LT(curve_.axes().values()[0], 0.25);
  EXPECT_NE(curve_.axes().values(), all);
  curve_.show_all_values();
  EXPECT_EQ(curve_.axes().values(), all);
  EXPECT_EQ(axes_shown_, 5);
}

TEST_F(TransferCurveTest, ForgetsZoomAndChoiceForAnotherField) {
  const auto histogram = std::make_shared<const VolumeHistogram>();
  const auto all = curve_.axes().values();
  wheel(200, 2);
  axes_shown_ = 0;
  const auto zoomed = curve_.axes().values();
  curve_.choose(ChosenHandle{Handle::extinction, 1});
  curve_.show_histogram(histogram);
  curve_.show_field("f", {0, 1});  // nothing new
  EXPECT_EQ(axes_shown_, 0);
  EXPECT_EQ(curve_.axes().values(), zoomed);
  EXPECT_EQ(curve_.histogram(), histogram.get());
  EXPECT_TRUE(curve_.chosen());
  curve_.show_field("f", {0, 2});  // the same field of another mesh
  EXPECT_EQ(axes_shown_, 1);
  EXPECT_NEAR(curve_.axes().values()[1], 2.04, 1e-12);
  EXPECT_EQ(curve_.histogram(), nullptr);
  EXPECT_FALSE(curve_.chosen());
  curve_.show_field("g", {0, 1});
  EXPECT_EQ(curve_.field(), "g");
  EXPECT_EQ(curve_.place_of({Handle::extinction, 0}), std::nullopt);
  curve_.show_field("f", {0, 1});
  EXPECT_EQ(curve_.axes().values(), all);
}

TEST_F(TransferCurveTest, ShowsPointsBesideTheValuesOfTheField) {
  // a half of the field's width and no farther
  ASSERT_TRUE(set(with_key(kCurveView, "volume.extinction.points", "[[-0.5, 1], [9, 2]]")));
  EXPECT_NEAR(curve_.axes().values()[0], -0.5 - 0.02 * 1.5, 1e-12);
  EXPECT_NEAR(curve_.axes().values()[1], 1 + 0.02 * 1.5, 1e-12);
  ASSERT_TRUE(set(with_key(kCurveView, "volume.color.points", "[[0, 0, 0, 0], [1.25, 1, 1, 1]]")));
  EXPECT_NEAR(curve_.axes().values()[1], 1.25 + 0.02 * 1.25, 1e-12);
}

TEST_F(TransferCurveTest, AsksForAHistogramOfOtherValuesOnce) {
  curve_.show_histogram(std::make_shared<const VolumeHistogram>());
  curve_.set_log_values(false);  // as it is
  EXPECT_EQ(axes_shown_, 0);
  EXPECT_NE(curve_.histogram(), nullptr);
  curve_.set_log_values(true);
  EXPECT_EQ(axes_shown_, 1);
  EXPECT_EQ(curve_.histogram(), nullptr);
  EXPECT_EQ(curve_.axes().scale(), TransferScale::log);
}

TEST_F(TransferCurveTest, AddsAtTheChosenValueOrInTheMiddle) {
  curve_.choose(ChosenHandle{Handle::color, 1});
  curve_.add_surface_here();
  ASSERT_EQ(document_.scene().isosurfaces.size(), 2U);
  EXPECT_NEAR(document_.scene().isosurfaces[1].value, 0.875, 1e-3);
  EXPECT_EQ(document_.scene().isosurfaces[1].opacity, 0.5);
  EXPECT_EQ(document_.scene().isosurfaces[1].field, "f");
  undo_all();
  curve_.choose(std::nullopt);
  wheel(curve_.axes().box().left, 3);  // the middle of what is shown, and not of the field
  const double middle = (curve_.axes().values()[0] + curve_.axes().values()[1]) / 2;
  curve_.add_point_here();
  ASSERT_EQ(volume().extinction->points.size(), 4U);
  EXPECT_NEAR(point(1)[0], middle, 1e-3);
  EXPECT_NEAR(point(1)[1] / (0.5 + 3 * middle), 1, 0.02);  // on the curve
}

TEST_F(TransferCurveTest, OffersInItsMenuWhatCanBeDoneThere) {
  const QString surface = QStringLiteral("Add isosurface at %1").arg(curve_.axes().value_at(300));
  const QString all = QStringLiteral("Show all values"), remove = QStringLiteral("Remove");
  const double strip = curve_.axes().box().bottom + 17;
  EXPECT_EQ(menu({300, 100}), (QStringList{QStringLiteral("Add point here"), surface, all}));
  EXPECT_EQ(menu({300, strip}), (QStringList{QStringLiteral("Add colour here"), surface, all}));
  const QPointF handle = at(Handle::extinction, 1);
  EXPECT_EQ(menu(handle).first(), remove);
  EXPECT_EQ(curve_.chosen(), (ChosenHandle{Handle::extinction, 1}));
  EXPECT_EQ(edits(), 0);
  menu(handle, remove);
  EXPECT_EQ(volume().extinction->points.size(), 2U);
  undo_all();
  menu({300, 100}, QStringLiteral("Add point"));
  EXPECT_EQ(volume().extinction->points.size(), 4U);
  undo_all();
  menu({300, strip}, QStringLiteral("Add colour"));
  EXPECT_EQ(volume().color->points.size(), 3U);
  undo_all();
  menu({300, 100}, QStringLiteral("Add isosurface"));
  ASSERT_EQ(document_.scene().isosurfaces.size(), 2U);
  EXPECT_EQ(document_.scene().isosurfaces[1].value, curve_.axes().value_at(300));
  const auto values = curve_.axes().values();
  wheel(300, 2);
  menu({300, 100}, all);
  EXPECT_EQ(curve_.axes().values(), values);
}

TEST_F(TransferCurveTest, DoesNothingWithoutAView) {
  Document empty;
  TransferCurve curve(empty);
  curve.resize(464, 320);
  curve.show_field("f", {0, 1});
  QTest::mouseDClick(&curve, Qt::LeftButton, Qt::NoModifier, {200, 100});
  QTest::keyClick(&curve, Qt::Key_Right);
  curve.add_surface_here();
  EXPECT_EQ(curve.chosen(), std::nullopt);
  EXPECT_EQ(curve.place_of({Handle::surface, 0}), std::nullopt);
  QContextMenuEvent event(QContextMenuEvent::Mouse, {200, 100}, {200, 100});
  QCoreApplication::sendEvent(&curve, &event);
  EXPECT_EQ(QApplication::activePopupWidget(), nullptr);
}

}  // namespace
}  // namespace hiac::view
