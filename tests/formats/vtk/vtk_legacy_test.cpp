#include <cmath>

#include <fmt/format.h>

#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kCubePoints = "0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1";
constexpr const char* kTetPoints = "0 0 0 1 0 0 0 1 0 0 0 1";

std::string tetrahedron() { return one_cell_file(kTetPoints, 4, "0 1 2 3", 4, 10); }

/// The tetrahedron's file with one part replaced.
std::string changed(const std::string& from, const std::string& to) {
  std::string text =
      tetrahedron() + "POINT_DATA 4\nSCALARS s double 1\nLOOKUP_TABLE default\n1 2 3 4\n";
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(VtkLegacy, BricksWithRepeatedNodesBecomeTheirTrueKind) {
  const ScratchFolder folder;
  const std::vector<std::pair<std::string, CellKind>> cells{
      {"0 1 2 3 4 5 6 6", CellKind::wedge7},
      {"0 1 2 3 4 4 6 7", CellKind::wedge7},
      {"0 1 2 2 4 5 6 6", CellKind::prism6},
      {"0 1 2 3 4 4 4 4", CellKind::pyramid5},
      {"0 1 2 2 4 4 4 4", CellKind::tetrahedron4}};
  for (const auto& [nodes, kind] : cells) {
    const Reading reading =
        read_any(folder.write("a.vtk", one_cell_file(kCubePoints, 8, nodes, 8, 12)));
    EXPECT_EQ(reading.mesh.kinds[0], kind);
    EXPECT_THAT(reading.notes, Contains(HasSubstr("brick8 to")));
  }
  const std::string knife =
      folder.write("knife.vtk", one_cell_file(kCubePoints, 8, "0 1 0 3 4 5 6 7", 8, 12));
  EXPECT_THAT(refusal(knife), HasSubstr("knife"));
  EXPECT_THAT(refusal(knife), HasSubstr("0 1 0 3 4 5 6 7"));
  const std::string pyramid =
      folder.write("pyr.vtk", one_cell_file(kCubePoints, 8, "0 1 2 2 4", 5, 14));
  EXPECT_EQ(read_any(pyramid).mesh.kinds[0], CellKind::tetrahedron4);
}

TEST(VtkLegacy, ValuesThatAreNotFiniteAreKept) {
  const ScratchFolder folder;
  const std::string path = folder.write(
      "nan.vtk", tetrahedron() +
                     "POINT_DATA 4\nVECTORS v double\n1 nan 3 4 5 -inf 7 8 9 NaN 11 12\n"
                     "SCALARS s float 1\nLOOKUP_TABLE default\n1 2 inf 4\n"
                     "CELL_DATA 1\nFIELD f 1\nc 2 1 float\nnan 5\n");
  const ZooMesh mesh = read_any(path).mesh;
  const Field x = scalar_field(mesh, "v:x");
  const Field y = scalar_field(mesh, "v:y");
  const Field z = scalar_field(mesh, "v:z");
  EXPECT_TRUE(std::isnan(y.values[0]));
  EXPECT_EQ(z.values[1], -INFINITY);
  EXPECT_TRUE(std::isnan(x.values[3]));
  EXPECT_EQ(z.values[3], 12);
  EXPECT_EQ(scalar_field(mesh, "s").values[2], INFINITY);
  EXPECT_EQ(scalar_field(mesh, "s").values[3], 4);
  EXPECT_TRUE(std::isnan(scalar_field(mesh, "c:0").values[0]));
  EXPECT_EQ(scalar_field(mesh, "c:1").values[0], 5);
}

TEST(VtkLegacy, CoordinatesMustBeFinite) {
  const ScratchFolder folder;
  EXPECT_THAT(refusal(folder.write("a.vtk", changed("0 1 0 0 0 1", "0 nan 0 0 0 1"))),
              HasSubstr("line 6"));
  EXPECT_THAT(refusal(folder.write("a.vtk", changed("0 1 0 0 0 1", "0 1e400 0 0 0 1"))),
              HasSubstr("'1e400'"));
  // single precision that overflows is caught too, and what underflows is as good as zero
  EXPECT_THAT(refusal(folder.write("a.vtk", changed("4 double\n0 0", "4 float\n1e39 0"))),
              HasSubstr("1e39"));
  EXPECT_EQ(refusal(folder.write("a.vtk", changed("4 double\n0 0", "4 float\n1e-60 0"))), "");
}

TEST(VtkLegacy, DataOfEveryKindAreRead) {
  const ScratchFolder folder;
  const std::string path = folder.write(
      "all.vtk",
      "# vtk DataFile Version 4.2\nMy title\nASCII\nDATASET UNSTRUCTURED_GRID\n"
      "FIELD FieldData 3\nTIME 1 1 double\n2.5\nnote 1 1 string\nhello%20world\nlong 1 20 int\n"
      "1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20\n"
      "POINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\nMETADATA\nINFORMATION 1\n"
      "NAME L2_NORM_RANGE LOCATION vtkDataArray\nDATA 2 0 1\n\n"
      "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n"
      "CELL_DATA 1\nSCALARS region%201 int\nLOOKUP_TABLE mine\n7\nLOOKUP_TABLE mine 2\n"
      "0 0 0 1 1 1 1 1\nTENSORS t float\n1 2 3 4 5 6 7 8 9\n"
      "POINT_DATA 4\nSCALARS a double 2\nLOOKUP_TABLE default\n1 2 3 4 5 6 7 8\n"
      "SCALARS b unsigned_char\nLOOKUP_TABLE default\n1 2 3 255\n"
      "VECTORS u float\n1 0 0 1 0 0 1 0 0 1 0 0\nVECTORS w float\n2 0 0 1 0 0 1 0 0 1 0 0\n"
      "NORMALS n float\n1 0 0 1 0 0 1 0 0 1 0 0\nTEXTURE_COORDINATES tc 2 float\n1 2 3 4 5 6 7 8\n"
      "TENSORS6 t6 float\n1 2 3 4 5 6 1 2 3 4 5 6 1 2 3 4 5 6 1 2 3 4 5 6\n"
      "GLOBAL_IDS ids vtkIdType\n1 2 3 4\n"
      "FIELD FieldData 2\nlabels 1 4 string\none\ntwo\nthree\nfour\nc 1 4 long\n1 2 3 -4\n"
      "METADATA\nCOMPONENT_NAMES\ncc\n\n");
  const Reading reading = read_any(path);
  std::vector<std::string> names;
  for (const Field& field : reading.mesh.fields) names.push_back(field.name);
  EXPECT_THAT(names, testing::UnorderedElementsAre("region 1", "t", "a", "b", "u", "w", "n", "tc",
                                                   "t6", "ids", "c"));
  EXPECT_EQ(scalar_field(reading.mesh, "a:1").values[3], 8);
  EXPECT_EQ(scalar_field(reading.mesh, "b").values[3], 255);
  EXPECT_EQ(scalar_field(reading.mesh, "w:x").values[0], 2);
  EXPECT_EQ(scalar_field(reading.mesh, "t6:xz").values[0], 6);
  EXPECT_EQ(scalar_field(reading.mesh, "c").values[3], -4);
  EXPECT_EQ(scalar_field(reading.mesh, "region 1").values[0], 7);
  EXPECT_THAT(reading.mesh.metadata, testing::UnorderedElementsAre(
                                         std::pair<std::string, std::string>("source", "all.vtk"),
                                         std::pair<std::string, std::string>("time", "2.5"),
                                         std::pair<std::string, std::string>("note", "hello world"),
                                         std::pair<std::string, std::string>("title", "My title")));
  EXPECT_THAT(reading.notes, Contains(HasSubstr("'labels' holds no numbers")));
  EXPECT_THAT(reading.notes, Contains(HasSubstr("long (20 values)")));

  ReadOptions options;
  options.time = 2.5;
  EXPECT_NO_THROW(read_any(path, options));
  options.time = 3;
  EXPECT_THROW(read_any(path, options), UsageError);
  options.time.reset();
  options.step = 1;
  EXPECT_THROW(read_any(path, options), UsageError);
  options.step.reset();
  options.block = "b";
  EXPECT_THROW(read_any(path, options), UsageError);
}

// VTK's own search for the dimensions takes every word for a keyword
TEST(VtkLegacy, StructuredGridsWithConfusingNames) {
  const ScratchFolder folder;
  const std::string path = folder.write(
      "grid.vtk",
      fmt::format("# vtk DataFile Version 3.0\nfield\nASCII\nDATASET STRUCTURED_GRID\n"
                  "DIMENSIONS 2 2 2\nPOINTS 8 float\n{}\nPOINT_DATA 8\nSCALARS field float\n"
                  "LOOKUP_TABLE dimensions\n0 1 2 3 4 5 6 7\n",
                  "0 0 0 1 0 0 0 1 0 1 1 0 0 0 1 1 0 1 0 1 1 1 1 1"));
  const ZooMesh mesh = read_any(path).mesh;
  EXPECT_THAT(std::vector<NodeId>(mesh.nodes.begin(), mesh.nodes.end()),
              ElementsAre(0, 1, 3, 2, 4, 5, 7, 6));
  EXPECT_EQ(mesh.fields[0].name, "field");
}

TEST(VtkLegacy, BlankedPointsTakeTheirCellsAway) {
  const ScratchFolder folder;
  std::string points;
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 3; ++i) points += fmt::format("{} {} {} ", i, j, k);
  const std::string path = folder.write(
      "grid.vtk", fmt::format("# vtk DataFile Version 2.0\nt\nASCII\nDATASET STRUCTURED_GRID\n"
                              "DIMENSIONS 3 2 2\nBLANKING 12 unsigned_char\n"
                              "1 1 0 1 1 1 1 1 1 1 1 1\nPOINTS 12 float\n{}\nCELL_DATA 2\n"
                              "SCALARS c float\nLOOKUP_TABLE default\n5 6\n",
                              points));
  const Reading reading = read_any(path);
  EXPECT_EQ(reading.mesh.cell_count(), 1U);
  EXPECT_EQ(reading.mesh.node_count(), 8U);
  EXPECT_EQ(reading.mesh.fields.at(0).values[0], 5);
  EXPECT_THAT(reading.notes, Contains(HasSubstr("dropped 1 ghost or hidden")));
}

