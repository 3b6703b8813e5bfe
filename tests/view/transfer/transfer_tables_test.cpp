// The numbers behind the curves, and colours as text.

#include "tools/view/transfer/transfer_tables.hpp"

#include <QApplication>
#include <QColorDialog>
#include <QTableWidget>
#include <QTimer>
#include <cmath>

#include <gtest/gtest.h>

#include "hiac/scene/toml/edited_text.hpp"
#include "tests/view/small_view.hpp"
#include "tools/view/transfer/display_color.hpp"

namespace hiac::view {
namespace {

const std::string kTablesView = test::kSmallView + R"([volume.color]
field = "f"
points = [[0, 0.0, 0.0, 1.0], [1, 0.25, 0.5, 2.0]]
[volume.extinction]
field = "f"
points = [[0.0, 0.5], [0.5, 0.0]]
[[isosurface]]
field = "f"
value = 0.25
color = [1, 0, 0]
opacity = 0.125
[[isosurface]]
field = "g"
value = 3
)";

class TransferTablesTest : public ::testing::Test {
 protected:
  TransferTablesTest() {
    QObject::connect(&document_, &Document::message, &tables_,
                     [this](const QString& line) { messages_ << line; });
    QObject::connect(&tables_, &TransferTables::row_chosen, &tables_,
                     [this](const ChosenHandle& handle) { chosen_.push_back(handle); });
    EXPECT_TRUE(document_.open_text(kTablesView, "", ""));
  }
  static QStringList row(const QTableWidget& table, int row) {
    QStringList texts;
    for (int column = 0; column < table.columnCount(); ++column)
      texts << table.item(row, column)->text();
    return texts;
  }
  static bool is_editable(const QTableWidget& table, int row, int column) {
    return table.item(row, column)->flags().testFlag(Qt::ItemIsEditable);
  }
  static QColor swatch(const QTableWidget& table, int row, int column) {
    return table.item(row, column)->icon().pixmap(12).toImage().pixelColor(6, 6);
  }
  /// Answers the dialog for colours that comes next; an invalid colour dismisses it.
  void answer(const QColor& color) {
    QTimer::singleShot(0, &tables_, [color] {
      auto* dialog = qobject_cast<QColorDialog*>(QApplication::activeModalWidget());
      ASSERT_NE(dialog, nullptr);
      if (color.isValid()) dialog->setCurrentColor(color);
      color.isValid() ? dialog->accept() : dialog->reject();
    });
  }

