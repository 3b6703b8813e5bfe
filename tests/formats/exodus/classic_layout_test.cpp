// The check of classic netCDF files, byte by byte: where the data end, and what is said of headers
// that lead beyond the file.
#include "formats/exodus/classic_layout.hpp"

#include <fmt/format.h>

#include "tests/formats/exodus/classic_file.hpp"
#include "tests/formats/files.hpp"

namespace hiac::formats::exodus {
namespace {

using testing::AnyOf;
using testing::Eq;

/// What is said of the bytes; "ends at N" where nothing is.
std::string layout_verdict(const std::string& bytes) {
  try {
    return fmt::format("ends at {}", check_classic_layout(bytes, "file"));
  } catch (const InputError& error) {
    return std::string(error.what()).substr(6);
  }
}

/// Two variables: five bytes, padded to eight, and three doubles.
std::string two_variables(unsigned version) {
  ClassicFile file(version);
  const std::size_t five = file.dimension("five", 5);
  const std::size_t three = file.dimension("three", 3);
  file.variable("text", {five}, 2, "abcde");
  file.doubles("reals", {three}, {1, 2, 3});
  return file.bytes();
}

TEST(ClassicLayout, DataEndBehindTheLastVariable) {
  for (const unsigned version : {1, 2, 5}) {
    const std::string bytes = two_variables(version);
    EXPECT_TRUE(is_classic_netcdf(bytes));
    EXPECT_EQ(layout_verdict(bytes), fmt::format("ends at {}", bytes.size()));
    EXPECT_EQ(layout_verdict(bytes + "more"), fmt::format("ends at {}", bytes.size()));
    EXPECT_EQ(layout_verdict(bytes.substr(0, bytes.size() - 1)),
              fmt::format("ended before the data of 'reals' ({} bytes expected, {} found)",
                          bytes.size(), bytes.size() - 1));
  }
  EXPECT_FALSE(is_classic_netcdf("CDF\x03 "));
  EXPECT_FALSE(is_classic_netcdf("CDF\x01"));
  EXPECT_FALSE(is_classic_netcdf("CDG\x01 "));
}

TEST(ClassicLayout, TheLastVariableNeedNoPadding) {
  ClassicFile file;
  file.variable("text", {file.dimension("five", 5)}, 2, "abcde");
  const std::string bytes = file.bytes();
  const std::size_t header = bytes.size() - 8;
  EXPECT_EQ(layout_verdict(bytes), fmt::format("ends at {}", header + 8));
  EXPECT_EQ(layout_verdict(bytes.substr(0, header + 5)), fmt::format("ends at {}", header + 5));
  EXPECT_EQ(layout_verdict(bytes.substr(0, header + 4)),
            fmt::format("ended before the data of 'text' ({} bytes expected, {} found)", header + 5,
                        header + 4));
}

TEST(ClassicLayout, HeadersAreWholeAtEveryLength) {
  for (const unsigned version : {1, 2, 5}) {
    const std::string bytes = two_variables(version);
    const std::size_t header = bytes.size() - 32;
    for (std::size_t length = 4; length < header; ++length)
      EXPECT_THAT(layout_verdict(bytes.substr(0, length)),
                  AnyOf(Eq("ended in its netCDF header"),
                        Eq("ended before the data of 'text' (5 values expected)")))
          << length;
  }
}

TEST(ClassicLayout, BytesOfEveryType) {
  const std::vector<std::pair<std::uint32_t, std::size_t>> types{
      {1, 1}, {2, 1}, {3, 2}, {4, 4}, {5, 4}, {6, 8}, {7, 1}, {8, 2}, {9, 4}, {10, 8}, {11, 8}};
  for (const auto& [type, bytes] : types) {
    ClassicFile file(5);
    file.variable("v", {file.dimension("four", 4)}, type, std::string(4 * bytes, 'x'));
    const std::string text = file.bytes();
    EXPECT_EQ(layout_verdict(text + "more"), fmt::format("ends at {}", text.size())) << type;
    EXPECT_NE(layout_verdict(text.substr(0, text.size() - 1)).find("ended before the data"),
              std::string::npos)
        << type;
  }
  for (const std::uint32_t type : {0, 12}) {
    ClassicFile file(5);
    file.variable("v", {file.dimension("four", 4)}, type, std::string(32, 'x'));
    EXPECT_EQ(layout_verdict(file.bytes()),
              "has a damaged netCDF header (unknown type of a variable)");
  }
}

/// The records of variables that stand in turn.
std::string recorded(std::uint64_t declared, const std::vector<std::string>& variables,
                     const std::string& more) {
  ClassicFile file;
  const std::size_t time = file.dimension("time", 0);
  const std::size_t three = file.dimension("three", 3);
  file.records = declared;
  for (const std::string& data : variables)
    file.variable(data.substr(0, 1), {time, three}, 2, data);
  return file.bytes() + more;
}

TEST(ClassicLayout, RecordsStandInTurn) {
  // a record of one variable is not padded, one of several is
  const std::string one = recorded(1, {"abc"}, "");
  EXPECT_EQ(layout_verdict(one), fmt::format("ends at {}", one.size()));
  const std::string three = recorded(3, {"abc"}, "abcabcab");
  EXPECT_EQ(layout_verdict(three), fmt::format("ends at {}", three.size()));
  const std::string behind = recorded(3, {"abc"}, "");
  EXPECT_EQ(layout_verdict(behind),
            fmt::format("ended before the data of 'a' ({} bytes expected, {} found)",
                        behind.size() + 5, behind.size()));
  const std::string two = recorded(2, {"abc", "def"}, "abc.def.");
  EXPECT_EQ(layout_verdict(two + "more"), fmt::format("ends at {}", two.size()));
  EXPECT_EQ(layout_verdict(two.substr(0, two.size() - 2)),
            fmt::format("ended before the data of 'd' ({} bytes expected, {} found)",
                        two.size() - 1, two.size() - 2));
  EXPECT_EQ(layout_verdict(two.substr(0, two.size() - 1)),
            fmt::format("ends at {}", two.size() - 1));
}

TEST(ClassicLayout, NoRecordsAndRecordsThatAreStillWritten) {
  const std::string none = recorded(0, {"abc"}, "");
  EXPECT_EQ(layout_verdict(none.substr(0, none.size() - 4)),
            fmt::format("ends at {}", none.size() - 4));
  const std::string streaming = recorded(0xffffffffU, {"abc"}, "any number of them");
  EXPECT_EQ(layout_verdict(streaming), fmt::format("ends at {}", streaming.size()));
  const std::string many = recorded(0xfffffffeU, {"abc"}, "");
  EXPECT_EQ(layout_verdict(many), "declares 4294967294 records, more than it can hold");
}

TEST(ClassicLayout, NumbersThatLeadBeyondTheFile) {
  const auto along = [](std::size_t dimension) {
    ClassicFile file;
    file.dimension("one", 1);
    file.variable("v", {dimension}, 1, "x");
    return layout_verdict(file.bytes());
  };
  EXPECT_EQ(along(0).substr(0, 7), "ends at");
  EXPECT_EQ(along(1), "has a damaged netCDF header");
  const auto large = [](std::uint64_t length, std::size_t times) {
    ClassicFile file(5);
    const std::size_t dimension = file.dimension("n", length);
    file.variable("v", std::vector<std::size_t>(times, dimension), 1, "x");
    return layout_verdict(file.bytes());
  };
  EXPECT_EQ(large(1000, 1), "ended before the data of 'v' (1000 values expected)");
  EXPECT_EQ(large(std::uint64_t{1} << 32, 2), "declares more values of 'v' than it can hold");
  EXPECT_EQ(large((std::uint64_t{1} << 32) - 1, 2),
            "ended before the data of 'v' (18446744065119617025 values expected)");
  // as many values as the file has bytes, of which the header takes some
  const std::size_t size = [] {
    ClassicFile file(5);
    file.variable("v", {file.dimension("n", 1)}, 1, "x");
    return file.bytes().size();
  }();
  EXPECT_EQ(large(size, 1),
            fmt::format("ended before the data of 'v' ({} bytes expected, {} found)", 2 * size - 4,
                        size));
  EXPECT_EQ(large(size + 1, 1),
            fmt::format("ended before the data of 'v' ({} values expected)", size + 1));
  // only the first dimension makes records
  ClassicFile file;
  const std::size_t time = file.dimension("time", 0);
  const std::size_t two = file.dimension("two", 2);
  file.variable("v", {two, time}, 4, "");
  EXPECT_EQ(layout_verdict(file.bytes()), fmt::format("ends at {}", file.bytes().size()));
}

TEST(ClassicLayout, BeginningsBeyondTheFileDoNotWrapRound) {
  ClassicFile file(5);
  file.variable("v", {file.dimension("sixteen", 16)}, 1, std::string(16, 'x'));
  std::string bytes = file.bytes();
  // the header's last number is where the variable begins
  bytes.replace(bytes.size() - 24, 8, ClassicFile::big_endian(~std::uint64_t{7}, 8));
  EXPECT_THAT(layout_verdict(bytes), testing::StartsWith("ended before the data of 'v'"));
}

TEST(ClassicLayout, ListsHaveTheirTags) {
  const std::string bytes = two_variables(1);
  const auto with = [&](std::size_t at, std::uint64_t value) {
    std::string changed = bytes;
    return layout_verdict(changed.replace(at, 4, ClassicFile::big_endian(value, 4)));
  };
  EXPECT_EQ(with(8, 11), "has a damaged netCDF header");
  EXPECT_EQ(with(8, 0), "has a damaged netCDF header");
  EXPECT_EQ(with(12, bytes.size() + 1), "has a damaged netCDF header");
  EXPECT_EQ(with(12, bytes.size()), "ended in its netCDF header");
  EXPECT_EQ(with(16, bytes.size()), "ended in its netCDF header");
  // a name's length
  const std::size_t left = bytes.size() - 20;
  EXPECT_EQ(with(16, left + 1), "ended in its netCDF header");
}

TEST(ClassicLayout, AttributesArePassedOver) {
  const auto attribute = [](std::uint32_t type, std::uint64_t length, const std::string& data) {
    const ClassicFile file;
    return "CDF\x01" + ClassicFile::big_endian(0, 4) + std::string(8, '\0') +
           ClassicFile::big_endian(12, 4) + ClassicFile::big_endian(1, 4) + file.name("title") +
           ClassicFile::big_endian(type, 4) + ClassicFile::big_endian(length, 4) + data +
           std::string(8, '\0');
  };
  EXPECT_EQ(layout_verdict(attribute(2, 5, "words\0\0\0" + std::string(3, '\0'))), "ends at 60");
  EXPECT_EQ(layout_verdict(attribute(6, 2, std::string(16, 'x'))), "ends at 68");
  EXPECT_EQ(layout_verdict(attribute(6, 3, std::string(16, 'x'))), "ended in its netCDF header");
  EXPECT_EQ(layout_verdict(attribute(6, 4, std::string(16, 'x'))), "ended in its netCDF header");
  EXPECT_EQ(layout_verdict(attribute(2, 1000, "")), "ended in its netCDF header");
  EXPECT_EQ(layout_verdict(attribute(12, 1, "x")),
            "has a damaged netCDF header (unknown type of a variable)");
}

}  // namespace
}  // namespace hiac::formats::exodus
