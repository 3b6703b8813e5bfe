// Binary legacy files: the byte that a complaint names, and values of every width behind which the
// next word is found.
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "tests/formats/field_named.hpp"
#include "tests/formats/files.hpp"
#include "tests/formats/raw_bytes.hpp"

namespace hiac::formats {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

template <typename Number>
std::string big_endian(std::initializer_list<Number> numbers) {
  std::string text;
  for (const Number number : numbers) {
    const std::string raw = raw_bytes({number});
    text.append(raw.rbegin(), raw.rend());
  }
  return text;
}

std::string binary_head(const std::string& version = "4.2") {
  return "# vtk DataFile Version " + version + "\nt\nBINARY\nDATASET UNSTRUCTURED_GRID\n";
}
const std::string kBinaryPoints =
    "POINTS 4 float\n" + big_endian<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}) + "\n";
const std::string kBinaryCells = "CELLS 1 5\n" + big_endian<std::int32_t>({4, 0, 1, 2, 3}) + "\n";
const std::string kBinaryTypes = "CELL_TYPES 1\n" + big_endian<std::int32_t>({10}) + "\n";
const std::string kBinaryGrid = binary_head() + kBinaryPoints + kBinaryCells + kBinaryTypes;

/// The complaint about a file without the file's name.
std::string binary_refusal(const std::string& text) {
  const ScratchFolder folder;
  const std::string path = folder.write("a.vtk", text);
  const std::string message = refusal(path);
  return message.empty() ? message : message.substr(path.size() + 2);
}

TEST(LegacyBinary, ComplaintsNameTheByte) {
  const std::size_t head = binary_head().size();
  EXPECT_EQ(binary_refusal(kBinaryGrid), "");
  EXPECT_EQ(binary_refusal(binary_head() + "POINTS 4 quad\n"),
            fmt::format("byte {}: unknown data type 'quad'", head + 9));
  EXPECT_EQ(binary_refusal(binary_head() + "POINTS 4 float x\n"),
            fmt::format("byte {}: binary values must begin on a line of their own (' x' found "
                        "before them)",
                        head + 14));
  EXPECT_EQ(binary_refusal(binary_head() + "POINTS 4 float " + std::string(253, ' ') + "\n"),
            fmt::format("byte {}: the file ends too soon (12 values of 4 bytes expected, 0 bytes "
                        "found)",
                        head + 269));
  EXPECT_THAT(binary_refusal(binary_head() + "POINTS 4 float " + std::string(254, ' ') + "\n"),
              HasSubstr("on a line of their own"));
  EXPECT_EQ(binary_refusal(binary_head() + "POINTS 4 float"),
            fmt::format("byte {}: the file ends too soon (binary values expected)", head + 14));
  const std::string points = binary_head() + kBinaryPoints;
  EXPECT_EQ(binary_refusal(points.substr(0, points.size() - 2)),
            fmt::format("byte {}: the file ends too soon (12 values of 4 bytes expected, 47 bytes "
                        "found)",
                        head + 15));
  // the words of the head stand in lines
  EXPECT_EQ(binary_refusal("# vtk DataFile Version 4.2\nt\nBINARY\nDATASET FIELD\n").substr(0, 7),
            "line 4:");
}

TEST(LegacyBinary, CellsAreRefusedBehindTheNumber) {
  const std::string before = binary_head() + kBinaryPoints;
  const auto cells = [&](std::initializer_list<std::int32_t> list) {
    return binary_refusal(before + "CELLS 1 5\n" + big_endian<std::int32_t>(list) + "\n" +
                          kBinaryTypes);
  };
  const std::size_t list = before.size() + 10;
  EXPECT_EQ(cells({4, 0, 1, 2, 3}), "");
  EXPECT_EQ(cells({4, 0, 1, 4, 3}),
            fmt::format("byte {}: cell 0: no such point (0 to 3 expected, 4 found)", list + 16));
  EXPECT_EQ(cells({4, 0, -1, 2, 3}),
            fmt::format("byte {}: cell 0: no such point (0 to 3 expected, -1 found)", list + 12));
  EXPECT_EQ(
      cells({5, 0, 1, 2, 3}),
      fmt::format("byte {}: cell 0: wrong number of nodes (0 to 4 expected, 5 found)", list + 4));
}

