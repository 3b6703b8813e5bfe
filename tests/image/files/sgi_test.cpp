#include <string>
#include <utility>

#include <gmock/gmock.h>

#include "hiac/base/error.hpp"
#include "hiac/image/image_io.hpp"
#include "tests/image/test_folder.hpp"

namespace hiac {
namespace {

class Sgi : public FolderTest {
 protected:
  Image read(const std::string& bytes, bool linear = true) {
    write_bytes(path("hand.sgi"), bytes);
    return read_image(path("hand.sgi"), {.linear = linear}).image;
  }
  std::string complaint(const std::string& bytes) {
    try {
      read(bytes);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
};

std::string header(char storage, char sample_bytes, char axes, char width, char height,
                   char channels) {
  std::string bytes{'\x01', '\xda', storage, sample_bytes, '\0', axes,
                    '\0',   width,  '\0',    height,       '\0', channels};
  bytes.resize(512);
  return bytes;
}

TEST_F(Sgi, ReadsHandMadeFiles) {
  // two rows of three pixels, bottom row first, channel by channel
  const Image plain = read(header(0, 1, 3, 3, 2, 2) + std::string("\0\x33\xff\xff\x33\0", 6) +
                           "\xff\xff\xff\x33\xff\xff");
  ASSERT_EQ(plain.width(), 3u);
  ASSERT_EQ(plain.channel_count(), 2u);
  EXPECT_EQ(plain.at(1, 1, 0), 0.2);
  EXPECT_EQ(plain.at(2, 1, 0), 1);
  EXPECT_EQ(plain.at(0, 0, 1), 0.2);
  EXPECT_EQ(plain.at(0, 0, 0), 0.2);  // straight 1, times alpha

  // one row of five: three times 7, then 1 and 2 as they are
  const std::string packed = header(1, 2, 1, 5, 0, 0) + std::string("\0\0\x02\x08", 4) +
                             std::string("\0\0\0\x0e", 4) +
                             std::string("\0\x03\0\x07\0\x82\0\x01\0\x02\0\0", 12);
  const Image row = read(packed);
  ASSERT_EQ(row.width(), 5u);
  ASSERT_EQ(row.height(), 1u);
  for (std::size_t x = 0; x < 5; ++x)
    EXPECT_EQ(row.at(x, 0, 0), (x < 3 ? 7 : static_cast<double>(x) - 2) / 65535) << x;

  const Image srgb = read(header(0, 1, 2, 1, 1, 1) + "\x80", false);
  EXPECT_NEAR(srgb.at(0, 0, 0), 0.21586050011389926, 1e-15);
}

TEST_F(Sgi, WritesTheBytesThatTheFormatAsksFor) {
  Image image(4, 1, {"Y"});
  image.at(3, 0, 0) = 1;
  write_image(path("a.rgba"), image);
  std::string expected = header(1, 1, 2, 4, 1, 1);
  expected[19] = '\xff';  // the largest sample
  expected += std::string("\0\0\x02\x08\0\0\0\x05\x03\0\x81\xff\0", 13);
  EXPECT_EQ(bytes_of(path("a.rgba")), expected);
}

TEST_F(Sgi, GivesEverySampleBack) {
  for (const int depth : {8, 16})
    for (const std::size_t width : {1u, 2u, 127u, 128u, 300u}) {
      write_image(path("a.sgi"), random_picture(width, 5), {.depth = depth});
      const Image once = read_image(path("a.sgi")).image;
      write_image(path("b.sgi"), once, {.depth = depth});
      EXPECT_EQ(bytes_of(path("a.sgi")), bytes_of(path("b.sgi"))) << depth << " " << width;
    }
}

TEST_F(Sgi, WritesOpaqueImagesWhereTheBackgroundIsIncluded) {
  write_image(path("a.sgi"), random_picture(3, 2), {.background_included = true});
  EXPECT_EQ(read_image(path("a.sgi")).image.channel_count(), 3u);
}

TEST_F(Sgi, RefusesMalformedFiles) {
  EXPECT_THAT(complaint("hello"), testing::HasSubstr("not an SGI image"));
  EXPECT_THAT(complaint(header(2, 1, 3, 1, 1, 1)), testing::HasSubstr("not an ordinary SGI image"));
  EXPECT_THAT(complaint(header(0, 3, 3, 1, 1, 1)), testing::HasSubstr("not an ordinary SGI image"));
  EXPECT_THAT(complaint(header(0, 1, 3, 1, 1, 5)), testing::HasSubstr("5 channels"));
  EXPECT_THAT(complaint(header(0, 1, 3, 0, 1, 1)), testing::HasSubstr("impossible image size"));
  EXPECT_THAT(complaint(header(0, 1, 3, 9, 9, 3)), testing::HasSubstr("ends too early"));
  // 65535 x 65535 x 4 samples in rows that would all share a few bytes
  std::string huge = header(1, 2, 3, 0, 0, 4);
  for (const std::size_t at : {6u, 7u, 8u, 9u}) huge[at] = '\xff';
  EXPECT_THAT(complaint(huge + std::string(100000, '\0')), testing::HasSubstr("ends too early"));
  const std::string tables("\0\0\x02\x08\0\0\0\x05", 8);
  EXPECT_THAT(complaint(header(1, 1, 2, 4, 1, 1) + tables + std::string("\x05\0\0", 3)),
              testing::HasSubstr("a row longer than 4 samples"));
  EXPECT_THAT(complaint(header(1, 1, 2, 4, 1, 1) + tables + std::string("\x03\0\0", 3)),
              testing::HasSubstr("a row of 3 samples, expected 4"));
}

TEST_F(Sgi, SurvivesDamagedFiles) {
  write_image(path("a.sgi"), random_picture(40, 30), {.depth = 16});
  expect_survival(bytes_of(path("a.sgi")), 600, 3000,
                  [&](const std::string& bytes) { return read(bytes); });
}

// Storage 0 and 1, 1 and 2 bytes a sample, and 1 to 3 axes: fewer of them have sides of 1.
TEST_F(Sgi, OrdinaryImagesAlone) {
  const auto told = [&](char storage, char sample_bytes, char axes) {
    std::string bytes = header(storage, sample_bytes, axes, 2, 2, 2);
    if (storage == 1)  // no row can be where its table says
      return complaint(bytes + std::string(64, '\0'));
    const int samples = axes == 1 ? 2 : axes == 2 ? 4 : 8;
    return complaint(bytes + std::string(static_cast<std::size_t>(samples * sample_bytes), '\1'));
  };
  for (const char sample_bytes : std::string("\1\2"))
    for (const char axes : std::string("\1\2\3"))
      EXPECT_EQ(told(0, sample_bytes, axes), "no error");
  const std::string expected = path("hand.sgi") +
                               ": not an ordinary SGI image (expected storage 0 or 1, 1 or 2 bytes "
                               "a sample, 1 to 3 axes and "
                               "colour map 0, found ";
  EXPECT_EQ(told(2, 1, 3), expected + "2, 1, 3 and 0)");
  EXPECT_EQ(told(0, 0, 3), expected + "0, 0, 3 and 0)");
  EXPECT_EQ(told(0, 3, 3), expected + "0, 3, 3 and 0)");
  EXPECT_EQ(told(0, 1, 0), expected + "0, 1, 0 and 0)");
  EXPECT_EQ(told(0, 1, 4), expected + "0, 1, 4 and 0)");
  std::string mapped = header(0, 1, 3, 1, 1, 1) + "\1";
  mapped[107] = 3;
  EXPECT_EQ(complaint(mapped), expected + "0, 1, 3 and 3)");
  EXPECT_EQ(
      complaint(header(0, 1, 3, 1, 1, 1).substr(0, 511)),
      path("hand.sgi") + ": not an SGI image (wrong magic number, or shorter than its header)");
  EXPECT_EQ(complaint(header(0, 1, 3, 1, 1, 4) + std::string(4, '\1')), "no error");
}

TEST_F(Sgi, AxesThatAreNotThereCountAsOne) {
  const Image row = read(header(0, 1, 1, 3, 9, 9) + std::string("\0\xff\x33", 3));
  EXPECT_EQ(row.width(), 3U);
  EXPECT_EQ(row.height(), 1U);
  EXPECT_EQ(row.channel_count(), 1U);
  EXPECT_EQ(row.at(2, 0, 0), 0.2);
  const Image grey = read(header(0, 1, 2, 1, 2, 9) + std::string("\x33\xff", 2));
  EXPECT_EQ(grey.height(), 2U);
  EXPECT_EQ(grey.channel_count(), 1U);
  EXPECT_EQ(grey.at(0, 1, 0), 0.2);  // the bottom row comes first
}

TEST_F(Sgi, SidesHave65535PixelsAtMost) {
  write_image(path("a.sgi"), Image(65535, 1, {"Y"}));
  EXPECT_EQ(read_image(path("a.sgi")).image.width(), 65535U);
  for (const auto& [width, height] : {std::pair{65536U, 1U}, {1U, 65536U}}) {
    try {
      write_image(path("b.sgi"), Image(width, height, {"Y"}));
      ADD_FAILURE() << width;
    } catch (const UsageError& error) {
      EXPECT_EQ(error.what(), path("b.sgi") +
                                  ": an SGI image has at most 65535 pixels a side (found " +
                                  std::to_string(width) + " x " + std::to_string(height) + ")");
    }
  }
}

}  // namespace
}  // namespace hiac
