// What the check of legacy files says about the sections of a dataset: the whole complaint with its
// line, and the nearest input that is fine.
#include <fmt/format.h>

#include "formats/vtk/legacy/legacy_layout.hpp"
#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

using testing::HasSubstr;

struct LegacyRow {
  std::string name;
  std::string text;
  std::string message;  ///< after the file's name; empty where the file is read
};

void expect_legacy_rows(const std::vector<LegacyRow>& rows) {
  const ScratchFolder folder;
  for (const LegacyRow& row : rows) {
    const std::string path = folder.write("a.vtk", row.text);
    EXPECT_EQ(refusal(path), row.message.empty() ? "" : path + ": " + row.message) << row.name;
  }
}

/// The first four lines.
std::string legacy_head(const std::string& dataset, const std::string& version = "3.0") {
  return fmt::format("# vtk DataFile Version {}\nt\nASCII\nDATASET {}\n", version, dataset);
}

const std::string kLegacyPoints = "POINTS 4 double\n0 0 0 1 0 0 0 1 0 0 0 1\n";
const std::string kLegacyCells = "CELLS 1 5\n4 0 1 2 3\n";
const std::string kLegacyTypes = "CELL_TYPES 1\n10\n";
const std::string kLegacyHead = legacy_head("UNSTRUCTURED_GRID");
const std::string kLegacyGrid = kLegacyHead + kLegacyPoints + kLegacyCells + kLegacyTypes;

TEST(LegacyRefusals, TheHeadOfAFile) {
  // other first lines are not even taken for this format
  try {
    vtk::check_legacy_file("# vtk DataFile Versio 3.0\n", "a.vtk");
    ADD_FAILURE() << "not refused";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "a.vtk: line 1: not a legacy VTK file ('# vtk DataFile Version ...' expected)");
  }
  const std::string head = "# vtk DataFile Version 3.0\nt\n";
  expect_legacy_rows(
      {{"encoding", head + "UTF8\n",
        "line 3: unknown encoding (ASCII or BINARY expected, 'utf8' found)"},
       {"no encoding", head, "line 3: the file ends too soon (ASCII or BINARY expected)"},
       {"no dataset", head + "ASCII\nDATA SET\n", "line 4: DATASET expected"},
       {"no kind", head + "ASCII\nDATASET\n",
        "line 5: the file ends too soon (the kind of dataset expected)"},
       {"surface", head + "ASCII\nDATASET POLYDATA\n",
        "line 4: holds no volume cells (UNSTRUCTURED_GRID, STRUCTURED_GRID, STRUCTURED_POINTS or "
        "RECTILINEAR_GRID expected, 'polydata' found)"},
       {"any case and blanks",
        "# vtk DataFile Version\t 3.0\nt\nascii\ndataset unstructured_GRID\n" + kLegacyPoints +
            kLegacyCells + kLegacyTypes,
        ""}});
}

TEST(LegacyRefusals, SectionsToldAgainOrMissing) {
  expect_legacy_rows(
      {{"points", kLegacyHead + kLegacyPoints + kLegacyPoints, "line 7: a second POINTS section"},
       {"cells", kLegacyHead + kLegacyPoints + kLegacyCells + kLegacyCells,
        "line 9: a second CELLS section"},
       {"types", kLegacyGrid + kLegacyTypes, "line 11: a second CELL_TYPES section"},
       {"no points", kLegacyHead + kLegacyCells + kLegacyTypes,
        "line 8: the file ends too soon (POINTS expected)"},
       {"no cells", kLegacyHead + kLegacyPoints + kLegacyTypes,
        "line 8: the file ends too soon (CELLS expected)"},
       {"no types", kLegacyHead + kLegacyPoints + kLegacyCells,
        "line 8: the file ends too soon (CELL_TYPES expected)"},
       {"other order", kLegacyHead + kLegacyTypes + kLegacyCells + kLegacyPoints, ""},
       {"unknown", kLegacyHead + "NODES 4\n",
        "line 5: unexpected 'nodes' (a section of the dataset expected)"},
       {"a long word", kLegacyHead + std::string(41, 'q') + " 4\n",
        "line 5: unexpected '" + std::string(40, 'q') + "' (a section of the dataset expected)"},
       {"section of grids", kLegacyHead + "DIMENSIONS 2 2 2\n",
        "line 5: unexpected 'dimensions' (a section of the dataset expected)"}});
}

