#include "hiac/image/image.hpp"

#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

namespace hiac {
namespace {

TEST(Image, LaysValuesOutRowByRowAndPixelByPixel) {
  Image image(3, 2, {"R", "depth"});
  EXPECT_EQ(image.values().size(), 12u);
  image.at(2, 1, 1) = 5;
  EXPECT_EQ(image.values()[(1 * 3 + 2) * 2 + 1], 5);
  image.pixel(0, 0)[0] = 7;
  EXPECT_EQ(image.values()[0], 7);
  EXPECT_EQ(image.channel_index("depth"), 1u);
  EXPECT_FALSE(image.channel_index("A"));
}

TEST(Image, RefusesWhatIsNoImage) {
  EXPECT_THROW(Image(1, 1, {""}), std::invalid_argument);
  EXPECT_THROW(Image(1, 1, {"R", "R"}), std::invalid_argument);
  EXPECT_THROW(Image(1, 1, {"R"}, {1, 2}), std::invalid_argument);
  constexpr std::size_t kHuge = std::numeric_limits<std::size_t>::max() / 4;
  EXPECT_THROW(Image(kHuge, 8, {"R"}), std::invalid_argument);
}

}  // namespace
}  // namespace hiac
