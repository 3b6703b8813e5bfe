// What is said of image files that cannot be read, and of images that a format cannot hold.
#include <cmath>
#include <cstdint>
#include <utility>

#include <gmock/gmock.h>

#include "hiac/base/error.hpp"
#include "hiac/image/files/image_formats.hpp"
#include "hiac/image/image_io.hpp"
#include "tests/image/test_folder.hpp"

namespace hiac {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class ImageComplaints : public FolderTest {
 protected:
  template <typename Work>
  static std::string told_by(const Work& work) {
    try {
      work();
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }
  std::string reading(const std::string& name, const std::string& bytes,
                      const ReadOptions& options = {}) {
    write_bytes(path(name), bytes);
    return reading_there(name, options);
  }
  std::string reading_there(const std::string& name, const ReadOptions& options = {}) {
    return told_by([&] { read_image(path(name), options); });
  }
  std::string writing(const std::string& name, const Image& image,
                      const WriteOptions& options = {}) {
    return told_by([&] { write_image(path(name), image, options); });
  }
};

TEST_F(ImageComplaints, ImagesThatAFormatCannotHoldAreNamed) {
  const std::string file = path("a.png");
  EXPECT_EQ(writing("a.png", Image(1, 1, {"depth", "order"})),
            file + ": PNG needs the channels R G B or Y (found depth order)");
  EXPECT_EQ(writing("a.png", Image(1, 1, {"R", "G"})),
            file + ": PNG needs the channels R G B or Y (found R G)");
  EXPECT_EQ(writing("a.hdr", Image(1, 1, {"A"})),
            path("a.hdr") + ": Radiance HDR needs the channels R G B or Y (found A)");
  EXPECT_EQ(writing("a.png", Image(1, 0, {"Y"})), file + ": an image without pixels");
  EXPECT_EQ(writing("a.png", Image(1, 1, {"Y"}), {.depth = 32}),
            file + ": 32 bits a sample (a .png image has 8, 16)");
  EXPECT_EQ(writing("a.TIF", Image(1, 1, {"Y"}), {.depth = 64}),
            path("a.TIF") + ": 64 bits a sample (a .tif image has 8, 16, 32)");
  EXPECT_EQ(writing("a.exr", Image(1, 1, {"Y"}), {.depth = 16}),
            path("a.exr") + ": 16 bits a sample (a .exr image has 32)");
  EXPECT_THAT(writing("a.jpg", Image(1, 1, {"Y"})), HasSubstr(".hdr, found .jpg)"));
  EXPECT_THAT(writing("a", Image(1, 1, {"Y"})), HasSubstr(".hdr, found no extension)"));
  EXPECT_EQ(file_count(), 0U);
}

TEST_F(ImageComplaints, SizesAreUpTo65536AndChannelsUpTo1024) {
  using image_files::require_sane_size;
  const auto sizes = [](std::uint64_t width, std::uint64_t height, std::uint64_t channels) {
    return told_by([&] { require_sane_size(width, height, channels, "a"); });
  };
  EXPECT_EQ(sizes(65536, 65536, 1024), "no error");
  EXPECT_EQ(sizes(1, 1, 1), "no error");
  const std::string expected =
      "a: impossible image size (expected 1 to 65536 pixels a side and 1 to 1024 channels, found ";
  EXPECT_EQ(sizes(65537, 2, 3), expected + "65537 x 2 with 3 channels)");
  EXPECT_EQ(sizes(2, 65537, 3), expected + "2 x 65537 with 3 channels)");
  EXPECT_EQ(sizes(2, 1, 1025), expected + "2 x 1 with 1025 channels)");
  EXPECT_EQ(sizes(0, 1, 1), expected + "0 x 1 with 1 channels)");
  EXPECT_EQ(sizes(1, 0, 1), expected + "1 x 0 with 1 channels)");
  EXPECT_EQ(sizes(1, 1, 0), expected + "1 x 1 with 0 channels)");
}

TEST_F(ImageComplaints, FilesHoldARatioOfTheirBytesAtMost) {
  using image_files::require_possible_size;
  const auto size = [](std::uint64_t row, std::uint64_t rows, std::uint64_t bytes) {
    return told_by([&] { require_possible_size(row, rows, 10, bytes, "a"); });
  };
  EXPECT_EQ(size(50, 2, 10), "no error");
  EXPECT_EQ(size(50, 2, 9), "a: the file ends too early (9 bytes cannot hold 2 rows of 50 bytes)");
}

TEST_F(ImageComplaints, ChannelsHaveNamesByTheirNumber) {
  using image_files::default_channel_names;
  using testing::ElementsAre;
  EXPECT_THAT(default_channel_names(1), ElementsAre("Y"));
  EXPECT_THAT(default_channel_names(2), ElementsAre("Y", "A"));
  EXPECT_THAT(default_channel_names(3), ElementsAre("R", "G", "B"));
  EXPECT_THAT(default_channel_names(4), ElementsAre("R", "G", "B", "A"));
  EXPECT_THAT(default_channel_names(6), ElementsAre("R", "G", "B", "A", "channel4", "channel5"));
}

TEST_F(ImageComplaints, RawFilesNeedAWidthAndRowsOfIt) {
  const auto planes = [&](std::size_t width) { return reading_there("a.f32", {.width = width}); };
  EXPECT_EQ(planes(0),
            path("a.f32") + ": raw files do not hold their size (expected the image's width)");
  EXPECT_EQ(planes(1),
            path("a.f32") + ": cannot be opened (expected " + path("a.r.f32") + " and so on)");
  write_bytes(path("a.g.f32"), std::string(24, '\0'));
  write_bytes(path("a.a.f32"), std::string(20, '\0') + std::string("\0\0\x80\x3f", 4));
  const Image image = read_image(path("a.f32"), {.width = 3}).image;
  EXPECT_THAT(image.channels(), testing::ElementsAre("G", "A"));
  EXPECT_EQ(image.height(), 2U);
  EXPECT_EQ(image.at(2, 1, 1), 1);
  EXPECT_EQ(image.at(2, 1, 0), 0);
  EXPECT_EQ(planes(4), path("a.g.f32") +
                           ": wrong length (expected rows of 4 values, as many as in "
                           "the other channels, found 6 values)");
  write_bytes(path("a.a.f32"), std::string(12, '\0'));
  EXPECT_EQ(planes(3), path("a.a.f32") +
                           ": wrong length (expected rows of 3 values, as many as in "
                           "the other channels, found 3 values)");
  write_bytes(path("high.r.f32"), std::string(4 * 65537, '\0'));
  EXPECT_THAT(reading_there("high.f32", {.width = 1}),
              HasSubstr("found 1 x 65537 with 1 channels"));
  write_bytes(path("a.a.f32"), "12345");
  EXPECT_EQ(planes(3),
            path("a.a.f32") + ": wrong length (expected a multiple of 4 bytes, found 5)");
  write_bytes(path("a.a.f32"), "");
  EXPECT_EQ(planes(3),
            path("a.a.f32") + ": wrong length (expected a multiple of 4 bytes, found 0)");
}

TEST_F(ImageComplaints, PortableFloatMapsSayWhatIsExpected) {
  const std::pair<const char*, const char*> cases[] = {
      {"", "PF or Pf first"},
      {"PF", "PF or Pf first"},
      {"QF\n", "PF or Pf first"},
      {"P6\n1 1\n-1\n", "PF or Pf first"},
      {"PF1 1\n-1\n", "width, height and scale"},
      {"PF\n", "width, height and scale"},
      {"PF\n1\n", "width, height and scale"},
      {"PF\n1 1\n", "width, height and scale"},
      {"PF\n-1 1\n-1\n", "width, height and scale"},
      {"PF\n1 1\n-1", "one white space after the scale"},
      {"PF\n1 1\n-1x", "one white space after the scale"},
      {"PF\n1 1\n0\n", "a scale other than 0"},
      {"PF\n1 1\ninf\n", "a scale other than 0"},
      {"PF\n1 1\nnan\n", "a scale other than 0"},
  };
  for (const auto& [bytes, expected] : cases)
    EXPECT_EQ(reading("a.pfm", bytes),
              path("a.pfm") + ": not a portable float map (expected " + expected + ")")
        << bytes;
  EXPECT_EQ(reading("a.pfm", "Pf\n1 2\n-1\n1234567"),
            path("a.pfm") + ": wrong length (expected 8 bytes of numbers, found 7)");
  EXPECT_EQ(reading("a.pfm", "PF\n1 1\n-1\n1234567890123"),
            path("a.pfm") + ": wrong length (expected 12 bytes of numbers, found 13)");
  EXPECT_EQ(reading("a.pfm", "Pf\n1 1\n-1\t1234"), "no error");
}

TEST_F(ImageComplaints, OpenExrHeadersAreLookedThrough) {
  const std::string magic("\x76\x2f\x31\x01\2\0\0\0", 8);
  const std::string malformed = path("a.exr") + ": malformed OpenEXR header (";
  const std::string endless = malformed + "a name longer than 255 characters)";
  EXPECT_EQ(reading("a.exr", "not an image"),
            path("a.exr") + ": not an OpenEXR file (wrong magic number)");
  EXPECT_EQ(reading("a.exr", magic.substr(0, 7)),
            path("a.exr") + ": the file ends too early (expected 8 more bytes, found 7)");
  EXPECT_EQ(reading("a.exr", magic + std::string(256, 'n') + '\0'), endless);
  EXPECT_EQ(reading("a.exr", magic + "name" + '\0' + std::string(256, 't') + '\0'), endless);
  const std::string name = magic + std::string(255, 'n') + '\0' + std::string(255, 't') + '\0';
  EXPECT_EQ(reading("a.exr", name + std::string("\5\0\0\0", 4) + "1234"),
            malformed + "an attribute of 5 bytes, more than the file has)");
  EXPECT_EQ(reading("a.exr", name + std::string("\4\0\0\0", 4) + "1234"),
            path("a.exr") + ": the file ends too early (expected 1 more bytes, found 0)");
  EXPECT_THAT(reading("a.exr", magic + '\0'),
              StartsWith(path("a.exr") + ": not a readable OpenEXR file ("));
  EXPECT_EQ(reading("a.exr", magic.substr(0, 5) + std::string("\x10\0\0", 3) + "name" + '\0' +
                                 "type" + '\0' + std::string(4, '\0') + '\0' + "n"),
            path("a.exr") + ": the file ends too early (expected 1 more bytes, found 0)");
}

TEST_F(ImageComplaints, OpenExrTextsHaveNamesOf255Characters) {
  const Image image = random_picture(3, 2);
  const WriteOptions longest{.attributes = {{std::string(255, 'n'), "text"}}};
  EXPECT_EQ(writing("a.exr", image, longest), "no error");
  EXPECT_THAT(read_image(path("a.exr")).attributes, testing::Contains(longest.attributes[0]));
}

TEST_F(ImageComplaints, LibrariesSayWhatTheyCannotRead) {
  EXPECT_EQ(reading("a.png", "not an image at all"),
            path("a.png") + ": not a readable PNG file (Not a PNG file)");
  EXPECT_THAT(reading("a.tiff", "not an image at all"),
              StartsWith(path("a.tiff") + ": not a readable TIFF file (Not a TIFF"));
  write_image(path("a.tiff"), random_picture(40, 3));
  std::string bytes = bytes_of(path("a.tiff"));
  for (std::size_t i = 8; i < 40; ++i) bytes[i] = '\xff';  // the first strip
  EXPECT_THAT(reading("a.tiff", bytes),
              testing::AllOf(StartsWith(path("a.tiff") + ": not a readable TIFF file ("),
                             HasSubstr("Decoding error at scanline 0")));
}

}  // namespace
}  // namespace hiac
