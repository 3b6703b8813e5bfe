// What real files of the text formats hold beside what their formats' descriptions need: comments,
// blanks, other words for one thing, sections to be passed over.
#include <cmath>

#include <fmt/format.h>

#include "tests/formats/files.hpp"
#include "tests/formats/unit_tetrahedron.hpp"

namespace hiac::formats {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string kAbaqus =
    "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*ELEMENT, TYPE=C3D4\n1,1,2,3,4\n";

TEST(TextHabits, AMarkBeforeUtf8IsPassedOver) {
  const ScratchFolder folder;
  expect_unit_tetrahedron(read_any(folder.write("a.inp", "\xef\xbb\xbf" + kAbaqus)).mesh);
}

TEST(AbaqusHabits, BlanksBeforeStarsAndCommentsWithinKeywords) {
  const ScratchFolder folder;
  expect_unit_tetrahedron(
      read_any(folder.write("a.inp",
                            " *NODE\n1,0,0,0\n ** note\n2,1,0,0\n3,0,1,0\n4,0,0,1\n"
                            "*SYSTEM\n  *ELEMENT,\n** between\n TYPE=C3D4\n1,1,2,3,4\n *STEP\n"))
          .mesh);
}

const std::string kDeckGrids =
    "GRID,1,,0.,0.,0. $ c\nGRID,2,,1.,0.,0.$c\n  GRID,3,,0.,1.,0.\n"
    "GRID    4                               1.    $ c\n";

TEST(NastranHabits, CommentsBlanksAndFreeContinuations) {
  const ScratchFolder folder;
  expect_unit_tetrahedron(read_any(folder.write("a.bdf", "BEGIN BULK\n" + kDeckGrids +
                                                             " CTETRA,1,1,1,2,3,4 $ c\nENDDATA"))
                              .mesh);
  const std::string corners =
      "GRID,5,,1.,1.,0.\nGRID,6,,1.,0.,1.\nGRID,7,,1.,1.,1.\nGRID,8,,0.,1.,1.\n";
  const ZooMesh brick =
      read_any(folder.write("b.bdf", "BEGIN BULK\n" + kDeckGrids + corners +
                                         "CIHEX1,1,1,1,2,5,3,4,6\n $ between\n ,7,8\n"))
          .mesh;
  ASSERT_EQ(brick.cell_count(), 1U);
  EXPECT_EQ(brick.kinds[0], CellKind::brick8);
  EXPECT_THAT(brick.position(brick.nodes[7]), ElementsAre(0, 1, 1));
}

TEST(NastranHabits, LongTitlesIncludesOverLinesAndReplication) {
  const ScratchFolder folder;
  static_cast<void>(folder.write("part.inc", kDeckGrids + "CTETRA,1,1,1,2,3,4\n"));
  std::string filler;
  for (int i = 0; i < 200; ++i) filler += "$ a line of comment that is about that long\n";
  expect_unit_tetrahedron(
      read_any(folder.write("a.dat", "TITLE = a job\n" + filler +
                                         "BEGIN BULK\nINCLUDE 'pa\n   rt.inc'\nENDDATA\n"))
          .mesh);
  EXPECT_THAT(refusal(folder.write("b.bdf", "BEGIN BULK\nGRID,1,,0.,0.,0.\n=,*1,=,*1.\n")),
              HasSubstr("b.bdf:3: replicated entries"));
  EXPECT_THAT(refusal(folder.write("c.bdf", "BEGIN BULK\n" + kDeckGrids + "CIHEX2,1,1,1,2,3,4\n")),
              HasSubstr("1 CIHEX2"));
}

/// Rows of integers and reals in columns.
std::string cdb_nodes(int integers) {
  std::string text;
  for (int i = 0; i < 4; ++i) {
    text += fmt::format("{:9}", i + 1);
    for (int n = 1; n < integers; ++n) text += fmt::format("{:9}", 0);
    for (int c = 0; c < 3; ++c) text += fmt::format("{:20.9E}", i == c + 1 ? 1.0 : 0.0);
    text += "\n";
  }
  return text;
}
std::string cdb_row(std::initializer_list<int> fields) {
  std::string text;
  for (const int field : fields) text += fmt::format("{:9}", field);
  return text + "\n";
}

TEST(AnsysHabits, TypesInBlocksAndByName) {
  const ScratchFolder folder;
  const std::string element = cdb_row({1, 1, 1, 1, 0, 0, 0, 0, 8, 0, 1, 1, 2, 3, 3, 4, 4, 4, 4});
  const std::string nodes =
      "NBLOCK,6,SOLID,4,4\n(3i9,6e20.9)\n" + cdb_nodes(3) + "N,R5.3,LOC,-1,\n";
  for (const std::string types :
       {"ET,1,SOLID185\n",
        "ETBLOCK,        1,        1\n(2i9,19a9)\n        1      185\n       -1\n"})
    expect_unit_tetrahedron(
        read_any(folder.write("a.cdb", "/PREP7\n" + types + nodes +
                                           "EBLOCK,19,SOLID,1,1\n(19i9)\n" + element + "-1,\n"))
            .mesh);
  // Workbench's input: lower case, one integer a node, options of types
  expect_unit_tetrahedron(
      read_any(folder.write("ds.dat",
                            "/batch\n/com, ---\n/prep7\nnblock,3\n(1i9,3e20.9e3)\n" + cdb_nodes(1) +
                                "-1\net,1,285\nkeyo,1,2,1\n" + "eblock,19,solid,,1\n(19i9)\n" +
                                cdb_row({1, 1, 1, 1, 0, 0, 0, 0, 4, 0, 1, 1, 2, 3, 4}) + "-1\n"))
          .mesh);
}

const std::string kMshNodes = "4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n";
const std::string kMshElements = "$Elements\n1\n1 4 2 1 1 1 2 3 4\n$EndElements\n";

TEST(GmshHabits, LinesBetweenSectionsAndParametricNodes) {
  const ScratchFolder folder;
  const std::string head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  expect_unit_tetrahedron(
      read_any(folder.write("a.msh", "// made by hand\n\n" + head + "# nodes\n$Nodes\n" +
                                         kMshNodes + "$EndNodes\n" + kMshElements))
          .mesh);
  expect_unit_tetrahedron(
      read_any(folder.write("b.msh", head +
                                         "$ParametricNodes\n4\n1 0 0 0 0 1\n2 1 0 0 1 1 0.5\n"
                                         "3 0 1 0 2 1 0.1 0.2\n4 0 0 1 3 1\n$EndParametricNodes\n" +
                                         kMshElements))
          .mesh);
}

const std::string kSu2 =
    "NDIME= 3\nNELEM = 1 % elements\n% rows\n10 0 1 2 3 0\nNPOIN= 4 4\n0 0 0 0\n1 0 0 1\n0 1 0 2\n"
    "0 0 1 3\nNMARK= 1\nMARKER_TAG= wall\nMARKER_ELEMS= 1\n\n5 0 1 2\n";

TEST(Su2Habits, DeformationBoxesArePassedOverAndZonesAreBlocks) {
  const ScratchFolder folder;
  expect_unit_tetrahedron(
      read_any(folder.write("a.su2", kSu2 + "FFD_NBOX= 1\nFFD_TAG= 0\nFFD_CORNER_POINTS= 2\n0 0 0\n"
                                            "1 1 1\nFFD_SURFACE_POINTS= 1\nwall 1 0.5 0.5 0.5\n"))
          .mesh);
  const std::string path =
      folder.write("b.su2", "NZONE= 2\nIZONE= 1\n" + kSu2 + "IZONE= 2\n" + kSu2);
  EXPECT_EQ(read_any(path).mesh.cell_count(), 2U);
  ReadOptions options;
  options.block = "zone 2";
  expect_unit_tetrahedron(read_any(path, options).mesh);
  std::string wrong = kSu2;
  wrong.replace(wrong.find("10 0 1 2 3"), 10, "10 0 1 2 4");
  EXPECT_THAT(refusal(folder.write("c.su2", "NZONE= 2\nIZONE= 1\n" + wrong + "IZONE= 2\n" + kSu2)),
              HasSubstr("zone 1: there is no point 4 (0 to 3 expected)"));
}

TEST(MeditHabits, CommentsStandAnywhere) {
  const ScratchFolder folder;
  expect_unit_tetrahedron(
      read_any(
          folder.write("a.mesh",
                       "# c\nMeshVersionFormatted 1\n# d\nDimension\n# e\n3\nVertices\n# f\n4\n"
                       "# g\n0 0 0 1\n1 0 0 1\n0 1 0 1\n0 0 1 1\nTetrahedra\n1\n# h\n"
                       "1 2 3 4 1\nEnd"))
          .mesh);
}

TEST(UcdHabits, ShortNamesInCapitals) {
  const ScratchFolder folder;
  const std::string nodes = "1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n";
  expect_unit_tetrahedron(
      read_any(folder.write("a.inp", "\n# c\n 4 1 0 0 0\n" + nodes + "1 1 TET 1 2 3 4\n")).mesh);
  const ZooMesh prism = read_any(folder.write("b.inp", "6 1 0 0 0\n" + nodes +
                                                           "5 1 0 1\n6 0 1 1\n"
                                                           "1 1 pri 1 2 3 4 5 6\n"))
                            .mesh;
  EXPECT_EQ(prism.kinds[0], CellKind::prism6);
}

std::string neutral_file(const std::string& counts, const std::string& sections) {
  return "        CONTROL INFO 2.4.6\n** GAMBIT NEUTRAL FILE\nx\nPROGRAM:  Gambit     VERSION:  "
         "2.4.6\n Jan\n     NUMNP     NELEM     NGRPS    NBSETS     NDFCD     NDFVL\n" +
         counts + "\nENDOFSECTION\n" + sections;
}

TEST(GambitHabits, PlaneMeshesAndNamesWithBlanks) {
  const ScratchFolder folder;
  EXPECT_THAT(refusal(folder.write("four.neu", neutral_file(" 3 1 0 0 4 4", ""))),
              HasSubstr("four.neu:7: 2 or 3 coordinate directions expected (4 found)"));
  EXPECT_THAT(refusal(folder.write(
                  "a.neu", neutral_file(" 3 1 0 0 2 2",
                                        "   NODAL COORDINATES 2.4.6\n 1 0 0\n 2 1 0\n 3 0 1\n"
                                        "ENDOFSECTION\n      ELEMENTS/CELLS 2.4.6\n 1 3 3 1 2 3\n"
                                        "ENDOFSECTION\n"))),
              HasSubstr("no volume cells"));
  const std::string name = fmt::format("{:>32}", "wall of the tank");
  expect_unit_tetrahedron(
      read_any(
          folder.write("b.neu",
                       neutral_file(" 4 1 0 1 3 3",
                                    "   NODAL COORDINATES 2.4.6\n 1 0 0 0\n 2 1 0 0\n 3 0 1 0\n"
                                    " 4 0 0 1\nENDOFSECTION\n      ELEMENTS/CELLS 2.4.6\n"
                                    " 1 6 4 1 2 3 4\nENDOFSECTION\n BOUNDARY CONDITIONS 2.4.6\n" +
                                        name +
                                        "       1       1       0       6\n       1 6 1\n"
                                        "ENDOFSECTION\n")))
          .mesh);
}

TEST(TetgenHabits, CountsAtTheEndOfTheFirstLineMayBeMissing) {
  const ScratchFolder folder;
  static_cast<void>(folder.write("a.node", "4 3 # c\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n"));
  expect_unit_tetrahedron(read_any(folder.write("a.ele", "1 4\n1 1 2 3 4\n# end\n")).mesh);
}

const std::string kZone =
    "N=4, E=1, F=FEPOINT, ET=TETRAHEDRON\n0 0 0 1\n1 0 0 2\n0 1 0 3\n0 0 1 4\n";

TEST(TecplotHabits, TitlesWithoutQuotesAndHeadsWithoutEqualsSigns) {
  const ScratchFolder folder;
  for (const std::string head : {"TITLE = some words here\nVARIABLES = X, Y, Z, P\nZONE T=z ",
                                 "TITLE \"t\"\nVARIABLES \"X\" \"Y\" \"Z\" \"P\"\nZONE "})
    expect_unit_tetrahedron(read_any(folder.write("a.dat", head + kZone + "1 2 3 4\n")).mesh);
}

TEST(TecplotHabits, DuplicatedVariablesFaceNeighboursAndNan) {
  const ScratchFolder folder;
  const std::string head = "VARIABLES = X Y Z P\nZONE T=\"a\", FACENEIGHBORCONNECTIONS=1, ";
  const Reading reading =
      read_any(folder.write("a.dat", head + kZone +
                                         "1 2 3 4\n1 1 1\nZONE T=\"b\", N=4, E=1, F=FEPOINT, "
                                         "ET=TETRAHEDRON, D=(1,2,3,FECONNECT)\nNaN 6 7 8\n"));
  ASSERT_EQ(reading.mesh.cell_count(), 2U);
  EXPECT_EQ(reading.mesh.position(reading.mesh.cell_nodes(1)[3])[2], 1);
  const auto values = reading.mesh.fields.at(0).values.view();
  EXPECT_TRUE(std::isnan(values[4]));
  EXPECT_EQ(values[7], 8);
  EXPECT_THAT(refusal(folder.write("b.dat",
                                   "VARIABLES = X Y Z\nZONE N=4, E=1, F=FEPOINT, "
                                   "ET=TETRAHEDRON, D=(1,2,3,FECONNECT)\n")),
              HasSubstr("there is no zone before"));
}

// Files joined end to end tell their variables before each zone.
TEST(TecplotHabits, VariablesMayBeToldAgain) {
  const ScratchFolder folder;
  const std::string head = "TITLE = \"t\"\nVARIABLES = \"X\" \"Y\" \"Z\" \"P\"\nZONE ";
  const std::string one = head + kZone + "1 2 3 4\n";
  const Reading reading = read_any(folder.write("a.dat", one + one));
  EXPECT_EQ(reading.mesh.cell_count(), 2U);
  ASSERT_EQ(reading.mesh.fields.size(), 1U);
  EXPECT_EQ(reading.mesh.fields[0].values.view()[7], 4);
  EXPECT_THAT(refusal(folder.write("b.dat", one + "VARIABLES = \"X\" \"Y\" \"Z\" \"Q\"\n")),
              HasSubstr("b.dat:9: the VARIABLES of the zones before expected (4 names found)"));
  EXPECT_THAT(refusal(folder.write("c.dat", one + "VARIABLES = more\n")),
              HasSubstr("the VARIABLES of the zones before expected (1 names found)"));
}

TEST(FrdHabits, ExponentsOfThreeDigitsAndNoFormatNumber) {
  const ScratchFolder folder;
  const auto head = [](const char* key, const char* encoding) {
    return fmt::format("    {}{:30}{:37}{}\n", key, "", "", encoding);
  };
  std::string text = "    1C\n    1UPGM test\n" + head("2C", " ");
  for (int i = 0; i < 4; ++i)
    text += fmt::format(" -1{:10}{:12.5E}{:12.5E}{:12.5E}\n", i + 1, i == 1 ? 1.0 : 0.0,
                        i == 2 ? 1.0 : 0.0, i == 3 ? 1.0 : 0.0);
  text += " -3\n" + head("3C", "1");
  text +=
      fmt::format(" -1{:10}{:5}{:5}{:5}\n -2{:10}{:10}{:10}{:10}\n -3\n", 1, 3, 0, 1, 1, 2, 3, 4);
  text += fmt::format("  100CL  101{:12.5E}{:12}{:20} 0{:5}{:10} 1\n", 0.5, 4, "", 1, "");
  text += " -4  V           3    1\n";
  for (int c = 1; c <= 3; ++c) text += fmt::format(" -5  V{}          1    2{:5}    0\n", c, c);
  text += fmt::format(" -1{:10}{:12.5E}{:12.5E}{:12.5E}\n", 2, -1.25e-100, -2.5e-200, 0.5);
  text += fmt::format(" -1{:10}{:12.5E}{:12.5E}{:12.5E}\n -3\n 9999\n", 3, -1.25, 2.5, -0.5);
  const ZooMesh mesh = read_any(folder.write("a.frd", text)).mesh;
  expect_unit_tetrahedron(mesh);
  const auto values = mesh.fields.at(0).values.view();
  EXPECT_EQ(values[3], -1.25e-100);
  EXPECT_EQ(values[4], -2.5e-200);
  EXPECT_EQ(values[5], 0.5);
  EXPECT_EQ(values[6], -1.25);
  EXPECT_EQ(values[8], -0.5);
}

std::string unv_row(std::initializer_list<int> fields) {
  std::string text;
  for (const int field : fields) text += fmt::format("{:10}", field);
  return text + "\n";
}

TEST(UnvHabits, SpringsAndRigidBodiesHaveNoVolume) {
  const ScratchFolder folder;
  std::string text = "    -1\n  2411\n";
  for (int i = 0; i < 4; ++i)
    text += unv_row({i + 1, 1, 1, 11}) + fmt::format("{:25.16E}{:25.16E}{:25.16E}\n",
                                                     i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0,
                                                     i == 3 ? 1.0 : 0.0);
  text += "    -1\n    -1\n  2412\n" + unv_row({1, 136, 1, 1, 7, 2}) + unv_row({1, 2}) +
          unv_row({2, 122, 1, 1, 7, 3}) + unv_row({1, 2, 3}) + unv_row({3, 122, 1, 1, 7, 2}) +
          unv_row({1, 2}) + unv_row({4, 111, 1, 1, 7, 4}) + unv_row({1, 2, 3, 4}) + "    -1\n";
  const Reading reading = read_any(folder.write("a.unv", text));
  expect_unit_tetrahedron(reading.mesh);
  EXPECT_THAT(reading.notes, Contains(HasSubstr("without volume")));
}

const std::string kXdmf = R"xml(<?xml version="1.0" ?>
<!DOCTYPE Xdmf SYSTEM "Xdmf.dtd" [
<!ENTITY HeavyData "points.bin ">
]>
<Xdmf Version="2.0"><Domain><Grid Name="g" GridType="uniform">
<Topology TopologyType="TETRAHEDRON" NumberOfElements="1">
<DataItem Dimensions="1 4" Format="xml" NumberType="int">0 1 2 3</DataItem></Topology>
<Geometry GeometryType="xyz"><DataItem Dimensions="4 3" Format="binary" Precision="8"
 Endian="little"> &HeavyData; </DataItem></Geometry>
<Attribute Name="v" AttributeType="Vector" Center="node">
<DataItem ItemType="Function" Function="JOIN($0, $1, $0)" Dimensions="4 3">
<DataItem Dimensions="4" Format="XML">1 2 3 4</DataItem>
<DataItem Dimensions="4" Format="XML">5 6 7 8</DataItem></DataItem></Attribute>
</Grid></Domain></Xdmf>)xml";

