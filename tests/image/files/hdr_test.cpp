#include <cmath>

#include <gmock/gmock.h>

#include "hiac/base/error.hpp"
#include "hiac/image/image_io.hpp"
#include "tests/image/test_folder.hpp"

namespace hiac {
namespace {

class Hdr : public FolderTest {
 protected:
  Image read(const std::string& bytes) {
    write_bytes(path("hand.hdr"), bytes);
    return read_image(path("hand.hdr")).image;
  }
};

const std::string kHeader = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n";

TEST_F(Hdr, WritesMantissasRoundedToTheNearest) {
  Image image(3, 1, {"R", "G", "B"});
  // 1 = 128/256 * 2^1; 0.3 = 76.8/128 / 2; 255.5/256 is carried to the next power of two
  const double pixels[] = {1, 0.5, 0.3, 255.5 / 256, 0, 0, -1, std::nan(""), 0};
  std::copy(std::begin(pixels), std::end(pixels), image.values().begin());
  write_image(path("a.hdr"), image);
  EXPECT_EQ(bytes_of(path("a.hdr")),
            "#?RADIANCE\nSOFTWARE=hiac\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 3\n" +
                std::string("\x80\x40\x26\x81\x80\0\0\x81\0\0\0\0", 12));
}

TEST_F(Hdr, IsNearWhatWasWritten) {
  // as wide as scanlines are plain, and packed, with long runs and long dumps
  for (const std::size_t width : {1u, 7u, 8u, 500u}) {
    Image image = random_picture(width, 6);
    for (std::size_t i = 0; i < image.values().size(); ++i)
      image.values()[i] *= std::pow(10, static_cast<double>(i % 11) - 5);
    write_image(path("a.hdr"), image);
    const Image read_back = read_image(path("a.hdr")).image;
    for (std::size_t y = 0; y < 6; ++y)
      for (std::size_t x = 0; x < width; ++x) {
        const auto pixel = image.pixel(x, y);
        const double largest = std::max({pixel[0], pixel[1], pixel[2]});
        for (std::size_t c = 0; c < 3; ++c)
          ASSERT_NEAR(read_back.at(x, y, c), pixel[c], largest / 255) << x << " " << y << " " << c;
      }
    write_image(path("b.hdr"), read_back);
    EXPECT_EQ(bytes_of(path("a.hdr")), bytes_of(path("b.hdr")));
  }
}

TEST_F(Hdr, ClampsWhatItCannotHold) {
  Image image(2, 1, {"R", "G", "B"});
  image.at(0, 0, 0) = INFINITY;
  image.at(1, 0, 0) = 1e-300;
  write_image(path("a.hdr"), image);
  const Image read_back = read_image(path("a.hdr")).image;
  EXPECT_EQ(read_back.at(0, 0, 0), std::ldexp(255, 119));
  EXPECT_EQ(read_back.at(1, 0, 0), 0);
}

TEST_F(Hdr, ReadsOldRepetitionsAndExposures) {
  const Image image = read(kHeader + "EXPOSURE=2\nEXPOSURE= 4\nVIEW=-vtv\n\n-Y 1 +X 4\n" +
                           std::string("\x80\x40\x20\x81\1\1\1\2\xff\0\0\x80", 12));
  for (std::size_t x = 0; x < 3; ++x) {
    EXPECT_EQ(image.at(x, 0, 0), 1.0 / 8);
    EXPECT_EQ(image.at(x, 0, 1), 0.5 / 8);
  }
  EXPECT_EQ(image.at(3, 0, 0), 255.0 / 256 / 8);
}

TEST_F(Hdr, RefusesMalformedFiles) {
  const std::string good = kHeader + "\n-Y 1 +X 1\n\x80\x80\x80\x80";
  EXPECT_NO_THROW(read(good));
  for (const std::string& bytes :
       {std::string(), std::string("#?"), std::string("P6\n\n-Y 1 +X 1\n1234"),
        std::string("#?R\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n1234"),
        kHeader + "EXPOSURE=0\n\n-Y 1 +X 1\n1234", kHeader + "\n+X 1 -Y 1\n1234",
        kHeader + "\n-Y 0 +X 1\n1234", kHeader + "\n-Y 65536 +X 65536\n1234",
        kHeader + "\n-Y 1 +X 1\n\1\1\1\1", kHeader + "\n-Y 1 +X 2\n1234\1\1\1\2",
        kHeader + "\n-Y 1 +X 8\n\2\2" + std::string("\0\x09", 2),
        kHeader + "\n-Y 1 +X 8\n\2\2" + std::string("\0\x08\x89\0\0\0\0\0\0\0", 10),
        kHeader + "\n-Y 1 +X 8\n\2\2" + std::string("\0\x08\0\0\0\0\0\0\0\0", 10)})
    EXPECT_THROW(read(bytes), InputError) << bytes;
}

TEST_F(Hdr, SurvivesDamagedFiles) {
  write_image(path("a.hdr"), random_picture(40, 20));
  expect_survival(bytes_of(path("a.hdr")), 100, 3000,
                  [&](const std::string& bytes) { return read(bytes); });
}

}  // namespace
}  // namespace hiac
