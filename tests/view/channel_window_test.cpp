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

}  // namespace
}  // namespace hiac::view
