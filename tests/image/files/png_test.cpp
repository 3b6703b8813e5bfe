#include <array>
#include <cstdint>

#include <gmock/gmock.h>

#include "hiac/base/error.hpp"
#include "hiac/image/files/image_formats.hpp"
#include "hiac/image/image_io.hpp"
#include "tests/image/test_folder.hpp"

namespace hiac {
namespace {

std::string big_endian(std::uint32_t value) {
  return {static_cast<char>(value >> 24), static_cast<char>(value >> 16),
          static_cast<char>(value >> 8), static_cast<char>(value)};
}

std::uint32_t crc32(const std::string& bytes) {
  std::uint32_t crc = ~0u;
  for (const char byte : bytes) {
    crc ^= static_cast<std::uint8_t>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xedb88320u : 0);
  }
  return ~crc;
}

std::string chunk(const std::string& type, const std::string& payload) {
  return big_endian(static_cast<std::uint32_t>(payload.size())) + type + payload +
         big_endian(crc32(type + payload));
}

/// zlib's format with one block that is stored, not compressed.
std::string stored(const std::string& bytes) {
  std::uint32_t a = 1;
  std::uint32_t b = 0;
  for (const char byte : bytes) {
    a = (a + static_cast<std::uint8_t>(byte)) % 65521;
    b = (b + a) % 65521;
  }
  const auto size = static_cast<std::uint16_t>(bytes.size());
  const auto inverse = static_cast<std::uint16_t>(~size);
  std::string text = "\x78\x01\x01";
  for (const std::uint16_t word : {size, inverse})
    text += {static_cast<char>(word & 0xff), static_cast<char>(word >> 8)};
  return text + bytes + big_endian(b << 16 | a);
}

/// A PNG file made by hand: rows are samples after a filter byte 0.
std::string png(std::uint32_t width, std::uint32_t height, char depth, char color_type,
                const std::string& rows, const std::string& further_chunks = "") {
  return "\x89PNG\r\n\x1a\n" +
         chunk("IHDR", big_endian(width) + big_endian(height) +
                           std::string{depth, color_type, '\0', '\0', '\0'}) +
         further_chunks + chunk("IDAT", stored(rows)) + chunk("IEND", "");
}

class Png : public FolderTest {
 protected:
  Image read(const std::string& bytes) {
    write_bytes(path("hand.png"), bytes);
    return read_image(path("hand.png")).image;
  }
};

// sRGB decoded by hand: ((128/255 + 0.055) / 1.055)^2.4 and so on
constexpr double kDecoded128 = 0.21586050011389926;
constexpr double kDecoded10 = 10 / 255.0 / 12.92;

TEST_F(Png, ReadsHandMadeFiles) {
  const Image rgba = read(png(2, 1, 8, 6, std::string("\0\x80\x0a\xff\xff\xff\xff\xff\x33", 9)));
  ASSERT_EQ(rgba.channel_count(), 4u);
  EXPECT_NEAR(rgba.at(0, 0, 0), kDecoded128, 1e-15);
  EXPECT_NEAR(rgba.at(0, 0, 1), kDecoded10, 1e-17);
  EXPECT_EQ(rgba.at(0, 0, 2), 1);
  EXPECT_EQ(rgba.at(0, 0, 3), 1);
  EXPECT_NEAR(rgba.at(1, 0, 0), 0.2, 1e-15);  // premultiplied by 0x33 / 255
  EXPECT_EQ(rgba.at(1, 0, 3), 0.2);

  const Image grey16 = read(
      png(1, 2, 16, 0, std::string("\0\xff\xff\0\x80\x00", 6), chunk("gAMA", big_endian(100000))));
  EXPECT_EQ(grey16.channels()[0], "Y");
  EXPECT_EQ(grey16.at(0, 0, 0), 1);
  EXPECT_EQ(grey16.at(0, 1, 0), 32768.0 / 65535);

  const Image bits = read(png(2, 1, 1, 0, std::string("\0\x40", 2)));
  EXPECT_EQ(bits.at(0, 0, 0), 0);
  EXPECT_EQ(bits.at(1, 0, 0), 1);
}

TEST_F(Png, WritesStraightSrgbRoundedToTheNearest) {
  Image image(2, 2, {"R", "G", "B", "A", "depth"});
  const std::array<std::array<double, 5>, 4> pixels{{{0.5, 0.2, 1, 1, 9},
                                                     {0.25, 0, 0.5, 0.5, 9},
                                                     {2, -1, std::nan(""), 0.2, 9},
                                                     {0, 0, 0, 0, 9}}};
  for (std::size_t i = 0; i < 4; ++i)
    std::copy(pixels[i].begin(), pixels[i].end(), image.pixel(i % 2, i / 2).begin());
  write_image(path("a.png"), image, {false, false, {{"Software", "hiac"}, {"hiac:mesh", "ä"}}});
  const ImageFile file = read_image(path("a.png"));
  // encode(0.5) = 0.7353570 -> 188, encode(0.2) = 0.4845292 -> 124, 0.5 of alpha -> 128
  const auto decode = [](int byte) {
    const double v = byte / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  };
  const double half = 128 / 255.0;
  const std::array<std::array<double, 4>, 4> expected{{{decode(188), decode(124), 1, 1},
                                                       {decode(188) * half, 0, half, half},
                                                       {0.2, 0, 0, 0.2},
                                                       {0, 0, 0, 0}}};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t c = 0; c < 4; ++c)
      EXPECT_NEAR(file.image.at(i % 2, i / 2, c), expected[i][c], 1e-15) << i << " " << c;
  EXPECT_THAT(file.attributes, testing::UnorderedElementsAre(testing::Pair("Software", "hiac"),
                                                             testing::Pair("hiac:mesh", "ä")));
  const std::string bytes = bytes_of(path("a.png"));
  EXPECT_THAT(bytes, testing::HasSubstr(std::string("sRGB\0", 5)));
  // a text in UTF-8, as it is
  EXPECT_THAT(bytes, testing::HasSubstr(std::string("iTXthiac:mesh\0\0\0\0\0\xc3\xa4", 20)));
  EXPECT_EQ(bytes.substr(12, 17),
            "IHDR" + big_endian(2) + big_endian(2) + std::string("\x08\x06\0\0\0", 5));
}