TEST(LegacyBinary, OffsetsOfEightAndFourBytes) {
  const std::string head = binary_head("5.1") + kBinaryPoints;
  const std::string wide = "OFFSETS vtktypeint64\n" + big_endian<std::int64_t>({0, 4}) +
                           "\nCONNECTIVITY vtktypeint64\n" +
                           big_endian<std::int64_t>({0, 1, 2, 3}) + "\n";
  const std::string narrow = "OFFSETS int\n" + big_endian<std::int32_t>({0, 4}) +
                             "\nCONNECTIVITY int\n" + big_endian<std::int32_t>({0, 1, 2, 3}) + "\n";
  for (const std::string& lists : {wide, narrow}) {
    EXPECT_EQ(binary_refusal(head + "CELLS 2 4\n" + lists + kBinaryTypes), "");
    std::string wrong = lists;
    wrong[wrong.find("\nCONN") - 1] = 5;
    EXPECT_THAT(binary_refusal(head + "CELLS 2 4\n" + wrong + kBinaryTypes),
                HasSubstr("cell 0: wrong offset 1 (0 to 4 expected, 5 found)"));
  }
  EXPECT_EQ(
      binary_refusal(head + "CELLS 3 8\nOFFSETS int\n" + big_endian<std::int32_t>({0, 4, 8}) +
                     "\nCONNECTIVITY int\n" + big_endian<std::int32_t>({0, 1, 2, 3, 3, 2, 1, 0}) +
                     "\nCELL_TYPES 2\n" + big_endian<std::int32_t>({10, 10}) + "\n"),
      "");
  std::string high = wide;
  high[high.find('\n') + 9] = 1;  // the highest byte of the second offset
  EXPECT_THAT(binary_refusal(head + "CELLS 2 4\n" + high + kBinaryTypes),
              HasSubstr("(0 to 4 expected, 72057594037927940 found)"));
}

TEST(LegacyBinary, ValuesOfEveryWidth) {
  const ScratchFolder folder;
  const ZooMesh mesh =
      read_any(folder.write(
                   "a.vtk",
                   kBinaryGrid + "POINT_DATA 4\nSCALARS d double\nLOOKUP_TABLE default\n" +
                       big_endian<double>({1, NAN, 3, -INFINITY}) + "\nFIELD f 6\nb 1 4 char\n" +
                       big_endian<std::int8_t>({-1, 2, 3, 127}) + "\nu 1 4 unsigned_short\n" +
                       big_endian<std::uint16_t>({65535, 1, 2, 3}) + "\ns 1 4 short\n" +
                       big_endian<std::int16_t>({-300, 1, 2, 3}) + "\nl 1 4 long\n" +
                       big_endian<std::int64_t>({-5, 6, 7, 8}) + "\nf 2 4 float\n" +
                       big_endian<float>({1, 2, 3, 4, 5, 6, 7, 8.5F}) + "\ni 1 4 unsigned_int\n" +
                       big_endian<std::uint32_t>({4294967295U, 1, 2, 3}) + "\n"))
          .mesh;
  EXPECT_TRUE(std::isnan(field_named(mesh, "d").values[1]));
  EXPECT_EQ(field_named(mesh, "d").values[3], -INFINITY);
  EXPECT_THAT(field_named(mesh, "b").values.view(), ElementsAre(-1, 2, 3, 127));
  EXPECT_EQ(field_named(mesh, "u").values[0], 65535);
  EXPECT_EQ(field_named(mesh, "s").values[0], -300);
  EXPECT_EQ(field_named(mesh, "l").values[0], -5);
  EXPECT_EQ(field_named(mesh, "f").values[7], 8.5);
  EXPECT_EQ(field_named(mesh, "i").values[0], 4294967295.0);
}

TEST(LegacyBinary, ColoursTablesAndBitsAreBytes) {
  const ScratchFolder folder;
  const ZooMesh mesh =
      read_any(
          folder.write("a.vtk",
                       kBinaryGrid + "FIELD f 2\nnine 1 9 bit\n" + std::string("\xff\x80", 2) +
                           "\neight 1 8 bit\n\xaa\nCELL_DATA 1\nCOLOR_SCALARS c 2\n" +
                           std::string("\xff\x33", 2) + "\nSCALARS s int\nLOOKUP_TABLE mine\n" +
                           big_endian<std::int32_t>({7}) + "\nLOOKUP_TABLE mine 2\n12345678\n"))
          .mesh;
  EXPECT_EQ(field_named(mesh, "s").values[0], 7);
  EXPECT_EQ(field_named(mesh, "c").components, 2U);
  // a bit less than the bytes hold, and a byte less than the bits need
  EXPECT_EQ(binary_refusal(kBinaryGrid + "FIELD f 1\nnine 1 16 bit\n" + std::string(2, 'x')), "");
  EXPECT_THAT(binary_refusal(kBinaryGrid + "FIELD f 1\nnine 1 17 bit\n" + std::string(2, 'x')),
              HasSubstr("the file ends too soon (17 values of 1 bit expected, 2 bytes found)"));
}

