// Keywords of Abaqus that make nodes and elements: what is made is compared with where the Keywords
// Reference says that it is.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "formats/abaqus/inp_parser.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "tests/formats/cell_volumes.hpp"
#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// The nodes of a deck by number.
std::map<std::int64_t, std::array<double, 3>> nodes_of(const std::string& text) {
  const ScratchFolder folder;
  const abaqus::Model model = abaqus::parse_deck(folder.write("a.inp", text));
  std::map<std::int64_t, std::array<double, 3>> nodes;
  const abaqus::Part& part = model.root;
  for (std::size_t n = 0; n < part.node_numbers.size(); ++n) {
    EXPECT_FALSE(nodes.contains(part.node_numbers[n])) << part.node_numbers[n];
    nodes[part.node_numbers[n]] = {part.xyz[3 * n], part.xyz[3 * n + 1], part.xyz[3 * n + 2]};
  }
  return nodes;
}

auto near(double x, double y, double z) {
  using testing::DoubleNear;
  return ElementsAre(DoubleNear(x, 1e-14), DoubleNear(y, 1e-14), DoubleNear(z, 1e-14));
}

std::string refused(const std::string& text) {
  const ScratchFolder folder;
  return refusal(folder.write("a.inp", text));
}

double volume_of_all(const ZooMesh& mesh) {
  double sum = 0;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    const double volume = volume_of(mesh, cell);
    EXPECT_GT(volume, 0) << cell;
    sum += volume;
  }
  return sum;
}

TEST(AbaqusGeneration, NodesAlongStraightLines) {
  auto nodes = nodes_of(
      "*NODE\n1,0,0,0\n5,4,8,0\n101,1,1,1\n*NGEN\n1,5\n*NGEN, NSET=B\n101,5,-32\n** end\n");
  EXPECT_EQ(nodes.size(), 8U);
  for (int k = 2; k < 5; ++k) EXPECT_THAT(nodes.at(k), near(k - 1, 2 * (k - 1), 0)) << k;
  EXPECT_THAT(nodes.at(69), near(2, 10.0 / 3, 2.0 / 3));
  EXPECT_THAT(nodes.at(37), near(3, 17.0 / 3, 1.0 / 3));
}

TEST(AbaqusGeneration, NodesAlongArcsAndParabolas) {
  const double h = std::sqrt(0.5);
  const std::string ends = "*NODE\n1,3,1,0\n3,1,3,0\n9,1,1,0\n";
  // the centre as coordinates, as a node, in cylindrical coordinates
  for (const std::string centre : {"*NGEN, LINE=C\n1,3,1,,1.,1.,0.\n", "*NGEN,LINE=c\n1,3,,9\n",
                                   "*NGEN,LINE=C,SYSTEM=C\n1,3,1,0,1.4142135623730951,45.,\n"})
    EXPECT_THAT(nodes_of(ends + centre).at(2), near(1 + 2 * h, 1 + 2 * h, 0)) << centre;
  // the long way round, with the clock about -z, and half a circle about z
  EXPECT_THAT(nodes_of(ends + "*NGEN,LINE=C\n1,3,1,9,,,,0,0,-2\n").at(2),
              near(1 - 2 * h, 1 - 2 * h, 0));
  auto half = nodes_of("*NODE\n1,1,0,0\n5,-1,0,0\n*NGEN,LINE=C\n1,5,1,,0,0,0,0,0,1\n");
  EXPECT_THAT(half.at(2), near(h, h, 0));
  EXPECT_THAT(half.at(3), near(0, 1, 0));
  // a whole circle from a node to one in the same place
  EXPECT_THAT(nodes_of("*NODE\n1,1,0,0\n5,1,0,0\n*NGEN,LINE=C\n1,5,1,,0,0,0,0,0,1\n").at(4),
              near(0, -1, 0));
  auto parabola = nodes_of("*NODE\n1,0,0,0\n5,4,0,0\n*NGEN,LINE=P\n1,5,1,,2,3,0\n");
  for (int k = 1; k < 4; ++k)
    EXPECT_THAT(parabola.at(k + 1), near(k, 3 - 0.75 * (k - 2) * (k - 2), 0)) << k;
}

