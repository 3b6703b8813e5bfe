#include <cstring>
#include <optional>

#include <gmock/gmock.h>
#include <tiffio.h>

#include "hiac/base/error.hpp"
#include "hiac/image/files/image_description.hpp"
#include "hiac/image/files/image_formats.hpp"
#include "hiac/image/image_io.hpp"
#include "tests/image/test_folder.hpp"

namespace hiac {
namespace {

/// A file as other programs could write it: two rows of two pixels.
struct Foreign {
  int depth = 8, channels = 4, format = SAMPLEFORMAT_UINT;
  int compression = COMPRESSION_NONE, planar = PLANARCONFIG_CONTIG;
  int photometric = PHOTOMETRIC_RGB, orientation = ORIENTATION_TOPLEFT;
  std::optional<std::uint16_t> alpha = EXTRASAMPLE_UNASSALPHA;
  std::string samples{};  ///< as the planes have them
};

class TiffFiles : public FolderTest {
 protected:
  Image read(const Foreign& foreign, bool linear = true) {
    TIFFSetWarningHandler(nullptr);
    TIFF* tiff = TIFFOpen(path("a.tif").c_str(), "wb");
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, 2);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, 2);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, foreign.depth);
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, foreign.channels);
    TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, foreign.format);
    TIFFSetField(tiff, TIFFTAG_COMPRESSION, foreign.compression);
    TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, foreign.planar);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, foreign.photometric);
    TIFFSetField(tiff, TIFFTAG_ORIENTATION, foreign.orientation);
    TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 1);
    if (foreign.alpha) TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, 1, &*foreign.alpha);
    const bool is_planar = foreign.planar == PLANARCONFIG_SEPARATE;
    const int planes = is_planar ? foreign.channels : 1;
    std::string samples = foreign.samples;
    samples.resize(static_cast<std::size_t>(4 * foreign.channels * foreign.depth / 8));
    const std::size_t row = samples.size() / static_cast<std::size_t>(2 * planes);
    for (int plane = 0; plane < planes; ++plane)
      for (unsigned y = 0; y < 2; ++y)
        TIFFWriteScanline(tiff, &samples[(static_cast<unsigned>(plane) * 2 + y) * row], y,
                          static_cast<std::uint16_t>(plane));
    TIFFClose(tiff);
    return read_image(path("a.tif"), {.linear = linear}).image;
  }
  std::string complaint(const Foreign& foreign) {
    try {
      read(foreign);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
};

TEST_F(TiffFiles, GiveEverySampleBack) {
  for (const int depth : {8, 16, 32})
    for (const auto& channels : {rgba_channels(), {"R", "G", "B"}, {"Y"}, {"Y", "A"}}) {
      // more rows than a strip has
      const Image image = random_picture(61, 200, channels);
      write_image(path("a.tiff"), image, {.depth = depth});
      const Image once = read_image(path("a.tiff")).image;
      EXPECT_THAT(once.channels(), testing::ElementsAreArray(channels));
      write_image(path("b.tiff"), once, {.depth = depth});
      EXPECT_EQ(bytes_of(path("a.tiff")), bytes_of(path("b.tiff"))) << depth;
      if (depth != 32) continue;
      for (std::size_t i = 0; i < image.values().size(); ++i)
        ASSERT_EQ(once.values()[i], static_cast<double>(static_cast<float>(image.values()[i])));
    }
}

TEST_F(TiffFiles, OfOtherProgramsAreRead) {
  const std::string pixels("\xff\x66\0\x33\0\0\0\xff\1\2\3\xff\4\5\6\xff", 16);
  for (const int compression : {COMPRESSION_NONE, COMPRESSION_LZW, COMPRESSION_PACKBITS,
                                COMPRESSION_DEFLATE, COMPRESSION_ADOBE_DEFLATE}) {
    const Image image = read({.compression = compression, .samples = pixels});
    EXPECT_EQ(image.at(0, 0, 0), 0.2);
    EXPECT_EQ(image.at(0, 0, 1), 0.4 * 0.2);
    EXPECT_EQ(image.at(0, 0, 3), 0.2);
    EXPECT_EQ(image.at(1, 1, 2), 6 / 255.0);
  }
  const Image planar =
      read({.planar = PLANARCONFIG_SEPARATE,
            .samples = std::string("\x33\1\2\3\0\0\0\0\4\5\6\7\xff\xff\xff\xff", 16)});
  EXPECT_EQ(planar.at(0, 0, 0), 0.2);
  EXPECT_EQ(planar.at(1, 1, 2), 7 / 255.0);
  const Image srgb = read({.channels = 1,
                           .photometric = PHOTOMETRIC_MINISBLACK,
                           .alpha = std::nullopt,
                           .samples = "\x80"},
                          false);
  EXPECT_NEAR(srgb.at(0, 0, 0), 0.21586050011389926, 1e-15);
}

TEST_F(TiffFiles, SayHowAlphaIsMeant) {
  const std::string pixel("\x33\x33\0\x33", 4);
  EXPECT_EQ(read({.alpha = EXTRASAMPLE_ASSOCALPHA, .samples = pixel}).at(0, 0, 0), 0.2);
  EXPECT_NEAR(read({.alpha = EXTRASAMPLE_UNASSALPHA, .samples = pixel}).at(0, 0, 0), 0.04, 1e-17);
  EXPECT_NEAR(read({.alpha = EXTRASAMPLE_UNSPECIFIED, .samples = pixel}).at(0, 0, 0), 0.04, 1e-17);
  const float numbers[] = {0.5F, 0.25F, 8, 0.5F};
  const std::string floats(reinterpret_cast<const char*>(numbers), sizeof numbers);
  const auto first = [&](std::uint16_t alpha) {
    return read({.depth = 32, .format = SAMPLEFORMAT_IEEEFP, .alpha = alpha, .samples = floats})
        .at(0, 0, 2);
  };
  EXPECT_EQ(first(EXTRASAMPLE_ASSOCALPHA), 8);
  EXPECT_EQ(first(EXTRASAMPLE_UNSPECIFIED), 8);
  EXPECT_EQ(first(EXTRASAMPLE_UNASSALPHA), 4);
  const Foreign straight{.depth = 32, .format = SAMPLEFORMAT_IEEEFP, .samples = floats};
  EXPECT_EQ(read(straight).at(0, 0, 0), 0.25);
  EXPECT_EQ(read(straight).at(0, 0, 3), 0.5);
}

// A premultiplied colour above alpha counts as alpha: a straight colour is at most 1.
TEST_F(TiffFiles, ColourIsAtMostAlphaWhereIntegersArePremultiplied) {
  const std::string pixels("\x66\x33\x1a\x33\xff\xff\xff\x01", 8);
  for (const bool linear : {true, false}) {
    const Image image = read({.alpha = EXTRASAMPLE_ASSOCALPHA, .samples = pixels}, linear);
    EXPECT_EQ(image.at(0, 0, 3), 0.2);
    EXPECT_EQ(image.at(0, 0, 0), 0.2);  // 0x66 above 0x33
    EXPECT_EQ(image.at(0, 0, 1), 0.2);
    EXPECT_LT(image.at(0, 0, 2), 0.11);  // 0x1a below it
    for (std::size_t c = 0; c < 4; ++c) EXPECT_EQ(image.at(1, 0, c), 1 / 255.0);
  }
  // sixteen bits, low byte first
  const std::string deep("\xff\xff\x00\x80\x00\x40\x00\x80", 8);
  const Image image = read({.depth = 16, .alpha = EXTRASAMPLE_ASSOCALPHA, .samples = deep});
  EXPECT_EQ(image.at(0, 0, 0), 32768 / 65535.0);
  EXPECT_EQ(image.at(0, 0, 1), 32768 / 65535.0);
  EXPECT_NEAR(image.at(0, 0, 2), 16384 / 65535.0, 1e-16);
}

TEST_F(TiffFiles, OfOtherKindsAreRefusedByName) {
  TIFFSetErrorHandler(nullptr);  // what the writer here thinks of them
  EXPECT_THAT(complaint({.compression = COMPRESSION_JPEG}), testing::HasSubstr("a compression"));
  EXPECT_THAT(complaint({.photometric = PHOTOMETRIC_CIELAB}), testing::HasSubstr("photometric"));
  EXPECT_THAT(complaint({.orientation = ORIENTATION_BOTLEFT}), testing::HasSubstr("orientation"));
  EXPECT_THAT(complaint({.channels = 5}), testing::HasSubstr("channels"));
  EXPECT_THAT(complaint({.depth = 32}), testing::HasSubstr("a depth"));
  EXPECT_THAT(complaint({.depth = 64, .format = SAMPLEFORMAT_IEEEFP}),
              testing::HasSubstr("a depth"));
  EXPECT_THAT(complaint({.format = SAMPLEFORMAT_INT}), testing::HasSubstr("a sample format"));
}

TEST_F(TiffFiles, KeepTexts) {
  const WriteOptions options{.attributes = {{"Software", "hiac-render 1"},
                                            {"hiac:mesh", "0123"},
                                            {"hiac:specification", "[image]\n# \"ä\"\t\\ \x01"}}};
  for (const int depth : {8, 32}) {
    WriteOptions of_depth = options;
    of_depth.depth = depth;
    write_image(path("a.tiff"), random_picture(5, 4), of_depth);
    EXPECT_EQ(read_image(path("a.tiff")).attributes, options.attributes) << depth;
    write_image(path("b.tiff"), random_picture(5, 4), of_depth);
    EXPECT_EQ(bytes_of(path("a.tiff")), bytes_of(path("b.tiff"))) << depth;
  }
  write_image(path("plain.tiff"), random_picture(5, 4));
  EXPECT_THAT(read_image(path("plain.tiff")).attributes,
              testing::ElementsAre(testing::Pair("Software", "hiac")));
}

TEST_F(TiffFiles, TextsAreAscii) {
  write_image(path("a.tiff"), random_picture(5, 4), {.attributes = {{"name", "caf\xe9 \xc3\xa4"}}});
  EXPECT_THAT(bytes_of(path("a.tiff")), testing::HasSubstr("{\"name\":\"caf\\ufffd \\u00e4\"}"));
}

// What other programs say of a picture is one text, JSON or not.
TEST_F(TiffFiles, TextsOfOtherProgramsAreKeptWhole) {
  using image_files::from_description;
  for (const char* text : {"a car", "{\"a\": 1}", "[\"a\"]", "\"a\"", "{\"a\": \"b\"", ""})
    EXPECT_THAT(from_description(text),
                testing::ElementsAre(testing::Pair("ImageDescription", text)));
  EXPECT_THAT(from_description("{\"b\": \"x\", \"a\": \"\"}"),
              testing::ElementsAre(testing::Pair("b", "x"), testing::Pair("a", "")));
}

TEST_F(TiffFiles, SurviveDamage) {
  for (const int depth : {8, 32}) {
    write_image(path("a.tiff"), random_picture(30, 40),
                {.attributes = {{"hiac:mesh", "0123"}}, .depth = depth});
    const std::string good = bytes_of(path("a.tiff"));
    const auto read_bytes = [&](const std::string& bytes) {
      write_bytes(path("damaged.tiff"), bytes);
      // in this process, in which the sanitizers see what the library does
      return image_files::read_tiff(path("damaged.tiff"), false);
    };
    // the directory, mostly: it stands behind the pixels
    std::string turned(good.rbegin(), good.rend());
    expect_survival(turned, 300, 2000, [&](const std::string& bytes) {
      return read_bytes({bytes.rbegin(), bytes.rend()});
    });
    for (std::size_t length = 0; length < good.size(); length += 1 + good.size() / 100)
      EXPECT_THROW(read_bytes(good.substr(0, length)), InputError) << length;
  }
}

}  // namespace
}  // namespace hiac