TEST(VtkLegacy, ImagesAndRectilinearGridsAreBricks) {
  const ScratchFolder folder;
  const std::string data = "POINT_DATA 8\nSCALARS s float\nLOOKUP_TABLE default\n0 1 2 3 4 5 6 7\n";
  const ZooMesh image = read_any(folder.write("i.vtk",
                                              "# vtk DataFile Version 3.0\nt\nASCII\n"
                                              "DATASET STRUCTURED_POINTS\nDIMENSIONS 2 2 2\n"
                                              "SPACING 1 2 3\nORIGIN 10 20 30\n" +
                                                  data))
                            .mesh;
  EXPECT_THAT(std::vector<double>(image.xyz.begin() + 21, image.xyz.end()),
              ElementsAre(11, 22, 33));
  const ZooMesh rectilinear =
      read_any(folder.write("r.vtk",
                            "# vtk DataFile Version 3.0\nt\nASCII\n"
                            "DATASET RECTILINEAR_GRID\nDIMENSIONS 2 2 2\n"
                            "X_COORDINATES 2 float\n10 11\nY_COORDINATES 2 float\n20 22\n"
                            "Z_COORDINATES 2 float\n30 33\n" +
                                data))
          .mesh;
  EXPECT_TRUE(std::equal(image.xyz.begin(), image.xyz.end(), rectilinear.xyz.begin(),
                         rectilinear.xyz.end()));
  EXPECT_EQ(image.kinds[0], CellKind::brick8);
}