TEST(LegacyRefusals, TypesOfCells) {
  const auto typed = [](int type) {
    return fmt::format("{}{}{}CELL_TYPES 1\n{}\n", kLegacyHead, kLegacyPoints, kLegacyCells, type);
  };
  expect_legacy_rows(
      {{"below", typed(-1), "line 10: cell 0: unknown type (0 to 255 expected, -1 found)"},
       {"above", typed(256), "line 10: cell 0: unknown type (0 to 255 expected, 256 found)"},
       {"too few types", kLegacyHead + kLegacyPoints + kLegacyCells + "CELL_TYPES 0\n",
        "line 9: the cell types do not fit the cells (1 expected, 0 found)"}});
  // the last number that fits is a type that nobody defines
  const ScratchFolder folder;
  EXPECT_THAT(refusal(folder.write("a.vtk", typed(255))), Not(HasSubstr("0 to 255")));
  EXPECT_NE(refusal(folder.write("a.vtk", typed(255))), "");
}

TEST(LegacyRefusals, ListsOfCells) {
  const auto listed = [](const std::string& list, int numbers) {
    return fmt::format("{}{}CELLS 1 {}\n{}\n{}", kLegacyHead, kLegacyPoints, numbers, list,
                       kLegacyTypes);
  };
  const auto two = [](const std::string& list, int numbers) {
    return fmt::format("{}{}CELLS 2 {}\n{}\nCELL_TYPES 2\n10 10\n", kLegacyHead, kLegacyPoints,
                       numbers, list);
  };
  expect_legacy_rows({{"one node more than there is", listed("5 0 1 2 3", 5),
                       "line 8: cell 0: wrong number of nodes (0 to 4 expected, 5 found)"},
                      {"negative", listed("-1 0 1 2 3", 5),
                       "line 8: cell 0: wrong number of nodes (0 to 4 expected, -1 found)"},
                      {"first point that is not there", listed("4 0 1 2 4", 5),
                       "line 8: cell 0: no such point (0 to 3 expected, 4 found)"},
                      {"negative point", listed("4 0 1 2 -1", 5),
                       "line 8: cell 0: no such point (0 to 3 expected, -1 found)"},
                      {"unfilled", listed("3 0 1 2 3", 5),
                       "line 8: the cells do not fill their list (5 numbers expected, 4 found)"},
                      {"second is missing", two("4 0 1 2 3", 5),
                       "line 8: cell 1: is missing from the list of cells"},
                      {"second is short", two("4 0 1 2 3 4 0 1 2", 9),
                       "line 8: cell 1: wrong number of nodes (0 to 3 expected, 4 found)"},
                      {"two", two("4 0 1 2 3 4 0 1 2 3", 10), ""},
                      {"plus signs", listed("+4 +0 +1 +2 +3", 5), ""}});
}

TEST(LegacyRefusals, FacesOfPolyhedra) {
  const auto polyhedron = [](const std::string& list, int numbers) {
    return one_cell_file("0 0 0 1 0 0 0 1 0 0 0 1", 4, list, static_cast<std::size_t>(numbers), 42);
  };
  expect_legacy_rows(
      {{"whole", polyhedron("4 3 0 1 2 3 0 1 3 3 1 2 3 3 2 0 3", 17), ""},
       {"negative count of faces", polyhedron("-1 3 0 1 2 3 0 1 3 3 1 2 3 3 2 0 3", 17),
        "line 8: cell 0: wrong list of faces (0 to 17 expected, -1 found)"},
       {"more faces than numbers", polyhedron("18 3 0 1 2 3 0 1 3 3 1 2 3 3 2 0 3", 17),
        "line 8: cell 0: wrong list of faces (0 to 17 expected, 18 found)"},
       {"negative count of corners", polyhedron("4 -3 0 1 2 3 0 1 3 3 1 2 3 3 2 0 3", 17),
        "line 8: cell 0: wrong list of faces (0 to 16 expected, -3 found)"},
       {"more corners than numbers", polyhedron("1 5 0 1 2", 5),
        "line 8: cell 0: wrong list of faces (0 to 4 expected, 5 found)"},
       {"one corner more than is left", polyhedron("1 4 0 1 2", 5),
        "line 8: cell 0: the list of its faces is too short"},
       {"no face after the last", polyhedron("2 3 0 1 2", 5),
        "line 8: cell 0: the list of its faces is too short"},
       {"no list", polyhedron("", 0), "line 8: cell 0: the list of its faces is too short"},
       {"too long", polyhedron("1 3 0 1 2 3 0", 7),
        "line 8: cell 0: the list of its faces is too long by 2"},
       {"no such point", polyhedron("1 3 0 1 4", 5),
        "line 8: cell 0: no such point (0 to 3 expected, 4 found)"}});
}

