#include <cstring>

#include <gmock/gmock.h>

#include "hiac/base/error.hpp"
#include "hiac/image/image_io.hpp"
#include "tests/image/test_folder.hpp"

namespace hiac {
namespace {

class Pfm : public FolderTest {
 protected:
  Image read(const std::string& bytes) {
    write_bytes(path("hand.pfm"), bytes);
    return read_image(path("hand.pfm")).image;
  }
};

TEST_F(Pfm, WritesTheBytesThatTheFormatAsksFor) {
  Image image(1, 2, {"Y"});
  image.at(0, 0, 0) = 1;  // the top row comes last
  write_image(path("a.pfm"), image);
  EXPECT_EQ(bytes_of(path("a.pfm")), "Pf\n1 2\n-1.0\n" + std::string("\0\0\0\0\0\0\x80\x3f", 8));
}

TEST_F(Pfm, KeepsFloatsToTheBit) {
  const Image image = random_image(17, 9, {"R", "G", "B", "A"});
  write_image(path("a.pfm"), image);
  const Image read_back = read_image(path("a.pfm")).image;
  ASSERT_EQ(read_back.channel_count(), 3u);
  for (std::size_t y = 0; y < 9; ++y)
    for (std::size_t x = 0; x < 17; ++x)
      for (std::size_t c = 0; c < 3; ++c) {
        const auto expected = static_cast<float>(image.at(x, y, c));
        const auto found = static_cast<float>(read_back.at(x, y, c));
        ASSERT_EQ(std::memcmp(&expected, &found, sizeof found), 0) << x << " " << y << " " << c;
      }
}

TEST_F(Pfm, ReadsOtherByteOrdersAndScales) {
  const Image image =
      read("PF 1\t1\r\n2.5\n" + std::string("\x3f\x80\0\0\x40\0\0\0\xbf\x80\0\0", 12));
  EXPECT_EQ(image.at(0, 0, 0), 2.5);
  EXPECT_EQ(image.at(0, 0, 1), 5);
  EXPECT_EQ(image.at(0, 0, 2), -2.5);
}

TEST_F(Pfm, RefusesMalformedFiles) {
  for (const char* bytes :
       {"", "PF", "P6\n1 1\n-1\n", "PF\n1\n", "PF\n1 1\n", "PF\n1 1\n0\n", "PF\n1 1\nnan\n",
        "PF\n-1 1\n-1\n", "PF\n1 1\n-1", "PF1 1\n-1\n", "Pf\n1 1\n-1\n123", "Pf\n1 1\n-1\n12345",
        "PF\n65536 65536\n-1\n", "PF\n99999999999999999999 1\n-1\n", "Pf\n0 1\n-1\n"})
    EXPECT_THROW(read(bytes), InputError) << bytes;
}

TEST_F(Pfm, SurvivesDamagedFiles) {
  write_image(path("a.pfm"), random_image(5, 4, {"R", "G", "B"}));
  expect_survival(bytes_of(path("a.pfm")), 14, 2000,
                  [&](const std::string& bytes) { return read(bytes); });
}

}  // namespace
}  // namespace hiac
