#include <cstdlib>
#include <cstring>

#include <gmock/gmock.h>

#include "hiac/base/error.hpp"
#include "hiac/image/image_io.hpp"
#include "tests/image/test_folder.hpp"

namespace hiac {
namespace {

class Npy : public FolderTest {
 protected:
  /// A file of version 1.0 with this header and these numbers.
  template <typename T>
  Image read(const std::string& dictionary, const std::vector<T>& numbers) {
    std::string bytes("\x93NUMPY\1\0", 8);
    bytes += {static_cast<char>(dictionary.size() + 1), '\0'};
    bytes += dictionary + "\n";
    bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T));
    write_bytes(path("a.npy"), bytes);
    return read_image(path("a.npy")).image;
  }

  std::string complaint(const std::string& dictionary, std::size_t numbers) {
    try {
      read(dictionary, std::vector<double>(numbers));
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
};

TEST_F(Npy, WritesTheBytesThatTheFormatAsksFor) {
  Image image(2, 1, {"R"});
  image.at(1, 0, 0) = 1;
  write_image(path("a.npy"), image);
  std::string expected("\x93NUMPY\1\0\x76\0", 10);
  expected += "{'descr': '<f8', 'fortran_order': False, 'shape': (1, 2, 1), }";
  expected.resize(127, ' ');
  expected += '\n';
  expected.append(8, '\0').append("\0\0\0\0\0\0\xf0\x3f", 8);
  EXPECT_EQ(bytes_of(path("a.npy")), expected);
  EXPECT_EQ(file_count(), 1u);
}

TEST_F(Npy, KeepsEveryBit) {
  const Image image = random_image(37, 23, {"R", "G", "B", "A", "depth"});
  write_image(path("a.npy"), image);
  const Image read = read_image(path("a.npy")).image;
  ASSERT_EQ(read.values().size(), image.values().size());
  EXPECT_EQ(read.width(), 37u);
  EXPECT_EQ(std::memcmp(read.values().data(), image.values().data(), image.values().size_bytes()),
            0);
}

TEST_F(Npy, IsReadByNumpy) {
  const std::string python = python_with_numpy();
  if (python.empty()) GTEST_SKIP() << "SKIPPED: numpy is not installed";
  Image image(3, 2, rgba_channels());
  for (std::size_t i = 0; i < image.values().size(); ++i)
    image.values()[i] = 0.1 * static_cast<double>(i);
  write_image(path("a.npy"), image);
  const std::string script =
      "import numpy as n; a = n.load('" + path("a.npy") +
      "'); assert a.dtype == n.float64 and a.shape == (2, 3, 4) and a.flags.c_contiguous; "
      "assert all(a.ravel()[i] == 0.1 * i for i in range(24)); "
      "n.save('" +
      path("f.npy") +
      "', n.asfortranarray(a)); "
      "n.save('" +
      path("b.npy") +
      "', a.astype('>f4')); "
      "n.save('" +
      path("i.npy") + "', n.array([[1, -2], [3, 4]]))";
  ASSERT_EQ(std::system((python + " -c \"" + script + "\"").c_str()), 0);
  const Image column_major = read_image(path("f.npy")).image;
  EXPECT_TRUE(std::equal(column_major.values().begin(), column_major.values().end(),
                         image.values().begin()));
  const Image big_endian = read_image(path("b.npy")).image;
  EXPECT_EQ(big_endian.at(1, 1, 3), static_cast<double>(static_cast<float>(image.at(1, 1, 3))));
  const Image integers = read_image(path("i.npy")).image;
  EXPECT_EQ(integers.channel_count(), 1u);
  EXPECT_EQ(integers.at(1, 0, 0), -2);
}

TEST_F(Npy, ReadsOtherTypesAndOrders) {
  const Image floats =
      read<float>("{'descr': '<f4', 'fortran_order': False, 'shape': (1, 2), }", {1.5F, 2.5F});
  EXPECT_EQ(floats.at(1, 0, 0), 2.5);
  const Image bytes = read<std::uint8_t>(
      "{'shape': (2, 1, 3), 'fortran_order': True, 'descr': '|u1'}", {1, 2, 3, 4, 5, 6});
  EXPECT_EQ(bytes.at(0, 0, 0), 1);
  EXPECT_EQ(bytes.at(0, 1, 0), 2);
  EXPECT_EQ(bytes.at(0, 0, 1), 3);
  EXPECT_EQ(bytes.channels()[2], "B");
}

TEST_F(Npy, RefusesMalformedFiles) {
  const std::string good = "{'descr': '<f8', 'fortran_order': False, 'shape': (1, 2), }";
  EXPECT_EQ(complaint(good, 2), "no error");
  const struct {
    const char* dictionary;
    std::size_t numbers;
    const char* message;
  } cases[] = {
      {good.c_str(), 1, "wrong length (expected 16 bytes of numbers, found 8)"},
      {good.c_str(), 3, "wrong length"},
      {"{'descr': '<f8', 'fortran_order': False, 'shape': (65536, 65536, 9), }", 1, "wrong length"},
      {"{'descr': '<f8', 'fortran_order': False, 'shape': (0, 2), }", 0, "impossible image size"},
      {"{'descr': '<f8', 'fortran_order': False, 'shape': (99999999999999999999999, 2), }", 0,
       "a shape of two or three axes"},
      {"{'descr': '<f8', 'fortran_order': False, 'shape': (1, 1, 1, 1), }", 1, "two or three"},
      {"{'descr': '<f8', 'fortran_order': False, 'shape': (1,), }", 1, "an array of 1 axes"},
      {"{'descr': '<f8', 'fortran_order': False, 'shape': (-1, 2), }", 1, "two or three axes"},
      {"{'descr': '<f2', 'fortran_order': False, 'shape': (1, 2), }", 1, "numbers of type '<f2'"},
      {"{'descr': '|O8', 'fortran_order': False, 'shape': (1, 2), }", 2, "numbers of type '|O8'"},
      {"{'descr': '', 'fortran_order': False, 'shape': (1, 2), }", 2, "numbers of type ''"},
      {"{'descr': ", 2, "malformed numpy header"},
      {"", 2, "expected the key 'descr'"},
  };
  for (const auto& c : cases)
    EXPECT_THAT(complaint(c.dictionary, c.numbers), testing::HasSubstr(c.message));
  for (const char* start : {"", "\x93NUMPY", "\x93NUMPY\7\0\0\0", "hello, world"}) {
    write_bytes(path("a.npy"), start);
    EXPECT_THROW(read_image(path("a.npy")), InputError);
  }
}

TEST_F(Npy, ReadsEveryTypeOfNumber) {
  const auto head = [](const std::string& type) {
    return "{'descr': '" + type + "', 'fortran_order': False, 'shape': (1, 2), }";
  };
  EXPECT_EQ((read<std::int8_t>(head("|i1"), {-3, 4}).at(0, 0, 0)), -3);
  EXPECT_EQ((read<std::uint8_t>(head("|u1"), {200, 201}).at(1, 0, 0)), 201);
  EXPECT_EQ((read<std::int16_t>(head("<i2"), {-300, 4}).at(0, 0, 0)), -300);
  EXPECT_EQ((read<std::uint16_t>(head("<u2"), {60000, 60001}).at(1, 0, 0)), 60001);
  EXPECT_EQ((read<std::int32_t>(head("<i4"), {-70000, 4}).at(0, 0, 0)), -70000);
  EXPECT_EQ((read<std::uint32_t>(head("<u4"), {1, 4000000000U}).at(1, 0, 0)), 4e9);
  EXPECT_EQ((read<std::int64_t>(head("=i8"), {1, -5000000000}).at(1, 0, 0)), -5e9);
  EXPECT_EQ((read<std::uint64_t>(head("<u8"), {1, std::uint64_t{1} << 63}).at(1, 0, 0)), 0x1p63);
  EXPECT_EQ((read<std::uint16_t>(head(">u2"), {0x0201, 0x0403}).at(1, 0, 0)), 0x0304);
  EXPECT_EQ((read<double>(head("=f8"), {1.5, 2.5}).at(1, 0, 0)), 2.5);
  for (const char* type : {"<f3", "<u", "<u16", "!f8", "f8", "<c8", "<b1"})
    EXPECT_EQ(complaint(head(type), 2), path("a.npy") + ": numbers of type '" + type +
                                            "' (expected floats of 4 or 8 bytes or integers)");
}

TEST_F(Npy, ReadsVersions1To3AndHeadersUpTo64KiB) {
  const std::string dictionary = "{'descr': '|u1', 'fortran_order': False, 'shape': (1, 1), }";
  const auto told = [&](char version, std::size_t length) -> std::string {
    std::string bytes = std::string("\x93NUMPY") + version + '\0';
    bytes += {static_cast<char>(length % 256), static_cast<char>(length / 256 % 256)};
    if (version != 1) bytes += {static_cast<char>(length / 65536), '\0'};
    std::string header = dictionary;
    header.resize(length, ' ');
    write_bytes(path("a.npy"), bytes + header + "\x7");
    try {
      const Image image = read_image(path("a.npy")).image;
      return image.at(0, 0, 0) == 7 ? "" : "another number";
    } catch (const InputError& error) {
      return error.what();
    }
  };
  for (const char version : std::string("\1\2\3")) {
    EXPECT_EQ(told(version, 118), "");
    EXPECT_EQ(told(version, 65535), "");
  }
  EXPECT_EQ(told(2, 65536), "");
  EXPECT_EQ(told(3, 65537), path("a.npy") + ": malformed numpy header (65537 bytes)");
  for (const char version : std::string("\0\4\x7f", 3))
    EXPECT_EQ(told(version, 118), path("a.npy") + ": numpy format version " +
                                      std::to_string(version) + " (expected 1 to 3)");
}

TEST_F(Npy, ReadsMoreNumbersThanABlockHas) {
  std::vector<std::uint8_t> numbers(131000);  // a block has 65536
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<std::uint8_t>(i % 251);
  const Image image = read<std::uint8_t>(
      "{'descr': '|u1', 'fortran_order': False, 'shape': (131, 1000), }", numbers);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    ASSERT_EQ(image.values()[i], static_cast<double>(i % 251)) << i;
}

TEST_F(Npy, ReadsColumnsFirstWhereTheFileSaysSo) {
  const Image image =
      read<std::uint8_t>("{'descr': '|u1', 'fortran_order': True, 'shape': (3, 2, 2), }",
                         {0, 10, 20, 1, 11, 21, 100, 110, 120, 101, 111, 121});
  ASSERT_EQ(image.width(), 2U);
  ASSERT_EQ(image.height(), 3U);
  for (std::size_t y = 0; y < 3; ++y)
    for (std::size_t x = 0; x < 2; ++x)
      for (std::size_t c = 0; c < 2; ++c)
        EXPECT_EQ(image.at(x, y, c), static_cast<double>(100 * c + 10 * y + x));
}

TEST_F(Npy, NamesTheSizeThatIsImpossible) {
  EXPECT_THAT(complaint("{'descr': '<f8', 'fortran_order': False, 'shape': (65537, 2, 3), }", 1),
              testing::HasSubstr("found 2 x 65537 with 3 channels"));
}

}  // namespace
}  // namespace hiac