/// A file of version 5: offsets and connectivity.
std::string offset_file(const std::string& cells, const std::string& types = kLegacyTypes) {
  return legacy_head("UNSTRUCTURED_GRID", "5.1") + kLegacyPoints + cells + types;
}

TEST(LegacyRefusals, OffsetsOfCells) {
  const std::string nodes = "CONNECTIVITY vtktypeint64\n0 1 2 3\n";
  const auto at = [&](const std::string& offsets) {
    return offset_file("CELLS 2 4\nOFFSETS vtktypeint64\n" + offsets + "\n" + nodes);
  };
  expect_legacy_rows(
      {{"whole", at("0 4"), ""},
       {"no offsets", offset_file("CELLS 2 4\nOFFSET int\n0 4\n" + nodes),
        "line 8: OFFSETS expected"},
       {"no connectivity", offset_file("CELLS 2 4\nOFFSETS int\n0 4\nNODES int\n0 1 2 3\n"),
        "line 10: CONNECTIVITY expected"},
       {"offsets that are no integers", offset_file("CELLS 2 4\nOFFSETS float\n0 4\n" + nodes),
        "line 8: an integer data type expected"},
       {"nodes that are no integers",
        offset_file("CELLS 2 4\nOFFSETS int\n0 4\nCONNECTIVITY double\n0 1 2 3\n"),
        "line 10: an integer data type expected"},
       {"offsets that are texts", offset_file("CELLS 2 4\nOFFSETS string\n0 4\n" + nodes),
        "line 8: data type 'string' cannot be read here"},
       {"not from the start", at("1 4"),
        "line 9: cell 0: wrong offset 0 (0 to 0 expected, 1 found)"},
       {"beyond the list", at("0 5"), "line 9: cell 0: wrong offset 1 (0 to 4 expected, 5 found)"},
       {"negative", at("0 -1"), "line 9: cell 0: wrong offset 1 (0 to 4 expected, -1 found)"},
       {"unfilled", at("0 3"),
        "line 11: the cells do not fill their list (4 numbers expected, 3 found)"},
       {"falling",
        offset_file("CELLS 3 4\nOFFSETS vtktypeint64\n0 4 3\n" + nodes, "CELL_TYPES 2\n10 10\n"),
        "line 9: cell 1: wrong offset 2 (4 to 4 expected, 3 found)"},
       {"a cell without nodes",
        offset_file("CELLS 3 4\nOFFSETS vtktypeint64\n0 0 4\n" + nodes, "CELL_TYPES 2\n0 10\n"),
        ""},
       {"no cells", offset_file("CELLS 0 0\nOFFSETS int\n"), "line 7: holds no cells"}});
}

const std::string kEightPoints =
    "POINTS 8 float\n0 0 0 1 0 0 0 1 0 1 1 0 0 0 1 1 0 1 0 1 1 1 1 1\n";

