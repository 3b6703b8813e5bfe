// The arrays of legacy files: what is said of wrong ones, and what stands between them and behind
// them that is passed over.
#include <algorithm>
#include <cmath>
#include <tuple>

#include <fmt/format.h>

#include "formats/vtk/number_type.hpp"
#include "tests/formats/field_named.hpp"
#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// Ten lines.
const std::string kTetrahedronFile =
    "# vtk DataFile Version 4.2\nt\nASCII\nDATASET UNSTRUCTURED_GRID\n"
    "POINTS 4 double\n0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n";

struct DataRow {
  std::string name;
  std::string data;     ///< from line 11 on
  std::string message;  ///< empty where the file is read
};

void expect_data_rows(const std::vector<DataRow>& rows) {
  const ScratchFolder folder;
  for (const DataRow& row : rows) {
    const std::string path = folder.write("a.vtk", kTetrahedronFile + row.data);
    EXPECT_EQ(refusal(path), row.message.empty() ? "" : path + ": " + row.message) << row.name;
  }
}

TEST(LegacyData, AttributesAreRefusedByTheirParts) {
  const std::string four = "\n1 2 3 4\n";
  expect_data_rows(
      {{"points", "POINT_DATA 3\n",
        "line 11: the data do not fit the points (4 values expected, 3 found)"},
       {"cells", "CELL_DATA 2\n",
        "line 11: the data do not fit the cells (1 values expected, 2 found)"},
       {"no number", "CELL_DATA\n",
        "line 12: the file ends too soon (the number of cells expected)"},
       {"keyword", "CELL_DATA 1\nEDGE_FLAGS e int\n1\n",
        "line 12: unexpected 'edge_flags' (SCALARS, VECTORS, FIELD, ... expected)"},
       {"edge flags of points", "POINT_DATA 4\nEDGE_FLAGS e int" + four, ""},
       {"long keyword", "POINT_DATA 4\n" + std::string(41, 'q') + " e int\n",
        "line 12: unexpected '" + std::string(40, 'q') +
            "' (SCALARS, VECTORS, FIELD, ... expected)"},
       {"long value", "CELL_DATA 1\nSCALARS s int\nLOOKUP_TABLE t\n" + std::string(41, 'q') + "\n",
        "line 14: wrong value 0 of 1 (a fitting integer expected, '" + std::string(40, 'q') +
            "' found)"},
       {"long type", "POINT_DATA 4\nSCALARS s " + std::string(41, 'q') + "\n",
        "line 12: unknown data type '" + std::string(40, 'q') + "'"},
       {"colours", "CELL_DATA 1\nCOLOR_SCALARS c 1\n3e38\n", ""},
       {"colours beyond floats", "CELL_DATA 1\nCOLOR_SCALARS c 1\n1e300\n",
        "line 13: wrong value 0 of 1 (a finite number expected, '1e300' found)"},
       {"texts of identifiers", "CELL_DATA 1\nPEDIGREE_IDS i string\na%20b\n", ""},
       {"type", "POINT_DATA 4\nSCALARS s quad 1\n", "line 12: unknown data type 'quad'"},
       {"variants", "POINT_DATA 4\nFIELD f 1\na 1 4 variant\n",
        "line 13: data type 'variant' cannot be read here"},
       {"texts", "POINT_DATA 4\nVECTORS v string\n",
        "line 12: data type 'string' cannot be read here"},
       {"bits", "POINT_DATA 4\nSCALARS s bit\n", "line 12: data type 'bit' cannot be read here"},
       {"no component", "POINT_DATA 4\nSCALARS s int 0\nLOOKUP_TABLE t\n",
        "line 12: LOOKUP_TABLE or a number of components expected"},
       {"a million components", "POINT_DATA 4\nSCALARS s int 1000000\nLOOKUP_TABLE t" + four,
        "line 13: the file ends too soon (4000000 values expected, 9 bytes found)"},
       {"more", "POINT_DATA 4\nSCALARS s int 1000001\nLOOKUP_TABLE t\n",
        "line 12: LOOKUP_TABLE or a number of components expected"},
       {"half a component", "POINT_DATA 4\nSCALARS s int 1.5\nLOOKUP_TABLE t\n",
        "line 12: LOOKUP_TABLE or a number of components expected"},
       {"no table", "POINT_DATA 4\nSCALARS s int 1" + four, "line 13: LOOKUP_TABLE expected"},
       {"unnamed table", "POINT_DATA 4\nSCALARS s int 1\nLOOKUP_TABLE",
        "line 13: the file ends too soon (the name of a lookup table expected)"},
       {"no texture", "POINT_DATA 4\nTEXTURE_COORDINATES t 0 int\n",
        "line 12: wrong dimension (1 to 3 expected)"},
       {"line", "POINT_DATA 4\nTEXTURE_COORDINATES t 1 int" + four, ""},
       {"space", "POINT_DATA 4\nTEXTURE_COORDINATES t 3 int\n1 2 3 4 5 6 7 8 9 10 11 12\n", ""},
       {"beyond space", "POINT_DATA 4\nTEXTURE_COORDINATES t 4 int\n",
        "line 12: wrong dimension (1 to 3 expected)"},
       {"colours", "CELL_DATA 1\nCOLOR_SCALARS c 2\n0.5 nan\n",
        "line 13: wrong value 1 of 2 (a finite number expected, 'nan' found)"},
       {"table of three", "POINT_DATA 4\nLOOKUP_TABLE t 1\n0 0 1 x\n",
        "line 13: wrong value 3 of 4 (a finite number expected, 'x' found)"},
       {"table of single precision", "POINT_DATA 4\nLOOKUP_TABLE t 1\n0 0 1 1e39\n",
        "line 13: wrong value 3 of 4 (a finite number expected, '1e39' found)"},
       {"vectors", "CELL_DATA 1\nVECTORS v int\n1 2\n",
        "line 14: the file ends too soon (3 values expected, 2 found)"},
       {"tensors", "CELL_DATA 1\nTENSORS v int\n1 2 3 4 5 6 7 8\n",
        "line 14: the file ends too soon (9 values expected, 8 found)"},
       {"short tensors", "CELL_DATA 1\nTENSORS6 v int\n1 2 3 4 5\n",
        "line 14: the file ends too soon (6 values expected, 5 found)"}});
}

