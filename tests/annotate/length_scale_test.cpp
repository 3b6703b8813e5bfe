#include "hiac/annotate/length_scale.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "hiac/annotate/ticks.hpp"
#include "hiac/base/error.hpp"
#include "hiac/frame/projection.hpp"
#include "tests/annotate/annotated_scene.hpp"

namespace hiac {
namespace {

using test::colored_scene;

std::array<double, 3> cross(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// How far apart two points are in the picture: look_at, and a length beside it across the view.
double projected_length(const Scene& scene, double length) {
  const Camera& camera = scene.camera;
  const std::array<double, 3> across = cross(view_direction(camera), camera.up);
  const double size = std::hypot(across[0], across[1], across[2]);
  std::array<double, 3> beside = camera.look_at;
  for (std::size_t k = 0; k < 3; ++k) beside[k] += across[k] / size * length;
  const Projector projector(camera, scene.image);
  const auto a = projector.project_extended(camera.look_at);
  const auto b = projector.project_extended(beside);
  return static_cast<double>(std::hypot(a[0] - b[0], a[1] - b[1]));
}

/// The length of the bar as it is drawn: the coverage along its row between the caps' ends.
double drawn_length(const AnnotationPart& part) {
  const Canvas canvas = test::drawn(part);
  double longest = 0;
  for (int y = 0; y < canvas.height(); ++y) {
    double sum = 0, run = 0;
    for (int x = 0; x < canvas.width(); ++x) {
      const double alpha = test::alpha(canvas, x, y);
      run = alpha > 0 ? run + alpha : 0;
      sum = std::max(sum, run);
    }
    longest = std::max(longest, sum);
  }
  return longest;
}

Scene parallel(Scene scene, double height) {
  scene.camera.projection = Projection::orthographic;
  scene.camera.height = height;
  return scene;
}

TEST(LengthScale, IsAsLongAsTheProjectionOfItsLength) {
  const Scene scene = colored_scene({700, 500});
  for (const Scene& view : {scene, parallel(scene, 3.7), parallel(scene, 1.1e5)}) {
    const double per_unit = projected_length(view, 1);
    for (const double share : {0.1, 0.21, 0.4}) {
      LengthAnnotation wanted;
      wanted.size = {share, false};
      const double length = round_below(share * 500 / per_unit);
      EXPECT_NEAR(drawn_length(length_scale(wanted, view, {15})), length * per_unit, 0.02);
      wanted.length = 0.77 * length;
      EXPECT_NEAR(drawn_length(length_scale(wanted, view, {15})), 0.77 * length * per_unit, 0.02);
    }
  }
}

TEST(LengthScale, IsARoundNumberThatFits) {
  for (const double height : {1e-80, 0.3, 1.0, 7.0, 123.0, 1e90}) {
    const Scene scene = parallel(colored_scene({400, 400}), height);
    const double bar = drawn_length(length_scale({}, scene, {12}));
    EXPECT_LE(bar, 100.01);
    EXPECT_GE(bar, 39.9);  // the next round number is 2.5 times as large at most
  }
}

TEST(LengthScale, SaysThatPerspectiveHoldsAtTheCentre) {
  // the words make the part wider
  const Scene scene = colored_scene({700, 500});
  LengthAnnotation wanted;
  wanted.length = 1;
  const Scene flat = parallel(scene, 500 / projected_length(scene, 1));
  EXPECT_NEAR(pixels_per_unit(flat), pixels_per_unit(scene), 1e-9);
  const double words = Text(30).width(" at the centre");
  EXPECT_NEAR(length_scale(wanted, scene, {30}).width,
              std::max(Text(30).width("1") + words, pixels_per_unit(scene)) + 6, 1);
  EXPECT_NEAR(length_scale(wanted, flat, {30}).width,
              std::max(Text(30).width("1"), pixels_per_unit(scene)) + 6, 1);
}

TEST(LengthScale, RefusesALengthBeyondThePicture) {
  LengthAnnotation wanted;
  wanted.length = 1e9;
  EXPECT_THAT(
      [&] {
        length_scale(wanted, colored_scene({700, 500}), {15});
      },
      testing::ThrowsMessage<InputError>(
          testing::HasSubstr("key `annotation.scale`: a length of 1000000000 is")));
}

// At 20 pixels an em: a halo of 2, a line of text 24 high with its baseline at 19, 2 between it and
// the caps, which are 12 high, a bar 3 thick, and caps 2 wide.
TEST(LengthScale, IsABarBetweenCapsBelowItsLabel) {
  Scene scene = parallel(colored_scene({700, 500}), 500);  // a pixel a unit
  LengthAnnotation wanted;
  wanted.length = 100;
  const AnnotationPart part = length_scale(wanted, scene, {20});
  EXPECT_EQ(part.name, "scale");
  EXPECT_EQ(part.width, 104);
  EXPECT_EQ(part.height, 2 + 24 + 2 + 12 + 2);
  const Canvas canvas = test::drawn(part);
  for (int y = 26; y < part.height; ++y)
    for (int x = 0; x < part.width; ++x) {
      const bool in_bar = x >= 2 && x < 102, in_caps = in_bar && (x < 4 || x >= 100);
      const bool across = y >= 28 + 4 && y < 28 + 4 + 3, down = y >= 28 && y < 28 + 12;
      EXPECT_NEAR(test::alpha(canvas, x, y), (in_bar && across) || (in_caps && down) ? 1 : 0, 1e-9)
          << x << " " << y;
    }
  int first = 1000, last = 0, lowest = 0;
  for (int y = 0; y < 26; ++y)
    for (int x = 0; x < part.width; ++x)
      if (test::alpha(canvas, x, y) > 0.2) {
        first = std::min(first, x);
        last = std::max(last, x);
        lowest = std::max(lowest, y);
      }
  EXPECT_NEAR((first + last + 1) / 2.0, 52, 1.5);  // "100" above the middle of the bar
  EXPECT_NEAR(lowest, 2 + 19 - 1, 1);
  // a bar that is shorter than its label stands below the middle of it
  wanted.length = 10;
  wanted.unit = "kilometres";
  const AnnotationPart wide = length_scale(wanted, scene, {20});
  const double label = Text(20).width("10 kilometres");
  EXPECT_EQ(wide.width, static_cast<int>(std::ceil(label)) + 4);
  const Canvas drawn = test::drawn(wide);
  const int start = 2 + static_cast<int>((label - 10) / 2);
  for (int x = 0; x < wide.width; ++x)
    EXPECT_NEAR(test::alpha(drawn, x, 33), x >= start && x < start + 10 ? 1 : 0, 1e-9) << x;
}

TEST(LengthScale, MayBeAsWideAsThePicture) {
  const Scene scene = parallel(colored_scene({700, 500}), 500);
  LengthAnnotation wanted;
  wanted.length = 700;
  EXPECT_NO_THROW(length_scale(wanted, scene, {20}));
  wanted.length = 700.001;
  EXPECT_THROW(length_scale(wanted, scene, {20}), InputError);
}

}  // namespace
}  // namespace hiac
