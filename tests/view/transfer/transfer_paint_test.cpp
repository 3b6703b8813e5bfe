// What the plot of the transfer functions shows: every line, area, mark and word.

#include <QCoreApplication>
#include <QMouseEvent>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "hiac/scene/toml/edited_text.hpp"
#include "tests/view/recorded_paint.hpp"
#include "tests/view/small_view.hpp"
#include "tools/view/transfer/display_color.hpp"
#include "tools/view/transfer/transfer_curve.hpp"

namespace hiac::view {
namespace {

using test::Drawn;
using test::RecordedPaint;

const std::string kPaintedView = test::kSmallView + R"([volume.color]
field = "f"
points = [[0, 0.0, 0.0, 1.0], [1, 1.0, 0.25, 0.0]]
[volume.extinction]
field = "f"
points = [[0.0, 0.5], [0.5, 2.0], [0.5, 0.0], [1.0, 8.0]]
[[isosurface]]
field = "f"
value = 0.25
color = [0, 1, 0]
opacity = 0.25
[[isosurface]]
field = "g"
value = 0.75
)";

const QColor kBase(255, 255, 255), kInk(0, 0, 0), kChosen(0, 0, 200);

class TransferPaint : public ::testing::Test {
 protected:
  TransferPaint() {
    QPalette colors;
    colors.setColor(QPalette::Base, kBase);
    colors.setColor(QPalette::Text, kInk);
    colors.setColor(QPalette::Highlight, kChosen);
    curve_.setPalette(colors);
    curve_.resize(464, 320);
    EXPECT_TRUE(document_.open_text(kPaintedView, "", ""));
    curve_.show_field("f", {0, 1});
    curve_.show();  // else a change of size is told when it is shown
  }

  [[nodiscard]] const CurveAxes::Box& box() const { return curve_.axes().box(); }
  [[nodiscard]] QRectF plot() const {
    return {QPointF(box().left, box().top), QPointF(box().right, box().bottom)};
  }
  [[nodiscard]] double line() const { return curve_.fontMetrics().height(); }
  [[nodiscard]] double strip_top() const { return box().bottom + 8; }
  void show(const std::vector<double>& edges, const std::vector<double>& volumes,
            std::array<double, 2> outside = {}, double without_value = 0) {
    curve_.show_histogram(std::make_shared<const VolumeHistogram>(
        VolumeHistogram{edges, volumes, outside, without_value}));
  }
  /// The histogram's outline; empty if there is none.
  QPolygonF histogram(QRectF* clip = nullptr) {
    for (const Drawn& shape : RecordedPaint(curve_).of(Drawn::polygon))
      if (shape.pen.style() == Qt::NoPen && shape.brush.color() == mixed(kBase, kInk, 0.22)) {
        if (clip != nullptr) *clip = shape.clip;
        return shape.points;
      }
    return {};
  }
  void hover(double x, double y) {
    QMouseEvent event(QEvent::MouseMove, QPointF(x, y), curve_.mapToGlobal(QPointF(x, y)),
                      Qt::NoButton, Qt::NoButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&curve_, &event);
  }

