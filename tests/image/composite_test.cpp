#include "hiac/image/composite.hpp"

#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/image/test_folder.hpp"

namespace hiac {
namespace {

Image pixel(std::vector<std::string> channels, std::vector<double> values) {
  return {1, 1, std::move(channels), std::move(values)};
}

void expect_values(const Image& image, const std::vector<double>& expected) {
  ASSERT_EQ(image.values().size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(image.values()[i], expected[i], 1e-15) << i;
}

TEST(Composite, AddsWhatShinesThrough) {
  Image front = pixel({"R", "G", "B", "A", "depth"}, {0.5, 0, 0.25, 0.75, 7});
  composite_over(front, pixel({"depth", "A", "B", "G", "R"}, {3, 0.5, 0.4, 1, 2}));
  expect_values(front, {1, 0.25, 0.35, 0.875, 7});

  Image grey = pixel(rgba_channels(), {0, 0.5, 0, 0.5});
  composite_over(grey, pixel({"Y"}, {1}));  // opaque
  expect_values(grey, {0.5, 1, 0.5, 1});
}

TEST(Composite, IsAssociativeAndHasTheEmptyImageAsItsOne) {
  const Image a = random_picture(9, 5), b = random_picture(9, 5, {"A", "R", "G", "B"});
  const Image c = random_picture(9, 5, {"B", "G", "R", "A"});
  Image left = a, right(9, 5, rgba_channels());
  composite_over(left, b);
  composite_over(left, c);
  composite_over(right, b);  // over nothing: b in the usual order
  const Image in_order = right;
  composite_over(right, c);
  Image whole = a;
  composite_over(whole, right);
  for (std::size_t i = 0; i < whole.values().size(); ++i)
    EXPECT_NEAR(whole.values()[i], left.values()[i], 1e-15);
  for (std::size_t x = 0; x < 9; ++x) EXPECT_EQ(in_order.at(x, 2, 3), b.at(x, 2, 0));
  Image over_nothing = a;
  composite_over(over_nothing, Image(9, 5, rgba_channels()));
  EXPECT_TRUE(std::equal(a.values().begin(), a.values().end(), over_nothing.values().begin()));
}

TEST(Composite, NeedsAlphaInFrontColourBehindAndOneSize) {
  Image front = pixel(rgba_channels(), {0, 0, 0, 0});
  EXPECT_THROW(composite_over(front, pixel({"A"}, {1})), std::invalid_argument);
  EXPECT_THROW(composite_over(front, Image(1, 2, rgba_channels())), std::invalid_argument);
  Image opaque = pixel({"R", "G", "B"}, {0, 0, 0});
  EXPECT_THROW(composite_over(opaque, front), std::invalid_argument);
  Image grey = pixel({"Y", "A"}, {0, 0});
  EXPECT_THROW(composite_over(grey, front), std::invalid_argument);
}

// Of the channels that are put behind: colours and alpha, whatever further ones there are.
TEST(Composite, NumbersThatAreNotFiniteAreFound) {
  Image back(4, 3, {"depth", "R", "G", "B", "A"});
  EXPECT_EQ(not_finite_in(back), std::nullopt);
  back.at(0, 0, 0) = std::numeric_limits<double>::infinity();
  EXPECT_EQ(not_finite_in(back), std::nullopt);
  back.at(3, 2, 4) = -std::numeric_limits<double>::infinity();
  EXPECT_EQ(not_finite_in(back),
            "pixel 3,2: channel A is not finite (a finite number expected, -inf found)");
  back.at(2, 1, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(not_finite_in(back),
            "pixel 2,1: channel B is not finite (a finite number expected, nan found)");
  Image grey(2, 2, {"Y"});
  EXPECT_EQ(not_finite_in(grey), std::nullopt);
  grey.at(1, 0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(not_finite_in(grey)->starts_with("pixel 1,0: channel Y"));
}

}  // namespace
}  // namespace hiac