TEST(LegacyData, FieldsAreRefusedByTheirCounts) {
  expect_data_rows(
      {{"as many arrays as bytes", "FIELD f 1 ",
        "line 11: the file ends too soon (a name expected)"},
       {"one more", "FIELD f 2 ", "line 11: too many arrays (2 declared, 1 bytes left)"},
       {"no arrays", "FIELD f 0\n", ""},
       {"null array", "FIELD f 2\nNULL_ARRAY\na 1 1 int\n5\n", ""},
       {"fit the cells", "CELL_DATA 1\nFIELD f 1\na 1 2 int\n5 6\n",
        "line 13: array 'a' does not fit the cells (1 tuples expected, 2 found)"},
       {"long name", "POINT_DATA 4\nFIELD f 1\n" + std::string(61, 'n') + " 1 3 int\n5 6 7\n",
        "line 13: array '" + std::string(60, 'n') +
            "' does not fit the points (4 tuples expected, 3 found)"},
       {"a million components of nothing", "FIELD f 1\na 1000000 0 int\n", ""},
       {"more", "FIELD f 1\na 1000001 0 int\n",
        "line 12: too many components (at most 1000000 expected, 1000001 found)"},
       {"largest count", "FIELD f 1\na 1 1099511627775 int\n5\n",
        "line 12: the file ends too soon (1099511627775 values expected, 3 bytes found)"},
       {"too large a count", "FIELD f 1\na 1 1099511627776 int\n5\n",
        "line 12: wrong count (the number of tuples expected, '1099511627776' found)"},
       {"values fill the rest", "FIELD f 1\na 1 3 int\n1 2 3", ""},
       {"one more than fits", "FIELD f 1\na 1 4 int\n1 2 3",
        "line 12: the file ends too soon (4 values expected, 6 bytes found)"},
       {"texts", "FIELD f 1\na 1 2 string\none\ntwo\n", ""},
       {"a text is missing", "FIELD f 1\na 1 3 string\none\ntwo\n",
        "line 14: the file ends too soon (3 texts expected)"},
       {"more texts than bytes", "FIELD f 1\na 1 7 string\none\n",
        "line 12: the file ends too soon (7 texts expected)"},
       {"no value is not finite", "FIELD f 1\na 1 1 double\nnan\n",
        "line 13: wrong value 0 of 1 (a finite number expected, 'nan' found)"}});
}