  Document document_;
  TransferCurve curve_{document_};
};

void expect_box(const QRectF& found, const QRectF& expected) {
  EXPECT_NEAR(found.left(), expected.left(), 1e-9);
  EXPECT_NEAR(found.top(), expected.top(), 1e-9);
  EXPECT_NEAR(found.width(), expected.width(), 1e-9);
  EXPECT_NEAR(found.height(), expected.height(), 1e-9);
}

bool has_point(const Drawn& drawn, const QPointF& point) {
  return std::ranges::any_of(drawn.points, [&](const QPointF& other) {
    return std::hypot(other.x() - point.x(), other.y() - point.y()) < 1e-6;
  });
}

TEST_F(TransferPaint, SaysThatThereIsNoFunctionAndPaintsNoPlot) {
  Document empty;
  TransferCurve none(empty);
  none.resize(800, 320);
  for (TransferCurve* curve : {&none, &curve_}) {
    curve->show_field("", {0, 1});
    const RecordedPaint paint(*curve);
    EXPECT_EQ(paint.words().join(QLatin1Char(' ')),
              QStringLiteral("No transfer function: open a mesh and a specification"));
    EXPECT_EQ(paint.of(Drawn::text).size(), paint.all().size());
  }
}

TEST_F(TransferPaint, HasRoomForLabelsAndTheStripOfColours) {
  expect_box(plot(), {52, 26, 400, 320 - line() - 6 - 26 - 26});
  curve_.resize(30, 30);  // however small the widget is
  expect_box(plot(), {52, 26, 10, 40});
}

TEST_F(TransferPaint, LabelsPowersOfTenAsFarAsThereIsRoom) {
  const double ascent = curve_.fontMetrics().ascent();
  for (const int height : {700, 320, 200, 120}) {
    curve_.resize(464, height);
    const auto [least, most] = curve_.axes().extinctions();
    const int from = static_cast<int>(std::lround(std::log10(least)));
    const int to = static_cast<int>(std::lround(std::log10(most)));
    const double decade = curve_.axes().y_of(least) - curve_.axes().y_of(10 * least);
    int step = 1;
    while (step * decade < 1.4 * line()) ++step;
    const RecordedPaint paint(curve_);
    for (int power = from; power <= to; ++power) {
      const double y = curve_.axes().y_of(std::pow(10, power));
      const auto is_its = [&](const Drawn& drawn) {
        return drawn.words == QStringLiteral("1e%1").arg(power) && drawn.pen.color() == kInk &&
               std::abs(drawn.points[0].y() - (y - line() / 2 + ascent)) < 1;
      };
      const auto is_line = [&](const Drawn& drawn) {
        return drawn.is_line() && drawn.pen.color() == mixed(kBase, kInk, 0.18) &&
               drawn.points == QPolygonF({QPointF(box().left, y), QPointF(box().right, y)});
      };
      const int expected = (to - power) % step == 0 ? 1 : 0;
      EXPECT_EQ(std::ranges::count_if(paint.all(), is_its), expected) << height << " " << power;
      EXPECT_EQ(std::ranges::count_if(paint.all(), is_line), expected) << height << " " << power;
    }
  }
}

TEST_F(TransferPaint, NamesTheFieldAndItsEnds) {
  const auto ends = curve_.axes().values();
  const auto text = [](double value) { return QString::number(value, 'g', 4); };
  const auto rest = [&] {
    QStringList words;
    for (const QString& word : RecordedPaint(curve_).words())
      if (!word.startsWith(QStringLiteral("1e"))) words << word;
    return words;
  };
  EXPECT_EQ(rest(),
            (QStringList{QStringLiteral("0"), text(ends[0]), QStringLiteral("f"), text(ends[1])}));
  for (const Drawn& word : RecordedPaint(curve_).of(Drawn::text)) {
    const double x = word.points[0].x(), y = word.points[0].y();
    const double below = strip_top() + 18 + 3 + curve_.fontMetrics().ascent();
    if (word.words == QStringLiteral("0")) {
      EXPECT_LT(x, box().left);
      EXPECT_NEAR(y, box().bottom - 2 - line() / 2 + curve_.fontMetrics().ascent(), 1);
    } else if (word.words == text(ends[0])) {
      EXPECT_NEAR(x, box().left, 1);
      EXPECT_NEAR(y, below, 1);
    } else if (word.words == QStringLiteral("f")) {
      EXPECT_NEAR(x, (box().left + box().right) / 2, 8);
      EXPECT_NEAR(y, below, 1);
    } else if (word.words == text(ends[1])) {
      const double right = x + curve_.fontMetrics().horizontalAdvance(word.words);
      EXPECT_NEAR(right, box().right, 1);
      EXPECT_NEAR(y, below, 1);
    }
  }
  curve_.set_log_values(true);
  EXPECT_EQ(rest()[2], QStringLiteral("f (log)"));
}

TEST_F(TransferPaint, FramesThePlotAndMarksZero) {
  const RecordedPaint paint(curve_);
  const QColor strong = mixed(kBase, kInk, 0.5);
  const double zero = box().bottom - 8;  // the middle of the gap
  const auto is_zero = [&](const Drawn& drawn) {
    return drawn.is_line() && drawn.pen.style() == Qt::DotLine && drawn.pen.color() == strong &&
           drawn.points == QPolygonF({QPointF(box().left, zero), QPointF(box().right, zero)});
  };
  EXPECT_EQ(std::ranges::count_if(paint.all(), is_zero), 1);
  const auto is_frame = [&](const Drawn& drawn) {
    return drawn.kind == Drawn::rectangle && drawn.box() == plot() && drawn.pen.color() == strong &&
           drawn.brush.style() == Qt::NoBrush;
  };
  EXPECT_EQ(std::ranges::count_if(paint.all(), is_frame), 1);
  const Drawn& ground = paint.all().front();
  EXPECT_EQ(ground.box(), plot());
  EXPECT_EQ(ground.brush.color(), kBase);
  for (const Drawn& drawn : paint.all()) EXPECT_TRUE(drawn.is_smooth);
}

TEST_F(TransferPaint, HasTheHistogramAsHighAsItsVolumes) {
  EXPECT_TRUE(histogram().isEmpty());
  const std::vector<double> edges{0, 0.25, 0.5, 0.75, 1};
  show(edges, {0, 0, 0, 0});
  EXPECT_TRUE(histogram().isEmpty());
  for (const bool is_log : {false, true}) {
    curve_.set_log_counts(is_log);
    show(edges, {1, 4, 0, 4e-7});
    const double shares[] = {is_log ? 1 + std::log10(0.25) / 5 : 0.25, 1, 0, is_log ? 0 : 1e-7};
    QPolygonF expected{{QPointF(curve_.axes().x_of(0), box().bottom)}};
    for (std::size_t k = 0; k < 4; ++k)
      for (const double edge : {edges[k], edges[k + 1]})
        expected << QPointF(curve_.axes().x_of(edge),
                            box().bottom - 0.92 * shares[k] * plot().height());
    expected << QPointF(curve_.axes().x_of(1), box().bottom);
    expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
    QRectF clip;
    const QPolygonF found = histogram(&clip);
    ASSERT_EQ(found.size(), expected.size());
    for (qsizetype k = 0; k < expected.size(); ++k) {
      EXPECT_NEAR(found[k].x(), expected[k].x(), 1e-9);
      EXPECT_NEAR(found[k].y(), expected[k].y(), 1e-9) << is_log << " " << k;
    }
    EXPECT_LT(std::abs(clip.left() - plot().left()), 1);
    EXPECT_LT(std::abs(clip.bottom() - plot().bottom()), 1);
  }
}

TEST_F(TransferPaint, DrawsTheExtinctionThroughItsPointsAndDownItsSteps) {
  const RecordedPaint paint(curve_);
  const auto is_curve = [](const Drawn& drawn) {
    return drawn.is_line() && drawn.pen.color() == kChosen && drawn.pen.widthF() == 2 &&
           drawn.points.size() > 100;
  };
  const auto found = std::ranges::find_if(paint.all(), is_curve);
  ASSERT_NE(found, paint.all().end());
  const QPolygonF& curve = found->points;
  const auto extinction = [](double s) {
    if (s < 0.5) return s < 0 ? 0.5 : 0.5 + 3 * s;
    return s > 1 ? 8.0 : 16 * (s - 0.5);
  };
  EXPECT_GE(curve.size(), 2 * 400);  // two a pixel
  EXPECT_NEAR(curve.front().x(), box().left, 1e-6);
  EXPECT_NEAR(curve.back().x(), box().right, 1e-6);
  for (qsizetype k = 0; k < curve.size(); ++k) {
    if (k > 0) {
      EXPECT_GE(curve[k].x(), curve[k - 1].x());
      EXPECT_LE(curve[k].x(), curve[k - 1].x() + 0.51);
    }
    const double value = curve_.axes().value_along((curve[k].x() - box().left) / 400);
    if (std::abs(value - 0.5) < 1e-3) continue;
    EXPECT_NEAR(curve[k].y(), curve_.axes().y_of(extinction(value)), 1e-6) << value;
  }
  // the step is upright: both of its ends are there
  const double middle = curve_.axes().x_of(0.5);
  for (const double end : {2.0, 0.0}) {
    const double y = curve_.axes().y_of(end);
    EXPECT_TRUE(std::ranges::any_of(curve, [&](const QPointF& p) {
      return std::abs(p.x() - middle) < 1e-6 && std::abs(p.y() - y) < 1e-6;
    })) << end;
  }
  // the area below it, and no farther than the plot and its line's width
  const Drawn& area = *(found - 1);
  EXPECT_TRUE(area.is_closed);
  EXPECT_EQ(area.brush.color(), QColor(0, 0, 200, 36));
  EXPECT_EQ(area.pen.style(), Qt::NoPen);
  EXPECT_EQ(area.points, curve + QPolygonF({plot().bottomRight(), plot().bottomLeft()}));
  for (const Drawn& drawn : {*found, area}) {
    EXPECT_LE(std::abs(drawn.clip.left() - plot().left()), 1);
    EXPECT_LE(std::abs(drawn.clip.top() - (plot().top() - 2)), 1);
    EXPECT_LE(std::abs(drawn.clip.bottom() - (plot().bottom() + 2)), 1);
  }
  document_.edit(QStringLiteral("none"), without_table(kPaintedView, "volume.extinction"));
  EXPECT_EQ(std::ranges::count_if(RecordedPaint(curve_).all(), is_curve), 0);
}

TEST_F(TransferPaint, PaintsTheColoursInAStripBelow) {
  const QRectF strip(box().left, strip_top(), 400, 18);
  const RecordedPaint paint(curve_);
  const auto frame = std::ranges::find_if(paint.all(), [&](const Drawn& drawn) {
    return drawn.kind == Drawn::rectangle && drawn.box() == strip;
  });
  ASSERT_NE(frame, paint.all().end());
  EXPECT_EQ(frame->brush.color(), kBase);
  EXPECT_EQ(frame->pen.color(), mixed(kBase, kInk, 0.5));
  ASSERT_GE(paint.all().end() - frame, 402);
  for (int i = 0; i < 400; ++i) {
    const Drawn& column = *(frame + 1 + i);
    ASSERT_EQ(column.kind, Drawn::rectangle);
    expect_box(column.box(), {strip.left() + i, strip.top() + 1, 1.5, 17});
    const double s = std::clamp(curve_.axes().value_along((i + 0.5) / 400), 0.0, 1.0);
    EXPECT_EQ(column.brush.color(), on_screen({s, 0.25 * s, 1 - s})) << i;
  }
  EXPECT_NE((frame + 401)->kind, Drawn::rectangle);
  document_.edit(QStringLiteral("none"), without_table(kPaintedView, "volume.color"));
  EXPECT_LT(RecordedPaint(curve_).of(Drawn::rectangle).size(), 20U);
}

TEST_F(TransferPaint, PaintsIsosurfacesAsFlagsThatAreAsFullAsTheyAreOpaque) {
  const double x = curve_.axes().x_of(0.25);
  const auto dashes = [&] {
    std::vector<Drawn> found;
    for (const Drawn& drawn : RecordedPaint(curve_).all())
      if (drawn.is_line() && drawn.pen.style() == Qt::DashLine) found.push_back(drawn);
    return found;
  };
  for (const bool is_chosen : {false, true}) {
    if (is_chosen) curve_.choose(ChosenHandle{Handle::surface, 0});
    const auto lines = dashes();
    ASSERT_EQ(lines.size(), 1U);  // the other one is of another field
    EXPECT_EQ(lines[0].points, QPolygonF({QPointF(x, 16), QPointF(x, box().bottom)}));
    EXPECT_EQ(lines[0].pen.color(), is_chosen ? kChosen : kInk);
    EXPECT_DOUBLE_EQ(lines[0].pen.widthF(), is_chosen ? 1.8 : 1);
    const RecordedPaint paint(curve_);
    const auto full = std::ranges::find_if(paint.all(), [](const Drawn& drawn) {
      return drawn.kind == Drawn::rectangle && drawn.brush.color() == QColor(0, 255, 0);
    });
    ASSERT_NE(full, paint.all().end());
    expect_box(full->box(), {x - 5, 22 - 3, 10, 3});  // a quarter of twelve pixels
    const Drawn& flag = *(full - 1);
    expect_box(flag.box(), {x - 6, 9, 12, 14});
    EXPECT_TRUE(has_point(flag, {x - 3, 9}) && has_point(flag, {x - 6, 12}));  // round corners
    EXPECT_EQ(flag.brush.color(), kBase);
    EXPECT_EQ(flag.pen.color(), is_chosen ? kChosen : kInk);
    EXPECT_EQ(flag.pen.widthF(), is_chosen ? 2 : 1);
  }
  // none beside the plot
  for (const auto& [value, count] :
       {std::pair("1.022", 1U), {"1.025", 0U}, {"-0.022", 1U}, {"-0.025", 0U}}) {
    document_.edit(QStringLiteral("move"), with_key(kPaintedView, "isosurface.0.value", value));
    EXPECT_EQ(dashes().size(), count) << value;
  }
}

TEST_F(TransferPaint, PaintsPointsOfTheExtinctionAndTheChosenOneLast) {
  const auto discs = [&] {
    std::vector<Drawn> found;
    for (const Drawn& drawn : RecordedPaint(curve_).of(Drawn::ellipse))
      if (drawn.box().width() == 9) found.push_back(drawn);
    return found;
  };
  const auto place = [&](std::size_t k) {
    const Place at = *curve_.place_of({Handle::extinction, k});
    return QPointF(at.x, at.y);
  };
  auto found = discs();
  ASSERT_EQ(found.size(), 4U);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(found[k].box().center(), place(k));
    EXPECT_EQ(found[k].brush.color(), kBase);
    EXPECT_EQ(found[k].pen.color(), kInk);
    EXPECT_DOUBLE_EQ(found[k].pen.widthF(), 1.3);
    EXPECT_TRUE(found[k].clip.isNull());
  }
  curve_.choose(ChosenHandle{Handle::extinction, 1});
  found = discs();
  ASSERT_EQ(found.size(), 4U);
  EXPECT_EQ(found[1].box().center(), place(2));
  EXPECT_EQ(found[3].box().center(), place(1));
  EXPECT_EQ(found[3].brush.color(), kChosen);
  EXPECT_EQ(found[3].pen.color(), kChosen);
  EXPECT_EQ(found[3].pen.widthF(), 2);
}

