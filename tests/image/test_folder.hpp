#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/image/image.hpp"
#include "tests/support/scratch_folder.hpp"

namespace hiac {

/// A test with a folder of its own, empty at first and gone in the end.
class FolderTest : public testing::Test {
 protected:
  [[nodiscard]] std::string path(const std::string& name) const { return folder_.file(name); }

  static std::string bytes_of(const std::string& file) { return test::bytes_of(file); }
  static void write_bytes(const std::string& file, const std::string& bytes) {
    std::filesystem::remove(
        file);  // a new file: some file systems flush one that is cut to nothing
    std::ofstream(file, std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  [[nodiscard]] std::size_t file_count() const { return folder_.names().size(); }

  test::ScratchFolder folder_;
};

/// A python that has numpy: the first one, or the system's; empty where there is none.
inline std::string python_with_numpy() {
  for (const char* candidate : {"python3", "/usr/bin/python3"})
    if (std::system((std::string(candidate) + " -c 'import numpy' 2>/dev/null").c_str()) == 0)
      return candidate;
  return "";
}

/// A picture as renderers make them: premultiplied, in [0, 1], with even areas, slopes and noise.
inline Image random_picture(std::size_t width, std::size_t height,
                            std::vector<std::string> channels = rgba_channels()) {
  Image image(width, height, std::move(channels));
  std::mt19937_64 random(23);
  std::uniform_real_distribution<double> uniform(0, 1);
  const std::size_t alpha = image.channel_index("A").value_or(image.channel_count());
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x) {
      const double a = x % 7 == 0 ? 1 : 0.1 + 0.9 * uniform(random);
      for (std::size_t c = 0; c < image.channel_count(); ++c) {
        const double noise = y % 3 == 0 ? 0.5 : uniform(random);
        const double straight =
            x < width / 3 ? 0.25
                          : noise * static_cast<double>(x + 1) / static_cast<double>(width + 1);
        image.at(x, y, c) = c == alpha ? a : straight * (alpha < image.channel_count() ? a : 1);
      }
    }
  return image;
}

/// Reads `good` with its end cut off in a hundred ways, and with some bytes changed, mostly among
/// the first `header` ones: InputError of one line that names the file, or an image.
template <typename Read>
void expect_survival(const std::string& good, std::size_t header, int trials, const Read& read) {
  const auto complaint = [&](const std::string& bytes) -> std::string {
    try {
      read(bytes);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  for (std::size_t length = 0; length < good.size(); length += 1 + good.size() / 100)
    EXPECT_NE(complaint(good.substr(0, length)), "") << length;
  std::mt19937 random(9);
  for (int trial = 0; trial < trials; ++trial) {
    std::string bytes = good;
    const std::size_t reach = trial % 4 == 0 ? bytes.size() : std::min(header, bytes.size());
    for (auto edits = 1 + random() % 3; edits > 0; --edits)
      bytes[random() % reach] = static_cast<char>(random() % 3 == 0 ? 0xff : random());
    std::string text;
    ASSERT_NO_THROW(text = complaint(bytes)) << trial;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  }
}

/// Values of many magnitudes, some of them not finite where `extremes`.
inline Image random_image(std::size_t width, std::size_t height, std::vector<std::string> channels,
                          bool extremes = true) {
  Image image(width, height, std::move(channels));
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> exponent(-30, 30);
  for (double& value : image.values())
    value = (random() % 2 == 0 ? 1 : -1) * std::pow(10, exponent(random));
  if (extremes && image.values().size() >= 4) {
    image.values()[0] = -0.0;
    image.values()[1] = std::numeric_limits<double>::infinity();
    image.values()[2] = std::numeric_limits<double>::quiet_NaN();
    image.values()[3] = std::numeric_limits<double>::denorm_min();
  }
  return image;
}

}  // namespace hiac
