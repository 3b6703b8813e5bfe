// Ansys decks without blocks: as CDWRITE writes them with UNBLOCKED (Programmer's Reference, "Coded
// database file commands"), and as users write them (Command Reference).
#include <cmath>

#include <fmt/format.h>

#include "hiac/mesh/shape_functions.hpp"
#include "tests/formats/cell_volumes.hpp"
#include "tests/formats/files.hpp"
#include "tests/formats/unit_tetrahedron.hpp"

namespace hiac::formats {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

Reading deck(const std::string& text) {
  const ScratchFolder folder;
  return read_any(folder.write("a.cdb", "/PREP7\n" + text));
}

std::string cdb_refusal(const std::string& text) {
  const ScratchFolder folder;
  return refusal(folder.write("a.cdb", "/PREP7\n" + text));
}

/// As CDWRITE writes a node and an element.
std::string written_node(std::size_t number, const std::array<double, 3>& point) {
  return fmt::format(
      "N,R5.3,LOC, {:8},       0,       0,  {:.9E}    ,  {:.9E}    ,  {:.9E}\n"
      "N,R5.3,ANG, {:8},       0,       0,  0.000000000E+00\n",
      number, point[0], point[1], point[2], number);
}

std::string written_element(int type, int number, const std::vector<int>& nodes) {
  std::string text = fmt::format("EN,R5.5,ATTR,{:8},{:8},{:8},{:8},{:8},{:8},{:8},{:8},{:8},{:8}\n",
                                 nodes.size(), 3, type, 5, 1, 0, number, 0, 0, 0);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (n % 8 == 0) text += n == 0 ? "EN,R5.5,NODE" : "\nEN,R5.5,NODE";
    text += fmt::format(",{:8}", nodes[n]);
  }
  return text + ",\n";
}