TEST(AbaqusGeneration, LinesBetweenSetsAreFilled) {
  const std::string ends =
      "*NODE, NSET=A\n1,0,0,0\n2,1,0,0\n*NODE,NSET=B\n41,0,8,0\n42,1,8,0\n43,7,7,7\n";
  auto even = nodes_of(ends + "*NFILL\nA,B,4,10\n");
  EXPECT_EQ(even.size(), 5U + 6U);
  EXPECT_THAT(even.at(12), near(1, 2, 0));
  EXPECT_THAT(even.at(31), near(0, 6, 0));
  // intervals of 1, 2 and 4 thirds: each half of the next
  auto biased = nodes_of(ends + "*NFILL, BIAS=0.5\nA,B,3,10\n");
  EXPECT_THAT(biased.at(11), near(0, 8.0 / 7, 0));
  EXPECT_THAT(biased.at(21), near(0, 24.0 / 7, 0));
  auto other = nodes_of(ends + "*NFILL, BIAS=2.\nA,B,3,10\n");
  EXPECT_THAT(other.at(11), near(0, 32.0 / 7, 0));
  EXPECT_THAT(other.at(21), near(0, 48.0 / 7, 0));
  // of pairs of intervals of equal length, 2 and 6
  auto pairs = nodes_of(ends + "*NFILL, BIAS=0.3333333333333333, TWO STEP\nA,B,4,10\n");
  EXPECT_THAT(pairs.at(11), near(0, 1, 0));
  EXPECT_THAT(pairs.at(21), near(0, 2, 0));
  EXPECT_THAT(pairs.at(31), near(0, 5, 0));
}

TEST(AbaqusGeneration, SetsOfNodesAreTakenInTheirOrder) {
  const std::string nodes = "*NODE\n1,0,0,0\n2,1,0,0\n3,2,0,0\n11,0,2,0\n12,1,2,0\n13,2,2,0\n";
  const std::string above = "*NSET,NSET=B,GEN\n11,900,1\n*NFILL\nA,B,2,100\n";
  EXPECT_THAT(nodes_of(nodes + "*NSET,NSET=A\n3,1,2,2\n" + above).at(103), near(2, 1, 0));
  EXPECT_THAT(nodes_of(nodes + "*NSET,NSET=A,UNSORT\n3,1,2,3\n" + above).at(103), near(1, 1, 0));
  EXPECT_THAT(nodes_of(nodes + "*NSET,NSET=C\n1,2\n*NSET,NSET=A\n3,\nC\n" + above).at(103),
              near(2, 1, 0));
  // *NFILL and *NGEN put the ends into their sets
  EXPECT_THAT(nodes_of("*NODE\n1,0,0,0\n3,0,2,0\n*NGEN,NSET=L\n1,3\n*NCOPY,CHANGE NUMBER=100,"
                       "OLD SET=L,SHIFT,NEW SET=R\n4,,\n,\n*NFILL,NSET=ALL\nL,R,2,50\n"
                       "*NCOPY,CHANGENUMBER=1000,OLDSET=ALL,SHIFT\n0,0,1\n")
                  .at(1103),
              near(4, 2, 1));
}

TEST(AbaqusGeneration, SetsAreCopied) {
  const auto copied = [](const std::string& how) {
    return nodes_of("*NODE,NSET=A\n1,3,1,2\n*NCOPY,CHANGE NUMBER=10,OLD SET=A," + how).at(11);
  };
  EXPECT_THAT(copied("SHIFT\n1,2,3\n"), near(4, 3, 5));
  EXPECT_THAT(copied("SHIFT\n1,2,3\n0.0,\n"), near(4, 3, 5));
  // moved, then turned
  EXPECT_THAT(copied("SHIFT\n1,0,0\n1,1,0,1,1,9,90\n"), near(1, 4, 2));
  EXPECT_THAT(copied("SHIFT\n\n1,1,0,1,1,9,90\n"), near(1, 3, 2));
  EXPECT_THAT(copied("SHIFT,MULTIPLE=3\n\n1,1,0,1,1,9,30.\n"), near(1, 3, 2));
  EXPECT_THAT(copied("REFLECT=POINT\n1,1,1\n"), near(-1, 1, 0));
  EXPECT_THAT(copied("REFLECT=LINE\n0,0,0,5,0,0\n"), near(3, -1, -2));
  EXPECT_THAT(copied("REFLECT=MIRROR\n1,0,0,1,5,0\n1,0,7\n"), near(-1, 1, 2));
}

