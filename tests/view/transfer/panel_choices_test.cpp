// The choices around the plots of the transfer functions, and the pane of the text.

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QScrollBar>
#include <QSlider>
#include <QTableWidget>
#include <QTest>
#include <QTextBlock>
#include <cmath>

#include <gtest/gtest.h>

#include "hiac/scene/colormaps/built_in_colormaps.hpp"
#include "hiac/scene/toml/edited_text.hpp"
#include "tests/support/meshes.hpp"
#include "tests/view/open_window.hpp"
#include "tests/view/small_view.hpp"
#include "tools/view/transfer/spec_pane.hpp"
#include "tools/view/transfer/transfer_panel.hpp"

namespace hiac::view {
namespace {

const std::string kPlainColor =
    "[volume.color]\nfield = \"f\"\npoints = [[0, 0.0, 0.0, 1.0], [1, 1.0, 0.0, 0.0]]\n";
const std::string kPlainExtinction =
    "[volume.extinction]\nfield = \"f\"\npoints = [[0.0, 0.5], [1.0, 8.0]]\n";

class PanelChoices : public ::testing::Test {
 protected:
  PanelChoices() {
    QObject::connect(&document_, &Document::message, &document_,
                     [this](const QString& line) { messages_ << line; });
  }
  void open(const std::string& text) {
    ASSERT_TRUE(document_.open(test::mesh_of_f_and_g(2), "m.zoo", text, "view.toml", ""));
    panel_.resize(460, 700);
    panel_.show();
    ASSERT_TRUE(test::wait_until([&] { return panel_.is_at_rest(); }));
  }
  void choose(QComboBox& box, const char* name) {
    const int index = box.findText(QString::fromLatin1(name));
    ASSERT_GE(index, 0) << name;
    box.setCurrentIndex(index);
    Q_EMIT box.activated(index);
    Q_EMIT box.textActivated(box.itemText(index));
    ASSERT_TRUE(test::wait_until([&] { return panel_.is_at_rest(); }));
  }
  QPushButton& button(const char* text) {
    for (auto* found : panel_.findChildren<QPushButton*>())
      if (found->text() == QLatin1String(text)) return *found;
    ADD_FAILURE() << text;
    return *panel_.findChild<QPushButton*>();
  }
  bool has_label(const QString& text) {
    return std::ranges::any_of(panel_.findChildren<QLabel*>(),
                               [&](const QLabel* label) { return label->text() == text; });
  }
  static QStringList items(const QComboBox& box) {
    QStringList texts;
    for (int k = 0; k < box.count(); ++k) texts << box.itemText(k);
    return texts;
  }
  [[nodiscard]] const Volume& volume() const { return document_.scene().volume; }

