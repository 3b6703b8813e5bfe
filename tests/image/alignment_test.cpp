#include "hiac/image/alignment.hpp"

#include <array>
#include <cmath>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

#include "hiac/image/srgb.hpp"

namespace hiac {
namespace {

// A scene that is known everywhere: soft spots of different colours, none in the middle.
double spots(double x, double y, std::size_t channel) {
  constexpr std::array<std::array<double, 4>, 4> kSpots{{{0.3, 0.35, 0.10, 0.9},
                                                         {0.68, 0.3, 0.07, 0.6},
                                                         {0.42, 0.72, 0.13, 0.4},
                                                         {0.7, 0.6, 0.05, 0.8}}};
  double sum = 0.02;
  for (std::size_t k = 0; k < kSpots.size(); ++k) {
    const auto [at_x, at_y, size, height] = kSpots[k];
    const double share = (k + channel) % 3 == 0 ? 0.3 : 1;
    sum += share * height *
           std::exp(-((x - at_x) * (x - at_x) + (y - at_y) * (y - at_y)) / (2 * size * size));
  }
  return std::min(sum, 1.0);
}

// The spots where the middle of a pixel sees them: shifted, in pixels, and scaled about the middle.
Image picture(std::size_t width, std::size_t height, std::array<double, 2> shift = {0, 0},
              double scale = 1) {
  Image image(width, height, {"R", "G", "B"});
  const double middle_x = static_cast<double>(width) / 2,
               middle_y = static_cast<double>(height) / 2;
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x)
      for (std::size_t c = 0; c < 3; ++c) {
        const double px = middle_x + (static_cast<double>(x) + 0.5 - middle_x - shift[0]) / scale;
        const double py = middle_y + (static_cast<double>(y) + 0.5 - middle_y - shift[1]) / scale;
        image.at(x, y, c) =
            spots(px / static_cast<double>(width), py / static_cast<double>(height), c);
      }
  return image;
}

template <typename Change>
Image changed(Image image, const Change& change) {
  for (double& value : image.values()) value = change(value);
  return image;
}

TEST(Alignment, FindsNothingInThePictureItself) {
  const Misfit misfit = find_misfit(picture(90, 70), picture(90, 70));
  EXPECT_EQ(misfit.rmse, 0);
  EXPECT_FALSE(misfit.orientation || misfit.encoding || misfit.place);
}

TEST(Alignment, FindsNothingInNoise) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> noise(0, 0.02);
  const Image reference = picture(90, 70);
  const Image image = changed(reference, [&](double v) { return v + noise(random); });
  const Misfit misfit = find_misfit(image, reference);
  EXPECT_NEAR(misfit.rmse, 0.02, 0.001);
  EXPECT_FALSE(misfit.orientation || misfit.encoding || misfit.place);
}

TEST(Alignment, FindsShifts) {
  const Image reference = picture(160, 120);
  for (const std::array<double, 2> shift :
       {std::array{0.5, 0.5}, {-0.05, 0.0}, {0.0, 1.0}, {3.3, -2.7}, {-14.0, 9.0}}) {
    const Misfit misfit = find_misfit(picture(160, 120, shift), reference);
    EXPECT_FALSE(misfit.orientation || misfit.encoding);
    ASSERT_TRUE(misfit.place) << shift[0] << "," << shift[1];
    EXPECT_NEAR(misfit.place->shift[0], shift[0], 0.01);
    EXPECT_NEAR(misfit.place->shift[1], shift[1], 0.01);
    EXPECT_NEAR(misfit.place->scale, 1, 2e-4);
    EXPECT_LT(misfit.place->rmse, 0.05 * misfit.rmse);
  }
}

TEST(Alignment, FindsScales) {
  const Image reference = picture(160, 120);
  for (const double scale : {0.9, 0.995, 1.002, 1.1}) {
    const Misfit misfit = find_misfit(picture(160, 120, {0.25, -1}, scale), reference);
    ASSERT_TRUE(misfit.place) << scale;
    EXPECT_NEAR(misfit.place->scale, scale, 5e-4);
    EXPECT_NEAR(misfit.place->shift[0], 0.25, 0.02);
    EXPECT_NEAR(misfit.place->shift[1], -1, 0.02);
  }
}

TEST(Alignment, FindsWhichWayAPictureIsTurned) {
  const std::size_t side = 64;
  const Image reference = picture(side, side);
  const auto turned = [&](Orientation orientation) {
    Image image = reference;
    for (std::size_t y = 0; y < side; ++y)
      for (std::size_t x = 0; x < side; ++x) {
        const std::size_t across = side - 1 - x, up = side - 1 - y;
        // where the reference's pixel (x, y) goes to
        std::array<std::size_t, 2> to{};
        switch (orientation) {
          case Orientation::mirrored:
            to = {across, y};
            break;
          case Orientation::upside_down:
            to = {x, up};
            break;
          case Orientation::half_turned:
            to = {across, up};
            break;
          case Orientation::transposed:
            to = {y, x};
            break;
          case Orientation::turned_left:  // what was at the right end is at the top
            to = {y, across};
            break;
          case Orientation::turned_right:  // what was at the top is at the right end
            to = {up, x};
            break;
          case Orientation::antitransposed:
            to = {up, across};
            break;
        }
        for (std::size_t c = 0; c < 3; ++c) image.at(to[0], to[1], c) = reference.at(x, y, c);
      }
    return image;
  };
  using enum Orientation;
  for (const Orientation orientation : {mirrored, upside_down, half_turned, transposed, turned_left,
                                        turned_right, antitransposed}) {
    const Misfit misfit = find_misfit(turned(orientation), reference);
    ASSERT_TRUE(misfit.orientation) << name_of(orientation);
    EXPECT_EQ(misfit.orientation->orientation, orientation) << name_of(orientation);
    EXPECT_EQ(misfit.orientation->rmse, 0);
    EXPECT_FALSE(misfit.encoding || misfit.place);
  }
}