/// A block of 2 x 3 x 4 bricks whose sides are 1, made as decks do it.
const std::string kBlock =
    "*NODE\n1,0,0,0\n3,2,0,0\n31,0,3,0\n33,2,3,0\n"
    "*NGEN,NSET=FRONT\n1,3\n*NGEN,NSET=BACK\n31,33\n*NFILL,NSET=BOTTOM\nFRONT,BACK,3,10\n"
    "*NCOPY,CHANGE NUMBER=400,OLD SET=BOTTOM,NEW SET=TOP,SHIFT\n0,0,4\n\n"
    "*NFILL,NSET=ALL\nBOTTOM,TOP,4,100\n"
    "*ELEMENT,TYPE=C3D8,ELSET=FIRST\n1,1,2,12,11,101,102,112,111\n";

TEST(AbaqusGeneration, ElementsInRowsAndLayers) {
  const ScratchFolder folder;
  const std::string path =
      folder.write("a.inp", kBlock + "*ELGEN,ELSET=ALL\n1, 2,1,1, 3,10,10, 4,100,100\n");
  const ZooMesh mesh = read_any(path).mesh;
  ASSERT_EQ(mesh.cell_count(), 24U);
  EXPECT_NEAR(volume_of_all(mesh), 24, 1e-12);
  for (CellId cell = 0; cell < 24; ++cell) EXPECT_NEAR(volume_of(mesh, cell), 1, 1e-12);
  EXPECT_THAT(format_named("abaqus").inspect(path).blocks,
              testing::UnorderedElementsAre("FIRST", "ALL"));
  ReadOptions all;
  all.block = "ALL";
  EXPECT_EQ(read_any(path, all).mesh.cell_count(), 24U);
  // one direction alone, with the default increments
  const Reading row = read_any(folder.write("b.inp", kBlock + "*ELGEN\n1,2\n"));
  EXPECT_EQ(row.mesh.cell_count(), 2U);
  // what stands behind the layers is not read
  const Reading more =
      read_any(folder.write("c.inp", kBlock + "*ELGEN\n1, 2,1,1, 3,10,10, 4,100,100, 1.5, x\n"));
  EXPECT_EQ(more.mesh.cell_count(), 24U);
}

TEST(AbaqusGeneration, QuadraticElementsRoundAnArc) {
  const ScratchFolder folder;
  // a quarter of a pipe, one element through its wall, four along the arc
  const Reading reading = read_any(folder.write(
      "a.inp",
      "*NODE\n1,2.,0.\n9,0.,2.\n21,3.,0.\n29,0.,3.\n*NGEN,LINE=C,NSET=IN\n1,9,1,,0.,0.,0.\n"
      "*NGEN,LINE=C,NSET=OUT\n21,29,1,,0.,0.,0.\n*NFILL,NSET=LOW\nIN,OUT,2,10\n"
      "*NCOPY,CHANGE NUMBER=200,OLD SET=LOW,SHIFT,NEW SET=HIGH\n0.,0.,1.\n0.,\n"
      "*NFILL\nLOW,HIGH,2,100\n*ELEMENT,TYPE=C3D20R\n"
      "1, 1,21,23,3, 201,221,223,203, 11,22,13,2, 211,222,213,\n202, 101,121,123,103\n"
      "*ELGEN,ELSET=E\n1,4,2,1\n"));
  ASSERT_EQ(reading.mesh.cell_count(), 4U);
  // between the chords of a quarter of a right angle each
  EXPECT_NEAR(volume_of_all(reading.mesh), 2 * 5 * std::sin(std::numbers::pi / 8), 1e-12);
}

