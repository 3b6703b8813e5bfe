#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/image/image.hpp"

namespace hiac {

/// A test with a folder of its own, empty at first and gone in the end.
class FolderTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("hiac_") + test->test_suite_name() + "_" + test->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_ / name).string();
  }

  static std::string bytes_of(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  static void write_bytes(const std::string& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  [[nodiscard]] std::size_t file_count() const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(folder_), {}));
  }

  std::filesystem::path folder_;
};

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
