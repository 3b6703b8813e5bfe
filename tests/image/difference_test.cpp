#include "hiac/image/difference.hpp"

#include <cmath>
#include <stdexcept>

#include <gmock/gmock.h>

#include "tests/image/test_folder.hpp"

namespace hiac {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Image shifted(Image image, double by) {
  for (double& value : image.values()) value += by;
  return image;
}

TEST(Difference, OfAConstantShiftIsTheShift) {
  const Image reference(7, 5, {"R", "G", "B", "A"});
  const auto differences = channel_differences(shifted(reference, -0.25), reference);
  ASSERT_EQ(differences.size(), 4u);
  for (const Difference& d : differences) {
    EXPECT_EQ(d.rmse, 0.25);
    EXPECT_EQ(d.mean_absolute, 0.25);
    EXPECT_EQ(d.largest, 0.25);
    EXPECT_NEAR(d.relative_mse, 625, 1e-9);  // (0.25 / 0.01)^2
    EXPECT_EQ(d.infinite, 0u);
  }
  EXPECT_NEAR(*peak_signal_to_noise(shifted(reference, 0.1), reference), 20, 1e-12);
}

TEST(Difference, IsWhatItsDefinitionSays) {
  const Image a = random_picture(31, 17, {"R", "G", "B", "A", "depth"});
  const Image b = random_picture(31, 17, {"depth", "A", "G", "X"});
  const auto differences = channel_differences(a, b);
  ASSERT_EQ(differences.size(), 3u);
  for (const Difference& d : differences) {
    const std::size_t ca = *a.channel_index(d.channel), cb = *b.channel_index(d.channel);
    long double squares = 0, relative = 0, sum = 0, largest = 0;
    for (std::size_t y = 0; y < 17; ++y)
      for (std::size_t x = 0; x < 31; ++x) {
        const long double e = static_cast<long double>(a.at(x, y, ca)) - b.at(x, y, cb);
        const long double r = b.at(x, y, cb);
        squares += e * e;
        relative += e * e / ((r + 0.01L) * (r + 0.01L));
        sum += std::fabs(e);
        largest = std::max(largest, std::fabs(e));
      }
    const long double n = 31 * 17;
    EXPECT_NEAR(d.rmse, static_cast<double>(std::sqrt(squares / n)), 1e-14) << d.channel;
    EXPECT_NEAR(d.relative_mse / static_cast<double>(relative / n), 1, 1e-12) << d.channel;
    EXPECT_NEAR(d.mean_absolute, static_cast<double>(sum / n), 1e-14) << d.channel;
    EXPECT_NEAR(d.largest, static_cast<double>(largest), 1e-16) << d.channel;
    EXPECT_EQ(std::fabs(a.at(d.x, d.y, ca) - b.at(d.x, d.y, cb)), d.largest);
  }
}

TEST(Difference, CountsWhatIsNotFinite) {
  Image a(4, 1, {"Y"}), b(4, 1, {"Y"});
  for (std::size_t x = 0; x < 2; ++x) a.at(x, 0, 0) = b.at(x, 0, 0) = x == 0 ? NAN : kInfinity;
  EXPECT_EQ(channel_differences(a, b).front().rmse, 0);
  EXPECT_EQ(*peak_signal_to_noise(a, b), kInfinity);
  a.at(2, 0, 0) = NAN;
  b.at(1, 0, 0) = -kInfinity;
  const Difference d = channel_differences(a, b).front();
  EXPECT_EQ(d.infinite, 2u);
  EXPECT_EQ(d.x, 1u);
  for (const double value : {d.rmse, d.relative_mse, d.mean_absolute, d.largest})
    EXPECT_EQ(value, kInfinity);
  EXPECT_EQ(*peak_signal_to_noise(a, b), -kInfinity);
}

TEST(Difference, OfTheWholeImageIsMapped) {
  Image a(2, 1, {"R", "Z", "G"}), b(2, 1, {"G", "R"});
  a.at(1, 0, 0) = 3;
  b.at(1, 0, 0) = -5;
  a.at(1, 0, 1) = 100;
  const Image map = difference_map(a, b);
  EXPECT_EQ(map.channels()[0], "difference");
  EXPECT_EQ(map.at(0, 0, 0), 0);
  EXPECT_EQ(map.at(1, 0, 0), 5);
}

TEST(Difference, NeedsOneSizeAndColours) {
  EXPECT_THROW(channel_differences(Image(2, 1, {"Y"}), Image(1, 2, {"Y"})), std::invalid_argument);
  EXPECT_TRUE(channel_differences(Image(2, 1, {"Y"}), Image(2, 1, {"Z"})).empty());
  EXPECT_FALSE(peak_signal_to_noise(Image(2, 1, {"R", "G"}), Image(2, 1, {"Y"})));
  EXPECT_EQ(peak_signal_to_noise(Image(2, 1, {"R", "G", "B"}), Image(2, 1, {"Y"})), kInfinity);
}

}  // namespace
}  // namespace hiac