struct Malformed {
  std::string from;
  std::string to;
  std::string message;
};

TEST(VtkLegacy, MalformedFilesAreRefusedWithTheirLine) {
  const ScratchFolder folder;
  const std::vector<Malformed> cases{
      {"ASCII", "ASCIIX", "unknown encoding"},
      {"UNSTRUCTURED_GRID", "POLYDATA", "holds no volume cells"},
      {"POINTS 4", "POINTS 5", "line 7: wrong value 12 of 15"},
      {"POINTS 4", "POINTS 3", "unexpected '0'"},
      {"POINTS 4", "POINTS 99999999999", "the file ends too soon"},
      {"POINTS 4", "POINTS 99999999999999999999", "wrong count"},
      {"POINTS 4", "POINTS -4", "wrong count"},
      {"double\n0", "doubled\n0", "unknown data type 'doubled'"},
      {"0 1 0 0 0 1", "0 1 0 0 0 x", "'x' found"},
      {"CELLS 1 5", "CELLS 1 6", "wrong value 5 of 6"},
      {"CELLS 1 5", "CELLS 1 4", "unexpected '3'"},
      {"CELLS 1 5", "CELLS 2 5", "the cell types do not fit the cells"},
      {"CELLS 1 5", "CELLS 0 5", "holds no cells"},
      {"CELLS 1 5", "CELLS 1 99999999999", "the file ends too soon"},
      {"4 0 1 2 3", "5 0 1 2 3", "wrong number of nodes"},
      {"4 0 1 2 3", "3 0 1 2 3", "do not fill their list"},
      {"4 0 1 2 3", "4 0 1 2 4", "no such point"},
      {"4 0 1 2 3", "4 0 1 2 -1", "no such point"},
      {"4 0 1 2 3", "4 0 1 2.0 3", "fitting integer"},
      {"CELL_TYPES 1\n10", "CELL_TYPES 1\n13", "a Wedge cannot have 4 nodes"},
      {"CELL_TYPES 1\n10", "CELL_TYPES 1\n999", "unknown type"},
      {"CELL_TYPES 1\n10", "CELL_TYPES 1\n42", "the list of its faces"},
      {"CELL_TYPES 1\n10\n", "", "expected)"},
      {"POINT_DATA 4", "POINT_DATA 5", "the data do not fit the points"},
      {"SCALARS", "SCALARZ", "unexpected 'scalarz'"},
      {"double 1\nLOOKUP", "double 0\nLOOKUP", "components expected"},
      {"double 1\nLOOKUP", "double 999999999\nLOOKUP", "components expected"},
      {"LOOKUP_TABLE default\n", "", "LOOKUP_TABLE expected"},
      {"1 2 3 4\n", "1 2 3\n", "4 values expected, 3 found"},
      {"1 2 3 4\n", "1 2 3 4 5\n", "unexpected '5'"},
      {"SCALARS s double 1\nLOOKUP_TABLE default\n1 2 3 4\n", "FIELD f 999999999\n", "too many"},
      {"SCALARS s double 1\nLOOKUP_TABLE default\n1 2 3 4\n", "FIELD f 1\na 1 5 int\n1 2 3 4 5\n",
       "does not fit the points"},
      {"SCALARS s double 1\nLOOKUP_TABLE default\n1 2 3 4\n", "LOOKUP_TABLE t 99999999\n1 1\n",
       "the file ends too soon"},
  };
  for (const Malformed& c : cases) {
    const std::string message = refusal(folder.write("bad.vtk", changed(c.from, c.to)));
    EXPECT_THAT(message, HasSubstr(c.message)) << c.from << " -> " << c.to;
    EXPECT_THAT(message, HasSubstr("bad.vtk: "));
  }
}

