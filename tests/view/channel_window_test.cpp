#include "tools/view/channels/channel_window.hpp"

#include <QCheckBox>
#include <QComboBox>
#include <QSettings>
#include <QStringList>
#include <limits>

#include <gtest/gtest.h>

#include "hiac/image/display_bytes.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/view/channels/channel_picture.hpp"

namespace hiac::view {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// 3 x 1 pixels with a depth that ends nowhere in the last one.
Image picture() {
  return Image(3, 1, {"R", "G", "B", "A", "depth"},
               {0, 0.5, 1, 1, 1, 0.2, 0.3, 0.4, 1, 100, 0, 0, 0, 0, kInfinity});
}

using Bytes = std::vector<std::uint8_t>;

TEST(ChannelPicture, IsGreyOverTheFiniteRange) {
  const auto range = finite_range(picture(), 4);
  ASSERT_TRUE(range.has_value());
  EXPECT_EQ((*range)[0], 1);
  EXPECT_EQ((*range)[1], 100);
  EXPECT_EQ(channel_bytes(picture(), 4, *range, false), (Bytes{0, 0, 0, 255, 255, 255, 255, 0, 0}));
  EXPECT_EQ(channel_bytes(picture(), 4, {1, 199}, false),
            (Bytes{0, 0, 0, 128, 128, 128, 255, 0, 0}));
  EXPECT_EQ(channel_bytes(picture(), 4, {1, 10000}, true),
            (Bytes{0, 0, 0, 128, 128, 128, 255, 0, 0}));
  // zeros have no logarithm
  EXPECT_EQ(channel_bytes(picture(), 0, {0.2, 0.4}, true), (Bytes{255, 0, 0, 0, 0, 0, 255, 0, 0}));
}

TEST(ChannelPicture, HasNoRangeWithoutFiniteValues) {
  EXPECT_EQ(finite_range(Image(1, 1, {"Y"}, {kInfinity}), 0), std::nullopt);
}

TEST(ChannelWindow, ShowsColoursAndEveryChannel) {
  const hiac::test::ScratchFolder folder;
  QSettings settings(QString::fromStdString(folder.file("s.ini")), QSettings::IniFormat);
  QStringList faults;
  const Bindings bindings(settings, faults);
  ChannelWindow window(picture(), QStringLiteral("p.exr"), bindings);
  ASSERT_EQ(window.choice().count(), 6);
  const auto shown = [&](int x) { return window.viewport().image().pixelColor(x, 0); };
  const auto colors = display_bytes(picture());
  EXPECT_EQ(shown(0), QColor(colors[0], colors[1], colors[2]));
  EXPECT_FALSE(window.logarithmic().isEnabled());
  window.choice().setCurrentText(QStringLiteral("depth"));
  EXPECT_EQ(shown(1), QColor(255, 255, 255));
  EXPECT_EQ(shown(2), QColor(255, 0, 0));
  EXPECT_TRUE(window.range_text().contains(QStringLiteral("100")));
  EXPECT_TRUE(window.logarithmic().isEnabled());
  Q_EMIT window.viewport().hovered(QPoint(1, 0));
  EXPECT_TRUE(window.pixel_text().contains(QStringLiteral("depth 100")));
}

TEST(ChannelPicture, IsGreyInTheMiddleWhereAllValuesAreOne) {
  EXPECT_EQ(channel_bytes(Image(2, 1, {"Y"}, {7, 7}), 0, {7, 7}, false),
            (Bytes{128, 128, 128, 128, 128, 128}));
  EXPECT_EQ(channel_bytes(Image(3, 1, {"Y"}, {-1, 0.5, 9}), 0, {0, 1}, false),  // cut
            (Bytes{0, 0, 0, 128, 128, 128, 255, 255, 255}));
  const auto range = finite_range(Image(2, 2, {"a", "b"}, {1, -5, 3, kInfinity, 2, -7, 0, 4}), 1);
  EXPECT_EQ(range, (std::array<double, 2>{-7, 4}));
}

TEST(ChannelWindow, TellsOfRangesAndPixelsAndOffersLogarithms) {
  const hiac::test::ScratchFolder folder;
  QSettings settings(QString::fromStdString(folder.file("s.ini")), QSettings::IniFormat);
  QStringList faults;
  const Bindings bindings(settings, faults);
  const Image grey(3, 2, {"depth", "zero", "none"},
                   {1, 0, kInfinity, 10, 2, kInfinity, 100, 1, kInfinity, 1, 0, -kInfinity, 1, 0,
                    kInfinity, 1, 0, kInfinity});
  ChannelWindow window(grey, QStringLiteral("p.exr"), bindings);
  EXPECT_EQ(window.windowTitle(), QStringLiteral("p.exr \u2013 hiac-view"));
  const auto level = [&](int x) { return window.viewport().image().pixelColor(x, 0).red(); };
  ASSERT_EQ(window.choice().count(), 3);  // there are no colours
  EXPECT_EQ(window.range_text(), QStringLiteral("depth: black 1, white 100, red: not finite"));
  EXPECT_EQ(level(1), 23);
  EXPECT_TRUE(window.logarithmic().isEnabled());
  window.logarithmic().setChecked(true);
  EXPECT_EQ(level(1), 128);
  // zero has no logarithm: grey stays even in the value, whatever was chosen
  window.choice().setCurrentText(QStringLiteral("zero"));
  EXPECT_FALSE(window.logarithmic().isEnabled());
  EXPECT_EQ(level(0), 0);
  EXPECT_EQ(level(2), 128);
  window.choice().setCurrentText(QStringLiteral("none"));
  EXPECT_EQ(window.range_text(), QStringLiteral("no finite value"));
  EXPECT_FALSE(window.logarithmic().isEnabled());
  EXPECT_TRUE(window.viewport().image().isNull());
  window.choice().setCurrentText(QStringLiteral("depth"));
  EXPECT_EQ(level(1), 128);
  Q_EMIT window.viewport().hovered(QPoint(1, 0));
  EXPECT_EQ(window.pixel_text(), QStringLiteral("pixel 1,0: depth 10 zero 2 none inf"));
  Q_EMIT window.viewport().hovered(std::nullopt);
  EXPECT_TRUE(window.pixel_text().isEmpty());
  ChannelWindow thirds(Image(2, 1, {"depth"}, {1.0 / 3, 2.0 / 3}), QStringLiteral("t"), bindings);
  EXPECT_EQ(thirds.range_text(),
            QStringLiteral("depth: black 0.333333, white 0.666667, red: not finite"));
  Q_EMIT thirds.viewport().hovered(QPoint(0, 0));
  EXPECT_EQ(thirds.pixel_text(), QStringLiteral("pixel 0,0: depth 0.333333"));
  ChannelWindow colors(picture(), QStringLiteral("q.exr"), bindings);
  EXPECT_EQ(colors.range_text(), QStringLiteral("3 x 1 pixels, colours in sRGB"));
  EXPECT_EQ(colors.choice().itemText(0), QStringLiteral("colours"));
  EXPECT_FALSE(colors.choice().accessibleName().isEmpty());
}

}  // namespace
}  // namespace hiac::view