TEST_F(TransferPaint, PaintsPointsOfTheColourWithTwoRings) {
  curve_.choose(ChosenHandle{Handle::color, 1});
  std::vector<Drawn> rings;
  for (const Drawn& drawn : RecordedPaint(curve_).of(Drawn::ellipse))
    if (drawn.box().width() > 9) rings.push_back(drawn);
  ASSERT_EQ(rings.size(), 4U);
  for (std::size_t k = 0; k < 2; ++k) {
    const Drawn &inner = rings[2 * k], &outer = rings[2 * k + 1];
    const QPointF at(curve_.axes().x_of(k == 0 ? 0 : 1), strip_top() + 9);
    expect_box(inner.box(), {at.x() - 5, at.y() - 5, 10, 10});
    expect_box(outer.box(), {at.x() - 6, at.y() - 6, 12, 12});
    EXPECT_EQ(inner.pen.color(), kBase);
    EXPECT_EQ(inner.pen.widthF(), 4);
    EXPECT_EQ(outer.pen.color(), k == 1 ? kChosen : kInk);
    EXPECT_DOUBLE_EQ(outer.pen.widthF(), k == 1 ? 2.4 : 1.3);
    EXPECT_EQ(outer.brush.color(), k == 1 ? on_screen({1, 0.25, 0}) : QColor(0, 0, 255));
  }
}