  Document document_;
  QStringList messages_;
  TransferPanel panel_{document_};
};

TEST_F(PanelChoices, AreThoseOfTheMeshAndOfTheMaps) {
  EXPECT_FALSE(panel_.isEnabled());
  open(test::kSmallView + kPlainColor + kPlainExtinction);
  EXPECT_TRUE(panel_.isEnabled());
  const QStringList fields{QStringLiteral("f"), QStringLiteral("g")};
  EXPECT_EQ(items(panel_.extinction_fields()), fields);
  EXPECT_EQ(items(panel_.color_fields()), fields);
  QStringList maps{QStringLiteral("(points)")};
  for (const std::string& name : built_in_colormap_names()) maps << QString::fromStdString(name);
  EXPECT_EQ(items(panel_.presets()), maps);
  EXPECT_EQ(panel_.presets().currentIndex(), 0);
  EXPECT_EQ(panel_.extinction_fields().currentText(), QStringLiteral("f"));
  EXPECT_FALSE(button("Points").isEnabled());
  choose(panel_.presets(), "magma");
  EXPECT_EQ(panel_.presets().currentText(), QStringLiteral("magma"));
  EXPECT_TRUE(button("Points").isEnabled());
  button("Points").click();
  EXPECT_EQ(document_.text().find("preset"), std::string::npos);
  EXPECT_EQ(panel_.presets().currentIndex(), 0);
  EXPECT_FALSE(button("Points").isEnabled());
}

TEST_F(PanelChoices, NameFieldsThatNoListHas) {
  // without a mesh there are no lists
  ASSERT_TRUE(
      document_.open_text(test::kSmallView + kPlainColor +
                              with_key(kPlainExtinction, "volume.extinction.field", "\"x\""),
                          "", ""));
  EXPECT_EQ(panel_.color_fields().currentText(), QStringLiteral("f"));
  EXPECT_EQ(panel_.extinction_fields().currentText(), QStringLiteral("x"));
  EXPECT_EQ(items(panel_.extinction_fields()), QStringList{QStringLiteral("x")});
  ASSERT_TRUE(document_.edit(QStringLiteral("set"), test::kSmallView + kPlainColor));
  EXPECT_EQ(panel_.extinction_fields().currentText(), QString());
  EXPECT_EQ(items(panel_.extinction_fields()), QStringList{QStringLiteral("x")});
}

TEST_F(PanelChoices, BeginWhatIsNotThereYet) {
  open(test::kSmallView + kPlainExtinction);
  EXPECT_EQ(panel_.color_fields().currentIndex(), -1);
  EXPECT_EQ(panel_.color_fields().currentText(), QString());
  choose(panel_.presets(), "magma");  // by the extinction's field
  ASSERT_TRUE(volume().color.has_value());
  EXPECT_EQ(volume().color->field, "f");
  EXPECT_EQ(volume().color->points.front().scalar, 0);
  EXPECT_EQ(volume().color->points.back().scalar, 1);
  document_.undo_stack().undo();
  choose(panel_.color_fields(), "g");
  EXPECT_EQ(volume().color->field, "g");
  EXPECT_EQ(volume().color->points.front().scalar, 5);
  EXPECT_EQ(volume().color->points.back().scalar, 15);
  EXPECT_EQ(panel_.presets().currentText(), QStringLiteral("viridis"));
  ASSERT_TRUE(document_.edit(QStringLiteral("set"), test::kSmallView + kPlainColor));
  EXPECT_EQ(panel_.curve().field(), "f");
  choose(panel_.extinction_fields(), "g");
  ASSERT_TRUE(volume().extinction.has_value());
  EXPECT_EQ(volume().extinction->field, "g");
  ASSERT_EQ(volume().extinction->points.size(), 1U);
  EXPECT_EQ(volume().extinction->points[0].scalar, 5);
  EXPECT_EQ(volume().extinction->points[0].value[0], 1);
  EXPECT_EQ(panel_.curve().field(), "g");
  EXPECT_EQ(panel_.color_curve().field(), "f");
  EXPECT_TRUE(panel_.color_curve().isVisible());
  EXPECT_TRUE(messages_.isEmpty());
}

TEST_F(PanelChoices, ShowTheHistogramOfEachPlot) {
  open(test::kSmallView + kPlainColor + kPlainExtinction);
  choose(panel_.color_fields(), "g");
  for (TransferCurve* curve : {&panel_.curve(), &panel_.color_curve()}) {
    ASSERT_NE(curve->histogram(), nullptr) << curve->field();
    const VolumeHistogram& found = *curve->histogram();
    EXPECT_EQ(found.volumes.size(), 512U);
    EXPECT_EQ(found.edges.front(), curve->axes().values()[0]);
    EXPECT_NEAR(found.edges.back(), curve->axes().values()[1], 1e-12);
    double whole = 0;
    for (const double part : found.volumes) whole += part;
    EXPECT_NEAR(whole, 1, 1e-9);
  }
  panel_.log_values().setChecked(true);
  ASSERT_TRUE(test::wait_until([&] { return panel_.is_at_rest(); }));
  EXPECT_EQ(panel_.curve().axes().scale(), TransferScale::log);
  EXPECT_EQ(panel_.color_curve().axes().scale(), TransferScale::log);
  EXPECT_NEAR(panel_.curve().histogram()->outside[0], 0, 1e-5);
}

TEST_F(PanelChoices, MultiplyTheDensityByKeysOnceAKey) {
  open(test::kSmallView + kPlainColor + kPlainExtinction);
  QSlider& slider = panel_.density();
  EXPECT_EQ(slider.minimum(), -200);
  EXPECT_EQ(slider.maximum(), 200);
  slider.setValue(100);
  EXPECT_EQ(slider.value(), 0);
  EXPECT_DOUBLE_EQ(volume().extinction->points[1].value[0], 80);
  slider.setValue(-200);
  EXPECT_DOUBLE_EQ(volume().extinction->points[1].value[0], 0.8);
  EXPECT_EQ(document_.undo_stack().count(), 2);
  document_.undo_stack().setIndex(0);
  slider.setSliderDown(true);
  slider.setValue(30);  // ten to the power 0.3
  EXPECT_TRUE(has_label(QStringLiteral("\u00d7 2")));
  EXPECT_NEAR(volume().extinction->points[1].value[0], 8 * 1.995, 1e-9);  // four digits
  slider.setValue(0);                                                     // where the drag began
  EXPECT_FALSE(has_label(QStringLiteral("\u00d7 2")));
  slider.setSliderDown(false);
  Document empty;
  TransferPanel without(empty);
  without.density().setValue(50);
  EXPECT_FALSE(empty.has_scene());
}

TEST_F(PanelChoices, TellTheOpticalDepthAndTheLightThatPasses) {
  EXPECT_TRUE(has_label(QStringLiteral("Optical depth along the mean ray: \u2013")));
  panel_.show_depth(std::log(4.0));
  EXPECT_TRUE(has_label(
      QStringLiteral("Optical depth along the mean ray: 1.39 (25 % of the light passes)")));
  panel_.show_depth(std::nullopt);
  EXPECT_TRUE(has_label(QStringLiteral("Optical depth along the mean ray: \u2013")));
}

TEST_F(PanelChoices, AddAndRemoveByButtons) {
  open(test::kSmallView + kPlainColor + kPlainExtinction);
  button("Add point").click();
  ASSERT_EQ(volume().extinction->points.size(), 3U);
  EXPECT_NEAR(volume().extinction->points[1].scalar, 0.5, 1e-3);
  button("Add isosurface").click();
  ASSERT_EQ(document_.scene().isosurfaces.size(), 1U);
  panel_.curve().choose(ChosenHandle{Handle::surface, 0});
  button("Remove").click();
  EXPECT_TRUE(document_.scene().isosurfaces.empty());
  // what is chosen in the plot of the colour is meant, as long as that is seen
  choose(panel_.color_fields(), "g");
  button("Add point").click();
  panel_.curve().choose(ChosenHandle{Handle::extinction, 0});
  panel_.color_curve().choose(ChosenHandle{Handle::color, 1});
  button("Remove").click();
  EXPECT_EQ(volume().color->points.size(), 1U);
  EXPECT_EQ(volume().extinction->points.size(), 4U);
  EXPECT_FALSE(panel_.color_curve().chosen());
  button("Remove").click();
  EXPECT_EQ(volume().extinction->points.size(), 3U);
}

TEST_F(PanelChoices, ShowInTablesWhatIsChosenInPlotsAndBack) {
  open(test::kSmallView + kPlainColor + kPlainExtinction);
  panel_.curve().choose(ChosenHandle{Handle::color, 1});
  EXPECT_EQ(panel_.tables().currentWidget(), &panel_.tables().colors());
  EXPECT_EQ(panel_.tables().colors().currentRow(), 1);
  panel_.tables().extinctions().selectRow(1);
  EXPECT_EQ(panel_.curve().chosen(), (ChosenHandle{Handle::extinction, 1}));
  EXPECT_EQ(panel_.color_curve().chosen(), std::nullopt);  // has no such point
  choose(panel_.color_fields(), "g");
  panel_.tables().colors().selectRow(0);
  EXPECT_EQ(panel_.color_curve().chosen(), (ChosenHandle{Handle::color, 0}));
}

class SpecPaneTest : public ::testing::Test {
 protected:
  SpecPaneTest() { EXPECT_TRUE(document_.open_text(test::kSmallView + kPlainColor, "v.toml", "")); }
  QPushButton& button(const char* text) {
    for (auto* found : pane_.findChildren<QPushButton*>())
      if (found->text() == QLatin1String(text)) return *found;
    ADD_FAILURE() << text;
    return *pane_.findChild<QPushButton*>();
  }
  void type(const std::string& text) { pane_.editor().setPlainText(QString::fromStdString(text)); }
  [[nodiscard]] std::string typed() { return pane_.editor().toPlainText().toStdString(); }
  bool can_apply() {
    EXPECT_EQ(button("Apply").isEnabled(), button("Revert").isEnabled());
    return button("Apply").isEnabled();
  }

