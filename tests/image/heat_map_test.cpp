#include "hiac/image/heat_map.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "hiac/image/srgb.hpp"

namespace hiac {
namespace {

TEST(HeatMap, GoesFromBlueToYellowAndMarksWhatIsNotFinite) {
  Image map(6, 1, {"flip"});
  const double values[] = {0, 1, 0.25, 3, std::nan(""), std::numeric_limits<double>::infinity()};
  std::copy(std::begin(values), std::end(values), map.values().begin());
  const Image colors = heat_map(map, 2);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_EQ(colors.at(0, 0, c), srgb_decode(kViridis[0][c] / 255.0));
    EXPECT_EQ(colors.at(1, 0, c), srgb_decode(kViridis[3][c] / 255.0));
    // three quarters of the first step of six
    EXPECT_NEAR(srgb_encode(colors.at(2, 0, c)) * 255,
                0.25 * kViridis[0][c] + 0.75 * kViridis[1][c], 1e-4);
    EXPECT_EQ(colors.at(3, 0, c), srgb_decode(kViridis[6][c] / 255.0));
    for (const std::size_t x : {4u, 5u}) EXPECT_EQ(colors.at(x, 0, c), c == 0 ? 1 : 0);
    EXPECT_EQ(heat_map(map, 0).at(1, 0, c), srgb_decode(kViridis[0][c] / 255.0));
  }
}

}  // namespace
}  // namespace hiac