TEST_F(TransferPaint, PutsBracketsAroundAColourMap) {
  const std::string map =
      without_table(kPaintedView, "volume.color") +
      "[volume.color]\nfield = 'f'\npreset = 'viridis'\nrange = [0.125, 0.75]\n";
  ASSERT_TRUE(document_.edit(QStringLiteral("map"), map));
  curve_.choose(ChosenHandle{Handle::color_range, 0});
  std::vector<Drawn> brackets;
  for (const Drawn& drawn : RecordedPaint(curve_).of(Drawn::polygon))
    if (drawn.points.size() == 4 && drawn.is_line()) brackets.push_back(drawn);
  ASSERT_EQ(brackets.size(), 4U);
  for (std::size_t k = 0; k < 4; ++k) {
    const bool is_first = k >= 2;  // the chosen one is painted last
    const double x = curve_.axes().x_of(is_first ? 0.125 : 0.75), in = is_first ? 5 : -5;
    const double top = strip_top() - 2, bottom = strip_top() + 20;
    EXPECT_EQ(brackets[k].points, QPolygonF({QPointF(x + in, top), QPointF(x, top),
                                             QPointF(x, bottom), QPointF(x + in, bottom)}));
    EXPECT_EQ(brackets[k].pen.color(), k % 2 == 0 ? kBase : (is_first ? kChosen : kInk));
    EXPECT_DOUBLE_EQ(brackets[k].pen.widthF(), k % 2 == 0 ? 5 : 2.4);
    EXPECT_EQ(brackets[k].brush.style(), Qt::NoBrush);
  }
}

