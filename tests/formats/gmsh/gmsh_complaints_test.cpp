// What MSH files are refused for, with the place, and what is just allowed.
#include <cstdint>

#include <fmt/format.h>

#include "hiac/mesh/shape_functions.hpp"
#include "tests/formats/complaints.hpp"
#include "tests/formats/raw_bytes.hpp"
#include "tests/formats/unit_tetrahedron.hpp"

namespace hiac::formats {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string kMsh2Head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
const std::string kMsh2Nodes = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n";
const std::string kMsh2Cells = "$Elements\n1\n9 4 2 1 1 1 2 3 4\n$EndElements\n";
const std::string kMsh2 = kMsh2Head + kMsh2Nodes + kMsh2Cells;

TEST(GmshComplaints, FormatsHaveAVersionAnEncodingAndASize) {
  const auto format = [](const std::string& line) {
    return "$MeshFormat\n" + line + "\n$EndMeshFormat\n" + kMsh2Nodes + kMsh2Cells;
  };
  const auto version = [&](const std::string& number) {
    return Complaint{format(number + " 0 8"),
                     ":2: version " + number +
                         " of the format is not known (1, 2 to 2.2, 3, 4 or 4.1 expected)"};
  };
  const std::string expected = ":2: '0 8' or '1 8' expected behind the version (";
  expect_complaints(
      "a.msh",
      {{format("2 0 8"), ""},
       {format("2.2 0 8"), ""},
       {format("2.25 0 8"), ""},
       version("1.9"),
       version("2.3"),
       version("3.1"),
       version("4.2"),
       version("4.05"),
       version("1"),
       {format("2.2 2 8"), expected + "'2 8' found)"},
       {format("2.2 -1 8"), expected + "'-1 8' found)"},
       {format("2.2 0 4"), expected + "'0 4' found)"},
       {"$Comments\nx\n$EndComments\n", ":4: no section found ('$MeshFormat' expected)"},
       {"$Comments\nx\n$EndComments\n$Nodes\n",
        ":4: '$MeshFormat' or '$NOD' expected ('Nodes' found)"},
       {"$Comments\nx\n$EndComments\n$Comments\n$Nodes\n$EndComments\n" + kMsh2, ""},
       {"$MeshFormat\n2.2 0 8\n$EndMesh\n", ":3: '$EndMeshFormat' expected ('$EndMesh' found)"}});
}

TEST(GmshComplaints, BinaryFilesTellTheirByteOrder) {
  const std::string head = "$MeshFormat\n2.2 1 8\n";
  const auto order = [&](std::uint32_t one) {
    return head + raw_bytes<std::uint32_t>({one}) + "\n$EndMeshFormat\n";
  };
  const std::string message = ":3: the number one that tells the byte order expected";
  expect_complaints("a.msh", {{order(1), ": the file ends too early ($Nodes expected)"},
                              {order(0x01000000), ": the file ends too early ($Nodes expected)"},
                              {order(2), message},
                              {order(0x00010000), message},
                              {order(0), message}});
  // behind the head, binary errors name the byte
  const std::string nodes = "$Nodes\n1\n" + raw_bytes<std::int32_t>({1}) +
                            raw_bytes<double>({0, 0, 0}) + "\n$EndNodes\n$Elements\n1\n";
  expect_complaints(
      "a.msh", {{order(1) + nodes + raw_bytes<std::int32_t>({200, 1, 0}),
                 ": at byte 104: unknown element type 200"},
                {order(1) + nodes + raw_bytes<std::int32_t>({4, 99, 0}),
                 ": at byte 108: a number of elements: impossible (0 to 1 expected, 99 found)"}});
}

TEST(GmshComplaints, SectionsHaveTheirEndsAndComeOnce) {
  expect_complaints(
      "a.msh",
      {{kMsh2, ""},
       {kMsh2Head + kMsh2Nodes, ": the file ends too early ($Elements expected)"},
       {kMsh2Head + kMsh2Cells, ": the file ends too early ($Nodes expected)"},
       {kMsh2Head, ": the file ends too early ($Nodes expected)"},
       {kMsh2Head + kMsh2Nodes + kMsh2Nodes + kMsh2Cells, ":12: a second section of nodes"},
       {kMsh2Head + kMsh2Nodes + "$ParametricNodes\n", ":12: a second section of nodes"},
       {kMsh2 + kMsh2Cells, ":16: a second section of elements"},
       {kMsh2 + "$Periodic\n1\n$EndPeriodi\n",
        ":15: the file ends too early ('$EndPeriodic' expected)"},
       {kMsh2 + "$Periodic\n1\n$EndPeriodic x\n",
        ":17: '$EndPeriodic' expected ('$EndPeriodic x' found)"},
       {kMsh2Head + "$Nodes\n1\n1 0 0 0\n2 1 0 0\n$EndNodes\n",
        ":7: '$EndNodes' expected ('2 1 0 0' found)"},
       {kMsh2 + "$PhysicalNames\n2\n0 1 \"a\"\n3 1 \"b\"\n$EndPhysicalNames\n", ""},
       {kMsh2 + "$PhysicalNames\n1\n4 1 \"a\"\n$EndPhysicalNames\n",
        ":17: a dimension: impossible (0 to 3 expected, 4 found)"},
       {kMsh2 + "$PhysicalNames\n1\n-1 1 \"a\"\n$EndPhysicalNames\n",
        ":17: a dimension: impossible (0 to 3 expected, -1 found)"}});
  const ScratchFolder folder;
  EXPECT_THAT(read_any(folder.write("b.msh", kMsh2 + "$Periodic\n1\n$EndPeriodic\n$Comments\n"
                                                     "$EndComments\n$Views\n$EndViews\n"))
                  .notes,
              ElementsAre("left out sections: '$Periodic', '$Views'"));
}

TEST(GmshComplaints, ElementsHaveAsManyNodesAsTheirTypes) {
  const std::string nodes = "$NOD\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$ENDNOD\n$ELM\n1\n";
  const std::string third =
      "$MeshFormat\n3 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0 0\n2 1 0 0 0\n"
      "3 0 1 0 0\n4 0 0 1 0\n$EndNodes\n$Elements\n1\n";
  expect_complaints(
      "a.msh",
      {{nodes + "9 4 1 1 4 1 2 3 4\n$ENDELM\n", ""},
       {nodes + "9 4 1 1 3 1 2 3\n$ENDELM\n", ":10: a Tetrahedron 4 has 4 nodes (3 found)"},
       {nodes + "9 4 1 1 5 1 2 3 4 4\n$ENDELM\n", ":10: a Tetrahedron 4 has 4 nodes (5 found)"},
       {nodes + "9 2 1 1 4 1 2 3 4\n$ENDELM\n", ":10: a Triangle 3 has 3 nodes (4 found)"},
       {nodes + "9 4 1 1 4 1 2 3 4\n$EndELM\n", ":11: '$ENDELM' expected ('$EndELM' found)"},
       {third + "9 4 5 4 1 2 3 4\n$EndElements\n", ""},
       {third + "9 4 5 5 1 2 3 4 1\n$EndElements\n", ""},
       {third + "9 4 5 3 1 2 3\n$EndElements\n", ":13: a Tetrahedron 4 has 4 nodes (3 found)"},
       {kMsh2Head + kMsh2Nodes + "$Elements\n1\n9 0 2 1 1 1\n", ":13: unknown element type 0"},
       {kMsh2Head + kMsh2Nodes + "$Elements\n1\n9 -1 2 1 1 1\n", ":13: unknown element type -1"}});
}

TEST(GmshComplaints, ListsAreNotLongerThanTheFile) {
  expect_complaints(
      "a.msh", {{kMsh2Head + "$Nodes\n3\n1 0 0 0\n$EndNodes\n",
                 ":7: not understood (a node number expected, '$EndNodes' found)"},
                {kMsh2Head + "$Nodes\n4\n1 0 0 0\n$EndNodes\n",
                 ":5: 4 nodes announced, more than the file can hold"},
                {"$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 1 1 1\n3 1 0 9\n1\n",
                 ":6: the number of nodes of a block: impossible (0 to 2 expected, 9 found)"},
                {"$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 1 1 1\n4 1 0 1\n1\n",
                 ":6: an entity's dimension: impossible (0 to 3 expected, 4 found)"},
                {"$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 1 1 1\n-1 1 0 1\n1\n",
                 ":6: an entity's dimension: impossible (0 to 3 expected, -1 found)"},
                {"$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n-1 1 1 1\n",
                 ":5: the number of blocks of nodes: impossible (0 to 4 expected, -1 found)"}});
}

std::string msh_data(const std::string& tags, const std::string& values) {
  return kMsh2 + "$ElementData\n" + tags + values + "$EndElementData\n";
}

TEST(GmshComplaints, HeadsOfDataTellStepComponentsAndValues) {
  std::string hundred = "9";
  for (int i = 0; i < 100; ++i) hundred += " 1";
  const std::string head = "1\n\"p\"\n1\n0.5\n";
  expect_complaints(
      "a.msh",
      {{msh_data(head + "3\n0\n1\n1\n", "9 7\n"), ""},
       {msh_data(head + "5\n0\n1\n1\n4\n5\n", "9 7\n"), ""},
       {msh_data(head + "3\n0\n100\n1\n", hundred + "\n"), ""},
       {msh_data(head + "3\n0\n0\n1\n", "9\n"),
        ":22: a number of components: impossible (1 to 100 expected, 0 found)"},
       {msh_data(head + "3\n0\n101\n1\n", "9\n"),
        ":22: a number of components: impossible (1 to 100 expected, 101 found)"},
       {msh_data(head + "3\n0\n1\n-1\n", ""),
        ":23: -1 values announced, more than the file can hold"},
       {msh_data(head + "3\n0\n1\n99\n", "9 7\n"),
        ":23: 99 values announced, more than the file can hold"},
       {msh_data(head + "2\n0\n1\n", "9 7\n"),
        ":22: step, components and number of values expected"},
       {msh_data("0\n1\ninf\n3\n0\n1\n1\n", "9 7\n"), ":18: the time is not finite"},
       {msh_data(head + "3\n0\n1\n1\n", "8 7\n"), ":24: a value for 8, which there is not"}});
}

TEST(GmshData, NamesTimesAndTextsAreOptional) {
  const ScratchFolder folder;
  const ZooMesh mesh =
      read_any(folder.write("a.msh", msh_data("0\n0\n3\n0\n1\n1\n", "9 7\n"))).mesh;
  ASSERT_EQ(mesh.fields.size(), 1U);
  EXPECT_EQ(mesh.fields[0].name, "unnamed");
  EXPECT_EQ(mesh.fields[0].values[0], 7);
  const std::string path = folder.write(
      "b.msh", msh_data("2\nwithout quotes \n\"scheme\"\n2\n0.5\n7\n3\n4\n3\n1\n", "9 7 8 9\n"));
  EXPECT_THAT(format_named("gmsh").inspect(path).times, ElementsAre(0.5));
  const ZooMesh named = read_any(path).mesh;
  EXPECT_EQ(named.fields.at(0).name, "without quotes");
  EXPECT_THAT(named.fields[0].values.view(), ElementsAre(7, 8, 9));
}

TEST(GmshData, ElementNodesHaveTheirValues) {
  const auto data = [](const std::string& values) {
    return kMsh2 + "$ElementNodeData\n1\n\"c\"\n0\n3\n0\n1\n1\n" + values + "$EndElementNodeData\n";
  };
  expect_complaints(
      "a.msh",
      {{data("9 4 1 2 3 4\n"), ""},
       {data("9 3 1 2 3\n"), ":23: values at the 4 nodes of a Tetrahedron 4 expected (3 found)"},
       {data("9 5 1 2 3 4 5\n"),
        ":23: values at the 4 nodes of a Tetrahedron 4 expected (5 found)"}});
  const ScratchFolder folder;
  const ZooMesh mesh = read_any(folder.write("a.msh", data("9 4 1 2 3 5\n"))).mesh;
  EXPECT_EQ(mesh.fields.at(0).location, FieldLocation::corner);
  EXPECT_THAT(mesh.fields[0].values.view(), ElementsAre(1, 2, 3, 5));
}

// Of two steps at one time, the number tells which is which.
TEST(GmshData, StepsOfOneTimeAreSeveral) {
  const auto step = [](const std::string& name, int number, double value) {
    return fmt::format("$ElementData\n1\n\"{}\"\n1\n0.5\n3\n{}\n1\n1\n9 {}\n$EndElementData\n",
                       name, number, value);
  };
  const ScratchFolder folder;
  const std::string path =
      folder.write("a.msh", kMsh2 + step("p", 0, 1) + step("q", 0, 2) + step("p", 1, 3));
  EXPECT_THAT(format_named("gmsh").inspect(path).times, ElementsAre(0.5, 0.5));
  ReadOptions options;
  for (const std::size_t number : {0, 1}) {
    options.step = number;
    const ZooMesh mesh = read_any(path, options).mesh;
    EXPECT_EQ(mesh.fields.at(0).name, "p");
    EXPECT_EQ(mesh.fields[0].values[0], number == 0 ? 1 : 3);
  }
}

TEST(GmshComplaints, WedgesOf29NodesCannotBeWritten) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.msh");
  ZooMesh mesh;
  std::vector<double> xyz;
  std::vector<NodeId> nodes;
  for (const auto& place : reference_nodes(CellKind::wedge29)) {
    nodes.push_back(static_cast<NodeId>(nodes.size()));
    xyz.insert(xyz.end(), place.begin(), place.end());
  }
  for (const NodeId node : std::vector<NodeId>(nodes)) nodes.push_back(node);
  mesh.kinds = std::vector<CellKind>{CellKind::wedge29, CellKind::wedge29};
  mesh.elems = std::vector<std::uint64_t>{0, 29, 58};
  mesh.nodes = std::move(nodes);
  mesh.xyz = std::move(xyz);
  try {
    format_to_write(path).write(path, mesh);
    ADD_FAILURE() << "written";
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(), path + ": Gmsh has no element for a wedge29 (2 found)");
  }
  EXPECT_FALSE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace hiac::formats
