// What Abaqus decks are refused for, with the line, and what is just allowed; sets and types of
// elements as their decks write them.
#include <cmath>

#include <fmt/format.h>

#include "formats/abaqus/inp_elements.hpp"
#include "formats/abaqus/inp_parser.hpp"
#include "tests/formats/complaints.hpp"
#include "tests/formats/unit_tetrahedron.hpp"

namespace hiac::formats {
namespace {

using abaqus::NumberRange;
using testing::ElementsAre;
using testing::EndsWith;
using testing::StartsWith;

const std::string kInpCorners = "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n";
const std::string kInpTetrahedra = kInpCorners + "*ELEMENT,TYPE=C3D4\n";

abaqus::Model inp_model(const std::string& text) {
  const ScratchFolder folder;
  return abaqus::parse_deck(folder.write("a.inp", text));
}

TEST(AbaqusComplaints, KeywordsNeedTheirParameters) {
  expect_complaints(
      "a.inp",
      {{kInpCorners + "*ELEMENT\n1,1,2,3,4\n", ":6: *ELEMENT without TYPE"},
       {kInpCorners + "*ELEMENT, TYPE=\n1,1,2,3,4\n", ":6: *ELEMENT without TYPE"},
       {"*HEADING\n*PART\n", ":2: *PART without NAME"},
       {"*HEADING\n\n*INSTANCE, PART=P\n", ":3: *INSTANCE without NAME"},
       {"*ELSET, GENERATE\n1,2\n", ":1: *ELSET without ELSET"},
       {"*NCOPY, SHIFT, CHANGE NUMBER=1\n1,2,3\n", ":1: *NCOPY without OLDSET"},
       {"*NCOPY, REFLECT, CHANGE NUMBER=1, OLD SET=A\n1,2,3\n", ":1: *NCOPY without REFLECT"},
       {"*NCOPY, OLD SET=A, REFLECT=TREE,\n CHANGE NUMBER=1\n1,2,3\n",
        ":1: *NCOPY: REFLECT=POINT, LINE or MIRROR expected ('*NCOPY, OLD SET=A, REFLECT=TREE,' "
        "found)"}});
}

TEST(AbaqusComplaints, NumbersMadeOfOthersHaveNineDigits) {
  const std::string nodes = "*NODE,NSET=A\n1,0,0,0\n5,4,0,0\n*ELEMENT,TYPE=MASS,ELSET=E\n7,1\n";
  expect_complaints(
      "a.inp",
      {{kInpTetrahedra + "1,1,2,3,4\n*NGEN\n1.0,4,-3.\n", ""},
       {nodes + "*NGEN\n1,5.5\n", ":7: *NGEN: a node number expected ('1,5.5' found)"},
       {nodes + "*NGEN\n1,5,x\n", ":7: *NGEN: an increment expected ('1,5,x' found)"},
       {nodes + "*NGEN\n,5\n", ":7: *NGEN: a node number expected (',5' found)"},
       {nodes + "*NGEN\n1,1000000000\n",
        ":7: *NGEN: a node number expected ('1,1000000000' found)"},
       {nodes + "*NGEN\n1,999999999\n",
        ":7: *NGEN: a node 999999999 before it expected ('1,999999999' found)"},
       {nodes + "*NFILL\nA,A,x,1\n",
        ":7: *NFILL: a number of intervals expected ('A,A,x,1' found)"},
       {nodes + "*ELCOPY, OLD SET=E, SHIFT NODES=1\n", ":6: *ELCOPY without ELEMENTSHIFT"},
       {nodes + "*ELCOPY, OLD SET=E, ELEMENT SHIFT=1\n", ":6: *ELCOPY without SHIFTNODES"},
       {nodes + "*ELCOPY, ELEMENT SHIFT=1, SHIFT NODES=1\n", ":6: *ELCOPY without OLDSET"},
       {nodes + "*ELCOPY, ELEMENT SHIFT=x, SHIFT NODES=1\n",
        ":6: *ELCOPY, ELEMENTSHIFT: a whole number expected ('*ELCOPY, ELEMENT SHIFT=x, SHIFT "
        "NODES=1' found)"}});
  const abaqus::Model made = inp_model(nodes + "*NGEN\n1.0,5.,2.\n");
  EXPECT_THAT(made.root.node_numbers, testing::UnorderedElementsAre(1, 3, 5));
}

TEST(AbaqusComplaints, IncrementsMayBeLeftOutZeroOrNegative) {
  for (const std::string line : {"1,5", "1,5,", "1,5,1", "1,5,0", "1,5,-1"}) {
    const abaqus::Model model = inp_model("*NODE\n1,0,0,0\n5,4,8,12\n*NGEN\n" + line + "\n");
    ASSERT_EQ(model.root.node_numbers.size(), 5U) << line;
    for (std::size_t n = 0; n < 5; ++n) {
      const auto number = model.root.node_numbers[n];
      EXPECT_EQ(model.root.xyz[3 * n + 1], 2.0 * static_cast<double>(number - 1)) << line;
    }
  }
}

TEST(AbaqusComplaints, ElementsHaveAsManyNodesAsTheirTypes) {
  expect_complaints(
      "a.inp",
      {{kInpTetrahedra + "1,1,2,3,4\n", ""},
       {kInpTetrahedra + "1,1,2,3,4,\n", ""},
       {kInpTetrahedra + "1,1,2\n** c\n\n3,4\n*STEP\n", ""},
       {kInpTetrahedra + "1,1,2,3,4,5\n", ":7: element 1: 4 nodes expected ('1,1,2,3,4,5' found)"},
       {kInpTetrahedra + "1,1,2,3,4,,\n", ":7: element 1: 4 nodes expected ('1,1,2,3,4,,' found)"},
       {kInpTetrahedra + "21,1,2,\n3,4,1\n", ":8: element 21: 4 nodes expected ('3,4,1' found)"},
       {kInpTetrahedra + "21,1,2,3\n", ":8: element 21: 4 nodes expected (3 found)"},
       {kInpTetrahedra + "21\n*STEP\n", ":8: element 21: 4 nodes expected (0 found)"},
       {kInpTetrahedra + "1,1,2,x,4\n", ":7: a node number expected ('1,1,2,x,4' found)"},
       {kInpTetrahedra + "x,1,2,3,4\n", ":7: an element number expected ('x,1,2,3,4' found)"},
       {"*NODE\n1.5,0,0,0\n", ":2: a node number expected ('1.5,0,0,0' found)"}});
}

// A brick of 27 nodes may leave out nodes in its faces: its record has no fixed length.
TEST(AbaqusComplaints, RecordsWithoutAFixedLengthHaveTheCornersAtLeast) {
  const std::string nodes =
      "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n9,9,9,9\n";
  const ScratchFolder folder;
  ReadOptions corners;
  corners.corners_of_unsupported = true;
  const auto read = [&](const std::string& element) {
    return folder.write("a.inp", nodes + "*ELEMENT,TYPE=C3D27\n" + element);
  };
  const std::string further = "1,1,2,3,4,5,6,\n7,8,9,9,9,\n9,9\n2,1,2,3,4,5,6,7,8\n";
  for (const std::string element :
       {"1,1,2,3,4,5,6,7,8\n", "1,1,2,3,4,5,6,7,8,9,\n9\n", "1,1,2,3,4,5,6,\n7,8,\n"}) {
    const ZooMesh mesh = read_any(read(element), corners).mesh;
    ASSERT_EQ(mesh.cell_count(), 1U) << element;
    EXPECT_EQ(mesh.kinds[0], CellKind::brick8);
    EXPECT_EQ(mesh.node_count(), 8U);
    EXPECT_THAT(mesh.position(mesh.nodes[6]), ElementsAre(1, 1, 1));
  }
  EXPECT_EQ(read_any(read(further), corners).mesh.cell_count(), 2U);
  EXPECT_THAT(refusal(read("5,1,2,3,4,5,6,7\n"), corners),
              EndsWith("a.inp:12: element 5: at least 8 nodes expected ('5,1,2,3,4,5,6,7' found)"));
  EXPECT_THAT(refusal(read("5,1,2,3,4,5,6,\n7,\n*STEP\n"), corners),
              EndsWith("a.inp:13: element 5: at least 8 nodes expected ('7,' found)"));
}

TEST(AbaqusComplaints, FilesIncludeFilesTenDeep) {
  const ScratchFolder folder;
  for (int file = 0; file < 9; ++file)
    static_cast<void>(folder.write(fmt::format("f{}.inp", file),
                                   fmt::format("*HEADING\n*INCLUDE, INPUT=f{}.inp\n", file + 1)));
  const std::string tetrahedron = kInpTetrahedra + "1,1,2,3,4\n";
  static_cast<void>(folder.write("f9.inp", tetrahedron));
  expect_unit_tetrahedron(read_any(folder.file("f0.inp")).mesh);
  static_cast<void>(folder.write("f9.inp", "*INCLUDE, INPUT=f10.inp\n"));
  static_cast<void>(folder.write("f10.inp", tetrahedron));
  EXPECT_EQ(read_any(folder.file("f1.inp")).mesh.cell_count(), 1U);
  const std::string message = refusal(folder.file("f0.inp"));
  EXPECT_THAT(message, StartsWith(folder.file("f0.inp") + ":2: in the included file: "));
  EXPECT_THAT(message, EndsWith(folder.file("f9.inp") +
                                ":1: in the included file: " + folder.file("f10.inp") +
                                ": files include files more than 10 deep"));
  // files side by side are not nested
  std::string many = kInpTetrahedra + "1,1,2,3,4\n";
  for (int i = 0; i < 12; ++i) many += "*INCLUDE, INPUT=f10.inp\n";
  EXPECT_EQ(read_any(folder.write("many.inp", many)).mesh.cell_count(), 13U);
}

TEST(AbaqusComplaints, RangesOfSetsRise) {
  const auto range = [](const std::string& line) {
    return inp_model("*ELSET, ELSET=a, GENERATE\n" + line + "\n").root.sets.at("A").ranges;
  };
  EXPECT_THAT(range("5,5"), ElementsAre(NumberRange{5, 5, 1}));
  EXPECT_THAT(range("0,7,3"), ElementsAre(NumberRange{0, 7, 3}));
  EXPECT_THAT(range("1,3,\n7,9,2"), ElementsAre(NumberRange{1, 3, 1}, NumberRange{7, 9, 2}));
  const auto refused = [](const std::string& line) {
    return Complaint{"*ELSET, ELSET=A, GENERATE\n1,2\n" + line + "\n",
                     ":3: first, last and step of a range expected ('" + line + "' found)"};
  };
  expect_complaints("a.inp", {refused("5,4"), refused("-1,5"), refused("1,5,0"), refused("1,5,-1"),
                              refused("1"), refused("x,5"), refused("1,x"), refused("1,5,x")});
}

TEST(AbaqusComplaints, NodeSetsThatAreNoRangesAreToldWhereTheyAreUsed) {
  expect_complaints(
      "a.inp",
      {{kInpCorners + "*NSET, NSET=A, GENERATE\n5,4\n*NFILL\nA,A,2,1\n",
        ":9: *NFILL: of the node set 'A' nodes that are listed, not '5,4', expected ('A,A,2,1' "
        "found)"},
       {kInpCorners + "*NSET, NSET=A\n1,B,3\n*NFILL\nA,A,2,1\n",
        ":9: *NFILL: of the node set 'A' nodes that are listed, not 'B', expected ('A,A,2,1' "
        "found)"}});
}

TEST(AbaqusSets, NumbersInARowAreOneRange) {
  const auto ranges = [](const std::string& lines) {
    return inp_model("*ELSET, ELSET=A\n" + lines).root.sets.at("A").ranges;
  };
  EXPECT_THAT(ranges("1,2,3,\n4, 6,7\n"), ElementsAre(NumberRange{1, 4, 1}, NumberRange{6, 7, 1}));
  EXPECT_THAT(ranges("9,8,8\n"),
              ElementsAre(NumberRange{9, 9, 1}, NumberRange{8, 8, 1}, NumberRange{8, 8, 1}));
  // the names of node sets and surfaces are no members; a set's name is, once
  const abaqus::Model model =
      inp_model("*ELSET, ELSET=B\n3,4\n*ELSET, ELSET=A\n1,b,S1,B,9\n*ELSET, ELSET=b\n7\n");
  EXPECT_THAT(model.root.sets.at("A").ranges,
              ElementsAre(NumberRange{1, 1, 1}, NumberRange{3, 4, 1}, NumberRange{9, 9, 1}));
  EXPECT_THAT(model.root.sets.at("B").ranges,
              ElementsAre(NumberRange{3, 4, 1}, NumberRange{7, 7, 1}));
  EXPECT_EQ(model.root.sets.at("B").name, "B");
}

TEST(AbaqusSets, NamesHaveQuotesAndFlagsAreShortened) {
  const abaqus::Model quoted =
      inp_model("*Elset, elset = \"the core\" , \n** c\n  Gen\n1,5\n*ELSET,ELSET=Q,GE\n1,5\n");
  EXPECT_EQ(quoted.root.sets.at("THE CORE").name, "the core");
  EXPECT_THAT(quoted.root.sets.at("THE CORE").ranges, ElementsAre(NumberRange{1, 5, 1}));
  // two letters are no abbreviation
  EXPECT_THAT(quoted.root.sets.at("Q").ranges,
              ElementsAre(NumberRange{1, 1, 1}, NumberRange{5, 5, 1}));
  // *ELEMENT and *NODE make sets, too
  const abaqus::Model made =
      inp_model("*NODE,NSET=N\n1,0,0,0\n2,1,0,0\n*ELEMENT,TYPE=MASS,ELSET=E\n7,1\n8,2\n");
  EXPECT_THAT(made.root.node_sets.at("N").ranges, ElementsAre(NumberRange{1, 2, 1}));
  EXPECT_THAT(made.root.sets.at("E").ranges, ElementsAre(NumberRange{7, 8, 1}));
}

// A range may be longer than the mesh or shorter; both are those of its numbers that there are.
TEST(AbaqusSets, RangesAreTheNumbersThatThereAre) {
  for (const std::string range : {"2,4,2", "2,5,2", "0,4000,2", "2,900000000,2", "2,4,1\n"}) {
    const abaqus::Model model = inp_model(kInpCorners + "*NSET, NSET=A, GENERATE\n" + range +
                                          "\n*NCOPY, CHANGE NUMBER=100, OLD SET=A, SHIFT\n0,0,5\n");
    const bool three = range.starts_with("2,4,1");
    ASSERT_EQ(model.root.node_numbers.size(), three ? 7U : 6U) << range;
    EXPECT_EQ(model.root.node_numbers[4], 102) << range;
    EXPECT_EQ(model.root.node_numbers.back(), 104) << range;
    EXPECT_EQ(model.root.xyz[3 * 4], 1);
    EXPECT_EQ(model.root.xyz.back(), 6);
  }
}

TEST(AbaqusSystems, NodesInSphericalCoordinates) {
  const abaqus::Model model = inp_model("*NODE, SYSTEM=s\n1,2,90,30\n2,2,0,-90\n3,2,180\n");
  const std::vector<double> expected{0, std::sqrt(3.0), 1, 0, 0, -2, -2, 0, 0};
  ASSERT_EQ(model.root.xyz.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(model.root.xyz[i], expected[i], 1e-15) << i;
}

// Abaqus Elements Guide: the letters tell the family, the number behind them the nodes.
TEST(AbaqusTypes, SolidsOfEveryFamily) {
  const std::vector<std::pair<std::string, CellKind>> kinds{
      {"4", CellKind::tetrahedron4}, {"5", CellKind::pyramid5},       {"6", CellKind::prism6},
      {"8", CellKind::brick8},       {"10", CellKind::tetrahedron10}, {"15", CellKind::prism15},
      {"20", CellKind::brick20}};
  for (const std::string family :
       {"C3D", "DC3D", "DCC3D", "AC3D", "Q3D", "EC3D", "EMC3D", "FC3D", "F3D", "PC3D", "SC", "CSS"})
    for (const auto& [nodes, kind] : kinds)
      for (const std::string suffix : {"", "R", "IH"}) {
        const abaqus::InpElement element = abaqus::inp_element(family + nodes + suffix);
        EXPECT_EQ(element.type.conversion.fate, CellFate::converted) << family << nodes;
        EXPECT_EQ(element.type.conversion.kind, kind) << family << nodes;
        EXPECT_EQ(element.type.nodes, node_count(kind)) << family << nodes;
        EXPECT_EQ(element.nodes_in_file, node_count(kind)) << family << nodes;
        EXPECT_EQ(element.type.name, family + nodes + suffix);
      }
}

TEST(AbaqusTypes, OthersHaveNoVolumeOrAreNotSupported) {
  for (const std::string flat : {"S4R", "M3D4", "B31", "T3D2", "R3D4", "MASS", "CPS4", "SPRINGA",
                                 "C3D", "SC", "C3D100", "C3DX8", "XC3D8"}) {
    const abaqus::InpElement element = abaqus::inp_element(flat);
    EXPECT_EQ(element.type.conversion.fate, CellFate::no_volume) << flat;
    EXPECT_EQ(element.type.nodes, 0U) << flat;
    EXPECT_EQ(element.nodes_in_file, 0U) << flat;
  }
  // a shape is known of those whose corners can be read
  for (const auto& [name, corners] :
       std::vector<std::pair<std::string, std::size_t>>{{"C3D15V", 6},
                                                        {"C3D15VH", 6},
                                                        {"C3D27", 8},
                                                        {"C3D27RH", 8},
                                                        {"C3D7", 0},
                                                        {"C3D16", 0}}) {
    const abaqus::InpElement element = abaqus::inp_element(name);
    EXPECT_EQ(element.type.conversion.fate, CellFate::unsupported) << name;
    EXPECT_EQ(element.type.nodes, corners) << name;
    EXPECT_EQ(element.nodes_in_file, 0U) << name;
  }
}

}  // namespace
}  // namespace hiac::formats
