// What the panel shows of the ray of a pixel: the curve over depth, the table and the cell.

#include "tools/view/pixel/pixel_panel.hpp"

#include <QClipboard>
#include <QGuiApplication>
#include <QHelpEvent>
#include <QLabel>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QTextBlock>
#include <QToolTip>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/meshes.hpp"
#include "tests/view/recorded_paint.hpp"
#include "tools/common/picture/pixel_report.hpp"
#include "tools/view/pixel/depth_curve.hpp"

namespace hiac::view {
namespace {

using test::Drawn;
using test::RecordedPaint;

PixelSegment inside(CellId cell, const std::array<double, 2>& depths,
                    const std::array<double, 2>& extinction, double transparency,
                    const Color& color) {
  PixelSegment segment;
  segment.cell = cell;
  segment.kind = CellKind::brick8;
  segment.front = {depths[0], 10 * depths[0], extinction[0], {}, 0};
  segment.back = {depths[1], 10 * depths[1], extinction[1], {}, 0};
  segment.transparency = transparency;
  segment.color = color;
  return segment;
}

/// Two cells, the first one with an isosurface in it, and behind a gap an edge beside all cells.
ExplainedPixel explained_ray() {
  PixelExplanation pixel;
  pixel.segments.push_back(inside(7, {2, 4}, {1, 3}, 0.5, {0.2, 0.1, 0.05}));
  pixel.segments[0].surfaces.push_back({0, 3, {}, 0.5});
  pixel.segments.push_back(inside(5, {4, 6}, {3, 2}, 0.25, {0.3, 0.5, 0.05}));
  PixelSegment edge = inside(kNoCell, {8, 8}, {-9, 99}, 0.125, {0.3, 0.5, 0.25});
  edge.part = RayPart::edge;
  pixel.segments.push_back(edge);
  Scene scene;
  scene.volume.color = {"c", {{0, {0, 0, 0}}}};
  scene.volume.extinction = {"e", {{0, {0}}}};
  scene.isosurfaces.emplace_back();
  return {{std::make_shared<const PixelExplanation>(pixel), nullptr}, scene};
}

class DepthCurveTest : public ::testing::Test {
 protected:
  DepthCurveTest() {
    QPalette colors;
    colors.setColor(QPalette::Mid, QColor(1, 2, 3));
    colors.setColor(QPalette::Text, QColor(4, 5, 6));
    curve_.setPalette(colors);
    curve_.resize(416, 300);
    curve_.show();
  }
  void show(const ExplainedPixel& pixel) {
    curve_.show_pixel(std::make_shared<const ExplainedPixel>(pixel));
  }
  [[nodiscard]] double line() const { return curve_.fontMetrics().height(); }
  [[nodiscard]] QRectF plot() const { return {8, line() + 6, 400, 300 - 3 * line() - 12}; }
  /// Where a depth between 2 and 8 is.
  static double x(double depth) { return 8 + 400 * (depth - 2) / 6; }
  QString tip(double depth, int beside = 0) {
    const QPoint at(static_cast<int>(std::lround(x(depth))) + beside, 50);
    QHelpEvent event(QEvent::ToolTip, at, curve_.mapToGlobal(at));
    QCoreApplication::sendEvent(&curve_, &event);
    return QToolTip::text();
  }

