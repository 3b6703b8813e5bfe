#include "hiac/frame/background.hpp"

#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/frame/channels.hpp"

namespace hiac {
namespace {

constexpr Color kFirst{0.1, 0.2, 0.3}, kSecond{0.9, 0.4, 0.6};
constexpr ImageSize kPicture{20, 11};

Color background_of(BackgroundPattern pattern, double size, std::uint32_t x, std::uint32_t y) {
  return background_at({pattern, kFirst, kSecond, size}, kPicture, x, y);
}

TEST(Background, IsSolid) { EXPECT_EQ(background_of(BackgroundPattern::solid, 1, 7, 3), kFirst); }

TEST(Background, HasFieldsOfACheckerFromTheTopLeftOn) {
  for (std::uint32_t y = 0; y < 11; ++y)
    for (std::uint32_t x = 0; x < 20; ++x) {
      EXPECT_EQ(background_of(BackgroundPattern::checker, 4, x, y),
                (x / 4 + y / 4) % 2 == 0 ? kFirst : kSecond);
      // fields of two and a half pixels end after columns 2, 4, 7, 9 ...
      EXPECT_EQ(background_of(BackgroundPattern::checker, 2.5, x, y),
                (2 * x / 5 + 2 * y / 5) % 2 == 0 ? kFirst : kSecond);
    }
}

TEST(Background, HasLinesOfAGridOnePixelWide) {
  for (std::uint32_t y = 0; y < 11; ++y)
    for (std::uint32_t x = 0; x < 20; ++x)
      EXPECT_EQ(background_of(BackgroundPattern::grid, 4, x, y),
                x % 4 == 0 || y % 4 == 0 ? kSecond : kFirst)
          << x << ' ' << y;
}

TEST(Background, ChangesFromTheTopRowToTheBottomRow) {
  for (std::uint32_t y = 0; y < 11; ++y)
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(background_of(BackgroundPattern::gradient, 1, 5, y)[c],
                  kFirst[c] + (kSecond[c] - kFirst[c]) * y / 10, 1e-15);
  const Background gradient{BackgroundPattern::gradient, kFirst, kSecond, 1};
  EXPECT_EQ(background_at(gradient, {3, 1}, 2, 0), kFirst);
  EXPECT_EQ(background_at(gradient, {3, 2}, 2, 1), kSecond);
}

std::string told_of_channels(std::string_view list) {
  try {
    parse_channels(list);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

TEST(ChannelNames, AreParsedInTheirOrder) {
  EXPECT_TRUE(parse_channels("").empty());
  EXPECT_EQ(parse_channels("error,depth,mean_depth,transparency,witness,cells"),
            (std::vector{Channel::error, Channel::depth, Channel::mean_depth, Channel::transparency,
                         Channel::witness, Channel::cells}));
  EXPECT_EQ(parse_channels("depth,"), std::vector{Channel::depth});
  EXPECT_EQ(
      told_of_channels("depth,depths"),
      "no channel is called 'depths' (one of depth, mean_depth, transparency, cells, witness, "
      "error expected)");
  EXPECT_EQ(told_of_channels("cells,depth,cells"), "'cells' is there twice");
  EXPECT_EQ(told_of_channels(",depth"),
            "no channel is called '' (one of " + channel_names() + " expected)");
  EXPECT_EQ(channel_name(Channel::witness), "witness");
  EXPECT_EQ(image_channels(std::vector{Channel::cells}),
            (std::vector<std::string>{"R", "G", "B", "A", "cells"}));
}

}  // namespace
}  // namespace hiac