TEST(LegacyRefusals, GridsOfPoints) {
  const auto grid = [](const std::string& sections, const std::string& version = "3.0") {
    return legacy_head("STRUCTURED_GRID", version) + sections;
  };
  const std::string twos = "DIMENSIONS 2 2 2\n";
  const std::string blanking = " unsigned_char\n1 1 1 1 1 1 1 1\n";
  expect_legacy_rows(
      {{"whole", grid(twos + kEightPoints), ""},
       {"dimensions twice", grid(twos + twos), "line 6: a second DIMENSIONS section"},
       {"none of them", grid("DIMENSIONS 2 0 2\n"),
        "line 5: a dimension of 0 (1 or more points expected)"},
       {"flat", grid("DIMENSIONS 2 3 1\n"),
        "line 5: holds no volume cells (2 or more points along each axis expected, 2 x 3 x 1 "
        "found)"},
       {"too many", grid("DIMENSIONS 65536 2 16384\n"),
        "line 5: too many points (fewer than 2147483648 in all three dimensions expected)"},
       {"nearly too many", grid("DIMENSIONS 65536 2 16383\n"),
        "line 5: the file ends too soon (POINTS expected)"},
       {"no dimensions", grid(kEightPoints),
        "line 6: the file ends too soon (DIMENSIONS expected)"},
       {"other points", grid("DIMENSIONS 2 2 3\n" + kEightPoints),
        "line 7: the points do not fit the dimensions (12 expected, 8 found)"},
       {"blanking first", grid("BLANKING 8" + blanking), "line 5: DIMENSIONS must come first"},
       {"blanking", grid(twos + "BLANKING 8" + blanking + kEightPoints), ""},
       {"blanking of others", grid(twos + "BLANKING 7" + blanking),
        "line 6: wrong BLANKING (8 values of unsigned_char expected)"},
       {"blanking with a sign", grid(twos + "BLANKING 8 char\n1 1 1 1 1 1 1 1\n"),
        "line 6: wrong BLANKING (8 values of unsigned_char expected)"},
       {"wide blanking", grid(twos + "BLANKING 8 unsigned_short\n1 1 1 1 1 1 1 1\n"),
        "line 6: wrong BLANKING (8 values of unsigned_char expected)"},
       {"blanking of a later version", grid(twos + "BLANKING 8" + blanking, "4.0"),
        "line 6: unexpected 'blanking' (a section of the dataset expected)"},
       {"points twice", grid(twos + kEightPoints + kEightPoints),
        "line 8: a second POINTS section"}});
}

TEST(LegacyRefusals, ImagesAndCoordinates) {
  const auto image = [](const std::string& sections) {
    return legacy_head("STRUCTURED_POINTS") + sections;
  };
  const auto axes = [](const std::string& sections) {
    return legacy_head("RECTILINEAR_GRID") + sections;
  };
  const std::string twos = "DIMENSIONS 2 2 2\n";
  const std::string data = "CELL_DATA 1\nSCALARS s int\nLOOKUP_TABLE default\n7\n";
  const std::string y = "Y_COORDINATES 2 int\n0 1\n";
  const std::string z = "Z_COORDINATES 2 int\n0 1\n";
  const std::string all = "X_COORDINATES 2 int\n0 1\n" + y + z;
  expect_legacy_rows(
      {{"image", image(twos + "ASPECT_RATIO 1 1 1\nORIGIN 0 0 0\n" + data), ""},
       {"no spacing along y", image(twos + "SPACING 1 0 1\n"), "line 6: a spacing of 0"},
       {"no ratio along z", image(twos + "ASPECT_RATIO 1 1 0\n"), "line 6: a spacing of 0"},
       {"no number", image(twos + "ORIGIN 0 x 0\n"),
        "line 6: wrong number (origin expected, 'x' found)"},
       {"infinite", image(twos + "SPACING 1 1 inf\n"),
        "line 6: wrong number (spacing expected, 'inf' found)"},
       {"no data", image(twos),
        "line 5: the file ends too soon (POINT_DATA or CELL_DATA expected)"},
       {"no dimensions", image("SPACING 1 1 1\n"),
        "line 5: the file ends too soon (DIMENSIONS expected)"},
       {"no section of an image", image(twos + "X_COORDINATES 2 int\n0 1\n"),
        "line 6: unexpected 'x_coordinates' (a section of the dataset expected)"},
       {"coordinates", axes(twos + all + data), ""},
       {"coordinates first", axes(all), "line 5: DIMENSIONS must come first"},
       {"too many", axes(twos + "X_COORDINATES 3 int\n0 1 2\n"),
        "line 6: the coordinates do not fit the dimensions (2 once expected, 3 found)"},
       {"again", axes(twos + y + z + y),
        "line 10: the coordinates do not fit the dimensions (2 once expected, 2 found)"},
       {"no x", axes(twos + y + z + data),
        "line 10: the file ends too soon (X_, Y_ and Z_COORDINATES expected)"},
       {"no data either", axes(twos + all),
        "line 11: the file ends too soon (POINT_DATA or CELL_DATA expected)"},
       {"no such axis", axes(twos + "W_COORDINATES 2 int\n0 1\n"),
        "line 6: unexpected 'w_coordinates' (a section of the dataset expected)"}});
}

}  // namespace
}  // namespace hiac::formats
