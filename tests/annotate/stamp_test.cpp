#include "hiac/annotate/stamp.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "hiac/image/srgb.hpp"

namespace hiac {
namespace {

constexpr Color kWhite{1, 1, 1}, kBlack{0, 0, 0};

Image picture_of(std::vector<std::string> channels, const std::vector<double>& pixel) {
  Image image(20, 10, std::move(channels));
  for (std::size_t k = 0; k < image.values().size(); ++k)
    image.values()[k] = pixel[k % pixel.size()];
  return image;
}

/// A filled square of 2 x 2 pixels in the middle of 6 x 6.
Canvas square(const Color& ink) {
  Canvas canvas(6, 6);
  canvas.fill(2, 2, 2, 2, ink);
  return canvas;
}

TEST(Stamp, CoversWhatItCoversAndLeavesTheRestAlone) {
  const std::vector<double> pixel{0.1, 0.2, 0.3, 0.25, 7};
  const Image before = picture_of({"R", "G", "B", "A", "depth"}, pixel);
  Image picture = before;
  const Color ink{0.25, 0.5, 1};
  stamp(picture, square(ink), 3, 1, 1, kWhite, true);
  for (std::size_t y = 0; y < 10; ++y)
    for (std::size_t x = 0; x < 20; ++x) {
      const double away = std::max({5.0 - static_cast<double>(x), static_cast<double>(x) - 6,
                                    3.0 - static_cast<double>(y), static_cast<double>(y) - 4});
      EXPECT_EQ(picture.at(x, y, 4), 7);
      if (away > 1) {
        EXPECT_TRUE(std::ranges::equal(picture.pixel(x, y), before.pixel(x, y))) << x << " " << y;
      } else if (away > 0) {
        EXPECT_GE(picture.at(x, y, 0), 0.1);  // the white halo, less at corners
      } else {
        for (std::size_t c = 0; c < 3; ++c)
          EXPECT_NEAR(picture.at(x, y, c), srgb_decode(ink[c]), 1e-12);
        EXPECT_EQ(picture.at(x, y, 3), 1);
      }
    }
  EXPECT_GT(picture.at(4, 3, 0), 0.25);
}

TEST(Stamp, MixesDisplayValues) {
  Canvas canvas(1, 1);
  canvas.blend(0, 0, kWhite, 0.25);
  Image picture = picture_of({"R", "G", "B"}, {0.5, 0.5, 0});
  stamp(picture, canvas, 2, 3, 0, kWhite, false);
  // the ink's own halo lies below it
  const double halo = 0.75 * 0.25 * 0.5;
  const auto mixed = [&](double before) {
    const double below = halo + (1 - halo) * srgb_encode(before);
    return srgb_decode(0.25 + 0.75 * below);
  };
  EXPECT_NEAR(picture.at(2, 3, 0), mixed(0.5), 1e-12);
  EXPECT_NEAR(picture.at(2, 3, 2), mixed(0), 1e-12);
}

TEST(Stamp, IsPutOverTransparencyPremultiplied) {
  Canvas canvas(1, 1);
  canvas.blend(0, 0, kWhite, 1);
  Image clear = picture_of({"R", "G", "B", "A"}, {0, 0, 0, 0});
  stamp(clear, canvas, 0, 0, 0, kBlack, false);
  EXPECT_NEAR(clear.at(0, 0, 1), 1, 1e-12);
  EXPECT_EQ(clear.at(0, 0, 3), 1);
  Canvas half(3, 1);
  half.blend(1, 0, kBlack, 0.5);
  // straight grey 0.5 at alpha 0.5; without a halo's reach the pixel has ink and halo of one colour
  Image picture = picture_of({"R", "G", "B", "A"}, {0.25, 0.25, 0.25, 0.5});
  stamp(picture, half, 0, 0, 0, kBlack, false);
  const double cover = 1 - (1 - 0.5) * (1 - 0.75 * 0.25);
  const double alpha = cover + (1 - cover) * 0.5;
  EXPECT_NEAR(picture.at(1, 0, 3), alpha, 1e-12);
  EXPECT_LT(picture.at(1, 0, 0), alpha * 0.25);
  EXPECT_EQ(picture.at(0, 0, 0), 0.25);
}

TEST(Stamp, IsCutAtThePicturesEdgesAndDrawsGrey) {
  const Image before = picture_of({"Y"}, {0.5});
  Image picture = before;
  stamp(picture, square(kBlack), -30, 2, 1, kBlack, true);
  stamp(picture, square(kBlack), 5, 100, 1, kBlack, true);
  EXPECT_TRUE(std::ranges::equal(picture.values(), before.values()));
  stamp(picture, square(kBlack), -3, 7, 1, kBlack, true);
  EXPECT_NEAR(picture.at(0, 9, 0), 0, 1e-12);
  Image depth = picture_of({"depth"}, {3});
  stamp(depth, square(kBlack), 0, 0, 1, kBlack, true);
  EXPECT_EQ(depth.at(3, 3, 0), 3);
}

TEST(Stamp, TheHaloIsTheLargestCoverageNearby) {
  // against brute force over all pixels
  Canvas canvas(17, 13);
  canvas.segment({4, 4}, {12, 9}, 1.5, kWhite);
  constexpr int kRadius = 3;
  Image picture = picture_of({"R", "G", "B"}, {1, 1, 1});
  stamp(picture, canvas, 0, 0, kRadius, kBlack, true);
  for (int y = 0; y < 10; ++y)
    for (int x = 0; x < 17; ++x) {
      double spread = 0;
      for (int j = 0; j < 13; ++j)
        for (int i = 0; i < 17; ++i)
          spread = std::max(
              spread,
              canvas.image().at(static_cast<std::size_t>(i), static_cast<std::size_t>(j), 3) *
                  std::clamp(kRadius + 0.5 - std::hypot(i - x, j - y), 0., 1.));
      const auto column = static_cast<std::size_t>(x), row = static_cast<std::size_t>(y);
      const double ink = canvas.image().at(column, row, 3);
      const double expected = srgb_decode(ink + (1 - ink) * (1 - 0.75 * spread));
      EXPECT_NEAR(picture.at(column, row, 0), expected, 1e-9) << x << " " << y;
    }
}

}  // namespace
}  // namespace hiac
