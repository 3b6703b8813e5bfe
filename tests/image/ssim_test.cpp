#include "hiac/image/ssim.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/image/test_folder.hpp"

namespace hiac {
namespace {

/// The luma of the displayed image, by hand.
double luma(const Image& image, std::size_t x, std::size_t y) {
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double v = std::min(std::max(image.at(x, y, c), 0.0), 1.0);
    const double encoded = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
    sum += encoded * (c == 0 ? 0.299 : c == 1 ? 0.587 : 0.114);
  }
  return sum;
}

/// Window by window, from centred moments.
double brute_force(const Image& a, const Image& b) {
  double weights[11][11], total = 0;
  for (int j = 0; j < 11; ++j)
    for (int i = 0; i < 11; ++i)
      total += weights[j][i] = std::exp(-((i - 5) * (i - 5) + (j - 5) * (j - 5)) / (2 * 1.5 * 1.5));
  double sum = 0;
  std::size_t windows = 0;
  for (std::size_t y = 0; y + 11 <= a.height(); ++y)
    for (std::size_t x = 0; x + 11 <= a.width(); ++x, ++windows) {
      double ma = 0, mb = 0, va = 0, vb = 0, cov = 0;
      const auto each = [&](const auto& visit) {
        for (std::size_t j = 0; j < 11; ++j)
          for (std::size_t i = 0; i < 11; ++i)
            visit(weights[j][i] / total, luma(a, x + i, y + j), luma(b, x + i, y + j));
      };
      each([&](double w, double p, double q) {
        ma += w * p;
        mb += w * q;
      });
      each([&](double w, double p, double q) {
        va += w * (p - ma) * (p - ma);
        vb += w * (q - mb) * (q - mb);
        cov += w * (p - ma) * (q - mb);
      });
      const double c1 = 1e-4, c2 = 9e-4;
      sum += (2 * ma * mb + c1) * (2 * cov + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
    }
  return sum / static_cast<double>(windows);
}

Image disturbed(Image image, double by) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> noise(-by, by);
  for (double& value : image.values()) value += noise(random);
  return image;
}

TEST(StructuralSimilarity, IsWhatItsDefinitionSays) {
  for (const auto& [width, height] : {std::pair{11u, 11u}, {30u, 17u}, {12u, 25u}}) {
    const Image a = random_picture(width, height);
    for (const double by : {0.01, 0.3}) {
      const Image b = disturbed(a, by);
      EXPECT_NEAR(*structural_similarity(a, b), brute_force(a, b), 1e-11);
      EXPECT_EQ(*structural_similarity(a, b), *structural_similarity(b, a));
      EXPECT_LT(*structural_similarity(a, b), 1);
    }
    EXPECT_EQ(*structural_similarity(a, a), 1);
  }
}

TEST(StructuralSimilarity, OfConstantsComparesLuminanceAlone) {
  Image a(13, 12, {"Y"}), b(13, 12, {"Y"});
  for (double& value : b.values()) value = 1;
  // (2 * 0 * 1 + C1) / (0 + 1 + C1), the weights 0.299 + 0.587 + 0.114 being 1
  EXPECT_NEAR(*structural_similarity(a, b), 1e-4 / (1 + 1e-4), 1e-12);
}

TEST(StructuralSimilarity, NeedsFiniteColoursAndRoomForAWindow) {
  EXPECT_FALSE(structural_similarity(Image(10, 30, {"Y"}), Image(10, 30, {"Y"})));
  EXPECT_FALSE(structural_similarity(Image(11, 11, {"Z"}), Image(11, 11, {"Y"})));
  Image nan(11, 11, {"Y"});
  nan.at(3, 3, 0) = std::nan("");
  EXPECT_FALSE(structural_similarity(nan, nan));
  EXPECT_THROW(structural_similarity(Image(11, 12, {"Y"}), nan), std::invalid_argument);
}

}  // namespace
}  // namespace hiac
