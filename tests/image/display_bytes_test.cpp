#include "hiac/image/display_bytes.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/image/files/integer_pixels.hpp"

namespace hiac {
namespace {

// What write_image stores in a .png.
std::vector<std::uint8_t> stored(const Image& image) {
  WriteOptions options;
  options.background_included = true;
  options.depth = 8;
  const auto pixels = image_files::encode_integers("p.png", "PNG", image, options);
  return {pixels.samples.begin(), pixels.samples.end()};
}

Image image_of(const std::vector<double>& reds) {
  Image image(reds.size(), 1, rgba_channels());
  for (std::size_t x = 0; x < reds.size(); ++x) {
    image.at(x, 0, 0) = reds[x];
    image.at(x, 0, 1) = reds[reds.size() - 1 - x];
    image.at(x, 0, 3) = 0.3;
  }
  return image;
}

TEST(DisplayBytes, AreThoseOfAPngFile) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::vector<double> values{0,         -1,
                             1,         2,
                             kInfinity, -kInfinity,
                             1e-300,    std::nan(""),
                             0.0031308, std::nextafter(1.0, 0.0)};
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> number(0, 1);
  for (int k = 0; k < 100000; ++k) values.push_back(number(random));
  for (int k = 0; k <= 4096; ++k) values.push_back(k / 4096.0);
  EXPECT_EQ(display_bytes(image_of(values)), stored(image_of(values)));
}

// The values at which the byte changes, found by bisection of what is stored, to the last bit.
TEST(DisplayBytes, ChangeWhereThoseOfAPngFileDo) {
  std::vector<double> values;
  for (int byte = 1; byte < 256; ++byte) {
    double below = 0, above = 1;
    while (std::nextafter(below, 1) < above) {
      const double middle = below + (above - below) / 2;
      (stored(image_of({middle}))[0] >= byte ? above : below) = middle;
    }
    values.insert(values.end(), {below, above});
  }
  EXPECT_EQ(display_bytes(image_of(values)), stored(image_of(values)));
}

TEST(DisplayBytes, NeedColours) { EXPECT_THROW(display_bytes(Image(1, 1, {"depth"})), UsageError); }

}  // namespace
}  // namespace hiac