TEST_F(Png, WritesLinearValuesAndOpaqueImagesWhereAsked) {
  Image image(1, 1, rgba_channels());
  std::fill(image.values().begin(), image.values().end(), 0.5);
  write_image(path("a.png"), image, {true, false, {}});
  const Image linear = read_image(path("a.png")).image;
  EXPECT_NEAR(linear.at(0, 0, 0), 128 / 255.0, 1e-15);  // straight 1, times alpha
  write_image(path("a.png"), image, {true, true, {}});
  const Image opaque = read_image(path("a.png")).image;
  ASSERT_EQ(opaque.channel_count(), 3u);
  EXPECT_NEAR(opaque.at(0, 0, 0), 128 / 255.0, 1e-15);
}

TEST_F(Png, GivesEveryByteBack) {
  std::string rows;
  for (int y = 0; y < 16; ++y) {
    rows += '\0';
    for (int x = 0; x < 16; ++x)
      for (const int sample : {16 * y + x, 255 - 16 * y - x, 7 * x, 128 + 8 * y})
        rows += static_cast<char>(sample);
  }
  const Image image = read(png(16, 16, 8, 6, rows));
  write_image(path("a.png"), image);
  const Image again = read_image(path("a.png")).image;
  for (std::size_t i = 0; i < image.values().size(); ++i)
    EXPECT_EQ(again.values()[i], image.values()[i]);
}

TEST_F(Png, WritesSixteenBits) {
  Image image(3, 1, {"Y", "A"});
  // 1 / 65535 of each kind of sample, and a value that 8 bits do not have
  const double values[] = {1 / 65535.0, 1, 0.123456, 1, 0.5, 0.5};
  std::copy(std::begin(values), std::end(values), image.values().begin());
  write_image(path("a.png"), image, {.linear = true, .depth = 16});
  EXPECT_EQ(bytes_of(path("a.png")).substr(12, 14),
            "IHDR" + big_endian(3) + big_endian(1) + std::string("\x10\x04", 2));
  const Image linear = read_image(path("a.png")).image;
  EXPECT_EQ(linear.at(0, 0, 0), 1 / 65535.0);
  EXPECT_EQ(linear.at(1, 0, 0), 8091 / 65535.0);  // 0.123456 * 65535 = 8090.7
  EXPECT_EQ(linear.at(2, 0, 1), 32768 / 65535.0);

  const Image picture = random_picture(33, 9);
  write_image(path("b.png"), picture, {.depth = 16});
  const Image once = read_image(path("b.png")).image;
  for (std::size_t i = 0; i < once.values().size(); ++i)
    ASSERT_NEAR(once.values()[i], picture.values()[i], 4e-5);
  write_image(path("c.png"), once, {.depth = 16});
  EXPECT_EQ(bytes_of(path("b.png")), bytes_of(path("c.png")));
}

