#include "tools/view/viewport/drawing.hpp"

#include <QThread>
#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/base/seconds.hpp"
#include "hiac/image/display_bytes.hpp"
#include "hiac/scene/camera_motion.hpp"
#include "hiac/session/coarse_scene.hpp"
#include "hiac/session/error_bounds.hpp"
#include "hiac/session/session.hpp"
#include "tests/support/instrumented.hpp"
#include "tests/view/drawing_log.hpp"

namespace hiac::view {
namespace {

TEST(Drawing, RefinesToThePictureOfASession) {
  const Wanted wanted = test::wanted_of(4, {700, 500});
  const Picture expected = Session(ZooMesh(*wanted.mesh)).picture(wanted.scene);
  Drawing drawing;
  test::DrawingLog log(drawing);
  ASSERT_TRUE(log.rests(drawing.show(wanted)));
  ASSERT_GE(log.painted.size(), 2U);
  std::uint64_t pixels = 0;
  for (const auto& picture : log.painted) {
    EXPECT_GT(picture->pixels, pixels);
    pixels = picture->pixels;
  }
  EXPECT_EQ(pixels, 700U * 500U);
  EXPECT_TRUE(log.painted.back()->bytes == display_bytes(expected.image));
  EXPECT_TRUE(std::ranges::equal(log.painted.back()->image->values(), expected.image.values()));
  ASSERT_EQ(log.errors.size(), 1U);
  ASSERT_TRUE(log.errors[0].has_value());
  EXPECT_LE(*log.errors[0], 1e-8);
}

// The bound is looked for in bands of rows: what only the first, or only the last one shows counts.
TEST(Drawing, TheBoundIsThatOfTheWholePicture) {
  for (const double shift : {-440.0, 0.0, 440.0}) {
    Wanted wanted = test::wanted_of(2, {600, 900});
    wanted.scene.camera.shift = {0, shift};
    PictureRequest request;
    request.channels = {"error"};
    const auto expected =
        largest_error_bound(Session(ZooMesh(*wanted.mesh)).picture(wanted.scene, request).image);
    ASSERT_TRUE(expected.has_value());
    ASSERT_GT(*expected, 0) << "nothing is seen";
    const Cancellation never;
    EXPECT_EQ(Painter(never).error_bound(wanted), expected) << shift;
  }
}

TEST(Drawing, CoarsePicturesHaveThePixelsOfTheWholeOne) {
  Wanted wanted = test::wanted_of(3, {150, 101});
  wanted.scene.background = {BackgroundPattern::checker, {1, 0, 0}, {0, 0, 1}, 7};
  Cancellation never;
  Painter painter(never);
  const Painted whole = painter.paint(wanted, 1);
  for (const std::uint32_t step : {2U, 3U, 4U, 9U}) {
    const Painted coarse = painter.paint(wanted, step);
    ASSERT_EQ(coarse.bytes.size(), whole.bytes.size());
    const CoarseScene places = coarse_scene(wanted.scene, step);
    std::uint64_t compared = 0;
    for (std::int64_t y = places.top; y < 101; y += step) {
      for (std::int64_t x = places.left; x < 150; x += step) {
        ++compared;
        const auto at = static_cast<std::size_t>(3 * (y * 150 + x));
        for (std::size_t c = 0; c < 3; ++c)
          EXPECT_NEAR(coarse.bytes[at + c], whole.bytes[at + c], 1) << x << "," << y;
      }
    }
    EXPECT_EQ(compared, coarse.pixels) << step;
    EXPECT_LT(coarse.pixels, whole.pixels / (step * step - step)) << step;
  }
}

TEST(Drawing, TakesSeveralRaysAPixelAtRest) {
  Wanted wanted = test::wanted_of(3, {90, 60});
  wanted.samples = 2;
  PictureRequest request;
  request.sampling = Supersampling{2};
  const Picture expected = Session(ZooMesh(*wanted.mesh)).picture(wanted.scene, request);
  Drawing drawing;
  test::DrawingLog log(drawing);
  ASSERT_TRUE(log.rests(drawing.show(wanted)));
  EXPECT_EQ(log.painted.back()->samples, 2U);
  EXPECT_TRUE(log.painted.back()->bytes == display_bytes(expected.image));
}

TEST(Drawing, TellsOfAFieldThatIsNotThere) {
  Wanted wanted = test::wanted_of(2, {90, 60});
  wanted.scene.volume.color->field = "nothing";
  Drawing drawing;
  test::DrawingLog log(drawing);
  ASSERT_TRUE(log.rests(drawing.show(wanted)));
  ASSERT_EQ(log.faults.size(), 1);
  EXPECT_TRUE(log.faults[0].contains(QStringLiteral("nothing")));
  EXPECT_TRUE(log.painted.empty());
  // and goes on with what can be drawn
  wanted.scene.volume.color->field = "f";
  ASSERT_TRUE(log.rests(drawing.show(wanted)));
  EXPECT_FALSE(log.painted.empty());
}

// The picture of the last change is complete at the end, whatever was stopped on the way.
TEST(Drawing, StopsWithinFiftyMillisecondsForAChange) {
  Wanted wanted = test::wanted_of(hiac::test::kInstrumented ? 12 : 37, {900, 700});
  Drawing drawing;
  test::DrawingLog log(drawing);
  ASSERT_TRUE(log.rests(drawing.show(wanted)));
  constexpr int kChanges = hiac::test::kInstrumented ? 5 : 40;
  std::vector<double> waits;
  std::uint64_t number = 0;
  for (int change = 0; change < kChanges; ++change) {
    wanted.scene.camera = orbited(wanted.scene.camera, 3, 1);
    const std::size_t before = log.painted.size();
    number = drawing.show(wanted);
    ASSERT_TRUE(test::wait_until([&] { return log.painted.size() > before; }));
    QThread::msleep(static_cast<unsigned long>(7 * change % 50));  // into a refinement
    const std::size_t after = log.painted.size();
    number = drawing.show(wanted);
    ASSERT_TRUE(test::wait_until([&] { return log.painted.size() > after; }));
    if (drawing.last_stop_seconds() >= 0) waits.push_back(drawing.last_stop_seconds());
  }
  ASSERT_GE(waits.size(), static_cast<std::size_t>(kChanges) / 4);
  std::ranges::sort(waits);
  const double most = waits[waits.size() * 95 / 100];
  RecordProperty("seconds_to_stop_95th_percentile", std::to_string(most));
  std::printf("stopped within %.1f ms (95th percentile of %zu)\n", 1000 * most, waits.size());
  // other work on the same processors may take them for a moment
  EXPECT_LT(most, hiac::test::kInstrumented ? 2.0 : 0.2);
  ASSERT_TRUE(log.rests(number));
  const Picture expected = Session(ZooMesh(*wanted.mesh)).picture(wanted.scene);
  EXPECT_TRUE(log.painted.back()->bytes == display_bytes(expected.image));
}

}  // namespace
}  // namespace hiac::view