/// One cell of a kind and its mirror image beyond x = -1, which numbers its nodes with it.
TEST(AbaqusGeneration, ElementsAreCopiedAndReflected) {
  const ScratchFolder folder;
  const std::vector<std::pair<std::string, CellKind>> kinds{
      {"C3D4", CellKind::tetrahedron4}, {"C3D10", CellKind::tetrahedron10},
      {"C3D5", CellKind::pyramid5},     {"C3D6", CellKind::prism6},
      {"C3D15", CellKind::prism15},     {"C3D8", CellKind::brick8},
      {"C3D20", CellKind::brick20}};
  for (const auto& [type, kind] : kinds) {
    // Abaqus's order of nodes is the zoo's but for the prism, whose triangles turn the other way
    constexpr std::array<std::size_t, 15> kTurned{0, 2, 1, 3, 5, 4, 8, 7, 6, 11, 10, 9, 12, 14, 13};
    const bool prism = kind == CellKind::prism6 || kind == CellKind::prism15;
    std::string nodes = "*NODE,NSET=N\n";
    std::string cell = "*ELEMENT,ELSET=E,TYPE=" + type + "\n7";
    const auto places = reference_nodes(kind);
    for (std::size_t n = 0; n < places.size(); ++n) {
      const auto& place = places[prism ? kTurned[n] : n];
      nodes += fmt::format("{},{},{},{}\n", n + 1, place[0], place[1], place[2]);
      cell += fmt::format(",{}{}", n == 12 ? "\n" : "", n + 1);
    }
    const std::string text =
        nodes + cell +
        "\n*NCOPY,CHANGE NUMBER=100,OLD SET=N,REFLECT=MIRROR\n-9,0,0,-9,5,0\n-9,0,7\n";
    const std::string copy = "*ELCOPY,OLD SET=E,NEW SET=F,ELEMENT SHIFT=100,SHIFT NODES=100";
    const ZooMesh mesh = read_any(folder.write("a.inp", text + copy + ",REFLECT\n")).mesh;
    ASSERT_EQ(mesh.cell_count(), 2U) << type;
    EXPECT_EQ(mesh.kinds[1], kind);
    EXPECT_GT(volume_of(mesh, 0), 0) << type;
    EXPECT_NEAR(volume_of(mesh, 1), volume_of(mesh, 0), 1e-12) << type;
    const ZooMesh inside_out = read_any(folder.write("b.inp", text + copy + "\n")).mesh;
    EXPECT_NEAR(volume_of(inside_out, 1), -volume_of(mesh, 0), 1e-12) << type;
  }
}

TEST(AbaqusGeneration, TheLastDefinitionCounts) {
  auto nodes = nodes_of("*NODE\n1,0,0,0\n5,4,0,0\n*NGEN\n1,5\n*NODE\n3,2,9,0\n*NGEN\n3,5\n");
  EXPECT_EQ(nodes.size(), 5U);
  EXPECT_THAT(nodes.at(3), near(2, 9, 0));
  EXPECT_THAT(nodes.at(4), near(3, 4.5, 0));
  const ScratchFolder folder;
  const ZooMesh mesh = read_any(folder.write("a.inp", kBlock + "*ELGEN\n1,2\n*ELEMENT,TYPE=C3D4\n"
                                                               "2,1,2,11,101\n"))
                           .mesh;
  ASSERT_EQ(mesh.cell_count(), 2U);
  EXPECT_EQ(mesh.kinds[1], CellKind::tetrahedron4);
}

TEST(AbaqusGeneration, NodesInALocalSystem) {
  auto nodes = nodes_of(
      "*SYSTEM\n1,2,3\n*NODE\n1,1,0,0\n"
      "*SYSTEM\n0,0,0,0,5,7\n*NODE\n2,1,2,3\n"
      "*SYSTEM\n1,0,0,1,0,5\n1,-1,0\n*NODE\n3,1,2,3\n4,1,0,3\n*NGEN\n3,4\n"
      "*NODE,SYSTEM=C\n6,2,90,3\n*SYSTEM\n*NODE\n5,1,2,3\n");
  EXPECT_THAT(nodes.at(1), near(2, 2, 3));
  EXPECT_THAT(nodes.at(2), near(-2, 1, 3));
  EXPECT_THAT(nodes.at(3), near(4, -2, 1));
  EXPECT_THAT(nodes.at(6), near(4, -2, 0));
  EXPECT_THAT(nodes.at(5), near(1, 2, 3));
}