TEST(XdmfHabits, EntitiesJoinedItemsAndWordsOfAnyCase) {
  const ScratchFolder folder;
  const std::vector<double> points{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  static_cast<void>(folder.write(
      "points.bin", std::string(reinterpret_cast<const char*>(points.data()), 8 * points.size())));
  const ZooMesh mesh = read_any(folder.write("a.xmf", kXdmf)).mesh;
  expect_unit_tetrahedron(mesh);
  const Field& field = mesh.fields.at(0);
  EXPECT_EQ(field.components, 3U);
  EXPECT_EQ(field.values[4], 6);
  EXPECT_EQ(field.values[5], 2);
  std::string sum = kXdmf;
  sum.replace(sum.find("JOIN($0, $1, $0)"), 16, "$0 + $1");
  EXPECT_THAT(refusal(folder.write("b.xmf", sum)), HasSubstr("is not computed (JOIN expected)"));
}

// The head counts the nodes and the elements of one section each.
TEST(GambitHabits, SectionsToldAgainAreRefused) {
  const ScratchFolder folder;
  const std::string head =
      "        CONTROL INFO 1.2.1\n** GAMBIT NEUTRAL FILE\none\nPROGRAM: Gambit VERSION: 1\n now\n"
      " NUMNP NELEM NGRPS NBSETS NDFCD NDFVL\n 4 1 1 0 3 3\nENDOFSECTION\n";
  const std::string nodes =
      "   NODAL COORDINATES 1.2.1\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\nENDOFSECTION\n";
  const std::string cells = "      ELEMENTS/CELLS 1.2.1\n1 6 4 1 2 3 4\nENDOFSECTION\n";
  const std::string others = "      ELEMENTS/CELLS 1.2.1\n9 6 4 1 2 3 4\nENDOFSECTION\n";
  const std::string group =
      "       ELEMENT GROUP 1.2.1\nGROUP: 1 ELEMENTS: 1 MATERIAL: 2 NFLAGS: 1\nall\n0\n9\n"
      "ENDOFSECTION\n";
  EXPECT_EQ(read_any(folder.write("once.neu", head + nodes + cells)).mesh.cell_count(), 1U);
  EXPECT_THAT(refusal(folder.write("cells.neu", head + nodes + cells + others + group)),
              HasSubstr("a second section of elements"));
  EXPECT_THAT(refusal(folder.write("nodes.neu", head + nodes + nodes + cells)),
              HasSubstr("a second section of nodes"));
}

}  // namespace
}  // namespace hiac::formats