  DepthCurve curve_;
};

void expect_near(const QPolygonF& found, const QPolygonF& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (qsizetype k = 0; k < found.size(); ++k) {
    EXPECT_NEAR(found[k].x(), expected[k].x(), 1e-9) << k;
    EXPECT_NEAR(found[k].y(), expected[k].y(), 1e-9) << k;
  }
}

TEST_F(DepthCurveTest, SaysWhatToDoWhereThereIsNothing) {
  EXPECT_EQ(RecordedPaint(curve_).words(),
            QStringList{QStringLiteral("Click a pixel of the picture")});
  EXPECT_TRUE(tip(4).isEmpty());
  ExplainedPixel empty = explained_ray();
  empty.explanation.pixel = std::make_shared<const PixelExplanation>();
  show(empty);
  const RecordedPaint paint(curve_);
  EXPECT_EQ(paint.words(), QStringList{QStringLiteral("The ray of this pixel meets no cell")});
  EXPECT_EQ(paint.all().size(), 1U);
  EXPECT_TRUE(tip(4).isEmpty());
}

TEST_F(DepthCurveTest, HasAnAreaForWhatEveryCellAdds) {
  show(explained_ray());
  const RecordedPaint paint(curve_);
  struct Area {
    double from, width, share;  // of the largest, which is 0.4 of green
    std::array<double, 3> color;
  };
  const double third = 400 / 3.0;
  const Area areas[] = {{2, third, 0.5, {1, std::sqrt(0.5), 0.5}},
                        {4, third, 1, {0.5, 1, 0}},
                        {8, 1, 0.5, {0, 0, 1}}};  // no thinner than a pixel
  for (std::size_t k = 0; k < 3; ++k) {
    const Drawn& found = paint.all().at(k);
    ASSERT_EQ(found.kind, Drawn::rectangle);
    const double high = areas[k].share * plot().height();
    expect_near(QPolygonF(found.box()),
                QPolygonF(QRectF(x(areas[k].from), plot().bottom() - high, areas[k].width, high)));
    const QColor color = found.brush.color();
    EXPECT_NEAR(color.redF(), areas[k].color[0], 0.01) << k;
    EXPECT_NEAR(color.greenF(), areas[k].color[1], 0.01) << k;
    EXPECT_NEAR(color.blueF(), areas[k].color[2], 0.01) << k;
    EXPECT_EQ(color.alpha(), 110);
  }
  for (const Drawn& drawn : paint.all()) EXPECT_TRUE(drawn.is_smooth);
}

TEST_F(DepthCurveTest, HasNoAreasWhereNothingIsAdded) {
  ExplainedPixel dark = explained_ray();
  PixelExplanation pixel = *dark.explanation.pixel;
  for (PixelSegment& segment : pixel.segments) segment.color = {};
  dark.explanation.pixel = std::make_shared<const PixelExplanation>(pixel);
  show(dark);
  EXPECT_EQ(RecordedPaint(curve_).of(Drawn::rectangle).size(), 1U);  // the frame
  // a segment that adds nothing beside one that does is grey and has no height
  pixel.segments[1].color = pixel.segments[2].color = {0.5, 0, 0};
  dark.explanation.pixel = std::make_shared<const PixelExplanation>(pixel);
  show(dark);
  const RecordedPaint paint(curve_);
  EXPECT_EQ(paint.all()[0].box().height(), 0);
  EXPECT_NEAR(paint.all()[0].brush.color().redF(), 0.5, 0.01);
  EXPECT_NEAR(paint.all()[1].box().height(), plot().height(), 1e-9);
}

TEST_F(DepthCurveTest, FramesThePlotAndMarksTheEndsOfCells) {
  show(explained_ray());
  const RecordedPaint paint(curve_);
  const auto count = [&](const auto& is) { return std::ranges::count_if(paint.all(), is); };
  EXPECT_EQ(count([&](const Drawn& drawn) {
              return drawn.kind == Drawn::rectangle && drawn.box() == plot() &&
                     drawn.pen.color() == QColor(1, 2, 3);
            }),
            1);
  const double bottom = plot().bottom();
  for (const auto& [depth, expected] : {std::pair(2.0, 1), {4.0, 2}, {6.0, 1}, {8.0, 2}})
    EXPECT_EQ(count([&](const Drawn& drawn) {
                return drawn.is_line() && drawn.pen.color() == QColor(1, 2, 3) &&
                       std::abs(drawn.points[0].x() - x(depth)) < 1e-9 &&
                       drawn.points[0].y() == bottom && drawn.points[1].y() == bottom + 5;
              }),
              expected)
        << depth;
}

TEST_F(DepthCurveTest, NamesItsEnds) {
  show(explained_ray());
  const RecordedPaint paint(curve_);
  const std::vector<Drawn> texts = paint.of(Drawn::text);
  EXPECT_EQ(paint.words(),
            (QStringList{QStringLiteral("2"), QStringLiteral("depth"), QStringLiteral("8"),
                         QStringLiteral("e: 1 to 3"), QStringLiteral("transparency: 0 to 1")}));
  const double ascent = curve_.fontMetrics().ascent();
  const auto width = [&](const Drawn& text) {
    return curve_.fontMetrics().horizontalAdvance(text.words);
  };
  for (std::size_t k = 0; k < 5; ++k)
    EXPECT_NEAR(texts[k].points[0].y(), (k < 3 ? plot().bottom() + 5 : 2) + ascent, 1) << k;
  for (const std::size_t k : {0U, 3U}) EXPECT_NEAR(texts[k].points[0].x(), 8, 1);
  EXPECT_NEAR(texts[1].points[0].x() + width(texts[1]) / 2.0, 208, 1);
  for (const std::size_t k : {2U, 4U})
    EXPECT_NEAR(texts[k].points[0].x() + width(texts[k]), 408, 1);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(texts[k].pen.color(), QColor(4, 5, 6));
  EXPECT_EQ(texts[3].pen.color(), QColor(31, 119, 180));
  EXPECT_EQ(texts[4].pen.color(), QColor(120, 120, 120));
  // without an extinction the field of the colour, ten times the depth
  ExplainedPixel clear = explained_ray();
  clear.scene.volume.extinction.reset();
  show(clear);
  EXPECT_TRUE(RecordedPaint(curve_).words().contains(QStringLiteral("c: 20 to 60")));
}

TEST_F(DepthCurveTest, DrawsTheTransparencyBehindEverySegment) {
  show(explained_ray());
  const auto y = [&](double share) { return plot().bottom() - share * plot().height(); };
  std::vector<Drawn> dashed;
  for (const Drawn& drawn : RecordedPaint(curve_).all())
    if (drawn.pen.style() == Qt::DashLine) dashed.push_back(drawn);
  ASSERT_EQ(dashed.size(), 1U);
  EXPECT_EQ(dashed[0].pen.color(), QColor(120, 120, 120));
  EXPECT_DOUBLE_EQ(dashed[0].pen.widthF(), 1.5);
  expect_near(dashed[0].points,
              QPolygonF({QPointF(8, y(1)), QPointF(x(4), y(0.5)), QPointF(x(6), y(0.25)),
                         QPointF(x(8), y(0.25)), QPointF(x(8), y(0.125))}));
}

TEST_F(DepthCurveTest, DrawsTheFieldInCellsAndWhereSurfacesAre) {
  show(explained_ray());
  const RecordedPaint paint(curve_);
  const auto lines = [&](const QColor& color) {
    std::vector<Drawn> found;
    for (const Drawn& drawn : paint.of(Drawn::polygon))
      if (drawn.pen.color() == color) found.push_back(drawn);
    return found;
  };
  const auto y = [&](double field) { return plot().bottom() - (field - 1) / 2 * plot().height(); };
  const auto fields = lines({31, 119, 180});
  ASSERT_EQ(fields.size(), 2U);
  EXPECT_DOUBLE_EQ(fields[0].pen.widthF(), 1.8);
  expect_near(fields[0].points, QPolygonF({QPointF(x(2), y(1)), QPointF(x(4), y(3))}));
  expect_near(fields[1].points, QPolygonF({QPointF(x(4), y(3)), QPointF(x(6), y(2))}));
  const auto surfaces = lines({214, 39, 40});
  ASSERT_EQ(surfaces.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    const double at = k == 0 ? x(3) : x(8);
    expect_near(surfaces[k].points,
                QPolygonF({QPointF(at, plot().top()), QPointF(at, plot().bottom())}));
    EXPECT_DOUBLE_EQ(surfaces[k].pen.widthF(), 1.5);
  }
}

TEST_F(DepthCurveTest, PutsOneDepthAndOneValueInTheMiddleAndAtTheBottom) {
  ExplainedPixel thin = explained_ray();
  PixelExplanation pixel;
  pixel.segments.push_back(inside(7, {2, 2}, {3, 3}, 0.5, {0.2, 0.1, 0.05}));
  thin.explanation.pixel = std::make_shared<const PixelExplanation>(pixel);
  show(thin);
  for (const Drawn& drawn : RecordedPaint(curve_).of(Drawn::polygon))
    if (drawn.pen.color() == QColor(31, 119, 180))
      expect_near(drawn.points,
                  QPolygonF({QPointF(208, plot().bottom()), QPointF(208, plot().bottom())}));
  pixel.segments[0].part = RayPart::skin;  // no cell is passed: there is no field to name
  thin.explanation.pixel = std::make_shared<const PixelExplanation>(pixel);
  show(thin);
  EXPECT_EQ(RecordedPaint(curve_).words().size(), 4);
}

TEST_F(DepthCurveTest, TellsOfTheCellBelowTheMouse) {
  show(explained_ray());
  const QString first = QStringLiteral(
      "cell 7 (brick8)\ndepth 2 to 4 (world units)\ne: 1 to 3\ntransparency behind: 0.5");
  EXPECT_EQ(tip(2, 1), first);
  EXPECT_EQ(tip(4, -1), first);
  const QString second = QStringLiteral(
      "cell 5 (brick8)\ndepth 4 to 6 (world units)\ne: 3 to 2\ntransparency behind: 0.25");
  EXPECT_EQ(tip(4, 1), second);
  EXPECT_EQ(tip(6, -1), second);
  EXPECT_EQ(tip(7), QStringLiteral("depth %1: no cell").arg(2 + 6 * 333 / 400.0, 0, 'g', 4));
  EXPECT_EQ(tip(8, 0), QStringLiteral("depth 8: no cell"));  // an edge is no cell
}

class PixelPanelTest : public ::testing::Test {
 protected:
  PixelPanelTest() {
    mesh_ = std::make_shared<const ZooMesh>(hiac::test::structured(2, hiac::test::Cut::bricks));
  }
  QPlainTextEdit& table() { return *panel_.findChild<QPlainTextEdit*>(); }
  QString cell() { return panel_.findChild<QLabel*>()->text(); }
  QPushButton& button(int k) { return *panel_.findChildren<QPushButton*>().at(k); }
  void put_cursor_on(int line) {
    table().setTextCursor(QTextCursor(table().document()->findBlockByNumber(line)));
  }
  [[nodiscard]] QString told_of(CellId cell) const {
    QStringList nodes;
    for (const NodeId node : mesh_->cell_nodes(cell)) nodes << QString::number(node);
    return QStringLiteral("cell %1, brick8, nodes %2").arg(cell).arg(nodes.join(QLatin1Char(' ')));
  }