TEST(LegacyData, WordsAreShownShortAndPrintable) {
  const std::string forty(40, '9');
  const auto name = [](std::size_t length) {
    return "POINT_DATA 4\nSCALARS " + std::string(length, 'n') +
           " int\nLOOKUP_TABLE default\n1 2 3 4\n";
  };
  expect_data_rows(
      {{"forty", "POINT_DATA " + forty + "\n",
        "line 11: wrong count (the number of points expected, '" + forty + "' found)"},
       {"forty-one", "POINT_DATA " + forty + "9\n",
        "line 11: wrong count (the number of points expected, '" + forty + "...' found)"},
       {"signs", "POINT_DATA 4\x01\x7f\n",
        "line 11: wrong count (the number of points expected, '4?\?' found)"},
       {"not negative", "POINT_DATA -4\n",
        "line 11: wrong count (the number of points expected, '-4' found)"},
       {"longest name", name(255), ""},
       {"longer", name(256),
        "line 12: '" + std::string(40, 'n') +
            "...': the word is too long (a name of at most 255 characters expected, 256 found)"}});
}

TEST(LegacyData, IntegersFitTheirTypes) {
  const auto field = [](const std::string& type, const std::string& values) {
    return fmt::format("CELL_DATA 1\nFIELD f 1\na 2 1 {}\n{}\n", type, values);
  };
  struct Range {
    std::string type;
    std::string extremes;
    std::string below;
    std::string above;
  };
  std::vector<DataRow> rows;
  for (const Range& range :
       {Range{"char", "-128 127", "-129", "128"},
        {"signed_char", "-128 127", "-129", "128"},
        {"unsigned_char", "0 255", "-1", "256"},
        {"short", "-32768 32767", "-32769", "32768"},
        {"unsigned_short", "0 65535", "-1", "65536"},
        {"int", "-2147483648 2147483647", "-2147483649", "2147483648"},
        {"vtkIdType", "-2147483648 2147483647", "-2147483649", "2147483648"},
        {"unsigned_int", "0 4294967295", "-1", "4294967296"},
        {"long", "-9223372036854775808 9223372036854775807", "-9223372036854775809",
         "9223372036854775808"},
        {"vtktypeuint64", "0 18446744073709551615", "-1", "18446744073709551616"},
        {"bit", "0 1", "-1", "2"}}) {
    rows.push_back({range.type, field(range.type, range.extremes), ""});
    for (const std::string& wrong :
         {range.below, range.above, std::string("+-1"), std::string("1e1")})
      rows.push_back({range.type, field(range.type, "+1 " + wrong),
                      fmt::format("line 14: wrong value 1 of 2 (a fitting integer expected, '{}' "
                                  "found)",
                                  wrong)});
  }
  expect_data_rows(rows);
}

TEST(LegacyData, RealsFitTheirTypes) {
  const auto field = [](const std::string& type, const std::string& values) {
    return fmt::format("CELL_DATA 1\nFIELD f 1\na 2 1 {}\n{}\n", type, values);
  };
  const auto wrong = [](const std::string& word) {
    return fmt::format("line 14: wrong value 1 of 2 (a finite number expected, '{}' found)", word);
  };
  expect_data_rows({{"float", field("float", "-3.4028234e38 +3.4028234e38"), ""},
                    {"above", field("float", "0 3.5e38"), wrong("3.5e38")},
                    {"below", field("float", "0 -3.5e38"), wrong("-3.5e38")},
                    {"double", field("double", "-1.7976931348623157e308 1e-400"), ""},
                    {"too large", field("double", "0 1e309"), wrong("1e309")},
                    {"two signs", field("double", "0 +-1"), wrong("+-1")},
                    {"a comma", field("double", "0 1,5"), wrong("1,5")},
                    {"not finite", field("float", "nan -inf"), ""}});
}

