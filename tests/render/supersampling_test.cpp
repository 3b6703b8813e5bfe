#include "hiac/render/supersampling.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/base/parallel.hpp"
#include "hiac/render/quadratic_bspline.hpp"
#include "hiac/scene/view_of.hpp"
#include "tests/render/truth/general_meshes.hpp"
#include "tests/support/sorting.hpp"

namespace hiac {
namespace {

VisibilityOrder order_of_scene(const ZooMesh& mesh, const Scene& scene) {
  return test::sorted(mesh, view_of(scene.camera)).order;
}

Image sampled(const ZooMesh& mesh, const Scene& scene, const Supersampling& sampling,
              bool with_background = false) {
  return render_supersampled(mesh, order_of_scene(mesh, scene), scene, whole_picture(scene.image),
                             sampling, with_background)
      .image;
}

ZooMesh mesh_with_field() {
  ZooMesh mesh = test::moved(test::random_delaunay(30, 3), test::sheared);
  test::add_random_field(mesh, "f", FieldLocation::node, 3);
  return mesh;
}

// The sum of a box of width 1 convolved with itself twice, as truncated powers have it.
double truncated_powers(double t) {
  constexpr double kBinomial[4] = {1, -3, 3, -1};
  double sum = 0;
  for (int k = 0; k < 4; ++k) sum += kBinomial[k] * std::pow(std::max(t + 1.5 - k, 0.0), 2) / 2;
  return sum;
}

TEST(QuadraticBspline, IsTheBoxConvolvedTwiceWithItself) {
  for (int k = -200; k <= 200; ++k)
    EXPECT_NEAR(quadratic_bspline(k / 100.0), truncated_powers(k / 100.0), 1e-14) << k;
}

TEST(QuadraticBspline, ValuesAPixelApartSumToOne) {
  for (int k = 0; k < 1000; ++k) {
    double sum = 0;
    for (int pixel = -3; pixel <= 3; ++pixel) sum += quadratic_bspline(pixel + k / 1000.0);
    EXPECT_NEAR(sum, 1, 1e-15);
  }
}

// The view ends inside the cube: 1 - exp(-1.5) everywhere, at the picture's border as well.
TEST(Supersampling, AConstantImageStaysConstant) {
  ZooMesh mesh = test::structured(2, test::Cut::bricks);
  test::add_random_field(mesh, "f", FieldLocation::node, 4);
  Scene scene = test::cube_scene(Projection::orthographic, 11, 7);
  test::make_uniform(scene);
  scene.camera.eye = {0.5, 0.5, 4};
  scene.camera.look_at = {0.5, 0.5, 0.5};
  scene.camera.up = {0.3, 1, 0};
  scene.camera.height = 0.35;
  for (const SampleFilter filter : {SampleFilter::box, SampleFilter::bspline})
    for (const std::uint32_t samples : {1U, 2U, 3U, 8U}) {
      const Image image = sampled(mesh, scene, {samples, filter});
      for (std::uint32_t y = 0; y < 7; ++y)
        for (std::uint32_t x = 0; x < 11; ++x) {
          EXPECT_NEAR(image.at(x, y, 3), 1 - std::exp(-1.5), 1e-14) << samples;
          EXPECT_NEAR(image.at(x, y, 1), 0.5 * (1 - std::exp(-1.5)), 1e-14) << samples;
        }
    }
}

TEST(Supersampling, BoxIsTheMeanOfTheLargerPicture) {
  const ZooMesh mesh = mesh_with_field();
  for (const std::uint32_t n : {2U, 3U, 5U}) {
    Scene scene = test::cube_scene(Projection::perspective, 40, 30);
    scene.camera.shift = {2.5, -1.25};
    const Image image = sampled(mesh, scene, {n, SampleFilter::box});
    scene.image = {40 * n, 30 * n};
    scene.camera.shift = {2.5 * n, -1.25 * n};
    const Image larger = test::draw(mesh, scene).image;
    for (std::uint32_t y = 0; y < 30; ++y)
      for (std::uint32_t x = 0; x < 40; ++x)
        for (std::size_t c = 0; c < 4; ++c) {
          double sum = 0;
          for (std::uint32_t j = 0; j < n; ++j) {
            double row = 0;
            for (std::uint32_t i = 0; i < n; ++i) row += larger.at(x * n + i, y * n + j, c);
            sum += row;
          }
          ASSERT_EQ(image.at(x, y, c), sum / (n * n)) << x << ' ' << y << ' ' << c;
        }
  }
}

// Samples are drawn in bands of rows; all of them together are counted as one picture's, and every
// row of them is progress.
TEST(Supersampling, CountsWhatAllSamplesMeet) {
  const ZooMesh mesh = mesh_with_field();
  Scene scene = test::cube_scene(Projection::perspective, 40, 30);
  const VisibilityOrder order = test::sorted(mesh, scene);
  Progress progress;
  const RenderStatistics found = render_supersampled(mesh, order, scene, {3, 5, 30, 23},
                                                     {5, SampleFilter::box}, false, &progress)
                                     .statistics;
  EXPECT_EQ(progress.state().stage, "rows of samples");
  EXPECT_EQ(progress.state().total, 115U);
  EXPECT_EQ(progress.state().done, 115U);
  scene.image = {200, 150};
  const RenderStatistics expected = PartRenderer(mesh, order, scene, {}, nullptr)
                                        .render({15, 25, 150, 115}, false, nullptr)
                                        .statistics;
  EXPECT_EQ(found.segments, expected.segments);
  EXPECT_EQ(found.covered_pixels, expected.covered_pixels);
  EXPECT_NEAR(found.largest_optical_depth, expected.largest_optical_depth, 1e-12);
  EXPECT_NEAR(found.mean_optical_depth, expected.mean_optical_depth, 1e-12);
  EXPECT_GT(found.segments, 1000U);
  EXPECT_GT(found.prepare_seconds, 0);
}

// Against the sum over all samples of a picture with a margin of two pixels.
TEST(Supersampling, BsplineWeighsWhatLiesAround) {
  const ZooMesh mesh = mesh_with_field();
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    constexpr std::uint32_t kWidth = 36, kHeight = 28, kSamples = 3;
    Scene scene = test::cube_scene(projection, kWidth, kHeight);
    scene.camera.fov = 14;  // the cube goes beyond the picture
    scene.camera.height = 0.9;
    const Image image = sampled(mesh, scene, {kSamples, SampleFilter::bspline});
    scene.image = {(kWidth + 4) * kSamples, (kHeight + 4) * kSamples};
    scene.camera.height *= (kHeight + 4.0) / kHeight;
    const double half_degree = std::numbers::pi / 360;
    scene.camera.fov =
        std::atan(std::tan(14 * half_degree) * (kHeight + 4.0) / kHeight) / half_degree;
    const Image larger = test::draw(mesh, scene).image;
    double largest_at_border = 0;
    for (std::uint32_t y = 0; y < kHeight; ++y)
      for (std::uint32_t x = 0; x < kWidth; ++x)
        for (std::size_t c = 0; c < 4; ++c) {
          double expected = 0, weights = 0;
          for (std::uint32_t j = 0; j < scene.image.height; ++j)
            for (std::uint32_t i = 0; i < scene.image.width; ++i) {
              const double dx = (i + 0.5) / kSamples - 2 - (x + 0.5);
              const double dy = (j + 0.5) / kSamples - 2 - (y + 0.5);
              if (std::abs(dx) > 1.5 || std::abs(dy) > 1.5) continue;
              const double weight =
                  truncated_powers(dx) * truncated_powers(dy) / (kSamples * kSamples);
              weights += weight;
              expected += weight * larger.at(i, j, c);
            }
          ASSERT_NEAR(weights, 1, 1e-13);
          ASSERT_NEAR(image.at(x, y, c), expected, 1e-9) << x << ' ' << y << ' ' << c;
          if (x == 0 || y == 0) largest_at_border = std::max(largest_at_border, expected);
        }
    EXPECT_GT(largest_at_border, 0.3);
  }
}

TEST(Supersampling, BsplineKeepsTheEnergy) {
  const ZooMesh mesh = mesh_with_field();
  const Scene scene = test::cube_scene(Projection::perspective, 60, 50);
  std::array<double, 4> box{}, bspline{};
  const Image a = sampled(mesh, scene, {4, SampleFilter::box});
  const Image b = sampled(mesh, scene, {4, SampleFilter::bspline});
  for (std::size_t i = 0; i < a.values().size(); ++i) {
    box[i % 4] += a.values()[i];
    bspline[i % 4] += b.values()[i];
  }
  EXPECT_EQ(a.at(0, 0, 3) + a.at(59, 49, 3), 0);
  for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(bspline[c], box[c], 1e-9 * box[c]);
}

TEST(Supersampling, PartsAndThreadsDoNotChangeABit) {
  const ZooMesh mesh = mesh_with_field();
  Scene scene = test::cube_scene(Projection::perspective, 50, 90);
  scene.background = {BackgroundPattern::grid, {0.1, 0.2, 0.3}, {1, 0.5, 0}, 5};
  const VisibilityOrder order = order_of_scene(mesh, scene);
  for (const SampleFilter filter : {SampleFilter::box, SampleFilter::bspline}) {
    const Supersampling sampling{3, filter};
    const Image whole =
        render_supersampled(mesh, order, scene, whole_picture(scene.image), sampling, true).image;
    for (const unsigned threads : {1U, 3U}) {
      const ThreadLimit limit(threads);
      for (const PixelRect& rect :
           {PixelRect{0, 0, 50, 90}, {17, 9, 20, 41}, {30, 50, 1, 1}, {0, 89, 50, 1}}) {
        const Image part = render_supersampled(mesh, order, scene, rect, sampling, true).image;
        for (std::uint32_t y = 0; y < rect.height; ++y)
          for (std::uint32_t x = 0; x < rect.width; ++x)
            for (std::size_t c = 0; c < 4; ++c)
              ASSERT_EQ(part.at(x, y, c), whole.at(rect.x + x, rect.y + y, c));
      }
    }
  }
}

TEST(Supersampling, BackgroundIsCompositedBehind) {
  const ZooMesh mesh = mesh_with_field();
  Scene scene = test::cube_scene(Projection::perspective, 30, 20);
  scene.background.color = {0.25, 0.5, 0.75};
  for (const SampleFilter filter : {SampleFilter::box, SampleFilter::bspline}) {
    const Image bare = sampled(mesh, scene, {2, filter});
    const Image whole = sampled(mesh, scene, {2, filter}, true);
    for (std::uint32_t y = 0; y < 20; ++y)
      for (std::uint32_t x = 0; x < 30; ++x)
        for (std::size_t c = 0; c < 3; ++c) {
          ASSERT_EQ(whole.at(x, y, 3), bare.at(x, y, 3));
          ASSERT_NEAR(whole.at(x, y, c),
                      bare.at(x, y, c) + (1 - bare.at(x, y, 3)) * scene.background.color[c], 1e-15);
        }
  }
}

TEST(Supersampling, TooManyOrNoSamplesAreRefused) {
  const ZooMesh mesh = mesh_with_field();
  const Scene scene = test::cube_scene(Projection::perspective, 1000, 10);
  for (const std::uint32_t samples : {0U, 66U, 0xffffffffU})
    EXPECT_THROW((void)sampled(mesh, scene, {samples, SampleFilter::box}), UsageError);
}

const std::vector<Channel> kChannels{Channel::error, Channel::depth, Channel::mean_depth,
                                     Channel::transparency, Channel::cells};
enum : std::size_t { kAlpha = 3, kError, kDepth, kMeanDepth, kTransparency, kCells };

Image sampled_with_channels(const ZooMesh& mesh, const Scene& scene, std::uint32_t samples,
                            bool background) {
  return render_supersampled(mesh, order_of_scene(mesh, scene), scene, whole_picture(scene.image),
                             {samples, SampleFilter::box}, background, nullptr, kChannels)
      .image;
}

// One sample a pixel is the picture.
TEST(Supersampling, OneSampleHasTheChannelsOfThePicture) {
  const ZooMesh mesh = mesh_with_field();
  const Scene scene = test::cube_scene(Projection::perspective, 24, 20);
  const Image once = sampled_with_channels(mesh, scene, 1, false);
  const Image plain =
      render(mesh, order_of_scene(mesh, scene), scene, false, nullptr, kChannels).image;
  for (std::uint32_t y = 0; y < 20; ++y)
    for (std::uint32_t x = 0; x < 24; ++x) {
      for (const std::size_t c : {kTransparency, kCells})
        ASSERT_EQ(once.at(x, y, c), plain.at(x, y, c));
      ASSERT_EQ(once.at(x, y, kDepth), plain.at(x, y, kDepth));
      if (std::isinf(plain.at(x, y, kMeanDepth)))
        ASSERT_EQ(once.at(x, y, kMeanDepth), plain.at(x, y, kMeanDepth));
      else
        ASSERT_DOUBLE_EQ(once.at(x, y, kMeanDepth), plain.at(x, y, kMeanDepth));
    }
}

// Channels are means of the samples; depths of those that have one, the mean depth weighted with
// opacity. The error is the mean of the samples', and rounding: 6 N + 8 operations of numbers up to
// the largest, or 1. An error of A shows the background by as much, where that is brightest.
TEST(Supersampling, ChannelsAreMeansOfSamples) {
  constexpr std::uint32_t kSamples = 3, kWidth = 24, kHeight = 20;
  const ZooMesh mesh = mesh_with_field();
  Scene scene = test::cube_scene(Projection::perspective, kWidth, kHeight);
  scene.volume.color->points.back().value = {7, 0.1, 0.1};  // brighter than 1
  scene.background = {BackgroundPattern::checker, {0.4, 0.2, 0.1}, {0.5, 2.5, 1.5}, 3};
  const Image mean = sampled_with_channels(mesh, scene, kSamples, true);
  const Image bare = sampled_with_channels(mesh, scene, kSamples, false);
  Scene fine = scene;
  fine.image = {kWidth * kSamples, kHeight * kSamples};
  const Image samples =
      render(mesh, order_of_scene(mesh, fine), fine, false, nullptr, kChannels).image;
  std::size_t partly = 0;
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      double error = 0, depth = 0, seen = 0, cells = 0, mean_depth = 0, opacity = 0;
      for (std::uint32_t k = 0; k < 9; ++k) {
        const auto sample = samples.pixel(kSamples * x + k % 3, kSamples * y + k / 3);
        error += sample[kError] / 9;
        cells += sample[kCells] / 9;
        if (std::isinf(sample[kDepth])) continue;
        depth += sample[kDepth];
        seen += 1;
        mean_depth += sample[kAlpha] * sample[kMeanDepth];
        opacity += sample[kAlpha];
      }
      if (seen > 0 && seen < 9) ++partly;
      const auto colour = bare.pixel(x, y);
      const double largest = *std::max_element(colour.begin(), colour.begin() + 4);
      const double rounding = (6 * kSamples + 8) * 0x1p-52 * (1 + largest);
      ASSERT_NEAR(bare.at(x, y, kError), error + rounding, 1e-10 * (error + rounding));
      const double behind = (x / 3 + y / 3) % 2 == 0 ? 0.4 : 2.5;
      ASSERT_NEAR(mean.at(x, y, kError), (1 + behind) * (error + rounding),
                  1e-10 * (error + rounding));
      ASSERT_NEAR(mean.at(x, y, kTransparency), 1 - mean.at(x, y, kAlpha), 1e-15);
      ASSERT_NEAR(mean.at(x, y, kCells), cells, 1e-12);
      if (seen == 0) {
        ASSERT_TRUE(std::isinf(mean.at(x, y, kDepth)));
        ASSERT_TRUE(std::isinf(mean.at(x, y, kMeanDepth)));
      } else {
        ASSERT_NEAR(mean.at(x, y, kDepth), depth / seen, 1e-12);
        ASSERT_NEAR(mean.at(x, y, kMeanDepth), mean_depth / opacity, 1e-12);
      }
    }
  EXPECT_GT(partly, 20U);
}

