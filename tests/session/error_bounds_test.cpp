#include "hiac/session/error_bounds.hpp"

#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/render/bounds/bounded_scene.hpp"

namespace hiac {
namespace {

TEST(ErrorBounds, TheLargestIsThatOfAllPixels) {
  Image image(2, 2, {"R", "error", "depth"});
  image.at(0, 0, 0) = 9;
  image.at(1, 0, 1) = 1e-12;
  image.at(0, 1, 1) = 3e-12;
  image.at(1, 1, 2) = 5;
  EXPECT_EQ(largest_error_bound(image), 3e-12);
}

TEST(ErrorBounds, NoneIsKnownOfPicturesWithoutTheChannelOrWithUnknownPixels) {
  EXPECT_EQ(largest_error_bound(Image(2, 2, {"R", "G", "B", "A"})), std::nullopt);
  Image image(2, 1, {"error"});
  image.at(1, 0, 0) = std::numeric_limits<double>::infinity();
  EXPECT_EQ(largest_error_bound(image), std::nullopt);
}

TEST(ErrorBounds, AreClaimedUnlessTheReasonIsGiven) {
  Scene scene;
  EXPECT_EQ(reason_unbounded(scene), std::nullopt);
  scene.skin.emplace();
  EXPECT_EQ(reason_unbounded(scene), std::nullopt);
  scene.render.splat_below = 2;
  EXPECT_EQ(reason_unbounded(scene), "no bound is claimed of splats (`render.splat_below`)");
  scene.render.splat_below = 0;
  scene.render.integration = Integration::gauss5;
  EXPECT_NE(reason_unbounded(scene), std::nullopt);
}

}  // namespace
}  // namespace hiac