TEST(LegacyData, NamesOfTypes) {
  using Family = vtk::NumberType::Family;
  using Named = std::tuple<const char*, Family, std::size_t>;
  const auto expect = [](const auto& find, const Named& named) {
    const auto& [name, family, bytes] = named;
    const auto type = find(name);
    ASSERT_TRUE(type) << name;
    EXPECT_EQ(type->family, family) << name;
    EXPECT_EQ(type->bytes, bytes) << name;
  };
  for (const Named& named : {Named{"bit", Family::bit, 0},
                             {"CHAR", Family::signed_integer, 1},
                             {"signed_char", Family::signed_integer, 1},
                             {"unsigned_char", Family::unsigned_integer, 1},
                             {"short", Family::signed_integer, 2},
                             {"unsigned_short", Family::unsigned_integer, 2},
                             {"vtkIdType", Family::signed_integer, 4},
                             {"int", Family::signed_integer, 4},
                             {"unsigned_int", Family::unsigned_integer, 4},
                             {"long", Family::signed_integer, 8},
                             {"unsigned_long", Family::unsigned_integer, 8},
                             {"vtktypeint64", Family::signed_integer, 8},
                             {"vtktypeuint64", Family::unsigned_integer, 8},
                             {"float", Family::real, 4},
                             {"double", Family::real, 8},
                             {"string", Family::text, 0},
                             {"utf8_string", Family::text, 0},
                             {"variant", Family::variant, 0}})
    expect(vtk::legacy_number_type, named);
  EXPECT_FALSE(vtk::legacy_number_type("Int8"));
  for (const Named& named : {Named{"Int8", Family::signed_integer, 1},
                             {"UInt8", Family::unsigned_integer, 1},
                             {"Int16", Family::signed_integer, 2},
                             {"UInt16", Family::unsigned_integer, 2},
                             {"Int32", Family::signed_integer, 4},
                             {"UInt32", Family::unsigned_integer, 4},
                             {"Int64", Family::signed_integer, 8},
                             {"UInt64", Family::unsigned_integer, 8},
                             {"Float32", Family::real, 4},
                             {"Float64", Family::real, 8},
                             {"String", Family::text, 0}})
    expect(vtk::xml_number_type, named);
  EXPECT_FALSE(vtk::xml_number_type("int8"));
}

TEST(LegacyData, SixtyFourSectionsOfDataAndNoMore) {
  std::string sections;
  for (int i = 0; i < 32; ++i) sections += "POINT_DATA 4\nCELL_DATA 1\n";
  expect_data_rows({{"64", sections, ""},
                    {"65", sections + "POINT_DATA 4\n",
                     "line 75: too many sections of data (at most 64 expected)"}});
}