// Sums of samples are no further from those of exact arithmetic than the channel `error` has for
// them.
TEST(Supersampling, RoundingIsNoLessThanThatOfTheSums) {
  constexpr std::uint32_t kSamples = 7;
  const ZooMesh mesh = mesh_with_field();
  Scene scene = test::cube_scene(Projection::perspective, 12, 10);
  const Image mean = sampled_with_channels(mesh, scene, kSamples, false);
  scene.image = {12 * kSamples, 10 * kSamples};
  const Image samples =
      render(mesh, order_of_scene(mesh, scene), scene, false, nullptr, kChannels).image;
  double largest = 0;
  for (std::uint32_t y = 0; y < 10; ++y)
    for (std::uint32_t x = 0; x < 12; ++x) {
      std::array<long double, 5> sum{};
      for (std::uint32_t j = 0; j < kSamples; ++j)
        for (std::uint32_t i = 0; i < kSamples; ++i)
          for (std::size_t c = 0; c < 5; ++c)
            sum[c] += samples.at(kSamples * x + i, kSamples * y + j, c);
      for (long double& value : sum) value /= kSamples * kSamples;
      for (std::size_t c = 0; c < 4; ++c) {
        const auto off = static_cast<double>(std::abs(sum[c] - mean.at(x, y, c)));
        ASSERT_LE(off, mean.at(x, y, kError) - static_cast<double>(sum[kError]));
        largest = std::max(largest, off);
      }
    }
  EXPECT_GT(largest, 0);
}

