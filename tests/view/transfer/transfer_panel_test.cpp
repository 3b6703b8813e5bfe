// The editor of transfer functions, with a mouse and a keyboard.

#include "tools/view/transfer/transfer_panel.hpp"

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QPlainTextEdit>
#include <QSlider>
#include <QTableWidget>
#include <QTest>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "hiac/scene/toml/edited_text.hpp"
#include "hiac/session/session.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/view/open_window.hpp"
#include "tests/view/small_view.hpp"
#include "tools/view/transfer/bump.hpp"
#include "tools/view/transfer/display_color.hpp"
#include "tools/view/transfer/spec_pane.hpp"

namespace hiac::view {
namespace {

using test::wait_until;

const std::string kText = "# a view of mine\n" + test::kSmallView + R"([volume.color]
field = "f"
points = [
  [0, 0.0, 0.0, 1.0],  # blue
  [1, 1.0, 0.0, 0.0],
]
[volume.extinction]
field = "f"
points = [
  [0.0, 0.5],  # thin
  [0.5, 2.0],
  [1.0, 8.0],  # thick
]
[[isosurface]]
field = "f"
value = 0.25
)";

class TransferPanelTest : public ::testing::Test {
 protected:
  TransferPanelTest() {
    QObject::connect(&document_, &Document::message, &document_,
                     [this](const QString& line) { messages_ << line; });
    EXPECT_TRUE(document_.open(test::mesh_of_f_and_g(3), "m.zoo", kText, "view.toml", ""));
    panel_.resize(460, 700);
    panel_.show();
    EXPECT_TRUE(wait_until([&] { return panel_.is_at_rest(); }));
  }

  TransferCurve& curve() { return panel_.curve(); }
  [[nodiscard]] const std::vector<ExtinctionTransfer::Point>& points() const {
    return document_.scene().volume.extinction->points;
  }
  QPoint at(Handle kind, std::size_t index) {
    const Place place = curve().place_of({kind, index}).value();
    return {static_cast<int>(std::lround(place.x)), static_cast<int>(std::lround(place.y))};
  }
  void drag(const QPoint& from, const QPoint& to, Qt::KeyboardModifiers keys = Qt::NoModifier) {
    QTest::mousePress(&curve(), Qt::LeftButton, keys, from);
    for (int step = 1; step <= 4; ++step) {
      const QPointF place = from + (to - from) * (step / 4.0);
      QMouseEvent event(QEvent::MouseMove, place, curve().mapToGlobal(place), Qt::NoButton,
                        Qt::LeftButton, keys);
      QCoreApplication::sendEvent(&curve(), &event);
    }
    QTest::mouseRelease(&curve(), Qt::LeftButton, keys, to);
  }
  void double_click(const QPoint& place) {
    QTest::mouseDClick(&curve(), Qt::LeftButton, Qt::NoModifier, place);
    QTest::mouseRelease(&curve(), Qt::LeftButton, Qt::NoModifier, place);
  }
  int edits() { return document_.undo_stack().index(); }
  /// Undoes all: the text is what it was.
  void undo_all() {
    document_.undo_stack().setIndex(0);
    EXPECT_EQ(document_.text(), kText);
  }