TEST(AnsysCommands, UnblockedArchives) {
  std::string text = "/COM,ANSYS RELEASE 18.2\nET, 1,187\nET,        2,185\nKEYOP, 2, 2, 0\n";
  const auto places = reference_nodes(CellKind::tetrahedron10);
  for (std::size_t n = 0; n < places.size(); ++n) text += written_node(n + 1, places[n]);
  text += "N,R5.3,LOC,       -1,\n";
  text += written_element(1, 7, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
  text += written_element(2, 9, {1, 2, 3, 3, 4, 4, 4, 4});
  text += written_element(1, 8, {1, 2, 3, 4, 5, 6, 7, 0, 0, 10});
  text += "EN,R5.5,ATTR,       -1,\nCMBLOCK,PART,ELEM,1\n(8i10)\n         9\nFINISH\n";
  const Reading reading = deck(text);
  ASSERT_EQ(reading.mesh.cell_count(), 3U);
  EXPECT_EQ(reading.mesh.kinds[0], CellKind::tetrahedron10);
  EXPECT_EQ(reading.mesh.kinds[1], CellKind::tetrahedron4);
  for (std::size_t n = 0; n < places.size(); ++n)
    EXPECT_THAT(reading.mesh.position(reading.mesh.cell_nodes(0)[n]),
                ElementsAre(places[n][0], places[n][1], places[n][2]));
  EXPECT_THAT(reading.mesh.position(reading.mesh.cell_nodes(2)[7]), ElementsAre(0, 0, 0.5));
  const ScratchFolder folder;
  EXPECT_THAT(format_named("ansys").inspect(folder.write("a.cdb", text)).blocks,
              ElementsAre("PART"));
}

const std::string kCorners = "N,1\nN,2,1.\nN,3,0,1\nN,4,0,0,1.0\n";

TEST(AnsysCommands, DecksOfUsers) {
  for (const std::string elements :
       {"ET,1,285\nE,1,2,3,4\n", "et,5,SOLID285\ntype,5\nen,12,1,2,3,4\n",
        "ET,1,185\nE,1,2,3,3,4,4,4,4\n", "ET,1,187 ! comment\nE,1,2,3,4,0,0,0,0\nEMORE,0,0\n",
        "ET,1,187\nE,1,2,3,4\n"})
    expect_unit_tetrahedron(deck(kCorners + elements).mesh);
  // numbers follow the largest; several commands a line; the last definition counts
  const Reading reading = deck(
      "ET,1,285 $ N,7,5,5,5\nN,,1,0,0 ! the eighth\n N,9,0,1 $ N,10,0,0,1\nN,7,0,0,0\n"
      "EN,4,7,8,9,10\nE,7,9,8,10\nEN,4,8,9,10,7\n");
  ASSERT_EQ(reading.mesh.cell_count(), 2U);
  EXPECT_NEAR(volume_of(reading.mesh, 0), -1.0 / 6, 1e-15);
  EXPECT_NEAR(volume_of(reading.mesh, 1), -1.0 / 6, 1e-15);
}

TEST(AnsysCommands, NodesInCylindersAndSpheres) {
  const Reading reading = deck(
      "ET,1,285\nCSYS,1\nN,1,2,90,3\nN,2,2,180,3\nCSYS,2\nN,3,2,90,30\nCSYS\nN,4,7,8,9\n"
      "E,1,2,3,4\n");
  const auto near = [](double x, double y, double z) {
    return ElementsAre(DoubleNear(x, 1e-15), DoubleNear(y, 1e-15), DoubleNear(z, 1e-15));
  };
  const auto nodes = reading.mesh.cell_nodes(0);
  EXPECT_THAT(reading.mesh.position(nodes[0]), near(0, 2, 3));
  EXPECT_THAT(reading.mesh.position(nodes[1]), near(-2, 0, 3));
  EXPECT_THAT(reading.mesh.position(nodes[2]), near(0, std::sqrt(3.0), 1));
  EXPECT_THAT(reading.mesh.position(nodes[3]), near(7, 8, 9));
}

TEST(AnsysCommands, PatternsAreRepeated) {
  // 2 x 3 x 4 bricks whose sides are 1
  const std::string nodes = "N,1,0,0,0\nNGEN,3,1,1,,,1\nNGEN,4,10,1,3,1,0,1,0\n";
  const std::string bricks = "ET,1,SOLID185\nE,1,2,12,11,101,102,112,111\nEGEN,2,1,1\n";
  for (const std::string& rest :
       {nodes + "NGEN,5,100,1,33,,0,0,1\n" + bricks + "EGEN,3,10,1,2\nEGEN,4,100,1,6\n",
        nodes + "NSEL,S,LOC\nALLSEL\nNGEN,5,100,ALL,,,,,1,1\n" + bricks +
            "EGEN,3,10,-2\nEGEN,4,100,ALL\n"}) {
    const Reading reading = deck(rest);
    ASSERT_EQ(reading.mesh.cell_count(), 24U);
    for (CellId cell = 0; cell < 24; ++cell)
      EXPECT_NEAR(volume_of(reading.mesh, cell), 1, 1e-12) << cell;
    std::array<double, 3> high{};
    for (NodeId node = 0; node < reading.mesh.node_count(); ++node)
      for (std::size_t c = 0; c < 3; ++c)
        high[c] = std::max(high[c], reading.mesh.position(node)[c]);
    EXPECT_THAT(high, ElementsAre(2, 3, 4));
  }
}

TEST(AnsysCommands, CommandsWithParametersBesidesBlocks) {
  const std::string blocks =
      "ET,1,285\nNBLOCK,3\n(3i8,6e16.9)\n"
      "       1       0       0\n       2       0       0 1.000000000E+00\n"
      "       3       0       0 0.000000000E+00 1.000000000E+00\n"
      "       4       0       0 0.000000000E+00 0.000000000E+00 1.000000000E+00\n-1\n"
      "EBLOCK,19,SOLID\n(19i8)\n"
      "       1       1       1       1       0       0       0       0       4       0       1"
      "       1       2       3       4\n-1\n";
  const Reading reading = deck(blocks +
                               "*DO,I,1,3\nN,I,2,2,2\n*ENDDO\nET,_cid,174\nTYPE,_cid\nE,1,2,3,4\n"
                               "CSYS,_cs\nN,9,1,1,1\nNUMMRG,NODE\nEDELE,5\n");
  expect_unit_tetrahedron(reading.mesh);
  EXPECT_THAT(reading.notes, testing::Contains(HasSubstr("left out 6 commands")));
  // what they say in numbers counts
  EXPECT_EQ(deck(blocks + "N,5,1,1,1\nE,2,3,4,5\n").mesh.cell_count(), 2U);
  // half of one that cannot be read does not
  const Reading half = deck(blocks + "N,R5.3,LOC,9,0,0,1.0,_x,0.\nN,5,1,1,1\n");
  expect_unit_tetrahedron(half.mesh);
  EXPECT_THAT(half.notes, testing::Contains(HasSubstr("left out 1 commands")));
  const Reading large =
      deck(blocks + "N,R5.3,LOC,9,0,0,1.,1.,1.\nTYPE,1\nE,2,3,4,9\nEN,3,1,2,3,9\nEGEN,3,1e9,1,3\n");
  EXPECT_EQ(large.mesh.cell_count(), 3U);
}

TEST(AnsysCommands, WhatIsNotReadIsNamedWithItsLine) {
  const std::string one = "ET,1,285\n" + kCorners + "E,1,2,3,4\n";
  const std::vector<std::pair<std::string, std::string>> cases{
      {"FILL,1,4\n" + one, ":2: FILL makes or changes nodes or elements"},
      {one + "nummrg,node\n", ":8: NUMMRG makes or changes"},
      {one + "*REPEAT,4,1,1\n", ":8: *REPEAT makes or changes"},
      {"BLOCK,0,1,0,1,0,1\nVMESH,ALL\n", ":3: VMESH makes or changes"},
      {"ET,1,285\n" + kCorners, "E or EN expected"},
      {"E,1,2,3,4\n", "NBLOCK or N expected"},
      {"N,I,0,0\n", ":2: N: a node number expected ('N,I,0,0' found)"},
      {"N,1,A,0\n", ":2: a real number expected"},
      {"N,R5.1,LOC,1\n", ":2: N of version R5.3 expected"},
      {"N,R5.3,ABC,1\n", ":2: N,R5.3,LOC or ANG expected"},
      {"N,R5.3,LOC,x\n", ":2: N: a node number expected"},
      {"EN,R5.1,ATTR,4\n", ":2: EN of version R5.5 expected"},
      {"EN,R5.5,ATTR,99,1,1,1,1,1,1\n", ":2: EN: 1 to 64 nodes expected"},
      {"EN,R5.5,NODE,1,2\n", ":2: EN,R5.5,ATTR before EN,R5.5,NODE expected"},
      {"EN,R5.5,ATTR,4,1,1,1,0,0,7\nEN,R5.5,NODE,1,2,3\n",
       ":2: EN: element 7: 4 nodes (3 are there) expected"},
      {"EN,R5.5,ATTR,1,1,1,1,0,0,7\nEN,R5.5,NODE,1\nEN,R5.5,NODE,1\n",
       ":4: EN: element 7: 1 nodes expected"},
      {"EMORE,1\n", ":2: E or EN before EMORE expected"},
      {"E\n", ":2: E: nodes expected"},
      {"E,1,2,3,4,5,6,7,8,9\n", ":2: E: at most 8 nodes expected"},
      {one + "E,1,2,3,4,3\n", ":8: E: element 2: at most 4 nodes expected"},
      {"TYPE,A\n", ":2: TYPE: a type number expected"},
      {"CSYS,11\nN,1\n", ":3: N: a system CSYS of 0, 1 or 2 expected"},
      {"N,1\nNGEN,2,1,7\n", ":3: NGEN of what is there by then expected"},
      {"N,1\nNGEN,2,1,1,,,0,0,0,2.\n", ":3: NGEN: a SPACE of 1 expected"},
      {"N,1\nCSYS,1\nNGEN,2,1,1\n", ":4: NGEN: a system CSYS of 0 expected"},
      {"N,1\nNSEL,S,LOC,X,1\nNGEN,2,1,ALL\n", ":4: NGEN of numbers, not of what NSEL"},
      {one + "EGEN,2,1,1,,,1,1\n", ":8: EGEN: a TINC of 0 expected"},
      {one + "EGEN,2,1,1,,,,,,,,1.\n", ":8: EGEN: a DX, DY and DZ of 0 expected"},
      {one + "E,1,2,3,77\n", "77"}};
  for (const auto& [text, message] : cases)
    EXPECT_THAT(cdb_refusal(text), HasSubstr(message)) << text;
}

TEST(AnsysCommands, ShortDecksDoNotTakeMemoryWithoutEnd) {
  const std::string limit = "at most 16000000 numbers of nodes and elements made by NGEN and EGEN";
  EXPECT_THAT(cdb_refusal("N,1\nNGEN,999999999,1,1\n"), HasSubstr(limit));
  EXPECT_THAT(cdb_refusal("ET,1,285\n" + kCorners + "E,1,2,3,4\nEGEN,999999999,1,1\n"),
              HasSubstr(limit));
  EXPECT_THAT(cdb_refusal("N,999999999\nN\nNGEN,1000000000,1\n"), HasSubstr("a number of times"));
  // numbers of blocks may be larger than those that commands can count on from
  const std::string large = "922337203685477580";
  const auto coordinate = [](int x) { return fmt::format("{:16.9E}", x + 0.0); };
  std::string blocks = "ET,1,285\nNBLOCK,3\n(1i19,3e16.9)\n";
  for (int n = 4; n < 8; ++n)
    blocks += fmt::format("{}{}{}{}{}\n", large, n, coordinate(n == 5), coordinate(n == 6),
                          coordinate(n == 7));
  blocks += "-1\nEBLOCK,19,SOLID\n(19i19)\n";
  for (const int field : {1, 1, 1, 1, 0, 0, 0, 0, 4, 0}) blocks += fmt::format("{:19}", field);
  for (const int last : {7, 4, 5, 6, 7}) blocks += large + std::to_string(last);
  const Reading reading = deck(blocks + "\n-1\nN\nEGEN,9,9,ALL\nEGEN,9,9,-1\n");
  EXPECT_THAT(reading.notes, testing::Contains(HasSubstr("left out 2 commands")));
  EXPECT_EQ(reading.mesh.cell_count(), 1U);
}

}  // namespace
}  // namespace hiac::formats