  Document document_;
  TransferTables tables_{document_};
  QStringList messages_;
  std::vector<ChosenHandle> chosen_;
};

QStringList texts(std::initializer_list<const char*> all) {
  QStringList list;
  for (const char* text : all) list << QString::fromUtf8(text);
  return list;
}

TEST_F(TransferTablesTest, ShowEveryNumber) {
  const QTableWidget &e = tables_.extinctions(), &c = tables_.colors(), &s = tables_.surfaces();
  ASSERT_EQ(e.rowCount(), 2);
  EXPECT_EQ(row(e, 0), texts({"0", "0.5", "1.38629"}));
  EXPECT_EQ(row(e, 1), texts({"0.5", "0", "\u221e"}));
  ASSERT_EQ(c.rowCount(), 2);
  EXPECT_EQ(row(c, 0), texts({"0", "#0000ff"}));
  EXPECT_EQ(row(c, 1), texts({"1", "0.25 0.5 2"}));
  EXPECT_EQ(swatch(c, 0, 1), QColor(0, 0, 255));
  EXPECT_EQ(swatch(c, 1, 1), QColor(137, 188, 255));  // encoded for the screen, cut at 1
  ASSERT_EQ(s.rowCount(), 2);
  EXPECT_EQ(row(s, 0), texts({"f", "0.25", "#ff0000", "0.125"}));
  EXPECT_EQ(row(s, 1)[0], QStringLiteral("g"));
  EXPECT_EQ(row(s, 1)[3], QStringLiteral("1"));
  EXPECT_EQ(swatch(s, 0, 2), QColor(255, 0, 0));
  for (const QTableWidget* table : {&e, &c, &s})
    for (int column = 0; column < table->columnCount(); ++column)
      EXPECT_TRUE(is_editable(*table, 0, column)) << column;
  for (int tab = 0; tab < 3; ++tab)
    EXPECT_EQ(tables_.tabText(tab), texts({"Extinction", "Colour", "Isosurfaces"})[tab]);
  ASSERT_TRUE(document_.open_text(
      without_table(without_table(kTablesView, "volume.extinction"), "isosurface.1"), "", ""));
  EXPECT_EQ(e.rowCount(), 0);
  EXPECT_EQ(s.rowCount(), 1);
}

TEST_F(TransferTablesTest, OfAColourMapAreNotEdited) {
  EXPECT_TRUE(tables_.colors().toolTip().isEmpty());
  const std::string map = without_table(kTablesView, "volume.color") +
                          "[volume.color]\nfield = 'f'\npreset = 'viridis'\nrange = [0, 1]\n";
  ASSERT_TRUE(document_.edit(QStringLiteral("map"), map));
  EXPECT_GT(tables_.colors().rowCount(), 2);
  for (int column = 0; column < 2; ++column) {
    EXPECT_FALSE(is_editable(tables_.colors(), 0, column));
    EXPECT_FALSE(is_editable(tables_.colors(), 1, column));
  }
  EXPECT_TRUE(tables_.colors().toolTip().contains(QStringLiteral("turn it into points")));
  document_.undo_stack().undo();
  EXPECT_TRUE(is_editable(tables_.colors(), 1, 0));
}

TEST_F(TransferTablesTest, RefuseWhatIsNoNumberAndNoColour) {
  struct Wrong {
    QTableWidget& table;
    int column;
    const char *text, *told;
  };
  QTableWidget &e = tables_.extinctions(), &c = tables_.colors(), &s = tables_.surfaces();
  const char* const number = "\"%1\": not a number (expected a finite number)";
  const char* const color = "\"%1\": not a colour";
  const char* const length = "a half-value length is positive";
  for (const Wrong& wrong : {Wrong{e, 0, "one", number},
                             {e, 1, "nan", number},
                             {e, 1, "inf", number},
                             {e, 2, "", number},
                             {e, 2, "0", length},
                             {e, 2, "-1", length},
                             {c, 0, "1,5", number},
                             {c, 1, "7", color},
                             {s, 1, "x", number},
                             {s, 2, "#12", color},
                             {s, 3, "x", number}}) {
    messages_.clear();
    const QString before = wrong.table.item(0, wrong.column)->text();
    wrong.table.item(0, wrong.column)->setText(QString::fromUtf8(wrong.text));
    QString told = QString::fromUtf8(wrong.told);
    if (told.contains(QStringLiteral("%1"))) told = told.arg(QString::fromUtf8(wrong.text));
    EXPECT_EQ(messages_, QStringList{told});
    EXPECT_EQ(wrong.table.item(0, wrong.column)->text(), before) << wrong.text;
  }
  EXPECT_EQ(document_.text(), kTablesView);
  EXPECT_EQ(document_.undo_stack().count(), 0);
}

TEST_F(TransferTablesTest, TakeNumbersWithBlanksAroundThem) {
  tables_.extinctions().item(1, 2)->setText(QStringLiteral(" 4 "));
  EXPECT_DOUBLE_EQ(document_.scene().volume.extinction->points[1].value[0], std::log(2.0) / 4);
  tables_.extinctions().item(1, 2)->setText(QStringLiteral(" \u221e "));
  EXPECT_EQ(document_.scene().volume.extinction->points[1].value[0], 0);
  tables_.colors().item(1, 0)->setText(QStringLiteral("1.5"));
  EXPECT_EQ(document_.scene().volume.color->points[1].scalar, 1.5);
  EXPECT_EQ(document_.scene().volume.color->points[1].value, (Color{0.25, 0.5, 2}));
  tables_.surfaces().item(1, 1)->setText(QStringLiteral("-7e-3"));
  EXPECT_EQ(document_.scene().isosurfaces[1].value, -7e-3);
  EXPECT_EQ(document_.undo_stack().count(), 4);
}

TEST_F(TransferTablesTest, ShowTheHandleOfTheCurvesAndTellOfAChosenRow) {
  tables_.show_handle(ChosenHandle{Handle::surface, 1});
  EXPECT_EQ(tables_.currentWidget(), &tables_.surfaces());
  EXPECT_EQ(tables_.surfaces().currentRow(), 1);
  tables_.show_handle(ChosenHandle{Handle::color, 1});
  EXPECT_EQ(tables_.currentWidget(), &tables_.colors());
  EXPECT_EQ(tables_.colors().currentRow(), 1);
  tables_.show_handle(ChosenHandle{Handle::extinction, 0});
  EXPECT_EQ(tables_.currentWidget(), &tables_.extinctions());
  EXPECT_EQ(tables_.extinctions().currentRow(), 0);
  tables_.show_handle(ChosenHandle{Handle::color_range, 1});  // has no row
  tables_.show_handle(std::nullopt);
  EXPECT_EQ(tables_.currentWidget(), &tables_.extinctions());
  EXPECT_TRUE(chosen_.empty());
  tables_.surfaces().selectRow(0);
  tables_.colors().selectRow(0);
  tables_.extinctions().selectRow(1);
  EXPECT_EQ(chosen_, (std::vector<ChosenHandle>{
                         {Handle::surface, 0}, {Handle::color, 0}, {Handle::extinction, 1}}));
}

TEST_F(TransferTablesTest, TakeColoursFromADialog) {
  answer(QColor(0, 255, 0));
  tables_.pick_color({Handle::surface, 0});
  EXPECT_EQ(document_.scene().isosurfaces[0].color, (Color{0, 1, 0}));
  answer(QColor(255, 255, 0));
  tables_.pick_color({Handle::color, 1});
  EXPECT_EQ(document_.scene().volume.color->points[1].value, (Color{1, 1, 0}));
  EXPECT_EQ(document_.scene().volume.color->points[1].scalar, 1);
  document_.undo_stack().setIndex(0);
  answer(QColor());
  tables_.pick_color({Handle::color, 1});
  answer(QColor(137, 188, 255));  // as it is shown: brighter than the screen it stays
  tables_.pick_color({Handle::color, 1});
  EXPECT_EQ(document_.text(), kTablesView);
}

TEST(DisplayColor, IsEncodedRoundedAndCut) {
  EXPECT_EQ(on_screen({0.21404114048223255, 0, 1}), QColor(128, 0, 255));  // half grey is 127.5
  EXPECT_EQ(on_screen({-1, 7, 0.002}), QColor(0, 255, 7));  // the linear part: 255 * 12.92 * 0.002
  for (int level = 0; level < 256; level += 5) {
    const QColor color(level, 255 - level, level / 2);
    EXPECT_EQ(on_screen(from_screen(color)), color);
  }
  EXPECT_NEAR(from_screen(QColor(188, 137, 99))[0], 0.503, 1e-3);
  EXPECT_NEAR(from_screen(QColor(188, 137, 99))[1], 0.250, 1e-3);
  EXPECT_NEAR(from_screen(QColor(188, 137, 99))[2], 0.125, 1e-3);
}

TEST(DisplayColor, IsReadFromNamesAndLinearNumbers) {
  EXPECT_EQ(color_from(QStringLiteral(" red ")), (Color{1, 0, 0}));
  EXPECT_EQ(color_from(QStringLiteral("#00ff00")), (Color{0, 1, 0}));
  EXPECT_EQ(color_from(QStringLiteral("0,0.5, 1e3")), (Color{0, 0.5, 1000}));
  EXPECT_EQ(color_from(QStringLiteral("0 0 0")), (Color{0, 0, 0}));
  EXPECT_EQ(color_from(QStringLiteral("red green")), std::nullopt);
  const QString most = QString::number(kLargestColor, 'g', 17);
  EXPECT_EQ(color_from(most + QStringLiteral(" 0 0")), (Color{kLargestColor, 0, 0}));
  EXPECT_EQ(color_from(QString::number(1.01 * kLargestColor, 'g', 17) + QStringLiteral(" 0 0")),
            std::nullopt);
  EXPECT_EQ(color_text({1.0 / 3, 2.0 / 3, 1.0 / 7}), QStringLiteral("0.333333 0.666667 0.142857"));
}

TEST(DisplayColor, MixesByShares) {
  const QColor a(10, 20, 30), b(110, 0, 33);
  EXPECT_EQ(mixed(a, b, 0), a);
  EXPECT_EQ(mixed(a, b, 1), b);
  EXPECT_EQ(mixed(a, b, 0.25), QColor(35, 15, 31));
}

}  // namespace
}  // namespace hiac::view