  Document document_;
  SpecPane pane_{document_};
};

TEST_F(SpecPaneTest, AppliesWhatIsTypedByItsButtonAndItsKey) {
  EXPECT_FALSE(can_apply());
  type(with_key(document_.text(), "camera.fov", "25.0"));
  EXPECT_TRUE(can_apply());
  EXPECT_EQ(document_.scene().camera.fov, 30);
  button("Apply").click();
  EXPECT_EQ(document_.scene().camera.fov, 25);
  EXPECT_FALSE(can_apply());
  type(with_key(document_.text(), "camera.fov", "20.0"));
  pane_.show();
  pane_.activateWindow();
  ASSERT_TRUE(test::wait_until([&] { return pane_.isActiveWindow(); }));
  pane_.editor().setFocus();
  QTest::keyClick(&pane_.editor(), Qt::Key_Return, Qt::ControlModifier);
  EXPECT_EQ(document_.scene().camera.fov, 20);
  EXPECT_EQ(document_.undo_stack().count(), 2);
  pane_.apply();  // nothing is typed
  EXPECT_EQ(document_.undo_stack().count(), 2);
}

TEST_F(SpecPaneTest, KeepsWhatIsWrongAndRevertsIt) {
  const std::string before = document_.text(), wrong = before + "nonsense = 1\n";
  type(wrong);
  button("Apply").click();
  EXPECT_TRUE(can_apply());
  EXPECT_EQ(typed(), wrong);
  EXPECT_TRUE(pane_.fault().contains(QStringLiteral("nonsense")));
  type(before);  // typed back
  EXPECT_FALSE(can_apply());
  EXPECT_TRUE(pane_.fault().isEmpty());
  type(wrong);
  EXPECT_TRUE(can_apply());
  button("Revert").click();
  EXPECT_FALSE(can_apply());
  EXPECT_EQ(typed(), before);
}

TEST_F(SpecPaneTest, OpensATextWhereThereIsNone) {
  Document document;
  SpecPane pane(document);
  pane.editor().setPlainText(QString::fromStdString(test::kSmallView + kPlainColor));
  pane.apply();
  ASSERT_TRUE(document.has_scene());
  EXPECT_EQ(document.text(), test::kSmallView + kPlainColor);
  EXPECT_EQ(document.undo_stack().count(), 0);
}

// An edit elsewhere replaces what differs alone.
TEST_F(SpecPaneTest, KeepsTheCursorWhereItIs) {
  for (const char* key : {"image.width", "volume.color.points.1.0", "camera.eye"}) {
    for (const char* word : {"look_at", "width", "points"}) {
      QTextCursor cursor(pane_.editor().document()->find(QString::fromLatin1(word)));
      ASSERT_FALSE(cursor.isNull());
      cursor.clearSelection();
      pane_.editor().setTextCursor(cursor);
      const std::string value = std::string(key) == "camera.eye" ? "[7.5, 1.25, 3.0]" : "17";
      ASSERT_TRUE(document_.edit(QStringLiteral("set"), with_key(document_.text(), key, value)));
      EXPECT_EQ(typed(), document_.text());
      const QTextCursor after = pane_.editor().textCursor();
      EXPECT_TRUE(
          after.block().text().left(after.positionInBlock()).endsWith(QString::fromLatin1(word)))
          << key << " " << word;
      EXPECT_FALSE(pane_.editor().document()->isUndoAvailable());
      document_.undo_stack().undo();
      EXPECT_EQ(typed(), document_.text());
    }
  }
  // one that is as long, and repeats what stands beside it
  for (const char* value : {"400", "4000", "40", "4"}) {
    ASSERT_TRUE(
        document_.edit(QStringLiteral("set"), with_key(document_.text(), "image.width", value)));
    EXPECT_EQ(typed(), document_.text());
    EXPECT_FALSE(can_apply());
  }
}

TEST_F(SpecPaneTest, StaysWhereItIsScrolledTo) {
  std::string text = document_.text();
  for (int k = 0; k < 300; ++k) text += "# a line\n";
  ASSERT_TRUE(document_.edit(QStringLiteral("long"), text));
  pane_.resize(300, 200);
  pane_.show();
  QCoreApplication::processEvents();
  pane_.editor().verticalScrollBar()->setValue(100);
  ASSERT_TRUE(document_.edit(QStringLiteral("set"), with_key(text, "image.width", "50")));
  EXPECT_EQ(pane_.editor().verticalScrollBar()->value(), 100);
}

TEST_F(SpecPaneTest, MarksHeadersAndComments) {
  type(
      "[image]  # small\nwidth = 4\n  [[camera]] \neye = [0, 1, 2]  # near\nname = \"a # b\" # c\n"
      "points = [\n[1, 2],\n# all\n");
  QCoreApplication::processEvents();
  // for every line: where bold ends, and where the comment begins
  struct Line {
    int bold, comment;
  };
  const Line lines[] = {{9, 9}, {0, -1}, {13, -1}, {0, 17}, {0, 15}, {0, -1}, {0, -1}, {0, 0}};
  for (int k = 0; k < 8; ++k) {
    const QTextBlock block = pane_.editor().document()->findBlockByNumber(k);
    int bold = 0, comment = -1;
    for (const QTextLayout::FormatRange& range : block.layout()->formats()) {
      if (range.format.fontWeight() == QFont::Bold && range.length > 0)
        bold = range.start + range.length;
      else if (range.format.hasProperty(QTextFormat::ForegroundBrush) && range.length > 0)
        comment = range.start;
    }
    EXPECT_EQ(bold, lines[k].bold) << block.text().toStdString();
    EXPECT_EQ(comment, lines[k].comment) << block.text().toStdString();
  }
}

}  // namespace
}  // namespace hiac::view