TEST_F(TransferPaint, TellsOfTheValueBelowTheMouse) {
  const auto told = [&]() -> std::optional<Drawn> {
    for (const Drawn& drawn : RecordedPaint(curve_).of(Drawn::text))
      if (drawn.words.contains(QStringLiteral("extinction")) ||
          drawn.words.contains(QStringLiteral("volume")))
        return drawn;
    return std::nullopt;
  };
  EXPECT_FALSE(told());
  const double value = curve_.axes().value_at(curve_.axes().x_of(0.25));
  ASSERT_NEAR(value, 0.25, 1e-3);
  hover(curve_.axes().x_of(0.25), 100);
  const QString plain = QStringLiteral("0.25  \u00b7  extinction 1.25  \u00b7  half after 0.5545");
  ASSERT_TRUE(told());
  EXPECT_EQ(told()->words, plain);
  // a histogram of which the bin has three of twenty parts
  show({0, 0.25, 0.5, 1}, {5, 3, 2}, {4, 2}, 4);
  EXPECT_EQ(told()->words, plain + QStringLiteral("  \u00b7  15 % of volume"));
  hover(curve_.axes().x_of(1), 100);
  EXPECT_TRUE(told()->words.endsWith(QStringLiteral("10 % of volume")));  // the last is closed
  hover(curve_.axes().x_of(1.01), 100);
  EXPECT_FALSE(told()->words.contains(QStringLiteral("volume")));
  hover(curve_.axes().x_of(-0.01), 100);
  EXPECT_FALSE(told()->words.contains(QStringLiteral("volume")));
  hover(box().left - 1, 100);
  EXPECT_FALSE(told());
  hover(box().right + 1, 100);
  EXPECT_FALSE(told());
  // nothing absorbs at zero extinction: no length
  hover(curve_.axes().x_of(0.5), 100);
  EXPECT_TRUE(told()->words.contains(QStringLiteral("extinction 0")));
  EXPECT_FALSE(told()->words.contains(QStringLiteral("half")));
}