  Document document_;
  QStringList messages_;
  TransferPanel panel_{document_};
};

TEST_F(TransferPanelTest, DragsAPointInOneEdit) {
  const QPoint from = at(Handle::extinction, 1), to = from + QPoint(30, -24);
  const double value = points()[1].scalar, extinction = points()[1].value[0];
  const auto& axes = curve().axes();
  const double width = axes.box().right - axes.box().left;
  const double per_pixel = (axes.values()[1] - axes.values()[0]) / width;
  drag(from, to);
  EXPECT_EQ(edits(), 1);
  EXPECT_NEAR(points()[1].scalar, value + 30 * per_pixel, per_pixel);
  EXPECT_NEAR(axes.y_of(points()[1].value[0]), axes.y_of(extinction) - 24, 1);
  EXPECT_NE(document_.text().find("# thick"), std::string::npos);
  // not beyond its neighbours
  drag(at(Handle::extinction, 1), to + QPoint(2000, 0));
  EXPECT_EQ(edits(), 2);
  EXPECT_EQ(points()[1].scalar, 1.0);
  undo_all();
}

TEST_F(TransferPanelTest, DragsToZeroAndAlongOneAxis) {
  const QPoint from = at(Handle::extinction, 1);
  drag(from, {from.x() + 3, static_cast<int>(curve().axes().box().bottom)}, Qt::ShiftModifier);
  EXPECT_EQ(points()[1].scalar, 0.5);
  EXPECT_EQ(points()[1].value[0], 0);
  undo_all();
}

TEST_F(TransferPanelTest, AClickIsNoEdit) {
  const QPoint place = at(Handle::extinction, 2);
  drag(place, place + QPoint(1, 1));
  EXPECT_EQ(edits(), 0);
  EXPECT_EQ(curve().chosen(), (ChosenHandle{Handle::extinction, 2}));
}

TEST_F(TransferPanelTest, AddsByADoubleClickAndRemovesByAKey) {
  const auto& axes = curve().axes();
  const QPoint place(static_cast<int>(axes.x_of(0.75)), static_cast<int>(axes.y_of(30)));
  const double extinction = axes.extinction_at(place.y());  // the axis grows with the new point
  double_click(place);
  ASSERT_EQ(points().size(), 4U);
  EXPECT_NEAR(points()[2].scalar, 0.75, 0.005);
  EXPECT_NEAR(points()[2].value[0] / extinction, 1, 0.05);
  EXPECT_EQ(curve().chosen(), (ChosenHandle{Handle::extinction, 2}));
  QTest::keyClick(&curve(), Qt::Key_Delete);
  EXPECT_EQ(points().size(), 3U);
  EXPECT_EQ(document_.text(), kText);
  for (int i = 0; i < 4; ++i) {
    curve().choose(ChosenHandle{Handle::extinction, 0});
    QTest::keyClick(&curve(), Qt::Key_Delete);
  }
  EXPECT_EQ(points().size(), 1U);  // the last one stays
  EXPECT_TRUE(messages_.last().contains(QStringLiteral("the last point stays")));
  undo_all();
}

TEST_F(TransferPanelTest, EditsColours) {
  const QPoint strip = at(Handle::color, 0);
  const auto& axes = curve().axes();
  double_click({static_cast<int>(axes.x_of(0.5)), strip.y()});
  const auto colors = [&] { return document_.scene().volume.color->points; };
  ASSERT_EQ(colors().size(), 3U);
  EXPECT_NEAR(colors()[1].value[0], 0.5, 0.01);  // what the function was there
  drag(at(Handle::color, 1), at(Handle::color, 1) + QPoint(40, 0));
  EXPECT_GT(colors()[1].scalar, 0.55);
  QTableWidget& table = panel_.tables().colors();
  table.item(1, 1)->setText(QStringLiteral("#ffffff"));
  EXPECT_EQ(colors()[1].value, (Color{1, 1, 1}));
  table.item(1, 1)->setText(QStringLiteral("0.25 0.5 7"));
  EXPECT_EQ(colors()[1].value, (Color{0.25, 0.5, 7}));
  const std::string before = document_.text();
  table.item(1, 1)->setText(QStringLiteral("no colour"));
  EXPECT_EQ(document_.text(), before);
  EXPECT_EQ(table.item(1, 1)->text(), QStringLiteral("0.25 0.5 7"));
  undo_all();
}

TEST_F(TransferPanelTest, TakesTypedNumbers) {
  QTableWidget& table = panel_.tables().extinctions();
  ASSERT_EQ(table.rowCount(), 3);
  EXPECT_EQ(table.item(1, 0)->text(), QStringLiteral("0.5"));
  table.item(1, 1)->setText(QStringLiteral("3.25"));
  EXPECT_EQ(points()[1].value[0], 3.25);
  table.item(1, 2)->setText(QStringLiteral("2"));
  EXPECT_DOUBLE_EQ(points()[1].value[0], std::log(2.0) / 2);
  table.item(1, 2)->setText(QStringLiteral("\u221e"));
  EXPECT_EQ(points()[1].value[0], 0);
  table.item(1, 0)->setText(QStringLiteral("0.125"));
  EXPECT_EQ(points()[1].scalar, 0.125);
  // refused: scalars would decrease; no number; negative
  for (const auto& [column, text] : {std::pair(0, "2"), {1, "much"}, {1, "-1"}, {2, "0"}}) {
    const std::string before = document_.text();
    const qsizetype told = messages_.size();
    table.item(1, column)->setText(QString::fromLatin1(text));
    EXPECT_EQ(document_.text(), before) << text;
    EXPECT_GT(messages_.size(), told) << text;
  }
  EXPECT_EQ(table.item(1, 0)->text(), QStringLiteral("0.125"));
  undo_all();
}

TEST_F(TransferPanelTest, EditsIsosurfaces) {
  const auto surfaces = [&] { return document_.scene().isosurfaces; };
  drag(at(Handle::surface, 0), at(Handle::surface, 0) + QPoint(50, 0));
  EXPECT_EQ(edits(), 1);
  EXPECT_GT(surfaces()[0].value, 0.3);
  QTableWidget& table = panel_.tables().surfaces();
  table.item(0, 3)->setText(QStringLiteral("0.5"));
  table.item(0, 2)->setText(QStringLiteral("red"));
  table.item(0, 1)->setText(QStringLiteral("0.75"));
  EXPECT_EQ(surfaces()[0].opacity, 0.5);
  EXPECT_EQ(surfaces()[0].color, (Color{1, 0, 0}));
  EXPECT_EQ(surfaces()[0].value, 0.75);
  table.item(0, 0)->setText(QStringLiteral("g"));
  EXPECT_EQ(curve().place_of({Handle::surface, 0}), std::nullopt);  // no surface of this field
  undo_all();
  curve().choose(ChosenHandle{Handle::surface, 0});
  QTest::keyClick(&curve(), Qt::Key_Delete);
  EXPECT_TRUE(surfaces().empty());
  undo_all();
  curve().choose(ChosenHandle{Handle::extinction, 1});
  curve().add_surface_here();
  ASSERT_EQ(surfaces().size(), 2U);
  EXPECT_EQ(surfaces()[1].value, 0.5);
  EXPECT_NEAR(surfaces()[1].color[0], 0.5, 1e-9);  // the colour there
  undo_all();
  curve().add_point_here();
  ASSERT_EQ(points().size(), 4U);
  EXPECT_EQ(points()[2].scalar, 0.5);
  undo_all();
}

TEST_F(TransferPanelTest, SlidesTheDensityInOneEdit) {
  QSlider& slider = panel_.density();
  slider.setSliderDown(true);
  for (int value = 20; value <= 100; value += 20) slider.setValue(value);
  EXPECT_DOUBLE_EQ(points()[2].value[0], 80);
  slider.setSliderDown(false);
  EXPECT_EQ(slider.value(), 0);
  EXPECT_EQ(edits(), 1);
  slider.setSliderDown(true);
  slider.setValue(-100);
  slider.setSliderDown(false);
  EXPECT_EQ(edits(), 2);
  EXPECT_DOUBLE_EQ(points()[2].value[0], 8);
  undo_all();
}

TEST_F(TransferPanelTest, MeasuresTheHistogramAndFollowsTheZoom) {
  const QPoint middle(static_cast<int>(curve().axes().x_of(0.5)), 60);
  const auto before = curve().axes().values();
  QWheelEvent event(middle, curve().mapToGlobal(middle), {}, {0, 240}, Qt::NoButton, Qt::NoModifier,
                    Qt::NoScrollPhase, false);
  QCoreApplication::sendEvent(&curve(), &event);
  const auto after = curve().axes().values();
  EXPECT_NEAR(after[1] - after[0], 0.64 * (before[1] - before[0]), 1e-12);
  EXPECT_TRUE(wait_until([&] { return panel_.is_at_rest(); }));
  curve().show_all_values();
  EXPECT_EQ(curve().axes().values(), before);
}

TEST_F(TransferPanelTest, PutsValuesEvenlyInTheirLogarithm) {
  const std::string before = document_.text();
  const auto linear = curve().axes().values();
  panel_.log_values().setChecked(true);
  const CurveAxes axes = curve().axes();
  EXPECT_EQ(axes.scale(), TransferScale::log);
  EXPECT_GT(axes.values()[0], 0);
  const double decade = axes.x_of(0.1) - axes.x_of(0.01);
  EXPECT_GT(decade, 20);
  EXPECT_NEAR(axes.x_of(1) - axes.x_of(0.1), decade, 1e-9);
  EXPECT_TRUE(wait_until([&] { return panel_.is_at_rest(); }));
  EXPECT_EQ(document_.text(), before);  // an axis is no edit
  ASSERT_NE(curve().histogram(), nullptr);
  const std::vector<double>& edges = curve().histogram()->edges;
  const double ratio = edges[1] / edges[0];
  EXPECT_GT(ratio, 1);
  EXPECT_NEAR(edges.back() / edges[edges.size() - 2], ratio, 1e-9 * ratio);
  // a point is dragged to the value below the mouse
  const QPoint from = at(Handle::extinction, 1);
  EXPECT_NEAR(from.x(), axes.x_of(0.5), 1);
  drag(from, {static_cast<int>(axes.x_of(0.05)), from.y()});
  EXPECT_NEAR(document_.scene().volume.extinction->points[1].scalar, 0.05, 0.05 * 0.03);
  panel_.log_values().setChecked(false);
  EXPECT_EQ(curve().axes().scale(), TransferScale::linear);
  EXPECT_EQ(curve().axes().values(), linear);
}

TEST_F(TransferPanelTest, NamesTheChoicesOfFields) {
  QStringList texts;
  for (const QLabel* label : panel_.findChildren<QLabel*>()) texts << label->text();
  for (const char* name : {"Extinction by", "Colour by"})
    EXPECT_TRUE(texts.contains(QLatin1String(name))) << name;
}

TEST_F(TransferPanelTest, HasAPlotForEachField) {
  EXPECT_FALSE(panel_.color_curve().isVisible());
  const auto choose = [](QComboBox& box, const char* name) {
    const int index = box.findText(QString::fromLatin1(name));
    ASSERT_GE(index, 0);
    box.setCurrentIndex(index);
    Q_EMIT box.activated(index);
    Q_EMIT box.textActivated(box.itemText(index));
  };
  choose(panel_.color_fields(), "g");
  EXPECT_TRUE(panel_.color_curve().isVisible());
  EXPECT_EQ(document_.scene().volume.color->field, "g");
  EXPECT_EQ(document_.scene().volume.color->points.front().scalar, 5);
  EXPECT_EQ(document_.scene().volume.color->points.back().scalar, 15);
  EXPECT_EQ(document_.scene().volume.extinction->field, "f");
  choose(panel_.extinction_fields(), "g");
  EXPECT_FALSE(panel_.color_curve().isVisible());
  EXPECT_EQ(curve().field(), "g");
  choose(panel_.presets(), "magma");
  EXPECT_EQ(document_.scene().volume.color->points.front().scalar, 5);
  // the ends of a colour map are dragged
  drag(at(Handle::color_range, 0), at(Handle::color_range, 0) + QPoint(60, 0));
  EXPECT_GT(document_.scene().volume.color->points.front().scalar, 6);
  const Scene mapped = document_.scene();
  choose(panel_.presets(), "(points)");
  EXPECT_EQ(document_.scene(), mapped);
  EXPECT_EQ(document_.text().find("preset"), std::string::npos);
  undo_all();
}

TEST_F(TransferPanelTest, AddsABump) {
  add_bump(document_, 0.7);
  ASSERT_EQ(points().size(), 6U);
  EXPECT_DOUBLE_EQ(points()[3].scalar, 0.7);
  EXPECT_EQ(points()[3].value[0], 10);  // five times the median
  EXPECT_EQ(edits(), 1);
  undo_all();
  // a view that does not absorb yet
  const std::string clear = without_table(kText, "volume.extinction");
  ASSERT_TRUE(document_.edit(QStringLiteral("clear"), clear));
  add_bump(document_, 0.7);
  ASSERT_EQ(points().size(), 3U);
  EXPECT_GT(points()[1].value[0], 1);
  EXPECT_EQ(points()[0].value[0], 0);
  undo_all();
}

TEST_F(TransferPanelTest, SavesCurvesThatGiveTheSamePicture) {
  const hiac::test::ScratchFolder folder;
  const auto picture = [&] {
    const Picture made = Session(*document_.mesh()).picture(document_.scene());
    const auto values = made.image.values();
    return std::vector<double>(values.begin(), values.end());
  };
  drag(at(Handle::extinction, 1), at(Handle::extinction, 1) + QPoint(20, -20));
  const auto before = picture();
  const Volume volume = document_.scene().volume;
  const QString file = QString::fromStdString(folder.file("curves.toml"));
  panel_.save_curves(file);
  undo_all();
  EXPECT_NE(picture(), before);
  panel_.load_curves(file);
  EXPECT_EQ(document_.scene().volume, volume);
  EXPECT_EQ(picture(), before);
  EXPECT_EQ(edits(), 1);
  panel_.load_curves(QStringLiteral("/no/such/file.toml"));
  EXPECT_TRUE(messages_.last().contains(QStringLiteral("/no/such/file.toml")));
  undo_all();
}

TEST_F(TransferPanelTest, SavesCurvesOverNothingElse) {
  const hiac::test::ScratchFolder folder;
  const std::string picture = folder.write("a.png", "\x89PNG\r\n\x1a\n and more");
  const std::string own = folder.write("own.toml", kText);
  document_.saved_as(own);
  panel_.save_curves(QString::fromStdString(picture));
  EXPECT_TRUE(messages_.last().contains(QStringLiteral("is a file of another kind")));
  EXPECT_EQ(hiac::test::bytes_of(picture), "\x89PNG\r\n\x1a\n and more");
  panel_.save_curves(QString::fromStdString(own));  // the specification has more than curves
  EXPECT_TRUE(messages_.last().contains(QStringLiteral("is an input")));
  EXPECT_EQ(hiac::test::bytes_of(own), kText);
}

TEST_F(TransferPanelTest, UndoesAnySequenceOfEdits) {
  std::mt19937 random(5);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  for (int step = 0; step < 150; ++step) {
    const QPoint a(below(curve().width()), below(curve().height()));
    const QPoint b(below(curve().width()), below(curve().height()));
    const int kind = below(6);
    if (kind == 0) double_click(a);
    if (kind == 1 && !points().empty())
      drag(at(Handle::extinction,
              static_cast<std::size_t>(below(static_cast<int>(points().size())))),
           b);
    if (kind == 2) drag(a, b);
    if (kind == 3) QTest::keyClick(&curve(), below(2) == 0 ? Qt::Key_Delete : Qt::Key_Right);
    if (kind == 4) QTest::keyClick(&curve(), Qt::Key_Up, Qt::ControlModifier);
    if (kind == 5) add_bump(document_, 0.01 * below(100));
    ASSERT_NO_THROW(parse_scene(document_.text(), "view")) << document_.text();
  }
  EXPECT_GT(edits(), 40);
  EXPECT_NE(document_.text().find("# a view of mine"), std::string::npos);
  const std::string last = document_.text();
  const int count = document_.undo_stack().count();
  undo_all();
  document_.undo_stack().setIndex(count);
  EXPECT_EQ(document_.text(), last);
}

TEST_F(TransferPanelTest, ShowsTheTextAndTakesATypedOne) {
  SpecPane pane(document_);
  EXPECT_EQ(pane.editor().toPlainText().toStdString(), kText);
  add_bump(document_, 0.7);
  EXPECT_EQ(pane.editor().toPlainText().toStdString(), document_.text());
  undo_all();
  // a text with a fault stays typed, and is not the document
  const std::string wrong = with_key(kText, "camera.fov", "500");
  pane.editor().setPlainText(QString::fromStdString(wrong));
  pane.apply();
  EXPECT_EQ(document_.text(), kText);
  EXPECT_TRUE(pane.fault().contains(QStringLiteral("view.toml:9: key `camera.fov`")))
      << pane.fault().toStdString();
  add_bump(document_, 0.7);
  EXPECT_EQ(pane.editor().toPlainText().toStdString(), wrong);
  pane.revert();
  EXPECT_EQ(pane.editor().toPlainText().toStdString(), document_.text());
  EXPECT_TRUE(pane.fault().isEmpty());
  const std::string right = with_key(kText, "camera.fov", "50");
  pane.editor().setPlainText(QString::fromStdString(right));
  pane.apply();
  EXPECT_EQ(document_.text(), right);
  undo_all();
}

TEST(DisplayColor, IsReadAsItIsWritten) {
  for (const Color& color :
       {Color{0, 0, 0}, {1, 0.5, 0.25}, {2, 0, 0}, from_screen(QColor(0x12, 0x34, 0x56))}) {
    const auto read = color_from(color_text(color));
    ASSERT_TRUE(read);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR((*read)[c], color[c], 1e-5);
  }
  EXPECT_EQ(color_text(from_screen(QColor(0x12, 0x34, 0x56))), QStringLiteral("#123456"));
  for (const char* text : {"", "1 2", "1 2 x", "-1 0 0", "nan 0 0", "#12", "1 1 1 1"})
    EXPECT_FALSE(color_from(QString::fromLatin1(text))) << text;
}

}  // namespace
}  // namespace hiac::view
