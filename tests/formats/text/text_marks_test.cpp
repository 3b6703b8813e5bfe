// What text formats say of cells and nodes besides their places: materials, references, boundary
// conditions, groups. Two tetrahedra over one face, and a point that no cell uses.
#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "tests/formats/cell_volumes.hpp"
#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

// Nodes 1 to 4 make the unit tetrahedron, 2 to 5 one over its slanted face; node 6 is of no cell.
constexpr std::array<std::array<int, 3>, 6> kMarkedPoints{
    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {7, 8, 9}}};
constexpr double kFirst = 1.0 / 6;
constexpr double kSecond = 1.0 / 3;

/// The points, each in a line after its number (from 1) where the pattern has four places.
std::string points(const char* pattern, bool numbered) {
  std::string text;
  for (std::size_t i = 0; i < kMarkedPoints.size(); ++i) {
    const auto& [x, y, z] = kMarkedPoints[i];
    text += numbered ? fmt::format(fmt::runtime(pattern), i + 1, x, y, z)
                     : fmt::format(fmt::runtime(pattern), x, y, z);
  }
  return text;
}

const Field& located_field(const ZooMesh& mesh, const std::string& name, FieldLocation location) {
  const auto found = std::find_if(mesh.fields.begin(), mesh.fields.end(), [&](const Field& field) {
    return field.name == name && field.location == location;
  });
  if (found == mesh.fields.end()) throw std::runtime_error("no field " + name);
  return *found;
}

/// Both tetrahedra in the file's order and no point besides theirs.
void expect_both_tetrahedra(const ZooMesh& mesh) {
  ASSERT_EQ(mesh.cell_count(), 2U);
  EXPECT_EQ(mesh.node_count(), 5U);
  EXPECT_EQ(mesh.kinds[0], CellKind::tetrahedron4);
  EXPECT_NEAR(volume_of(mesh, 0), kFirst, 1e-15);
  EXPECT_NEAR(volume_of(mesh, 1), kSecond, 1e-15);
}

/// The marks of the cells, and that a block by that name is the second cell alone.
void expect_marks(const std::string& path, const std::string& field, double first, double second,
                  const std::string& block) {
  SCOPED_TRACE(path);
  const ZooMesh mesh = read_any(path).mesh;
  expect_both_tetrahedra(mesh);
  EXPECT_THAT(located_field(mesh, field, FieldLocation::cell).values.view(),
              ElementsAre(first, second));
  EXPECT_EQ(format_to_read(path).inspect(path).points, 6U);
  if (block.empty()) return;
  ReadOptions options;
  options.block = block;
  const ZooMesh part = read_any(path, options).mesh;
  ASSERT_EQ(part.cell_count(), 1U);
  EXPECT_EQ(part.node_count(), 4U);
  EXPECT_NEAR(volume_of(part, 0), kSecond, 1e-15);
  EXPECT_THAT(located_field(part, field, FieldLocation::cell).values.view(), ElementsAre(second));
}

TEST(TextMarks, MaterialsOfUcdAreAField) {
  const ScratchFolder folder;
  const std::string path = folder.write("a.inp", "6 2 0 0 0\n" + points("{} {} {} {}\n", true) +
                                                     "1 12 tet 1 2 3 4\n2 7 tet 2 3 4 5\n");
  expect_marks(path, "Material Id", 12, 7, "");
}

TEST(TextMarks, ReferencesOfMeditAreFieldsOfNodesAndCells) {
  const ScratchFolder folder;
  std::string text = "MeshVersionFormatted 2\nDimension 3\nVertices\n6\n";
  for (std::size_t i = 0; i < kMarkedPoints.size(); ++i)
    text += fmt::format("{} {} {} {}\n", kMarkedPoints[i][0], kMarkedPoints[i][1],
                        kMarkedPoints[i][2], 10 + i);
  const std::string path = folder.write(
      "a.mesh", text + "Triangles\n1\n1 2 3 44\nTetrahedra\n2\n1 2 3 4 5\n2 3 4 5 6\nEnd\n");
  expect_marks(path, "ref", 5, 6, "");
  const Reading reading = read_any(path);
  EXPECT_THAT(located_field(reading.mesh, "ref", FieldLocation::node).values.view(),
              ElementsAre(10, 11, 12, 13, 14));
  EXPECT_THAT(reading.notes, Contains(HasSubstr("without volume")));
}

TEST(TextMarks, MaterialsOfNetgenAreAnIndexAndNameBlocks) {
  const ScratchFolder folder;
  const std::string path = folder.write(
      "a.vol",
      "mesh3d\ndimension\n3\ngeomtype\n0\nsurfaceelements\n1\n 1 1 0 0 3 1 2 3\n"
      "volumeelements\n2\n 2 4 1 3 2 4\n 9 4 2 4 3 5\npoints\n6\n" +
          points("{} {} {}\n", false) + "materials\n2\n2 steel\n9 the core\nendmesh\n");
  expect_marks(path, "index", 2, 9, "the core");
  EXPECT_THAT(read_any(path).notes, Contains(HasSubstr("1 surface elements")));
  EXPECT_THAT(refusal(folder.write("seven.vol", "mesh3d\nvolumeelements\n1\n 2\n 7 1 2 3\n")),
              HasSubstr("seven.vol:5: 4, 5, 6, 8, 10, 13, 15 or 20 nodes of an element"));
}