  PixelPanel panel_;
  std::shared_ptr<const ZooMesh> mesh_;
};

TEST_F(PixelPanelTest, ShowsNothingWithoutAPixel) {
  EXPECT_TRUE(panel_.text().isEmpty());
  EXPECT_FALSE(button(0).isEnabled());
  EXPECT_FALSE(button(1).isEnabled());
  EXPECT_TRUE(table().isReadOnly());
  panel_.show_pixel(std::make_shared<const ExplainedPixel>(explained_ray()), mesh_);
  panel_.show_pixel(nullptr, nullptr);
  EXPECT_TRUE(table().toPlainText().isEmpty());
  EXPECT_FALSE(button(0).isEnabled());
  EXPECT_TRUE(cell().isEmpty());
}

TEST_F(PixelPanelTest, CopiesItsTableAndItsNumbers) {
  const auto pixel = std::make_shared<const ExplainedPixel>(explained_ray());
  panel_.show_pixel(pixel, mesh_);
  const std::string expected = tools::pixel_table(*pixel->explanation.pixel, pixel->scene);
  EXPECT_EQ(panel_.text().toStdString(), expected);
  EXPECT_EQ(table().toPlainText(), panel_.text());
  ASSERT_TRUE(button(0).isEnabled());
  ASSERT_TRUE(button(1).isEnabled());
  button(0).click();
  EXPECT_EQ(QGuiApplication::clipboard()->text().toStdString(), expected);
  button(1).click();
  EXPECT_EQ(QGuiApplication::clipboard()->text().toStdString(),
            tools::pixel_json(*pixel->explanation.pixel, pixel->scene).dump(2));
}

TEST_F(PixelPanelTest, TellsOfTheCellOfTheLineWithTheCursor) {
  panel_.show_pixel(std::make_shared<const ExplainedPixel>(explained_ray()), mesh_);
  EXPECT_TRUE(cell().isEmpty());  // the table's head
  // a cell has lines for its front, its isosurface and its back
  const QString expected[] = {{}, told_of(7), told_of(7), told_of(7), told_of(5), told_of(5), {}};
  for (int line = 0; line < 7; ++line) {
    put_cursor_on(line);
    EXPECT_EQ(cell(), expected[line]) << line;
  }
  put_cursor_on(4);
  panel_.show_pixel(std::make_shared<const ExplainedPixel>(explained_ray()), nullptr);
  put_cursor_on(4);
  EXPECT_TRUE(cell().isEmpty());
}

}  // namespace
}  // namespace hiac::view