// The two highest bits of a text's first byte say in how many bytes its length stands.
TEST(LegacyBinary, TextsWithLengthsOfOneToEightBytes) {
  const ScratchFolder folder;
  const std::string one = "\xc3" + std::string("abc");
  const std::string two = "\x80\x46" + std::string(70, 'b');
  const std::string longer = "\x81\x02" + std::string(258, 'c');
  const std::string four = std::string("\x40\x00\x00\x02", 4) + "de";
  const std::string eight = std::string("\x00\x00\x00\x00\x00\x00\x00\x01", 8) + "f";
  const auto with = [&](const std::string& text) {
    return kBinaryGrid + "FIELD f 2\ntext 1 1 string\n" + text + "\nn 1 1 int\n" +
           big_endian<std::int32_t>({42}) + "\n";
  };
  using Entry = std::pair<std::string, std::string>;
  for (const auto& [written, text] : {std::pair<std::string, std::string>{one, "abc"},
                                      {two, std::string(70, 'b')},
                                      {longer, std::string(258, 'c')},
                                      {four, "de"},
                                      {eight, "f"}}) {
    const ZooMesh mesh = read_any(folder.write("a.vtk", with(written))).mesh;
    EXPECT_THAT(mesh.metadata, Contains(Entry("text", text)));
    EXPECT_THAT(mesh.metadata, Contains(Entry("n", "42")));
  }
  const std::size_t at = kBinaryGrid.size() + 26;
  const auto cut = [&](const std::string& text) {
    return binary_refusal(kBinaryGrid + "FIELD f 1\ntext 1 1 string\n" + text);
  };
  EXPECT_EQ(cut(one), "");
  EXPECT_EQ(
      cut("\xc3" + std::string("ab")),
      fmt::format("byte {}: the file ends too soon (a text of 3 bytes expected, 2 found)", at));
  EXPECT_EQ(cut("\x80"), fmt::format("byte {}: the file ends too soon (a text expected)", at));
  EXPECT_EQ(cut(std::string("\x00\x00\x00\x00\x00\x00\x00", 7)),
            fmt::format("byte {}: the file ends too soon (a text expected)", at));
  EXPECT_EQ(cut(std::string("\x7f\xff\xff\xff", 4)),
            fmt::format("byte {}: the file ends too soon (a text of 1073741823 bytes expected, 0 "
                        "found)",
                        at));
}

TEST(LegacyBinary, ArraysWithoutValuesNeedNoLine) {
  EXPECT_EQ(binary_refusal(kBinaryGrid + "FIELD f 1\nn 1 0 int"), "");
  EXPECT_THAT(binary_refusal(kBinaryGrid + "FIELD f 1\nn 1 1 int"),
              HasSubstr("the file ends too soon (binary values expected)"));
}

// Of every kind of data a dataset may have several.
TEST(LegacyData, SeveralArraysOfEveryKindAreRead) {
  const std::string grid =
      "# vtk DataFile Version 4.2\nt\nASCII\nDATASET UNSTRUCTURED_GRID\n"
      "POINTS 4 double\n0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n";
  std::string data = "CELL_DATA 1\n";
  std::vector<std::string> names;
  for (const char* kind : {"SCALARS {} float\nLOOKUP_TABLE default\n", "VECTORS {} float\n",
                           "NORMALS {} float\n", "TENSORS {} float\n", "COLOR_SCALARS {} 2\n",
                           "TEXTURE_COORDINATES {} 2 float\n", "FIELD more 1\n{} 3 1 float\n"})
    for (int copy = 0; copy < 2; ++copy) {
      const std::string head(kind);
      names.push_back(fmt::format("a{}", names.size()));
      const std::size_t values = head.starts_with("SCALARS")                                ? 1
                                 : head.starts_with("TENSORS")                              ? 9
                                 : head.starts_with("COLOR") || head.starts_with("TEXTURE") ? 2
                                                                                            : 3;
      data += fmt::format(fmt::runtime(head), names.back());
      for (std::size_t i = 0; i < values; ++i) data += "1 ";
      data += "\n";
    }
  const ScratchFolder folder;
  const ZooMesh mesh = read_any(folder.write("a.vtk", grid + data)).mesh;
  std::vector<std::string> found;
  for (const Field& field : mesh.fields) found.push_back(field.name);
  EXPECT_THAT(found, testing::UnorderedElementsAreArray(names));
}

}  // namespace
}  // namespace hiac::formats
