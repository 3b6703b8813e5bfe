// The blocks of Ansys archives: formats and columns, what they are refused for, with the line, and
// what is just allowed; components, and the types of elements that keys choose.
#include <fmt/format.h>

#include "formats/ansys/cdb_file.hpp"
#include "formats/common/io/input_text.hpp"
#include "tests/formats/complaints.hpp"
#include "tests/formats/unit_tetrahedron.hpp"

namespace hiac::formats {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Fields of eight columns.
std::string eights(const std::vector<std::int64_t>& numbers) {
  std::string text;
  for (const std::int64_t number : numbers) text += fmt::format("{:8}", number);
  return text;
}

const std::string kCdbFourNodes =
    "NBLOCK,3\n(1i8,3e8.1)\n       1\n       2 1.0E+00\n       3     0.0     1.0\n"
    "       4     0.0     0.0     1.0\n-1\n";

/// An element of the first type with that number.
std::string cdb_element(std::int64_t number, const std::vector<std::int64_t>& nodes) {
  return eights({1, 1, 1, 1, 0, 0, 0, 0, static_cast<std::int64_t>(nodes.size()), 0, number}) +
         eights(nodes) + "\n";
}

const std::string kCdbSolids = "EBLOCK,19,SOLID\n(19i8)\n";
const std::string kCdbBlocks =
    "/PREP7\nET,1,285\n" + kCdbFourNodes + kCdbSolids + cdb_element(9, {1, 2, 3, 4}) + "-1\n";

ForeignMesh cdb_blocks(const std::string& text) {
  const ScratchFolder folder;
  return ansys::read_cdb(InputText(folder.write("a.cdb", text)));
}

TEST(AnsysBlocks, FormatsTellNumbersAndWidths) {
  const auto nodes = [](const std::string& format) {
    return "/PREP7\nNBLOCK,3\n" + format + "\n-1\n" + kCdbBlocks;
  };
  const auto refused = [&](const std::string& format) {
    return Complaint{
        nodes(format),
        fmt::format(":3: a format like (3i9,6e21.13e3) or (19i9) expected ('{}' found)", format)};
  };
  const std::string reals = ":2: NBLOCK: a format with reals, like (3i9,6e21.13e3), expected";
  expect_complaints("a.cdb", {{nodes("(3i9,6e21.13e3)"), ""},
                              {nodes("  (1I9,6E21.13E3) "), ""},
                              {nodes("(3i9,e21.13)"), ""},
                              {nodes("(3i9)"), reals},
                              {nodes("(3i9,6f21.13)"), reals},
                              {nodes("(3i9,6e)"), reals},
                              refused("3i9,6e21.13"),
                              refused("(i9,6e21.13)"),
                              refused("(3i,6e21.13)"),
                              refused("(3x9,6e21.13)"),
                              refused("(0i9,6e21.13)"),
                              refused("("),
                              refused("()")});
}

TEST(AnsysBlocks, EndWithALine) {
  const std::string head = "/PREP7\nET,1,285\n" + kCdbFourNodes;
  for (const std::string end : {"-1\n", " -1 \n", "-1,\n", "N,R5.3,LOC,-1,\n", "  n,r5.3,loc,-1\n"})
    expect_unit_tetrahedron(
        read_any(ScratchFolder().write("a.cdb", "/PREP7\nET,1,285\nNBLOCK,3\n(1i8,3e8.1)\n" + end +
                                                    kCdbBlocks.substr(7)))
            .mesh);
  const std::string ends = ": the file ends within ";
  expect_complaints(
      "a.cdb",
      {{kCdbBlocks, ""},
       {kCdbBlocks.substr(0, kCdbBlocks.size() - 3), ":13" + ends + "EBLOCK (a line -1 expected)"},
       {head.substr(0, head.size() - 3), ":9" + ends + "NBLOCK (a line -1 expected)"},
       {head + "EBLOCK,19\n(19i8)\nx\n", ":13" + ends + "EBLOCK (a line -1 expected)"},
       {head + "ETBLOCK,1\n(2i9)\n", ":12" + ends + "ETBLOCK (a line -1 expected)"},
       {kCdbBlocks + "CMBLOCK,A,ELEM,2\n(1i8)\n       9\n", ":17" + ends + "CMBLOCK"},
       {head, ":10: the file ends too early (EBLOCK,19,SOLID or E or EN expected)"},
       {"/PREP7\nET,1,285\n" + kCdbSolids + "-1\n",
        ":6: the file ends too early (NBLOCK or N expected)"}});
}

TEST(AnsysBlocks, NumbersStandInTheirColumns) {
  const auto node = [](const std::string& line) {
    return "/PREP7\nNBLOCK,3\n(3i8,6e8.1)\n" + line + "\n-1\n" + kCdbBlocks;
  };
  const std::string number = "       8       0       0";
  expect_complaints(
      "a.cdb",
      {{node(number), ""},
       {node("       8"), ""},
       {node(number + "     1.0             2.0"), ""},
       {node(number + "     1.0     2.0     3.0       x"), ""},
       {node("      8.       0       0"),
        ":4: an integer in columns 1 to 8 expected ('      8.' found)"},
       {node("               0"), ":4: an integer in columns 1 to 8 expected (the line ends)"},
       {node(""), ":4: an integer in columns 1 to 8 expected (the line ends)"},
       {node(number + "     1.x"),
        ":4: a coordinate in columns 25 to 32 expected ('     1.x' found)"},
       {node(number + "     1.0     2.0     y"),
        ":4: a coordinate in columns 41 to 48 expected ('     y' found)"}});
  const ForeignMesh mesh = cdb_blocks(
      node(number + " 1.5E+00        -2.0E-01\n       7       0       0     2.0     3.0"));
  ASSERT_EQ(mesh.node_numbers.size(), 6U);
  EXPECT_THAT(std::vector(mesh.xyz.begin(), mesh.xyz.begin() + 6),
              ElementsAre(1.5, 0, -0.2, 2, 3, 0));
}

TEST(AnsysBlocks, ElementsHaveAHeadOfElevenNumbersAndGoOnInFurtherLines) {
  const std::string head = "/PREP7\nET,1,285\n" + kCdbFourNodes;
  const auto elements = [&](const std::string& lines) {
    return head + kCdbSolids + lines + kCdbBlocks.substr(kCdbBlocks.find("-1\n"));
  };
  const auto count = [&](int nodes) {
    return head + kCdbSolids + eights({1, 9, 1, 1, 0, 0, 0, 0, nodes, 0, 9}) +
           eights({1, 2, 3, 4, 1, 2, 3, 4}) + "\n" + eights(std::vector<std::int64_t>(19, 1)) +
           "\n" + eights(std::vector<std::int64_t>(19, 1)) + "\n" +
           eights(std::vector<std::int64_t>(18, 2)) + "\n-1\n" + "E,1,2,3,4\n";
  };
  const std::string impossible =
      ":12: an element's number of nodes: impossible (1 to 64 expected, ";
  expect_complaints(
      "a.cdb", {{head + "EBLOCK,19,SOLID\n(11i8)\n-1\n",
                 ":10: EBLOCK: a format of more than 11 integers expected (11 found)"},
                {head + "EBLOCK,19,SOLID\n(12i8)\n" + eights({1, 1, 1, 1, 0, 0, 0, 0, 4, 0, 9, 1}) +
                     "\n" + eights({2, 3, 4}) + "\n-1\n",
                 ""},
                {count(0), impossible + "0 found)"},
                {count(65), impossible + "65 found)"},
                {elements(eights({1, 1, 1, 1, 0, 0, 0, 0, 4, 0, 9, 1, 2, 3}) + "\n"),
                 ":12: an integer in columns 113 to 120 expected (the line ends)"},
                {elements(eights({1}) + "       x" + eights({1, 1, 0, 0, 0, 0, 1, 0, 9, 1}) + "\n"),
                 ":12: an integer in columns 9 to 16 expected ('       x' found)"}});
  const ForeignMesh most = cdb_blocks(count(64));
  ASSERT_EQ(most.cell_count(), 2U);
  ASSERT_EQ(most.types[most.cell_types[0]].nodes, 64U);
  EXPECT_EQ(most.cell_nodes[7], 4);
  EXPECT_EQ(most.cell_nodes[45], 1);
  EXPECT_EQ(most.cell_nodes[46], 2);
  // the first line of twelve has one node, the next has twelve; 0 is none
  const ForeignMesh mesh = cdb_blocks(head + "ET,1,186\nEBLOCK,19,SOLID\n(12i8)\n" +
                                      eights({1, 1, 1, 1, 0, 0, 0, 0, 20, 0, 7, 1}) + "\n" +
                                      eights({2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13}) + "\n" +
                                      eights({14, 15, 16, 17, 0, 19, 20}) + "\n-1\n");
  ASSERT_EQ(mesh.cell_nodes.size(), 20U);
  for (std::size_t n = 0; n < 20; ++n)
    EXPECT_EQ(mesh.cell_nodes[n], n == 17 ? kLeftOutNode : static_cast<std::int64_t>(n) + 1);
  EXPECT_THAT(mesh.cell_numbers, ElementsAre(7));
}

TEST(AnsysBlocks, OfOtherElementsAreLeftOut) {
  const ForeignMesh mesh = cdb_blocks(kCdbBlocks + "EBLOCK,10,,1\n(15i8)\nx\ny\nz\n-1\n");
  EXPECT_EQ(mesh.cell_count(), 1U);
  EXPECT_THAT(mesh.notes, ElementsAre("left out an EBLOCK that is not of solids (4 lines)"));
}

TEST(AnsysBlocks, ComponentsOfElementsAreBlocks) {
  std::string text = "/PREP7\nET,1,285\n" + kCdbFourNodes + kCdbSolids;
  for (const int number : {10, 11, 12, 13, 20, 21}) text += cdb_element(number, {1, 2, 3, 4});
  text += "-1\n";
  const auto cells = [&](const std::string& component) {
    const ForeignMesh mesh = cdb_blocks(text + component);
    std::vector<std::size_t> all;
    for (const ForeignBlock& block : mesh.blocks)
      for (const IndexRange& range : block.cells) {
        all.push_back(range.begin);
        all.push_back(range.end);
      }
    return all;
  };
  const std::string head = "CMBLOCK,A,ELEM,";
  EXPECT_THAT(cells(head + "3\n(8i8)\n" + eights({10, 12, 13}) + "\n"), ElementsAre(0, 1, 2, 4));
  // a range from the number before it, on the next line; numbers between that there are not
  EXPECT_THAT(
      cells(head + "4 ! items\n(3i8)\n" + eights({10, 12, 99}) + "\n" + eights({-20}) + "\n"),
      ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(cells("cmblock,A,elements,2\n(2i8)\n" + eights({11, -20}) + "\n"), ElementsAre(1, 5));
  EXPECT_THAT(cells(head + "3\n(8i8)\n" + eights({-12, 20, -21}) + "\n"), ElementsAre(4, 6));
  EXPECT_THAT(cells(head + "2\n(8i8)\n" + eights({12, -12}) + "\n"), ElementsAre(2, 3));
  EXPECT_THAT(cells(head + "0\n(8i8)\n"), IsEmpty());
  EXPECT_THAT(cdb_blocks(text + "CMBLOCK,N,NODE,1\n(8i8)\n" + eights({1}) + "\n").blocks,
              IsEmpty());
  EXPECT_EQ(cdb_blocks(text + head + "0\n(8i8)\n").blocks.at(0).name, "A");
  expect_complaints(
      "a.cdb",
      {{text + head + "x\n(8i8)\n", ":19: CMBLOCK: a number of items expected ('x' found)"},
       {text + head + "-1\n(8i8)\n", ":19: CMBLOCK: a number of items expected ('-1' found)"},
       {text + head + "2\n(8i8)\n      10\n",
        ":21: an integer in columns 9 to 16 expected (the line ends)"}});
}

// MESH200 is a solid where its first key says so; a type that is not named is its own routine.
TEST(AnsysBlocks, TypesAreNamedByCommandsAndBlocks) {
  const auto fate = [](const std::string& types, const std::string& more = {}) {
    const ForeignMesh mesh = cdb_blocks("/PREP7\n" + types + kCdbFourNodes + more + kCdbSolids +
                                        cdb_element(9, {1, 2, 3, 4}) + "-1\n");
    return mesh.types.at(0).name +
           (mesh.types[0].conversion.fate == CellFate::converted ? " solid" : "");
  };
  EXPECT_EQ(fate("ET,1,285\n"), "type285 solid");
  EXPECT_EQ(fate("et,1,SOLID285 ! c\n"), "type285 solid");
  EXPECT_EQ(fate("ET,1,SOLID285$ET,2,7\n"), "type285 solid");
  EXPECT_EQ(fate("ET,2,285\n"), "type1");
  EXPECT_EQ(fate("ET,1,200\n"), "type200");
  EXPECT_EQ(fate("ET,1,200,8\n"), "type200 solid");
  EXPECT_EQ(fate("ET,1,200,8\nKEYO,1,1,4\n"), "type200");
  EXPECT_EQ(fate("ET,1,200\nKEYOPT,1,1,8\n"), "type200 solid");
  EXPECT_EQ(fate("ET,1,200\nKEYOPT,1,2,8\n"), "type200");
  EXPECT_EQ(fate("ET,1,200\nKEYOPT,2,1,8\n"), "type200");
  EXPECT_EQ(fate("ET,1,200\nKEYOPT,1,1,x\n"), "type200");
  EXPECT_EQ(
      fate("ETBLOCK,2,2\n(3i8)\n" + eights({2, 5, 0}) + "\n" + eights({1, 200, 8}) + "\n-1\n"),
      "type200 solid");
  EXPECT_EQ(fate("ETBLOCK,1,1\n(2i8)\n" + eights({1, 285}) + "\n-1\n"), "type285 solid");
  // beside blocks, a parameter may stand for a number
  EXPECT_EQ(fate("ET,1,285\n", "ET,_t,1\n"), "type285 solid");
  const std::string expected = ": ET: a number and an element type expected ('ET,";
  expect_complaints(
      "a.cdb",
      {{"/PREP7\nET,_t,285\n" + kCdbBlocks.substr(7), ":2" + expected + "_t,285' found)"},
       {"/PREP7\nET,1\n" + kCdbBlocks.substr(7), ":2" + expected + "1' found)"},
       {"/PREP7\nET,1,SOLID\n" + kCdbBlocks.substr(7), ":2" + expected + "1,SOLID' found)"},
       {kCdbBlocks + "ET,1,SOLID\n", ":14" + expected + "1,SOLID' found)"},
       {"/PREP7\nETBLOCK,1\n(2i8)\n       1\n-1\n",
        ":4: an integer in columns 9 to 16 expected (the line ends)"}});
}

}  // namespace
}  // namespace hiac::formats