TEST(VtkLegacy, PolyhedraWithDamagedFaceListsAreRefused) {
  const ScratchFolder folder;
  const auto file = [&](const std::string& list) {
    const auto length = std::count(list.begin(), list.end(), ' ') + 1;
    return folder.write("poly.vtk",
                        one_cell_file(kTetPoints, 4, list, static_cast<std::size_t>(length), 42));
  };
  EXPECT_EQ(read_any(file("4 3 0 1 2 3 0 1 3 3 1 2 3 3 2 0 3")).mesh.kinds[0],
            CellKind::tetrahedron4);
  EXPECT_THAT(refusal(file("4 3 0 1 2 3 0 1 3 3 1 2 3 3 2 0 1")), HasSubstr("1 Polyhedron"));
  EXPECT_THAT(refusal(file("5 3 0 1 2 3 0 1 3 3 1 2 3 3 2 0 3")), HasSubstr("too short"));
  EXPECT_THAT(refusal(file("3 3 0 1 2 3 0 1 3 3 1 2 3 3 2 0 3")), HasSubstr("too long"));
  EXPECT_THAT(refusal(file("4 99 0 1 2 3 0 1 3 3 1 2 3 3 2 0 3")), HasSubstr("list of"));
  EXPECT_THAT(refusal(file("4 3 0 1 9 3 0 1 3 3 1 2 3 3 2 0 3")), HasSubstr("no such point"));
}

TEST(VtkLegacy, HigherOrderNodesOutOfPlaceAreRefused) {
  const ScratchFolder folder;
  const std::string points = "0 0 0 2 0 0 0 2 0 0 0 2 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 0 1 1";
  EXPECT_EQ(
      refusal(folder.write("a.vtk", one_cell_file(points, 10, "0 1 2 3 4 5 6 7 8 9", 10, 24))), "");
  EXPECT_THAT(
      refusal(folder.write("a.vtk", one_cell_file(points, 10, "0 1 2 3 4 5 6 7 9 8", 10, 24))),
      HasSubstr("wrong node order"));
}

}  // namespace
}  // namespace hiac::formats