TEST(TextMarks, GroupsOfGambitAreMaterialsAndBoundariesMarkNodes) {
  const ScratchFolder folder;
  const std::string path = folder.write(
      "a.neu",
      "        CONTROL INFO 2.4.6\n** GAMBIT NEUTRAL FILE\nx\nPROGRAM: Gambit VERSION: 2\n now\n"
      " NUMNP NELEM NGRPS NBSETS NDFCD NDFVL\n 6 2 2 2 3 3\nENDOFSECTION\n"
      "   NODAL COORDINATES 2.4.6\n" +
          points("{} {} {} {}\n", true) +
          "ENDOFSECTION\n      ELEMENTS/CELLS 2.4.6\n 11 6 4 1 2 3 4\n 12 6 4 2 3 4 5\n"
          "ENDOFSECTION\n       ELEMENT GROUP 2.4.6\n"
          "GROUP: 1 ELEMENTS: 1 MATERIAL: 4 NFLAGS: 1\n outer\n 0\n 11\nENDOFSECTION\n"
          "       ELEMENT GROUP 2.4.6\nGROUP: 2 ELEMENTS: 1 MATERIAL: 2 NFLAGS: 1\n inner\n 0\n "
          "12\n"
          "ENDOFSECTION\n BOUNDARY CONDITIONS 2.4.6\n wall 0 2 0 6\n 1\n 3\nENDOFSECTION\n"
          " BOUNDARY CONDITIONS 2.4.6\n top 0 1 0 6\n 5\nENDOFSECTION\n");
  expect_marks(path, "Material Type", 4, 2, "inner");
  const ZooMesh mesh = read_any(path).mesh;
  EXPECT_THAT(located_field(mesh, "Boundary Condition", FieldLocation::node).values.view(),
              ElementsAre(1, 0, 1, 0, 2));
}

TEST(TextMarks, AttributesOfTetgenAreReadThroughEitherFile) {
  const ScratchFolder folder;
  std::string nodes = "6 3 1 1\n";
  for (std::size_t i = 0; i < kMarkedPoints.size(); ++i)
    nodes += fmt::format("{} {} {} {} {} {}\n", i, kMarkedPoints[i][0], kMarkedPoints[i][1],
                         kMarkedPoints[i][2], 0.5 * double(i), i == 4 ? 1 : 0);
  const std::string node = folder.write("a.node", nodes);
  const std::string ele = folder.write("a.ele", "2 4 1\n0 0 1 2 3 21\n1 1 2 3 4 22\n");
  for (const std::string& path : {node, ele}) {
    expect_marks(path, "ref", 21, 22, "");
    const ZooMesh mesh = read_any(path).mesh;
    EXPECT_THAT(located_field(mesh, "attribute", FieldLocation::node).values.view(),
                ElementsAre(0, 0.5, 1, 1.5, 2));
    EXPECT_THAT(located_field(mesh, "boundary marker", FieldLocation::node).values.view(),
                ElementsAre(0, 0, 0, 0, 1));
  }
}

TEST(TextMarks, ElementSetsOfAbaqusAreBlocks) {
  const ScratchFolder folder;
  const std::string path = folder.write(
      "a.inp", "*NODE\n" + points("{}, {}, {}, {}\n", true) +
                   "*ELEMENT, TYPE=S3, ELSET=Skin\n5, 1, 2, 3\n"
                   "*ELEMENT, TYPE=C3D4, ELSET=EB1\n7, 1, 2, 3, 4\n*ELEMENT, TYPE=C3D4, ELSET=EB5\n"
                   "3, 2, 3, 4, 5\n*ELSET, ELSET=Both\nEB1, EB5\n*ELSET, ELSET=Row, GENERATE\n"
                   "3, 6, 1\n");
  const Reading reading = read_any(path);
  expect_both_tetrahedra(reading.mesh);
  EXPECT_THAT(reading.notes, Contains(HasSubstr("1 S3")));
  const std::vector<std::pair<std::string, std::vector<double>>> rows{
      {"EB5", {kSecond}}, {"EB1", {kFirst}}, {"Row", {kSecond}}, {"Both", {kFirst, kSecond}}};
  for (const auto& [block, volumes] : rows) {
    ReadOptions options;
    options.block = block;
    const ZooMesh part = read_any(path, options).mesh;
    ASSERT_EQ(part.cell_count(), volumes.size()) << block;
    for (CellId cell = 0; cell < part.cell_count(); ++cell)
      EXPECT_NEAR(volume_of(part, cell), volumes[cell], 1e-15) << block;
  }
}

}  // namespace
}  // namespace hiac::formats
