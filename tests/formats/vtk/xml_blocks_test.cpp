// Binary arrays of VTK's XML files, byte by byte: headers, base64 and compressed blocks, of which
// any part can be read.
#include <cstring>
#include <numeric>

#include <fmt/format.h>

#include "formats/vtk/xml/xml_array.hpp"
#include "hiac/base/error.hpp"
#include "tests/formats/files.hpp"

namespace hiac::formats::vtk {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Encoding = XmlArray::Encoding;
using Compressor = XmlStorage::Compressor;
using Family = NumberType::Family;

/// The integer's lowest bytes.
std::string bytes_of(std::uint64_t value, std::size_t count, bool big_endian = false) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i)
    text += static_cast<char>(value >> 8 * (big_endian ? count - 1 - i : i));
  return text;
}

std::string base64_of(const std::string& bytes) {
  constexpr const char* kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k <= bytes.size() ? kDigits[word >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

/// What zlib makes of bytes that it does not compress (RFC 1950, 1951).
std::string stored_by_zlib(const std::string& bytes) {
  std::uint32_t a = 1;
  std::uint32_t b = 0;
  for (const char c : bytes) {
    a = (a + static_cast<unsigned char>(c)) % 65521;
    b = (b + a) % 65521;
  }
  return std::string("\x78\x01\x01", 3) + bytes_of(bytes.size(), 2) + bytes_of(~bytes.size(), 2) +
         bytes + bytes_of(b << 16 | a, 4, true);
}

XmlArray array_of(Family family, std::size_t width, Encoding encoding, std::string_view data) {
  XmlArray array;
  array.name = "a";
  array.type = {family, width};
  array.encoding = encoding;
  array.data = data;
  return array;
}

/// What the check says of `values` numbers; empty where they are fine.
std::string complaint_about(XmlArray array, std::size_t values, const XmlStorage& storage = {}) {
  try {
    check_xml_array(array, values, storage, true, "file");
  } catch (const InputError& error) {
    return std::string(error.what()).substr(std::string("file: array 'a': ").size());
  }
  return {};
}

TEST(XmlBlocks, RawBytesBehindTheirCount) {
  for (const bool big : {false, true})
    for (const std::size_t word : {4, 8}) {
      const XmlStorage storage{big, word, Compressor::none};
      const std::string data = bytes_of(6, word, big) + bytes_of(0x0102, 2, big) +
                               bytes_of(0xfffe, 2, big) + bytes_of(7, 2, big);
      const auto shorts = [&](std::string_view text) {
        return array_of(Family::signed_integer, 2, Encoding::raw, text);
      };
      EXPECT_EQ(complaint_about(shorts(data), 3, storage), "");
      EXPECT_EQ(complaint_about(shorts(data), 4, storage),
                "the data end too soon (8 bytes expected, 6 found)");
      EXPECT_EQ(
          complaint_about(shorts(std::string_view(data).substr(0, data.size() - 1)), 2, storage),
          fmt::format("the data end too soon ({} bytes expected, {} found)", word + 6, word + 5));
      EXPECT_EQ(complaint_about(shorts(std::string_view(data).substr(0, word - 1)), 1, storage),
                fmt::format("the data end too soon ({} bytes expected, {} found)", word, word - 1));
      EXPECT_EQ(complaint_about(shorts({}), 0, storage), "");
      const std::string wrong = bytes_of(100, word, big) + data.substr(word);
      EXPECT_EQ(complaint_about(shorts(wrong), 3, storage),
                fmt::format("the data end too soon (100 bytes expected, {} found)", wrong.size()));
      EXPECT_THAT(read_xml_integers(shorts(data), 0, 3, storage, "file"), ElementsAre(258, -2, 7));
      EXPECT_THAT(read_xml_integers(shorts(data), 1, 1, storage, "file"), ElementsAre(-2));
      EXPECT_THAT(read_xml_integers(array_of(Family::unsigned_integer, 2, Encoding::raw, data), 1,
                                    2, storage, "file"),
                  ElementsAre(65534, 7));
      EXPECT_THAT(read_xml_reals(shorts(data), 2, storage, "file"), ElementsAre(258, -2));
    }
}

TEST(XmlBlocks, RealsOfBothWidths) {
  const auto bits = [](auto number) {
    std::uint64_t word = 0;
    std::memcpy(&word, &number, sizeof(number));
    return word;
  };
  for (const bool big : {false, true}) {
    const XmlStorage storage{big, 4, Compressor::none};
    const std::string wide =
        bytes_of(16, 4, big) + bytes_of(bits(1.5), 8, big) + bytes_of(bits(-1e300), 8, big);
    EXPECT_THAT(read_xml_reals(array_of(Family::real, 8, Encoding::raw, wide), 2, storage, "file"),
                ElementsAre(1.5, -1e300));
    const std::string narrow = base64_of(bytes_of(8, 4, big) + bytes_of(bits(0.25F), 4, big) +
                                         bytes_of(bits(-3.0F), 4, big));
    EXPECT_THAT(
        read_xml_reals(array_of(Family::real, 4, Encoding::base64, narrow), 2, storage, "file"),
        ElementsAre(0.25, -3));
  }
  EXPECT_THAT(
      read_xml_reals(array_of(Family::real, 8, Encoding::ascii, " 1 2.5\n-3e1 7"), 3, {}, "file"),
      ElementsAre(1, 2.5, -30));
  EXPECT_THAT(read_xml_integers(array_of(Family::signed_integer, 8, Encoding::ascii, "5 6\n7 8 9"),
                                2, 2, {}, "file"),
              ElementsAre(7, 8));
}

TEST(XmlBlocks, DigitsOfBase64) {
  // every value of a digit, and every length of the last group
  for (std::size_t count = 1; count <= 256; count += count < 8 ? 1 : 31) {
    std::string bytes = bytes_of(count, 4);
    for (std::size_t i = 0; i < count; ++i) bytes += static_cast<char>(255 - 37 * i);
    const std::string text = base64_of(bytes);
    const XmlArray array = array_of(Family::unsigned_integer, 1, Encoding::base64, text);
    ASSERT_EQ(complaint_about(array, count), "");
    const auto values = read_xml_integers(array, 0, count, {}, "file");
    for (std::size_t i = 0; i < count; ++i)
      ASSERT_EQ(values[i], static_cast<unsigned char>(255 - 37 * i));
    EXPECT_THAT(complaint_about(array_of(Family::unsigned_integer, 1, Encoding::base64,
                                         std::string_view(text).substr(0, text.size() - 1)),
                                count),
                HasSubstr("the data end too soon"));
  }
  const std::string text = base64_of(bytes_of(4, 4) + "abcd");
  ASSERT_EQ(text, "BAAAAGFiY2Q=");
  const auto digits = [](std::string_view data) {
    return complaint_about(array_of(Family::unsigned_integer, 1, Encoding::base64, data), 4);
  };
  EXPECT_EQ(digits("BAAAAGFiY2Q="), "");
  // what fills the last group is not looked at, but where a tag begins the data end
  EXPECT_EQ(digits("BAAAAGFiY2Q*"), "");
  EXPECT_EQ(digits("BAAAAGFiY2Q<"), "the data end too soon (11 base64 digits expected, 11 found)");
  EXPECT_EQ(digits("BAAAAGFiY2=="), "the data end too soon (11 base64 digits expected, 10 found)");
  EXPECT_EQ(digits("BA-AAGFiY2Q="), "the data end too soon (6 base64 digits expected, 2 found)");
}

/// Blocks of `size` bytes, stored.
std::string blocks_of(const std::string& bytes, std::size_t size, std::size_t word, bool base64) {
  std::vector<std::string> packed;
  for (std::size_t at = 0; at < bytes.size(); at += size)
    packed.push_back(stored_by_zlib(bytes.substr(at, size)));
  std::string header =
      bytes_of(packed.size(), word) + bytes_of(size, word) + bytes_of(bytes.size() % size, word);
  for (const std::string& block : packed) header += bytes_of(block.size(), word);
  const std::string data = std::accumulate(packed.begin(), packed.end(), std::string());
  return base64 ? base64_of(header) + base64_of(data) : header + data;
}

TEST(XmlBlocks, AnyPartOfCompressedBlocks) {
  std::string bytes;
  for (int i = 0; i < 12; ++i) bytes += bytes_of(static_cast<std::uint64_t>(1000 + i), 2);
  for (const std::size_t word : {4, 8})
    for (const bool base64 : {false, true})
      for (const std::size_t size : {2, 6, 7, 8, 10, 24, 100}) {
        const std::string data = blocks_of(bytes, size, word, base64);
        const XmlStorage storage{false, word, Compressor::zlib};
        const XmlArray array =
            array_of(Family::signed_integer, 2, base64 ? Encoding::base64 : Encoding::raw, data);
        ASSERT_EQ(complaint_about(array, 12, storage), "") << size;
        EXPECT_EQ(complaint_about(array, 13, storage),
                  "the data end too soon (26 bytes expected, 24 found)");
        for (std::size_t first = 0; first < 12; ++first)
          for (std::size_t count = 1; first + count <= 12; ++count) {
            const auto values = read_xml_integers(array, first, count, storage, "file");
            ASSERT_EQ(values.size(), count);
            for (std::size_t i = 0; i < count; ++i)
              ASSERT_EQ(values[i], static_cast<std::int64_t>(1000 + first + i)) << size;
          }
        EXPECT_THAT(complaint_about(array_of(Family::signed_integer, 2, array.encoding,
                                             std::string_view(data).substr(0, data.size() - 4)),
                                    12, storage),
                    HasSubstr("the data end too soon"));
      }
}

/// Words of four bytes, then bytes.
std::string header_of(std::initializer_list<std::uint64_t> words, std::size_t bytes = 0) {
  std::string text;
  for (const std::uint64_t word : words) text += bytes_of(word, 4);
  return text + std::string(bytes, 'x');
}

std::string block_complaint(const std::string& data, Compressor compressor = Compressor::zlib,
                            std::size_t values = 1, std::size_t word = 4) {
  return complaint_about(array_of(Family::unsigned_integer, 1, Encoding::raw, data), values,
                         {false, word, compressor});
}

TEST(XmlBlocks, HeadersOfBlocksAreChecked) {
  EXPECT_EQ(block_complaint(header_of({1, 8, 0, 5}, 5)), "");
  EXPECT_EQ(block_complaint(header_of({1, 8, 8, 5}, 5)), "");
  EXPECT_EQ(block_complaint(header_of({1, 8, 9, 5}, 5)),
            "wrong size of compressed blocks (8, the last 9)");
  EXPECT_EQ(block_complaint(header_of({1, 0, 0, 5}, 5)),
            "wrong size of compressed blocks (0, the last 0)");
  EXPECT_EQ(block_complaint(header_of({0, 0, 0})),
            "the data end too soon (1 bytes expected, 0 found)");
  EXPECT_EQ(block_complaint(header_of({0, 0})),
            "the data end too soon (12 bytes expected, 8 found)");
  EXPECT_EQ(block_complaint(header_of({22, 8, 0, 5}, 5)), "wrong number of compressed blocks (22)");
  EXPECT_EQ(block_complaint(header_of({21, 8, 0, 5}, 5)),
            "the data end too soon (96 bytes expected, 21 found)");
  EXPECT_EQ(block_complaint(header_of({1, 8, 0, 22}, 5)),
            "wrong size of compressed block 0 (22 bytes for 8)");
  EXPECT_EQ(block_complaint(header_of({1, 8, 0, 21}, 5)),
            "the data end too soon (21 bytes expected, 5 found)");
  EXPECT_EQ(block_complaint(header_of({2, 8, 3, 2, 4}, 5)),
            "the data end too soon (6 bytes expected, 5 found)");
  EXPECT_EQ(block_complaint(header_of({2, 8, 3, 2, 3}, 5), Compressor::zlib, 11), "");
  EXPECT_EQ(block_complaint(header_of({2, 8, 3, 2, 3}, 5), Compressor::zlib, 12),
            "the data end too soon (12 bytes expected, 11 found)");
  EXPECT_EQ(block_complaint(header_of({2, 8, 0, 2, 3}, 5), Compressor::zlib, 16), "");
  const auto wide = [](std::uint64_t size) {
    return block_complaint(
        bytes_of(1, 8) + bytes_of(size, 8) + bytes_of(0, 8) + bytes_of(1, 8) + "x",
        Compressor::zlib, 1, 8);
  };
  EXPECT_EQ(wide(std::uint64_t{1} << 40),
            "wrong size of compressed blocks (1099511627776, the last 0)");
  EXPECT_EQ(wide((std::uint64_t{1} << 40) - 1),
            "wrong size of compressed block 0 (1 bytes for 1099511627775)");
}

// What a byte can become: RFC 1951's 1032 at most, LZ4's 255, and some for a block's frame.
TEST(XmlBlocks, BlocksDoNotGrowWithoutBound) {
  for (const auto& [compressor, factor] : {std::pair{Compressor::zlib, std::size_t{1040}},
                                           {Compressor::lz4, std::size_t{256}},
                                           {Compressor::lzma, std::size_t{16384}}})
    for (const std::size_t packed : {1, 3}) {
      const std::size_t most = factor * packed + 4096;
      EXPECT_EQ(block_complaint(header_of({1, most, 0, packed}, packed), compressor), "");
      EXPECT_EQ(
          block_complaint(header_of({1, most + 1, 0, packed}, packed), compressor),
          fmt::format("wrong size of compressed block 0 ({} bytes for {})", packed, most + 1));
      // the last of two blocks is shorter
      EXPECT_EQ(block_complaint(header_of({2, most, 5, packed, 1}, packed + 1), compressor), "");
      EXPECT_EQ(
          block_complaint(header_of({2, most + 1, 5, packed, 1}, packed + 1), compressor),
          fmt::format("wrong size of compressed block 0 ({} bytes for {})", packed, most + 1));
    }
}

TEST(XmlBlocks, DamagedBlocksAreNamed) {
  const XmlStorage storage{false, 4, Compressor::zlib};
  std::string bytes;
  for (int i = 0; i < 8; ++i) bytes += bytes_of(static_cast<std::uint64_t>(i), 1);
  const std::string data = blocks_of(bytes, 4, 4, false);
  const auto read = [&](std::size_t at, std::size_t first, std::size_t count) -> std::string {
    std::string damaged = data;
    damaged[at] = static_cast<char>(~damaged[at]);
    // VTK itself complains of it on the standard error
    testing::internal::CaptureStderr();
    std::string said = "fine";
    try {
      read_xml_integers(array_of(Family::unsigned_integer, 1, Encoding::raw, damaged), first, count,
                        storage, "file");
    } catch (const InputError& error) {
      said = error.what();
    }
    testing::internal::GetCapturedStderr();
    return said;
  };
  const std::size_t second = 20 + stored_by_zlib("0123").size();
  EXPECT_EQ(read(20, 0, 4), "file: array 'a': compressed block 0 is damaged");
  EXPECT_EQ(read(second, 4, 1), "file: array 'a': compressed block 1 is damaged");
  // only the blocks that hold what is asked for are unpacked
  EXPECT_EQ(read(second, 0, 4), "fine");
  EXPECT_EQ(read(20, 4, 4), "fine");
  EXPECT_EQ(read(second, 3, 2), "file: array 'a': compressed block 1 is damaged");
}

}  // namespace
}  // namespace hiac::formats::vtk