TEST(AbaqusGeneration, PartsHaveTheirOwn) {
  const ScratchFolder folder;
  const std::string part =
      "*PART,NAME=P\n" + kBlock + "*ELGEN\n1,2,1,1,3,10,10,4,100,100\n*END PART\n";
  const std::string text = part +
                           "*PART,NAME=Q\n*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n"
                           "*ELEMENT,TYPE=C3D4\n1,1,2,3,4\n*END PART\n*ASSEMBLY\n"
                           "*INSTANCE,NAME=A,PART=P\n*END INSTANCE\n*INSTANCE,NAME=B,PART=P\n9,,\n"
                           "*END INSTANCE\n*INSTANCE,NAME=C,PART=Q\n*END INSTANCE\n*END ASSEMBLY\n";
  EXPECT_EQ(read_any(folder.write("a.inp", text)).mesh.cell_count(), 49U);
  // a part's sets are not another's
  EXPECT_THAT(refused(part + "*PART,NAME=Q\n*NODE\n1,0,0,0\n*NFILL\nFRONT,BACK,3,10\n"),
              HasSubstr("*NFILL: a node set 'FRONT' before it expected"));
}

TEST(AbaqusGeneration, WhatIsNotUnderstoodIsRefusedByNameAndLine) {
  const std::string nodes = "*NODE,NSET=A\n1,0,0,0\n5,4,0,0\n9,4,3,0\n";
  const std::vector<std::pair<std::string, std::string>> cases{
      {"*NMAP,NSET=A\n1,2\n", ":5: *NMAP makes nodes or elements"},
      {"*NCOPY,POLE,CHANGE NUMBER=1,OLD SET=A\n1,2,3\n", ":5: *NCOPY, POLE makes"},
      {"*NFILL,SINGULAR=1\nA,A,2,1\n", ":5: *NFILL, SINGULAR makes"},
      {"*SYSTEM\n1,2,3\n*NCOPY,SHIFT,CHANGE NUMBER=1,OLD SET=A\n1,2,3\n", "*NCOPY under *SYSTEM"},
      {"*SYSTEM\n1,2,3\n*NGEN,LINE=C\n1,5,1,,1,1,1\n", "point under *SYSTEM"},
      {"*NGEN\n1,7\n", ":6: *NGEN: a node 7 before it expected ('1,7' found)"},
      {"*NGEN\n1,x\n", ":6: *NGEN: a node number expected"},
      {"*NGEN\n1,5,3\n", ":6: *NGEN: an increment that leads"},
      {"*NGEN,LINE=X\n1,5\n", ":5: *NGEN: LINE=P or LINE=C expected"},
      {"*NGEN,LINE=C\n1,5,1,,1,0,0\n", ":6: *NGEN, LINE=C: ends equally far"},
      {"*NGEN,LINE=C\n1,5,1,,2,0,0\n", ":6: *NGEN, LINE=C: a normal, for an arc of 180"},
      {"*NGEN,LINE=C\n1,5,1,,2,0,0,1,0,0\n", ":6: *NGEN, LINE=C: a normal to the plane"},
      {"*NGEN,LINE=P\n1,5,1,77\n", ":6: *NGEN: a node 77 before it"},
      {"*NFILL\nA,B,2,1\n", ":6: *NFILL: a node set 'B' before it expected"},
      {"*NFILL\nA,A,0,1\n", ":6: *NFILL: 1 interval or more expected"},
      {"*NFILL\nA,A,2\n", ":6: *NFILL: an increment of node numbers expected"},
      {"*NFILL,BIAS=0\nA,A,2,1\n", ":5: *NFILL: a BIAS above 0 expected"},
      {"*NFILL,TWO STEP\nA,A,3,1\n", ":6: *NFILL, TWO STEP: an even number"},
      {"*NSET,NSET=B,ELSET=E\n*NFILL\nA,B,2,1\n", "not those of a set of elements, expected"},
      {"*NSET,NSET=B\nA,C\n*NFILL\nA,B,2,1\n", "not 'C', expected"},
      {"*NCOPY,SHIFT,OLD SET=A\n1,2,3\n", ":5: *NCOPY without CHANGENUMBER"},
      {"*NCOPY,SHIFT,CHANGE NUMBER=x,OLD SET=A\n1,2\n", ":5: *NCOPY, CHANGENUMBER: a whole number"},
      {"*NCOPY,CHANGE NUMBER=1,OLD SET=A\n1,2,3\n", ":5: *NCOPY: SHIFT or REFLECT expected"},
      {"*NCOPY,SHIFT,CHANGE NUMBER=1,OLD SET=A\n", ":5: *NCOPY, SHIFT: a line with a translation"},
      {"*NCOPY,SHIFT,CHANGE NUMBER=1,OLD SET=A\n1,y,3\n", ":6: a real number expected"},
      {"*NCOPY,SHIFT,CHANGE NUMBER=1,OLD SET=A\n,\n1,1,1,1,1,1,9\n",
       ":7: *NCOPY, SHIFT: two points"},
      {"*NCOPY,REFLECT=MIRROR,CHANGE NUMBER=1,OLD SET=A\n1,0,0,2,0,0\n3,0,0\n",
       ":7: *NCOPY, REFLECT: points that differ"},
      {"*NCOPY,REFLECT=TREE,CHANGE NUMBER=1,OLD SET=A\n1,0,0\n", ":5: *NCOPY: REFLECT=POINT"},
      {"*ELGEN\n1,5\n", ":6: *ELGEN: an element 1 before it expected"},
      {"*ELEMENT,TYPE=C3D4\n1,1,1,1,1\n*ELGEN\n1,2,1,1,3\n", ":8: *ELGEN: an increment of node"},
      {"*ELEMENT,TYPE=C3D4\n1,1,1,1,1\n*ELGEN\n1,0\n", ":8: *ELGEN: 1 element, row"},
      {"*ELEMENT,TYPE=C3D4\n1,1,1,1,1\n*ELGEN\n1,2,1,1,1,,,2.5\n", ":8: *ELGEN: a number of"},
      {"*ELCOPY,OLD SET=E,ELEMENT SHIFT=1,SHIFT NODES=1\n", ":5: *ELCOPY: there is no element set"},
      {"*SYSTEM\n1,2,3,1,2,9\n", ":6: *SYSTEM: points that make axes expected"},
      {"*SYSTEM\n1,2,3\n1,2,3\n", ":6: *SYSTEM: the origin and a point on the first axis"}};
  for (const auto& [text, message] : cases)
    EXPECT_THAT(refused(nodes + text), HasSubstr(message)) << text;
}

