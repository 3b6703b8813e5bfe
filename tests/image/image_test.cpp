#include "hiac/image/image.hpp"

#include <limits>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "hiac/base/error.hpp"

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

TEST(Image, MustHoldNumbers) {
  Image image(3, 2, {"R", "depth"});
  image.at(0, 0, 1) = std::numeric_limits<double>::infinity();  // nothing was hit
  EXPECT_NO_THROW(require_numbers(image));
  image.at(2, 1, 0) = std::numeric_limits<double>::quiet_NaN();
  try {
    require_numbers(image);
    FAIL() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), ExitCode::internal);
    EXPECT_NE(std::string(error.what()).find("pixel 2,1: channel R"), std::string::npos);
  }
}

}  // namespace
}  // namespace hiac