TEST(LegacyData, MetadataBehindArraysArePassedOver) {
  const std::string first = "CELL_DATA 1\nFIELD f 2\na 2 1 int\n5 6\n";
  const std::string second = "b 1 1 int\n7\n";
  const auto with = [&](const std::string& metadata) {
    return first + "METADATA\n" + metadata + "\n" + second;
  };
  const ScratchFolder folder;
  for (const std::string& metadata : {std::string(""), std::string("COMPONENT_NAMES\nx\n\n"),
                                      std::string("COMPONENT_NAMES\n\n\n"),
                                      std::string("INFORMATION 1\nNAME N LOCATION L\nDATA 2 5 6\n"),
                                      std::string("INFORMATION 0\r\n\r")}) {
    const ZooMesh mesh = read_any(folder.write("a.vtk", kTetrahedronFile + with(metadata))).mesh;
    EXPECT_EQ(field_named(mesh, "a").values[1], 6) << metadata;
    EXPECT_EQ(field_named(mesh, "b").values[0], 7) << metadata;
  }
  const auto declared = [&](const std::string& length) {
    return with("INFORMATION 1\nNAME N LOCATION L\nDATA " + length + "\n");
  };
  const std::size_t size = kTetrahedronFile.size() + declared("100").size();
  expect_data_rows(
      {{"negative", declared("-1"), "line 18: wrong METADATA (a length expected, -1 found)"},
       {"empty", declared("0"), ""},
       {"as long as the file", declared(fmt::format("{}", size)), ""},
       {"longer", declared(fmt::format("{}", size + 1)),
        fmt::format("line 18: wrong METADATA (a length expected, {} found)", size + 1)}});
}

TEST(LegacyData, OfArraysWithOneNameTheLastIsRead) {
  const ScratchFolder folder;
  const Reading reading = read_any(folder.write(
      "a.vtk", kTetrahedronFile +
                   "CELL_DATA 1\nFIELD f 3\na%20b 1 1 float\n3\nc 1 1 int\n8\na%20b 1 1 float\n"
                   "-inf\nPOINT_DATA 4\nSCALARS c float\nLOOKUP_TABLE default\n1 2 nan 4\n"));
  EXPECT_THAT(reading.notes, Contains("several arrays have the name 'a b': the last is read"));
  EXPECT_THAT(reading.notes, Not(Contains(HasSubstr("the name 'c'"))));
  EXPECT_EQ(field_named(reading.mesh, "a b").values[0], -INFINITY);
  ASSERT_EQ(reading.mesh.fields.size(), 3U);
}

TEST(LegacyData, ValuesOfAReplacedArrayMayBeNotFinite) {
  const ScratchFolder folder;
  const auto one = [](const std::string& value) { return " 1 1 float\n" + value + "\n"; };
  for (const auto& [first, second] :
       {std::pair<const char*, const char*>{"nan", "3"}, {"3", "nan"}, {"-inf", "nan"}}) {
    const Reading reading =
        read_any(folder.write("a.vtk", kTetrahedronFile + "CELL_DATA 1\nFIELD f 3\na" + one(first) +
                                           "%61" + one(first) + "a" + one(second)));
    ASSERT_EQ(reading.mesh.fields.size(), 1U) << first;
    EXPECT_EQ(fmt::format("{}", reading.mesh.fields[0].values[0]), second) << first;
    EXPECT_EQ(std::count(reading.notes.begin(), reading.notes.end(),
                         "several arrays have the name 'a': the last is read"),
              1)
        << first;
  }
}

// The names are those that VTK's reader gives: it drops a '%' without two characters behind it, and
// ends a name at a '%' with others than hexadecimal digits.
TEST(LegacyData, NamesWithAPercentSignThatBeginsNoCode) {
  const ScratchFolder folder;
  for (const char* value : {"5", "inf"})
    for (const auto& [written, name] : {std::pair<const char*, const char*>{"a%4", "a4"},
                                        {"a%", "a"},
                                        {"ab%", "ab"},
                                        {"50%x", "50x"},
                                        {"load%max", "load"},
                                        {"a%-1b", "a"},
                                        {"%41%g1b", "A"},
                                        {"abc%00d", "abc"},
                                        {"abc%%41", "abc"},
                                        {"%0", ""},
                                        {"%g1", ""},
                                        {"%", ""}}) {
      const Reading reading = read_any(folder.write(
          "a.vtk", kTetrahedronFile + "CELL_DATA 1\nFIELD f 2\na_name%20of_another 1 1 float\n4\n" +
                       written + " 2 1 float\n6 " + value + "\n"));
      ASSERT_EQ(reading.mesh.fields.size(), 2U) << written;
      const Field& field = reading.mesh.fields[1];
      EXPECT_EQ(field.name, std::string_view(name).empty() ? "cell field 1" : name) << written;
      EXPECT_EQ(field.values[0], 6) << written;
      EXPECT_EQ(fmt::format("{}", field.values[1]), value) << written;
      EXPECT_THAT(reading.notes,
                  Contains(fmt::format("a '%' in the name '{}' begins no code: it is read as '{}'",
                                       written, name)));
    }
  // what VTK makes of it depends on the names before it
  const std::string path =
      folder.write("a.vtk", kTetrahedronFile + "CELL_DATA 1\nFIELD f 1\n%4 1 1 float\n6\n");
  EXPECT_EQ(refusal(path), path + ": the name '%4' of an array ends in the middle of a code");
}

