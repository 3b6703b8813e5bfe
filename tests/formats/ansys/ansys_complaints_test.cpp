// What Ansys decks are refused for, with the line, and what is just allowed; what repetitions
// choose; the element types of the Ansys element reference and its legacy types.
#include <map>

#include <fmt/format.h>

#include "formats/ansys/cdb_elements.hpp"
#include "formats/ansys/cdb_file.hpp"
#include "formats/common/io/input_text.hpp"
#include "tests/formats/complaints.hpp"

namespace hiac::formats {
namespace {

using testing::ElementsAre;

const std::string kCdbHead = "/PREP7\nET,1,285\n";
const std::string kCdbCorners = kCdbHead + "N,1\nN,2,1\nN,3,0,1\nN,4,0,0,1\n";
const std::string kCdbTetrahedron = kCdbCorners + "E,1,2,3,4\n";

ForeignMesh cdb_mesh(const std::string& text) {
  const ScratchFolder folder;
  return ansys::read_cdb(InputText(folder.write("a.cdb", text)));
}

/// The nodes of a deck by number.
std::map<std::int64_t, std::vector<double>> cdb_points_by_number(const std::string& text) {
  const ForeignMesh mesh = cdb_mesh(text + "E,1,2,3,4\n");
  std::map<std::int64_t, std::vector<double>> nodes;
  for (std::size_t n = 0; n < mesh.node_numbers.size(); ++n) {
    EXPECT_FALSE(nodes.contains(mesh.node_numbers[n])) << mesh.node_numbers[n];
    nodes[mesh.node_numbers[n]] = {mesh.xyz[3 * n], mesh.xyz[3 * n + 1], mesh.xyz[3 * n + 2]};
  }
  return nodes;
}

TEST(AnsysComplaints, WrittenElementsHaveFrom1To64Nodes) {
  const auto element = [](int count, const std::string& nodes) {
    return kCdbTetrahedron + "ET,2,281\n" +
           fmt::format("EN,R5.5,ATTR,{},1,2,1,1,0,9\n{}", count, nodes);
  };
  const std::string eight = "EN,R5.5,NODE,1,2,3,4,1,2,3,4\n";
  std::string all;
  for (int i = 0; i < 8; ++i) all += eight;
  const std::string begin = ":9: EN: 1 to 64 nodes expected ('EN,R5.5,ATTR,";
  expect_complaints("a.cdb", {{element(1, "EN,R5.5,NODE,3\n"), ""},
                              {element(64, all), ""},
                              {element(-1, ""), ""},
                              {element(0, ""), begin + "0,1,2,1,1,0,9' found)"},
                              {element(-2, ""), begin + "-2,1,2,1,1,0,9' found)"},
                              {element(65, all), begin + "65,1,2,1,1,0,9' found)"},
                              {kCdbTetrahedron + "EN,R5.5,TAIL,1\n",
                               ":8: EN,R5.5,ATTR or NODE expected ('EN,R5.5,TAIL,1' found)"},
                              {element(8, eight + "EN,R5.5,NODE,1\n"),
                               ":11: EN: element 9: 8 nodes expected ('EN,R5.5,NODE,1' found)"},
                              {element(9, eight + "EN,R5.5,NODE\n"),
                               ":9: EN: element 9: 9 nodes (8 are there) expected "
                               "('EN,R5.5,ATTR,9,1,2,1,1,0,9' found)"},
                              {element(8, "EN,R5.5,NODE,1,2,3,,5\n"),
                               ":10: EN: a node number expected ('EN,R5.5,NODE,1,2,3,,5' found)"}});
}

TEST(AnsysComplaints, ElementsGoOnUpTo64Nodes) {
  const std::string element = kCdbTetrahedron + "ET,2,281\nTYPE,2\nE,1,2,3,4,1,2,3,4\n";
  std::string more;
  for (int i = 0; i < 7; ++i) more += "EMORE,1,2,3,4,1,2,3,4\n";
  expect_complaints("a.cdb", {{element + more, ""},
                              {element + more + "EMORE,1\n",
                               ":18: at most 64 nodes expected ('EMORE,1' "
                               "found)"},
                              {element + "EN,3,1,2\nEMORE,1,2,3\nE,1\nEMORE\n", ""},
                              {element + "EMORE,1,x\n",
                               ":11: EMORE: a node number expected ('EMORE,1,x' "
                               "found)"},
                              {element + "N,9,1,1,1\nEMORE,1\n",
                               ":12: E or EN before EMORE expected ('EMORE,1' found)"},
                              {element + "EN,R5.5,ATTR,1,1,2,1,1,0,9\nEMORE,1\n",
                               ":12: E or EN before EMORE expected ('EMORE,1' found)"}});
}

// EMORE continues behind the eighth node, wherever the line before it ended.
TEST(AnsysCommandNodes, FurtherNodesStandBehindTheEighth) {
  const ForeignMesh mesh = cdb_mesh(
      "/PREP7\nET,1,187\nET,2,186\nN,1\nN,99\nE,1,2,3,4,5,6,7,8\nEMORE,9,10\n"
      "E,1,2,3,4\nEMORE,9\nTYPE,2\nE,1,2,3,4,5,6,7,8\nEMORE,11,,13\nEMORE,21\nE,1,2,3,4,5,6,7,8\n");
  constexpr std::int64_t kNo = kLeftOutNode;
  ASSERT_EQ(mesh.cell_count(), 4U);
  const auto all = std::vector<std::int64_t>{
      1, 2, 3, 4, 5, 6, 7, 8, 9,   10,  1,   2,   3,   4,   kNo, kNo, kNo, kNo, 9,   kNo,
      1, 2, 3, 4, 5, 6, 7, 8, 11,  kNo, 13,  kNo, kNo, kNo, kNo, kNo, 21,  kNo, kNo, kNo,
      1, 2, 3, 4, 5, 6, 7, 8, kNo, kNo, kNo, kNo, kNo, kNo, kNo, kNo, kNo, kNo, kNo, kNo};
  EXPECT_EQ(mesh.cell_nodes, all);
  EXPECT_THAT(mesh.cell_numbers, ElementsAre(1, 2, 3, 4));
}

TEST(AnsysCommandNodes, NumbersFollowTheLargest) {
  const auto nodes = cdb_points_by_number(kCdbCorners + "N,70,7\nN,,8\nN,20\nN,,9\n");
  EXPECT_THAT(nodes.at(71), ElementsAre(8, 0, 0));
  EXPECT_THAT(nodes.at(72), ElementsAre(9, 0, 0));
  EXPECT_EQ(nodes.size(), 8U);
  const ForeignMesh mesh = cdb_mesh(kCdbCorners +
                                    "EN,40,1,2,3,4\nE,1,2,3,4\nEN,,1,2,3,4\n"
                                    "EN,7,1,2,3,4\nE,1,2,3,4\n");
  EXPECT_THAT(mesh.cell_numbers, testing::UnorderedElementsAre(40, 41, 42, 7, 43));
  expect_complaints("a.cdb",
                    {{kCdbTetrahedron + "EN,40,1,2,3,4\nE,1,2,3,4,1\n",
                      ":9: E: element 41: at most 4 nodes expected ('E,1,2,3,4,1' found)"},
                     {kCdbTetrahedron + "E,1,2,3,4,0,0\n", ""},
                     {kCdbTetrahedron + "E,1,2,3,4,1,2,3,4,\n",
                      ":8: E: element 2: at most 4 nodes expected ('E,1,2,3,4,1,2,3,4,' found)"}});
}

TEST(AnsysComplaints, SystemsOfNodesAreThreeByNumber) {
  expect_complaints("a.cdb", {{kCdbTetrahedron + "CSYS,2\nN,5,1\nCSYS,1\nN,6,1\nCSYS,0\nN,7\n", ""},
                              {kCdbTetrahedron + "CSYS,3\nN,5,1\n",
                               ":9: N: a system CSYS of 0, 1 or 2 expected ('N,5,1' found)"},
                              {kCdbTetrahedron + "CSYS,-1\nN,5,1\n",
                               ":9: N: a system CSYS of 0, 1 or 2 expected ('N,5,1' found)"},
                              {kCdbTetrahedron + "CSYS,3\nN,R5.3,LOC,5,0,0,1,1,1\n", ""}});
}

TEST(AnsysGeneration, NodesAreChosenByFirstLastAndStep) {
  const std::string five = kCdbCorners + "N,5,0,0,5\n";
  const auto numbers = [&](const std::string& generate) {
    std::vector<std::int64_t> made;
    for (const auto& [number, point] : cdb_points_by_number(five + generate))
      if (number > 5) made.push_back(number);
    return made;
  };
  EXPECT_THAT(numbers("NGEN,2,10,4\n"), ElementsAre(14));
  EXPECT_THAT(numbers("NGEN,2,10,2,4\n"), ElementsAre(12, 13, 14));
  EXPECT_THAT(numbers("NGEN,2,10,1,5,2\n"), ElementsAre(11, 13, 15));
  EXPECT_THAT(numbers("NGEN,2,10,2,5,2\n"), ElementsAre(12, 14));
  EXPECT_THAT(numbers("NGEN,2,10,4,5,0\n"), ElementsAre(14, 15));
  EXPECT_THAT(numbers("NGEN,3,10,5\n"), ElementsAre(15, 25));
  EXPECT_THAT(numbers("NGEN,1,10,5\n"), ElementsAre());
  EXPECT_THAT(numbers("NGEN,,10,5\n"), ElementsAre());
  EXPECT_THAT(numbers("NGEN,2,10,ALL\n"), ElementsAre(11, 12, 13, 14, 15));
  const auto nodes = cdb_points_by_number(five + "N,5,1,2,3\nNGEN,3,10,5,,,.5,.25,-1,1\n");
  EXPECT_THAT(nodes.at(15), ElementsAre(1.5, 2.25, 2));
  EXPECT_THAT(nodes.at(25), ElementsAre(2, 2.5, 1));
}

TEST(AnsysGeneration, ElementsAreChosenByFirstLastAndStep) {
  const auto nodes = [](const std::string& generate) {
    std::vector<std::int64_t> first;
    const ForeignMesh mesh =
        cdb_mesh(kCdbCorners + "E,1,2,3,4\nE,11,2,3,4\nE,21,2,3,4\nE,31,2,3,\n" + generate);
    for (std::size_t cell = 4; cell < mesh.cell_count(); ++cell)
      first.push_back(mesh.cell_nodes[4 * cell]);
    EXPECT_EQ(mesh.cell_numbers.back(), static_cast<std::int64_t>(mesh.cell_count()));
    EXPECT_EQ(mesh.cell_nodes.back() == kLeftOutNode, first.empty() || first.back() % 100 > 30);
    return first;
  };
  EXPECT_THAT(nodes("EGEN,2,100,2\n"), ElementsAre(111));
  EXPECT_THAT(nodes("EGEN,2,100,1,4,2\n"), ElementsAre(101, 121));
  EXPECT_THAT(nodes("EGEN,3,100,2,3\n"), ElementsAre(111, 121, 211, 221));
  EXPECT_THAT(nodes("EGEN,2,100,-1\n"), ElementsAre(131));
  EXPECT_THAT(nodes("EGEN,2,100,-3\n"), ElementsAre(111, 121, 131));
  EXPECT_THAT(nodes("EGEN,2,,3\n"), ElementsAre(21));
  EXPECT_THAT(nodes("EGEN,1,100,ALL\n"), ElementsAre());
  // MINC, RINC, CINC and SINC number what is not read
  EXPECT_THAT(nodes("EGEN,2,100,2,2,1,7,0,7,7,7,0,0,0\n"), ElementsAre(111));
}

TEST(AnsysComplaints, WhatRepetitionsCannotDo) {
  expect_complaints(
      "a.cdb",
      {{kCdbTetrahedron + "NGEN,2,10,1,4,1,0,0,0,0\n", ""},
       {kCdbTetrahedron + "NGEN,2,10,1,4,1,0,0,0,1.0\n", ""},
       {kCdbTetrahedron + "NGEN,2,10,1,4,1,0,0,0,.5\n",
        ":8: NGEN: a SPACE of 1 expected ('NGEN,2,10,1,4,1,0,0,0,.5' found)"},
       {kCdbTetrahedron + "NGEN,2,,1\n", ":8: NGEN: an increment expected ('NGEN,2,,1' found)"},
       {kCdbTetrahedron + "NGEN,2,10\n", ":8: NGEN: a number expected ('NGEN,2,10' found)"},
       {kCdbTetrahedron + "NGEN,2,10,1,x\n", ":8: NGEN: a number expected ('NGEN,2,10,1,x' found)"},
       {kCdbTetrahedron + "NGEN,2,10,1,4,x\n",
        ":8: NGEN: a step expected ('NGEN,2,10,1,4,x' found)"},
       {kCdbTetrahedron + "EGEN,2,1,1,1,1,9,2\n",
        ":8: EGEN: a TINC of 0 expected ('EGEN,2,1,1,1,1,9,2' found)"},
       {kCdbTetrahedron + "EGEN,2,1,1,1,1,9,0,9,9,9,0,0,1\n",
        ":8: EGEN: a DX, DY and DZ of 0 expected ('EGEN,2,1,1,1,1,9,0,9,9,9,0,0,1' found)"},
       {kCdbTetrahedron + "NSEL,S\nNGEN,2,10,ALL\n",
        ":9: NGEN of numbers, not of what NSEL or ESEL chose, expected ('NGEN,2,10,ALL' found)"},
       {kCdbTetrahedron + "ESEL,S\nEGEN,2,0,ALL\n",
        ":9: EGEN of numbers, not of what NSEL or ESEL chose, expected ('EGEN,2,0,ALL' found)"},
       {kCdbTetrahedron + "NSEL,S\nNSEL,ALL\nNGEN,2,10,ALL\n", ""},
       {kCdbTetrahedron + "ESEL,S\nALLS\nNGEN,2,10,ALL\n", ""},
       {kCdbTetrahedron + "EGEN,2,0,9\n",
        ":8: EGEN of what is there by then expected ('EGEN,2,0,9' found)"}});
}

TEST(AnsysTypes, SolidsHaveTheirNodes) {
  const std::vector<std::pair<std::size_t, std::vector<int>>> rows{
      {4, {72, 285}},
      {8, {5, 30, 45, 46, 62, 64, 65, 69, 70, 73, 80, 96, 97, 107, 164, 185, 190, 278}},
      {10, {87, 92, 98, 119, 123, 148, 168, 187, 217, 221, 227, 232, 237, 240, 291}},
      {20,
       {89, 90, 95, 117, 122, 147, 186, 191, 215, 216, 220, 225, 226, 231, 236, 238, 239, 279}}};
  const std::map<std::size_t, CellKind> kinds{{4, CellKind::tetrahedron4},
                                              {8, CellKind::brick8},
                                              {10, CellKind::tetrahedron10},
                                              {20, CellKind::brick20}};
  for (const auto& [own, routines] : rows)
    for (const int routine : routines) {
      EXPECT_EQ(ansys::library_nodes(routine, 0), own) << routine;
      for (const auto& [nodes, kind] : kinds) {
        const ForeignType type = ansys::element_type(routine, nodes, 0);
        const bool linear = (own == 20 && nodes == 8) || (own == 10 && nodes == 4);
        const bool fits = own == nodes || linear;
        EXPECT_EQ(type.conversion.fate, fits ? CellFate::converted : CellFate::unsupported)
            << routine << " " << nodes;
        EXPECT_EQ(type.conversion.kind, fits ? kind : CellKind{}) << routine << " " << nodes;
        EXPECT_EQ(type.name, fmt::format("type{}", routine));
        EXPECT_EQ(type.nodes, nodes);
      }
    }
}

TEST(AnsysTypes, ShapesOfMesh200AndWhatIsFlat) {
  const std::vector<std::size_t> nodes{0, 0, 0, 0, 0, 0, 0, 0, 4, 10, 8, 20};
  for (std::size_t shape = 0; shape < nodes.size(); ++shape)
    EXPECT_EQ(ansys::library_nodes(200, static_cast<std::int64_t>(shape)), nodes[shape]) << shape;
  EXPECT_EQ(ansys::library_nodes(200, -1), 0U);
  EXPECT_EQ(ansys::library_nodes(200, 12), 0U);
  for (const int flat : {53,  77,  78,  82,  83,  91,  93,  99,  113, 121, 132, 146, 150, 152, 154,
                         156, 157, 170, 172, 174, 183, 188, 189, 200, 213, 223, 230, 233, 281, 290})
    EXPECT_EQ(ansys::element_type(flat, 8, 0).conversion.fate, CellFate::no_volume) << flat;
  // an unknown type of eight nodes may be a solid, one of seven is not
  EXPECT_EQ(ansys::element_type(999, 8, 0).conversion.fate, CellFate::unsupported);
  EXPECT_EQ(ansys::element_type(999, 7, 0).conversion.fate, CellFate::no_volume);
}

}  // namespace
}  // namespace hiac::formats