TEST_F(TransferPaint, TellsOfTheChosenPointWhenTheMouseHasLeft) {
  curve_.choose(ChosenHandle{Handle::extinction, 3});
  const auto has = [&](const char* words) {
    return RecordedPaint(curve_).words().join(QLatin1Char('|')).contains(QLatin1String(words));
  };
  EXPECT_TRUE(has("extinction 8"));
  hover(curve_.axes().x_of(0.25), 100);
  EXPECT_TRUE(has("extinction 1.25"));
  EXPECT_FALSE(has("extinction 8"));
  QEvent leave(QEvent::Leave);
  QCoreApplication::sendEvent(&curve_, &leave);
  EXPECT_TRUE(has("extinction 8"));
  curve_.choose(std::nullopt);
  EXPECT_FALSE(has("extinction"));
}

TEST_F(TransferPaint, PutsTheWordsInTheUpperRightCornerOfThePlot) {
  hover(curve_.axes().x_of(0.25), 100);
  const RecordedPaint paint(curve_);
  const auto words = std::ranges::find_if(paint.all(), [](const Drawn& drawn) {
    return drawn.words.contains(QStringLiteral("extinction"));
  });
  ASSERT_NE(words, paint.all().end());
  const Drawn& label = *(words - 1);
  EXPECT_EQ(label.brush.color(), QColor(255, 255, 255, 215));
  EXPECT_EQ(label.pen.style(), Qt::NoPen);
  EXPECT_EQ(words->pen.color(), kInk);
  const double width = curve_.fontMetrics().horizontalAdvance(words->words);
  expect_box(label.box(), {box().right - 4 - width - 10, box().top + 3, width + 10, line() + 4});
  EXPECT_NEAR(words->points[0].x(), box().right - 4 - width - 5, 1);
  EXPECT_TRUE(has_point(label, label.box().topLeft() + QPointF(3, 0)));
  EXPECT_TRUE(has_point(label, label.box().topLeft() + QPointF(0, 3)));
  // in a narrow plot they are cut off
  curve_.resize(160, 320);
  hover(curve_.axes().x_of(0.25), 100);
  const RecordedPaint narrow(curve_);
  const auto cut = std::ranges::find_if(
      narrow.all(), [](const Drawn& drawn) { return drawn.words.contains(QChar(0x2026)); });
  ASSERT_NE(cut, narrow.all().end());
  expect_box((cut - 1)->box(), {56, 29, 160 - 64 - 8, line() + 4});
}

}  // namespace
}  // namespace hiac::view