TEST(LegacyData, CodedNamesOfArraysWithoutEveryValue) {
  const ScratchFolder folder;
  for (const auto& [written, name] : {std::pair<const char*, const char*>{"a%41", "aA"},
                                      {"%2525", "%25"},
                                      {"%c3%A9", "\u00e9"}}) {
    const ZooMesh mesh =
        read_any(folder.write("a.vtk", kTetrahedronFile + "CELL_DATA 1\nFIELD f 1\n" + written +
                                           " 2 1 float\n5 inf\n"))
            .mesh;
    ASSERT_EQ(mesh.fields.size(), 1U);
    EXPECT_EQ(mesh.fields[0].name, name);
    EXPECT_EQ(mesh.fields[0].values[0], 5);
    EXPECT_EQ(mesh.fields[0].values[1], INFINITY);
  }
}

TEST(LegacyData, TitlesAndCutEnds) {
  const ScratchFolder folder;
  const auto titled = [&](const std::string& title) {
    std::string text = kTetrahedronFile;
    return read_any(folder.write("a.vtk", text.replace(text.find("\nt\n"), 3, "\n" + title + "\n")))
        .mesh.metadata;
  };
  using Entry = std::pair<std::string, std::string>;
  EXPECT_THAT(titled("t"), Contains(Entry("title", "t")));
  EXPECT_THAT(titled("vtk output"), ElementsAre(Entry("source", "a.vtk")));
  EXPECT_THAT(titled(""), ElementsAre(Entry("source", "a.vtk")));
  const auto ends_with = [&](const std::string& end) {
    return read_any(
               folder.write("a.vtk", kTetrahedronFile.substr(0, kTetrahedronFile.size() - 1) + end))
        .notes;
  };
  EXPECT_THAT(ends_with("\n"), Not(Contains(HasSubstr("cut off"))));
  EXPECT_THAT(ends_with(" "), Not(Contains(HasSubstr("cut off"))));
  EXPECT_THAT(ends_with(""), Contains("the file does not end with a line end: its last number may "
                                      "have been cut off"));
}

TEST(LegacyData, WhatFilesHoldIsListed) {
  const ScratchFolder folder;
  const std::string path = folder.write(
      "a.vtk", kTetrahedronFile + "POINT_DATA 4\nSCALARS p int\nLOOKUP_TABLE default\n1 2 3 4\n" +
                   "SCALARS p float\nLOOKUP_TABLE default\n5 6 7 8\n");
  const Inventory inventory = format_to_read(path).inspect(path);
  EXPECT_EQ(inventory.format, "vtk");
  EXPECT_EQ(inventory.points, 4U);
  ASSERT_EQ(inventory.fields.size(), 1U);
  EXPECT_EQ(inventory.fields[0].type, "float");
  EXPECT_EQ(inventory.fields[0].low, 5);
  EXPECT_THAT(inventory.notes, Contains("several arrays have the name 'p': the last is read"));
}

TEST(LegacyData, ArraysWithoutValuesNeedNoLine) {
  expect_data_rows({{"numbers", "FIELD f 1\nn 1 0 int", ""},
                    {"texts", "FIELD f 1\nt 1 0 string", ""},
                    {"texts that lack", "FIELD f 1\nt 1 1 string",
                     "line 12: the file ends too soon (1 texts expected)"}});
}

}  // namespace
}  // namespace hiac::formats