// The background's pattern is that of the picture's pixels, not of the samples.
TEST(Supersampling, BackgroundIsThatOfThePixels) {
  const ZooMesh mesh = mesh_with_field();
  Scene scene = test::cube_scene(Projection::perspective, 30, 21);
  const Color first{0.25, 0.5, 0.75}, second{1, 0.125, 3};
  for (const SampleFilter filter : {SampleFilter::box, SampleFilter::bspline})
    for (const BackgroundPattern pattern :
         {BackgroundPattern::grid, BackgroundPattern::checker, BackgroundPattern::gradient}) {
      scene.background = {pattern, first, second, 5};
      const Image bare = sampled(mesh, scene, {2, filter});
      const Image whole = sampled(mesh, scene, {2, filter}, true);
      for (std::uint32_t y = 0; y < 21; ++y)
        for (std::uint32_t x = 0; x < 30; ++x)
          for (std::size_t c = 0; c < 3; ++c) {
            double share = y / 20.0;  // of the second colour
            if (pattern == BackgroundPattern::grid) share = x % 5 == 0 || y % 5 == 0 ? 1 : 0;
            if (pattern == BackgroundPattern::checker) share = (x / 5 + y / 5) % 2;
            const double behind = first[c] + share * (second[c] - first[c]);
            ASSERT_NEAR(whole.at(x, y, c), bare.at(x, y, c) + (1 - bare.at(x, y, 3)) * behind,
                        1e-14);
          }
    }
}

}  // namespace
}  // namespace hiac