TEST(AbaqusGeneration, ShortDecksDoNotTakeMemoryWithoutEnd) {
  const std::string limit = "at most 16000000 numbers of nodes and elements made by keywords";
  const std::string nodes = "*NODE,NSET=A\n1,0,0,0\n999999999,1,0,0\n";
  EXPECT_THAT(refused(nodes + "*NGEN\n1,999999999\n"), HasSubstr(limit));
  EXPECT_THAT(refused(nodes + "*NFILL\nA,A,999999999,1\n"), HasSubstr(limit));
  EXPECT_THAT(refused(nodes + "*ELEMENT,TYPE=MASS\n1,1\n*ELGEN\n1,999999999,1,1,999999999,1,1,"
                              "999999999,1,1\n"),
              HasSubstr(limit));
  EXPECT_THAT(refused(nodes + "*ELEMENT,TYPE=C3D4\n1,9223372036854775807,1,1,1\n*ELGEN\n1,2\n"),
              HasSubstr("*ELGEN: numbers of at most 999999999 expected"));
  EXPECT_THAT(refused(nodes + "*NGEN\n1,9999999999\n"), HasSubstr("a node number expected"));
  // sets made of themselves
  std::string sets = nodes;
  for (int i = 0; i < 40; ++i) sets += "*NSET,NSET=A\nA,A,A\n*ELSET,ELSET=E\nE,E,5\n";
  EXPECT_EQ(nodes_of(sets + "*NFILL\nA,A,2,5\n").size(), 4U);
  // what instances make of it
  std::string parts = "*PART,NAME=P\n*NODE\n1,0,0,0\n200001,1,0,0\n*NGEN\n1,200001\n*END PART\n";
  for (int i = 0; i < 60; ++i)
    parts += fmt::format("*INSTANCE,NAME=I{},PART=P\n*END INSTANCE\n", i);
  EXPECT_THAT(refused(parts), HasSubstr("instances of what keywords make are too large"));
}

}  // namespace
}  // namespace hiac::formats