TEST_F(Png, RefusesMalformedFiles) {
  const std::string good = png(2, 1, 8, 2, std::string(7, '\0'));
  EXPECT_NO_THROW(read(good));
  for (std::size_t length = 0; length < good.size() - 12; ++length)
    EXPECT_THROW(read(good.substr(0, length)), InputError) << length;
  EXPECT_THROW(read(png(60000, 60000, 8, 2, std::string(7, '\0'))), InputError);
  EXPECT_THROW(read(png(0, 1, 8, 2, std::string(7, '\0'))), InputError);
  EXPECT_THROW(read(png(2, 1, 3, 2, std::string(7, '\0'))), InputError);
  std::mt19937 random(5);
  for (int trial = 0; trial < 2000; ++trial) {
    std::string bytes = good;
    bytes[random() % bytes.size()] = static_cast<char>(random());
    write_bytes(path("hand.png"), bytes);
    try {
      // in this process, in which the sanitizers see what the library does
      image_files::read_png(path("hand.png"));
    } catch (const InputError&) {
    }
  }
}

TEST_F(Png, NeedsChannelsThatItCanHold) {
  EXPECT_THROW(write_image(path("a.png"), Image(1, 1, {"depth"})), UsageError);
  EXPECT_THROW(write_image(path("a.png"), Image(1, 1, {"R", "G"})), UsageError);
  EXPECT_EQ(file_count(), 0u);
  EXPECT_NO_THROW(write_image(path("a.png"), Image(1, 1, {"Y"})));
}

TEST_F(Png, ReadsPalettesWithTransparency) {
  const std::string palette("\xff\0\0\0\xff\0\0\0\xff", 9);
  const std::string rows("\0\x12", 2);  // entries 0 1 0 2 of 2 bits: 00 01 00 10
  const Image opaque = read(png(4, 1, 2, 3, rows, chunk("PLTE", palette)));
  ASSERT_EQ(opaque.channel_count(), 3U);
  EXPECT_EQ(opaque.at(0, 0, 0), 1);
  EXPECT_EQ(opaque.at(1, 0, 1), 1);
  EXPECT_EQ(opaque.at(3, 0, 2), 1);
  EXPECT_EQ(opaque.at(3, 0, 0), 0);
  const Image clear = read(png(4, 1, 2, 3, rows, chunk("PLTE", palette) + chunk("tRNS", "\x33")));
  ASSERT_EQ(clear.channel_count(), 4U);
  EXPECT_EQ(clear.at(0, 0, 3), 0.2);
  EXPECT_EQ(clear.at(0, 0, 0), 0.2);
  EXPECT_EQ(clear.at(1, 0, 3), 1);
}

TEST_F(Png, GammasNearThatOfSrgbAreSrgb) {
  const auto half = [&](std::uint32_t gamma, const std::string& further = "") {
    return read(png(1, 1, 8, 0, std::string("\0\x80", 2),
                    further + chunk("gAMA", big_endian(gamma))))
        .at(0, 0, 0);
  };
  EXPECT_NEAR(half(45455), kDecoded128, 1e-15);
  EXPECT_NEAR(half(45464), kDecoded128, 1e-15);
  EXPECT_NEAR(half(45446), kDecoded128, 1e-15);
  EXPECT_NEAR(half(45466), std::pow(128 / 255.0, 1 / 0.45466), 1e-15);
  EXPECT_NEAR(half(50000), std::pow(128 / 255.0, 2), 1e-15);
  EXPECT_NEAR(half(50000, chunk("sRGB", std::string(1, '\0'))), kDecoded128, 1e-15);
}

TEST_F(Png, SidesHave65536PixelsAtMost) {
  EXPECT_EQ(read(png(65536, 1, 1, 0, std::string(8193, '\0'))).width(), 65536U);
  EXPECT_THROW(read(png(65537, 1, 1, 0, std::string(8194, '\0'))), InputError);
  EXPECT_THROW(read(png(1, 65537, 1, 0, std::string(65534, '\0'))), InputError);
}

TEST_F(Png, TextsOfFilesAreRead) {
  write_bytes(path("hand.png"), png(1, 1, 8, 0, std::string("\0\x80", 2),
                                    chunk("tEXt", std::string("Title\0a car", 11)) +
                                        chunk("tEXt", std::string("Empty\0", 6))));
  EXPECT_THAT(read_image(path("hand.png")).attributes,
              testing::ElementsAre(testing::Pair("Title", "a car"), testing::Pair("Empty", "")));
}

}  // namespace
}  // namespace hiac
