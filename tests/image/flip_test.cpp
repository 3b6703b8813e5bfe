#include "hiac/image/flip.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include <gtest/gtest.h>

#include "tests/image/test_folder.hpp"

namespace hiac {
namespace {

using Triple = std::array<double, 3>;
constexpr double kPi = std::numbers::pi;

// FLIP once more, with two-dimensional kernels and plain loops. -----------------------------------

constexpr double kToXyz[3][3] = {
    {10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
    {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
    {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382}};
// white: the sums of the rows

Triple xyz_of(const Triple& rgb) {
  Triple xyz{};
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c) xyz[r] += kToXyz[r][c] * rgb[c];
  return xyz;
}

/// Cramer's rule.
Triple rgb_of(const Triple& xyz) {
  const auto determinant = [](const double(&m)[3][3]) {
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  };
  Triple rgb{};
  for (std::size_t column = 0; column < 3; ++column) {
    double m[3][3];
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c) m[r][c] = c == column ? xyz[r] : kToXyz[r][c];
    rgb[column] = determinant(m) / determinant(kToXyz);
  }
  return rgb;
}

const Triple kWhite = xyz_of({1, 1, 1});

Triple opponent(const Triple& rgb) {
  Triple t = xyz_of(rgb);
  for (std::size_t c = 0; c < 3; ++c) t[c] /= kWhite[c];
  return {116 * t[1] - 16, 500 * (t[0] - t[1]), 200 * (t[1] - t[2])};
}

Triple adjusted_lab(const Triple& rgb) {
  Triple t = xyz_of(rgb);
  for (std::size_t c = 0; c < 3; ++c) {
    t[c] /= kWhite[c];
    t[c] = t[c] > std::pow(6.0 / 29, 3) ? std::pow(t[c], 1.0 / 3)
                                        : std::pow(29.0 / 6, 2) / 3 * t[c] + 4.0 / 29;
  }
  const double lightness = 116 * t[1] - 16;
  return {lightness, lightness / 100 * 500 * (t[0] - t[1]), lightness / 100 * 200 * (t[1] - t[2])};
}

double hyab(const Triple& a, const Triple& b) {
  return std::fabs(a[0] - b[0]) +
         std::sqrt((a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

/// A colour image that goes on beyond its borders.
struct Picture {
  int width, height;
  std::function<Triple(int, int)> color;

  [[nodiscard]] Triple at(int x, int y) const {
    return color(std::min(std::max(x, 0), width - 1), std::min(std::max(y, 0), height - 1));
  }
};

using Kernel = std::function<double(double x, double y)>;

double sum_of(int radius, const Kernel& kernel) {
  double sum = 0;
  for (int j = -radius; j <= radius; ++j)
    for (int i = -radius; i <= radius; ++i) sum += kernel(i, j);
  return sum;
}

double response(const Picture& picture, std::size_t c, int x, int y, int radius,
                const Kernel& kernel) {
  double sum = 0;
  for (int j = -radius; j <= radius; ++j)
    for (int i = -radius; i <= radius; ++i) sum += kernel(i, j) * picture.at(x + i, y + j)[c];
  return sum;
}

Triple seen(const Picture& picture, int x, int y, double ppd) {
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * kPi * kPi)) * ppd));
  const auto term = [ppd](double a, double b, double i, double j) {
    return a * std::sqrt(kPi / b) * std::exp(-kPi * kPi * (i * i + j * j) / (ppd * ppd) / b);
  };
  const Kernel kernels[] = {
      [&](double i, double j) { return term(1, 0.0047, i, j); },
      [&](double i, double j) { return term(1, 0.0053, i, j); },
      [&](double i, double j) { return term(34.1, 0.04, i, j) + term(13.5, 0.025, i, j); }};
  Triple t{};
  for (std::size_t c = 0; c < 3; ++c)
    t[c] = response(picture, c, x, y, radius, kernels[c]) / sum_of(radius, kernels[c]);
  const double level = (t[0] + 16) / 116;
  Triple rgb = rgb_of(
      {kWhite[0] * (level + t[1] / 500), kWhite[1] * level, kWhite[2] * (level - t[2] / 200)});
  for (double& v : rgb) v = std::min(std::max(v, 0.0), 1.0);
  return adjusted_lab(rgb);
}

double feature(const Picture& picture, int x, int y, double ppd, bool edge) {
  const double sigma = 0.5 * 0.082 * ppd;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  const Kernel raw = [&](double i, double j) {
    const double g = std::exp(-(i * i + j * j) / (2 * sigma * sigma));
    return (edge ? -i : i * i / (sigma * sigma) - 1) * g;
  };
  const double positive =
      sum_of(radius, [&](double i, double j) { return std::max(raw(i, j), 0.0); });
  const double negative =
      sum_of(radius, [&](double i, double j) { return std::max(-raw(i, j), 0.0); });
  const Kernel balanced = [&](double i, double j) {
    const double weight = raw(i, j);
    return weight > 0 ? weight / positive : weight / negative;
  };
  // kernels sum to 0: the offset of (Y + 16) / 116 is of no account
  const double along_x = response(picture, 0, x, y, radius, balanced) / 116;
  const double along_y =
      response(picture, 0, x, y, radius, [&](double i, double j) { return balanced(j, i); }) / 116;
  return std::sqrt(along_x * along_x + along_y * along_y);
}

Picture picture_of(const Image& image) {
  return {
      static_cast<int>(image.width()), static_cast<int>(image.height()), [&image](int x, int y) {
        Triple rgb{};
        for (std::size_t c = 0; c < 3; ++c)
          rgb[c] = std::min(
              std::max(image.at(static_cast<std::size_t>(x), static_cast<std::size_t>(y), c), 0.0),
              1.0);
        return opponent(rgb);
      }};
}

double brute_force(const Image& a, const Image& b, int x, int y, double ppd) {
  const Picture pa = picture_of(a), pb = picture_of(b);
  const double largest = std::pow(hyab(adjusted_lab({0, 1, 0}), adjusted_lab({0, 0, 1})), 0.7);
  const double error = std::pow(hyab(seen(pa, x, y, ppd), seen(pb, x, y, ppd)), 0.7);
  const double color = error < 0.4 * largest
                           ? 0.95 * error / (0.4 * largest)
                           : 0.95 + 0.05 * (error - 0.4 * largest) / (0.6 * largest);
  double features = 0;
  for (const bool edge : {true, false})
    features =
        std::max(features, std::fabs(feature(pa, x, y, ppd, edge) - feature(pb, x, y, ppd, edge)));
  return std::pow(color, 1 - std::sqrt(features / std::sqrt(2.0)));
}

// -------------------------------------------------------------------------------------------------

Image constant(const Triple& color) {
  Image image(9, 8, {"R", "G", "B"});
  for (std::size_t i = 0; i < image.values().size(); ++i) image.values()[i] = color[i % 3];
  return image;
}

/// The patterns that the numbers below were made from.
Image pattern(bool second) {
  Image image(32, 24, {"R", "G", "B"});
  for (std::size_t y = 0; y < 24; ++y)
    for (std::size_t x = 0; x < 32; ++x) {
      image.at(x, y, 0) = static_cast<double>((x * 7 + y * (second ? 11 : 13)) % 32) / 31;
      image.at(x, y, 1) = static_cast<double>((x * 5 + y * 3) % 16) / 15 * (second ? 0.8 : 1);
      image.at(x, y, 2) = static_cast<double>((x * x + (second ? 2 : 1) * y) % 23) / 22;
    }
  return image;
}

double mean(const Image& map) {
  return std::accumulate(map.values().begin(), map.values().end(), 0.0) /
         static_cast<double>(map.values().size());
}

TEST(Flip, IsWhatItsDefinitionSays) {
  Image a = random_picture(24, 19), b = random_picture(24, 19);
  std::reverse(b.values().begin(), b.values().end());
  a.at(3, 3, 0) = 7;  // shown as 1
  for (const double ppd : {kFlipPixelsPerDegree, 25.0}) {
    const Image map = *flip_map(a, b, ppd);
    for (std::size_t y = 0; y < 19; y += 3)
      for (std::size_t x = 0; x < 24; x += 4)
        EXPECT_NEAR(map.at(x, y, 0),
                    brute_force(a, b, static_cast<int>(x), static_cast<int>(y), ppd), 1e-6)
            << x << " " << y;
  }
}

// By a transcription of the authors' Python code (NVlabs/flip, python/flip_api.py) in double
// precision.
TEST(Flip, HasTheValuesOfTheAuthorsCode) {
  const Image map = *flip_map(pattern(false), pattern(true));
  EXPECT_NEAR(mean(map), 0.40158146189300775, 1e-8);
  EXPECT_NEAR(map.at(7, 5, 0), 0.33306150154610203, 1e-8);
  EXPECT_NEAR(map.at(0, 0, 0), 0.514174224056129, 1e-8);
  EXPECT_NEAR(mean(*flip_map(pattern(false), pattern(true), 30)), 0.5209318698835985, 1e-8);
  const struct {
    Triple a, b;
    double flip;
  } constants[] = {{{0, 0, 0}, {1, 1, 1}, 0.9673797633394966},
                   {{0, 1, 0}, {0, 0, 1}, 1},
                   {{1, 0, 0}, {0, 1, 0}, 0.9866622751045715},
                   {{.5, .5, .5}, {.51, .5, .5}, 0.0403058241240639},
                   {{.2, .3, .4}, {.25, .3, .4}, 0.14238404751221176}};
  for (const auto& c : constants) {
    const Image even = *flip_map(constant(c.a), constant(c.b));
    for (const double value : even.values()) EXPECT_NEAR(value, c.flip, 1e-7);
  }
}

TEST(Flip, IsSymmetricAndZeroForEqualImages) {
  const Image a = pattern(false), b = pattern(true);
  const Image ab = *flip_map(a, b), ba = *flip_map(b, a), aa = *flip_map(a, a);
  EXPECT_EQ(ab.channels()[0], "flip");
  for (std::size_t i = 0; i < ab.values().size(); ++i) {
    EXPECT_EQ(ab.values()[i], ba.values()[i]);
    EXPECT_GE(ab.values()[i], 0);
    EXPECT_LE(ab.values()[i], 1);
    EXPECT_EQ(aa.values()[i], 0);
  }
}

TEST(Flip, AssumesTheAuthorsDisplay) {
  EXPECT_NEAR(kFlipPixelsPerDegree, 0.7 * 3840 / 0.7 * kPi / 180, 1e-9);
}

TEST(Flip, NeedsFiniteColoursOfOneSize) {
  EXPECT_FALSE(flip_map(Image(2, 2, {"Z"}), Image(2, 2, {"Y"})));
  Image nan(2, 2, {"Y"});
  nan.at(1, 1, 0) = std::nan("");
  EXPECT_FALSE(flip_map(nan, nan));
  EXPECT_THROW(flip_map(Image(2, 1, {"Y"}), nan), std::invalid_argument);
}

}  // namespace
}  // namespace hiac
