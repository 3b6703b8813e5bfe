// Scanlines of Radiance's pictures: where runs, dumps and repetitions begin and end, and what is
// said of those that do not fit.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "hiac/base/error.hpp"
#include "hiac/image/image_io.hpp"
#include "tests/image/test_folder.hpp"

namespace hiac {
namespace {

using testing::HasSubstr;

class HdrScanlines : public FolderTest {
 protected:
  Image scanline(std::size_t width, const std::string& bytes, const std::string& further = "") {
    return whole("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n" + further + "\n-Y 1 +X " +
                 std::to_string(width) + "\n" + bytes);
  }
  Image whole(const std::string& bytes) {
    write_bytes(path("hand.hdr"), bytes);
    return read_image(path("hand.hdr")).image;
  }
  template <typename Read>
  static std::string hdr_complaint(const Read& read) {
    try {
      read();
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
  std::string scanline_complaint(std::size_t width, const std::string& bytes,
                                 const std::string& further = "") {
    return hdr_complaint([&] { scanline(width, bytes, further); });
  }
  std::string written_scanline(const Image& image) {
    write_image(path("a.hdr"), image);
    const std::string bytes = bytes_of(path("a.hdr"));
    return bytes.substr(bytes.find("+X"));
  }
};

/// A grey line: 1 has the mantissa 128 and the exponent 129.
Image grey_line(const std::vector<double>& values) {
  Image image(values.size(), 1, {"Y"});
  std::ranges::copy(values, image.values().begin());
  return image;
}

std::string hdr_bytes(std::initializer_list<int> values) {
  std::string text;
  for (const int value : values) text += static_cast<char>(value);
  return text;
}

TEST_F(HdrScanlines, RunsOfThreeAreDumpedAndRunsOfFourAreRuns) {
  EXPECT_EQ(written_scanline(grey_line({1, 1, 1, 0.5, 0.5, 0.5, 0.5, 0.75})),
            "+X 8\n" + hdr_bytes({2,        2,   0,   8,                      //
                                  0x80 + 7, 128, 1,   192,                    // red
                                  0x80 + 7, 128, 1,   192,                    // green
                                  0x80 + 7, 128, 1,   192,                    // blue
                                  3,        129, 129, 129, 0x80 + 5, 128}));  // exponents
  EXPECT_EQ(written_scanline(grey_line({1, 1.5, 1.5, 1.5, 1.75, 1.75, 1.75, 1.75})),
            "+X 8\n" + hdr_bytes({2,        2,   0,   8,                        //
                                  4,        128, 192, 192, 192, 0x80 + 4, 224,  // red
                                  4,        128, 192, 192, 192, 0x80 + 4, 224,  // green
                                  4,        128, 192, 192, 192, 0x80 + 4, 224,  // blue
                                  0x80 + 8, 129}));                             // exponents
}

TEST_F(HdrScanlines, RunsHave127BytesAtMostAndDumps128) {
  const std::string run = written_scanline(grey_line(std::vector<double>(131, 1.0)));
  EXPECT_EQ(run.substr(7, 8), hdr_bytes({2, 2, 0, 131, 0xff, 128, 0x84, 128}));
  std::vector<double> changing;
  for (int x = 0; x < 129; ++x) changing.push_back(x % 2 == 0 ? 1 : 1.5);
  const std::string dump = written_scanline(grey_line(changing));
  EXPECT_EQ(dump.substr(7, 6), hdr_bytes({2, 2, 0, 129, 128, 128}));
  EXPECT_EQ(dump.substr(7 + 4 + 129, 2), hdr_bytes({1, 128}));
  EXPECT_EQ(dump.size(), 7 + 4 + 3 * (129 + 2) + 5U);  // exponents: a run of 127, a dump of 2
}

TEST_F(HdrScanlines, OnlyWidthsOf8To32767AreEncoded) {
  const auto line = [&](std::size_t width) {
    return written_scanline(grey_line(std::vector<double>(width, 1.0)));
  };
  EXPECT_EQ(line(7).size(), 5 + 4 * 7U);
  EXPECT_EQ(line(8), "+X 8\n" + hdr_bytes({2, 2, 0, 8, 0x88, 128, 0x88, 128, 0x88, 128,  //
                                           0x88, 129}));
  EXPECT_EQ(line(32767).substr(9, 4), hdr_bytes({2, 2, 127, 255}));
  EXPECT_EQ(read_image(path("a.hdr")).image.at(32766, 0, 2), 1);
  EXPECT_EQ(line(32768).size(), 9 + 4 * 32768U);
  EXPECT_EQ(read_image(path("a.hdr")).image.at(32767, 0, 2), 1);
}

TEST_F(HdrScanlines, PixelsThatLookLikeAnEncodedLineArePixelsInOtherWidths) {
  // of 7 pixels, none is encoded; with a third byte of 128, none is, whatever the width
  const Image narrow = scanline(7, hdr_bytes({2, 2, 0, 7}) + std::string(24, '\x90'));
  EXPECT_EQ(narrow.at(0, 0, 1), std::ldexp(2.0, 7 - 136));
  EXPECT_EQ(narrow.at(0, 0, 2), 0);
  EXPECT_EQ(narrow.at(6, 0, 0), std::ldexp(144.0, 144 - 136));
  const Image bright = scanline(8, hdr_bytes({2, 2, 128, 136}) + std::string(28, '\x90'));
  EXPECT_EQ(bright.at(0, 0, 0), 2);
  EXPECT_EQ(bright.at(0, 0, 2), 128);
  const Image other = scanline(8, hdr_bytes({2, 3, 0, 136}) + std::string(28, '\x90'));
  EXPECT_EQ(other.at(0, 0, 1), 3);
}

TEST_F(HdrScanlines, RepetitionsInARowAreDigitsOfOneNumber) {
  std::string bytes = hdr_bytes({128, 0, 0, 129, 1, 1, 1, 2, 1, 1, 1, 1});  // 2 + 256 * 1
  for (int x = 0; x < 40; ++x) bytes += hdr_bytes({x + 2, 0, 0, 136});
  bytes += hdr_bytes({1, 1, 1, 1});
  const Image image = scanline(300, bytes);
  EXPECT_EQ(image.at(258, 0, 0), 1);
  EXPECT_EQ(image.at(259, 0, 0), 2);
  EXPECT_EQ(image.at(298, 0, 0), 41);
  EXPECT_EQ(image.at(299, 0, 0), 41);  // a pixel between begins a number anew
}

// Three times four bytes are a scanline of any length, here one of 43 + 256 repetitions.
TEST_F(HdrScanlines, FewBytesOfRepetitionsAreManyPixels) {
  const std::string pixel = hdr_bytes({128, 64, 0, 129}),
                    bytes = pixel + hdr_bytes({1, 1, 1, 43, 1, 1, 1, 1});
  const Image image = scanline(300, bytes);
  EXPECT_EQ(image.at(299, 0, 0), 1);
  EXPECT_EQ(image.at(299, 0, 1), 0.5);
  EXPECT_EQ(scanline_complaint(301, bytes),
            path("hand.hdr") + ": the file ends too early (within its pixels)");
  const std::string longest = pixel + hdr_bytes({1, 1, 1, 255, 1, 1, 1, 255});
  EXPECT_EQ(scanline(65536, longest).at(65535, 0, 0), 1);
  const std::string two = "#?R\n\n-Y 2 +X 300\n";
  EXPECT_EQ(whole(two + bytes + bytes).at(299, 1, 1), 0.5);
  EXPECT_EQ(hdr_complaint([&] { whole(two + bytes); }),
            path("hand.hdr") + ": the file ends too early (within its pixels)");
}

TEST_F(HdrScanlines, ThatDoNotFitAreRefused) {
  const std::string beyond =
      "malformed Radiance picture (a repetition of no pixel, or beyond its scanline)";
  const std::string pixel = hdr_bytes({128, 0, 0, 129});
  const struct {
    std::size_t width;
    std::string bytes;
    std::string message;  ///< empty: none
  } cases[] = {
      {3, pixel + hdr_bytes({1, 1, 1, 2}), ""},
      {3, pixel + hdr_bytes({1, 1, 1, 3}), beyond},
      {3, hdr_bytes({1, 1, 1, 1}) + pixel + pixel, beyond},
      {3, pixel + pixel, "the file ends too early (within its pixels)"},
      {8, hdr_bytes({2, 2, 0, 9}),
       "malformed Radiance picture (a scanline of 9 pixels, expected 8)"},
      {8, hdr_bytes({2, 2, 127, 8}),
       "malformed Radiance picture (a scanline of 32520 pixels, expected 8)"},
      {8, hdr_bytes({2, 2, 0, 8, 0x80 + 9, 1}),
       "malformed Radiance picture (a scanline with 8 pixels left goes on by 9)"},
      {8, hdr_bytes({2, 2, 0, 8, 0x80 + 5, 1, 4}),
       "malformed Radiance picture (a scanline with 3 pixels left goes on by 4)"},
      {8, hdr_bytes({2, 2, 0, 8, 0}),
       "malformed Radiance picture (a scanline with 8 pixels left goes on by 0)"},
      {8, hdr_bytes({2, 2, 0, 8, 0x80}),
       "malformed Radiance picture (a scanline with 8 pixels left goes on by 128)"},
      {8, hdr_bytes({2, 2, 0, 8, 0x88, 1, 0x88, 1, 0x88, 1, 0x88}),
       "the file ends too early (within its pixels)"},
      {8, hdr_bytes({2, 2, 0, 8, 0x88, 1, 0x88, 1, 0x88, 1, 0x88, 1}), ""},
      {15, "", "the file ends too early (within its pixels)"},
      {16, "", "the file ends too early (within its pixels)"},
      {16, "1", "the file ends too early (within its pixels)"},
      {0, "",
       "impossible image size (expected 1 to 65536 pixels a side and 1 to 1024 channels, "
       "found 0 x 1 with 3 channels)"},
      {65536, "", "the file ends too early (within its pixels)"},
      {65536, pixel, "the file ends too early (within its pixels)"},
      {65537, "",
       "impossible image size (expected 1 to 65536 pixels a side and 1 to 1024 "
       "channels, found 65537 x 1 with 3 channels)"},
  };
  for (const auto& c : cases)
    EXPECT_EQ(scanline_complaint(c.width, c.bytes),
              c.message.empty() ? "no error" : path("hand.hdr") + ": " + c.message);
}

TEST_F(HdrScanlines, HeadersThatAreNoneAreRefused) {
  const std::string endless = "not a Radiance picture (its header has no end)";
  const std::string turned =
      "a Radiance picture of another orientation (expected -Y height +X width)";
  const std::pair<std::string, std::string> cases[] = {
      {"", endless},
      {"#?RADIANCE", endless},
      {"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n", endless},
      {"#?RADIANCE\n\n-Y 1 +X 1", endless},
      {"#!RADIANCE\n", "not a Radiance picture (expected #? first)"},
      {"#?R\nFORMAT=32-bit_rle_xyze\n",
       "a Radiance picture of another format (expected 32-bit_rle_rgbe)"},
      {"#?R\n\n+Y 1 +X 1\n", turned},
      {"#?R\n\n-Y 1 -X 1\n", turned},
      {"#?R\n\n-Y a +X 1\n", turned},
      {"#?R\n\n-Y 1 +X a\n", turned},
      {"#?R\n\n-X 1 +Y 1\n", turned},
  };
  for (const auto& [bytes, message] : cases)
    EXPECT_THAT(hdr_complaint([&] { whole(bytes); }), HasSubstr("hand.hdr: " + message)) << bytes;
  EXPECT_EQ(whole("#?R\n\n-Y 1 +X 1\n" + hdr_bytes({128, 64, 32, 129})).at(0, 0, 1), 0.5);
}

TEST_F(HdrScanlines, ExposuresArePositiveAndMultiply) {
  const std::string pixel = hdr_bytes({128, 0, 0, 129});
  EXPECT_EQ(scanline(1, pixel, "EXPOSURE=0.5\nEXPOSURE=  0.25\n").at(0, 0, 0), 8);
  for (const char* exposure : {"0", "-1", "inf", "nan", "", " ", "x"})
    EXPECT_THAT(scanline_complaint(1, pixel, std::string("EXPOSURE=") + exposure + "\n"),
                HasSubstr("malformed Radiance header (expected a positive exposure)"))
        << exposure;
  for (const char* exposure : {"1e-200", "1e200"})
    EXPECT_THAT(
        scanline_complaint(1, pixel, fmt::format("EXPOSURE={0}\nEXPOSURE={0}\n", exposure)),
        HasSubstr("malformed Radiance header (the product of its exposures is 0 or infinite)"));
}

}  // namespace
}  // namespace hiac
