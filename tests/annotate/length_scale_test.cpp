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

}  // namespace
}  // namespace hiac