TEST(Alignment, FindsWrongEncodings) {
  const Image reference = picture(90, 70);
  const Misfit encoded = find_misfit(changed(reference, srgb_encode), reference);
  ASSERT_TRUE(encoded.encoding);
  EXPECT_EQ(encoded.encoding->encoding, Encoding::encoded_once_more);
  EXPECT_LT(encoded.encoding->rmse, 1e-12);
  const Misfit decoded = find_misfit(changed(reference, srgb_decode), reference);
  ASSERT_TRUE(decoded.encoding);
  EXPECT_EQ(decoded.encoding->encoding, Encoding::decoded_once_more);

  Image premultiplied(90, 70, rgba_channels()), straight(90, 70, rgba_channels());
  for (std::size_t y = 0; y < 70; ++y)
    for (std::size_t x = 0; x < 90; ++x) {
      const double alpha = 0.1 + 0.8 * static_cast<double>(x) / 90;
      for (std::size_t c = 0; c < 3; ++c) {
        straight.at(x, y, c) = reference.at(x, y, c);
        premultiplied.at(x, y, c) = alpha * reference.at(x, y, c);
      }
      straight.at(x, y, 3) = premultiplied.at(x, y, 3) = alpha;
    }
  const Misfit of_alpha = find_misfit(straight, premultiplied);
  ASSERT_TRUE(of_alpha.encoding);
  EXPECT_EQ(of_alpha.encoding->encoding, Encoding::straight);
  EXPECT_LT(of_alpha.encoding->rmse, 1e-12);
}

TEST(Alignment, FindsOneThingBehindTheOther) {
  Image image = changed(picture(90, 70, {1.5, 0}), srgb_encode);
  const Image upright = image;
  for (std::size_t y = 0; y < 70; ++y)
    for (std::size_t x = 0; x < 90; ++x)
      for (std::size_t c = 0; c < 3; ++c) image.at(x, y, c) = upright.at(x, 69 - y, c);
  const Misfit misfit = find_misfit(image, picture(90, 70));
  ASSERT_TRUE(misfit.orientation);
  EXPECT_EQ(misfit.orientation->orientation, Orientation::upside_down);
  ASSERT_TRUE(misfit.encoding);
  ASSERT_TRUE(misfit.place);
  EXPECT_NEAR(misfit.place->shift[0], 1.5, 0.01);
}

TEST(Alignment, KnowsNothingOfOtherSizesAndOfPicturesWithoutColour) {
  EXPECT_THROW(find_misfit(picture(20, 10), picture(10, 20)), std::invalid_argument);
  const Misfit misfit = find_misfit(Image(20, 20, {"depth"}), picture(20, 20));
  EXPECT_EQ(misfit.rmse, 0);
  EXPECT_FALSE(misfit.place);
  Image broken = picture(20, 20);
  broken.at(3, 3, 0) = std::nan("");
  EXPECT_TRUE(std::isfinite(find_misfit(broken, picture(20, 20)).rmse));
}

TEST(Alignment, DisplacementsFromAFiftiethOfAPixelOnAreTold) {
  const Image reference = picture(160, 120);
  EXPECT_TRUE(find_misfit(picture(160, 120, {0.03, 0}), reference).place);
  EXPECT_TRUE(find_misfit(picture(160, 120, {0, -0.03}), reference).place);
  EXPECT_FALSE(find_misfit(picture(160, 120, {0.01, 0}), reference).place);
  EXPECT_FALSE(find_misfit(picture(160, 120, {-0.007, 0.007}), reference).place);
  // the corners move by 100 pixels times what the scale is from 1
  EXPECT_TRUE(find_misfit(picture(160, 120, {0, 0}, 1.0003), reference).place);
  EXPECT_FALSE(find_misfit(picture(160, 120, {0, 0}, 0.9999), reference).place);
}

TEST(Alignment, SaysHowFarAwayThePictureWas) {
  const Image reference = picture(90, 70);
  const Image moved = picture(90, 70, {2, 1});
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t y = 1; y + 1 < 70; ++y)  // inside, where slopes are known
    for (std::size_t x = 1; x + 1 < 90; ++x, ++count) {
      const auto luminance = [&](const Image& image) {
        return 0.2126 * image.at(x, y, 0) + 0.7152 * image.at(x, y, 1) + 0.0722 * image.at(x, y, 2);
      };
      const double difference = luminance(moved) - luminance(reference);
      sum += difference * difference;
    }
  const Misfit misfit = find_misfit(moved, reference);
  ASSERT_TRUE(misfit.place);
  EXPECT_NEAR(misfit.place->rmse_before, std::sqrt(sum / static_cast<double>(count)), 1e-12);
  EXPECT_LT(misfit.place->rmse, 0.01 * misfit.place->rmse_before);
}

}  // namespace
}  // namespace hiac
