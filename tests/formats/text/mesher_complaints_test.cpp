// What files of the mesh generators Gambit, Netgen and Medit are refused for, with the place, and
// what is just allowed.
#include <cstdint>

#include <fmt/format.h>

#include "formats/common/io/input_text.hpp"
#include "formats/medit/gmf_file.hpp"
#include "tests/formats/complaints.hpp"
#include "tests/formats/raw_bytes.hpp"
#include "tests/formats/unit_tetrahedron.hpp"

namespace hiac::formats {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// ---- Gambit

std::string neu(const std::string& counts, const std::string& sections) {
  return "        CONTROL INFO 2.4.6\n** GAMBIT NEUTRAL FILE\nx\nPROGRAM: Gambit VERSION: 2\n now\n"
         " NUMNP NELEM NGRPS NBSETS NDFCD NDFVL\n " +
         counts + "\nENDOFSECTION\n" + sections;
}
const std::string kNeuNodes =
    "NODAL COORDINATES 2\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\nENDOFSECTION\n";
const std::string kNeuCells = "ELEMENTS/CELLS 2\n9 6 4 1 2 3 4\nENDOFSECTION\n";
const std::string kNeu = neu("4 1 0 0 3 3", kNeuNodes + kNeuCells);

TEST(GambitComplaints, GroupsTellTheirNumbers) {
  const auto group = [](const std::string& line, const std::string& rest) {
    return kNeu + "ELEMENT GROUP 2\n" + line + "\n" + rest + "ENDOFSECTION\n";
  };
  const std::string all = "all\n0\n9\n";
  expect_complaints(
      "a.neu",
      {{group("GROUP: 1 ELEMENTS: 1 MATERIAL: 2 NFLAGS: 1", all), ""},
       {group("GROUP: 1 ELEMENTS: 0 MATERIAL: 2 NFLAGS: 0", "all\n"), ""},
       {group("SET: 1 ELEMENTS: 1 MATERIAL: 2 NFLAGS: 1", all),
        ":19: 'GROUP:' expected in the line"},
       {group("GROUP: 1 ELEMENT: 1 MATERIAL: 2 NFLAGS: 1", all),
        ":19: 'ELEMENTS:' expected in the line"},
       {group("GROUP: 1 ELEMENTS: 1 MATER: 2 NFLAGS: 1", all),
        ":19: 'MATERIAL:' expected in the line"},
       {group("GROUP: 1 ELEMENTS: 1 MATERIAL: 2", all), ":19: 'NFLAGS:' expected in the line"},
       {group("GROUP: 1 ELEMENTS: -1 MATERIAL: 2 NFLAGS: 1", all), ":19: a negative count"},
       {group("GROUP: 1 ELEMENTS: 1 MATERIAL: 2 NFLAGS: -1", all), ":19: a negative count"},
       {group("GROUP: 1 ELEMENTS: 1 MATERIAL: 2 NFLAGS: 1", "all\n0\n8\n"),
        ":22: 8 is named, which there is not"},
       {group("GROUP: 1 ELEMENTS: 1 MATERIAL: 2 NFLAGS: 1", "all\n0\n9\n9\n"),
        ":23: 'ENDOFSECTION' expected ('9' found)"}});
}

TEST(GambitComplaints, ElementsHaveAShapeFrom1To7With1To64Nodes) {
  const auto element = [](int shape, int nodes) {
    std::string text = fmt::format("ELEMENTS/CELLS 2\n9 6 4 1 2 3 4\n10 {} {}\n", shape, nodes);
    for (int n = 0; n < nodes; ++n) text += "1\n";
    return neu("4 2 0 0 3 3", kNeuNodes + text + "ENDOFSECTION\n");
  };
  const auto refused = [&](int shape, int nodes) {
    return Complaint{element(shape, nodes),
                     fmt::format(":17: a shape from 1 to 7 with 1 to 64 nodes expected ({} with {} "
                                 "found)",
                                 shape, nodes)};
  };
  expect_complaints("a.neu", {{element(1, 1), ""},
                              {element(3, 64), ""},
                              refused(0, 4),
                              refused(8, 4),
                              refused(1, 0),
                              refused(1, 65),
                              refused(3, -1)});
  const ScratchFolder folder;
  for (const auto& [shape, name] :
       std::vector<std::pair<int, std::string>>{{1, "edge"}, {2, "quadrilateral"}, {3, "triangle"}})
    EXPECT_THAT(read_any(folder.write("a.neu", element(shape, 4))).notes,
                ElementsAre("dropped cells without volume: 1 " + name));
  for (const auto& [shape, name] : std::vector<std::pair<int, std::string>>{
           {4, "brick"}, {5, "wedge"}, {6, "tetrahedron"}, {7, "pyramid"}})
    EXPECT_THAT(refusal(folder.write("a.neu", element(shape, 14))),
                HasSubstr(": 1 " + name + " of 14 nodes ("));
}

TEST(GambitComplaints, CountsOfTheHeadAreThoseOfTheSections) {
  expect_complaints(
      "a.neu",
      {{kNeu, ""},
       {neu("4 2 0 0 3 3", kNeuNodes), ":15: 4 nodes and 2 elements expected (4 and 0 found)"},
       {neu("4 0 0 0 3 3", ""), ":9: 4 nodes and 0 elements expected (0 and 0 found)"},
       {neu("4 1 0 0 1 3", kNeuNodes), ":7: 2 or 3 coordinate directions expected (1 found)"},
       {neu("5 1 0 0 3 3", kNeuNodes),
        ":14: not understood (a node number expected, 'ENDOFSECTION' found)"},
       {neu("3 1 0 0 3 3", kNeuNodes), ":13: 'ENDOFSECTION' expected ('4 0 0 1' found)"},
       {neu("4 1 0 0 3 3", kNeuNodes + kNeuNodes + kNeuCells), ":16: a second section of nodes"},
       {neu("4 1 0 0 3 3", kNeuNodes + kNeuCells + kNeuCells), ":19: a second section of elements"},
       {kNeu + "TIMESTEP DATA 2\n1 2\nENDOFSECTIONS\n", ":21: 'ENDOFSECTION' expected ('' found)"},
       {kNeu + "BOUNDARY CONDITIONS 2\nwall 0 1 0 6\n7\nENDOFSECTION\n",
        ":20: 7 is named, which there is not"}});
}

TEST(GambitSections, OthersAreLeftOutAndBoundariesOfElementsMarkNoNodes) {
  const ScratchFolder folder;
  const Reading reading = read_any(folder.write(
      "a.neu", kNeu + "TIMESTEP DATA 2\n1 2\nENDOFSECTION\nBOUNDARY CONDITIONS 2\nwall 1 1 0 6\n"
                      "9 6 2\nENDOFSECTION\n"));
  expect_unit_tetrahedron(reading.mesh);
  EXPECT_THAT(reading.notes, ElementsAre("left out section 'TIMESTEP DATA 2'"));
  EXPECT_THAT(reading.mesh.fields, IsEmpty());
  // of several boundaries with nodes, each has the next number
  const std::string three =
      "BOUNDARY CONDITIONS 2\nwall 0 1 0 6\n4\nENDOFSECTION\nBOUNDARY CONDITIONS 2\nside 1 1 0 6\n"
      "9 6 2\nENDOFSECTION\nBOUNDARY CONDITIONS 2\ntop 0 2 1 6\n1 0.5\n2 0.5\nENDOFSECTION\n";
  const ZooMesh mesh = read_any(folder.write("b.neu", kNeu + three)).mesh;
  ASSERT_EQ(mesh.fields.size(), 1U);
  EXPECT_EQ(mesh.fields[0].name, "Boundary Condition");
  EXPECT_THAT(mesh.fields[0].values.view(), ElementsAre(2, 2, 0, 1));
}

TEST(GambitSections, GroupsOfElementsApartAreBlocks) {
  const ScratchFolder folder;
  std::string cells = "ELEMENTS/CELLS 2\n";
  for (int e = 1; e <= 5; ++e) cells += fmt::format("{} 6 4 1 2 3 4\n", 10 * e);
  const std::string path =
      folder.write("a.neu", neu("4 5 0 0 3 3", kNeuNodes + cells +
                                                   "ENDOFSECTION\nELEMENT GROUP 2\n"
                                                   "GROUP: 1 ELEMENTS: 3 MATERIAL: 7 NFLAGS: 2\n"
                                                   "some of them\n0\n0\n20 30 50\nENDOFSECTION\n"));
  EXPECT_THAT(read_any(path).mesh.fields.at(0).values.view(), ElementsAre(0, 7, 7, 0, 7));
  ReadOptions options;
  options.block = "some of them";
  EXPECT_EQ(read_any(path, options).mesh.cell_count(), 3U);
}

// ---- Netgen

const std::string kVol =
    "mesh3d\nvolumeelements\n1\n2 4 1 3 2 4\npoints\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n";

TEST(NetgenComplaints, PointsDimensionsAndElements) {
  expect_complaints(
      "a.vol",
      {{kVol, ""},
       {kVol + "endmesh\n7 points\npoints\n1\n", ""},
       {"mesh3d\nendmesh\n", ":3: no points found ('points' expected)"},
       {"mesh3d\nvolumeelements\n1\n2 4 1 3 2 4\n", ":5: no points found ('points' expected)"},
       {"# c\n\nmesh3d\ndimension\n3\npoints\n0\n", ":8: no points found ('points' expected)"},
       {"mesh3d\ndimension\n2\n", ":3: dimension 3 expected"},
       {"mesh3d\nvolumeelements\n2\n1 4 1 3 2 4\n1 9 1 3 2 4\n",
        ":5: 4, 5, 6, 8, 10, 13, 15 or 20 nodes of an element expected (9 found)"},
       {"mesh3d\nvolumeelements\n1\n1 -4 1 3 2 4\n",
        ":4: 4, 5, 6, 8, 10, 13, 15 or 20 nodes of an element expected (-4 found)"},
       {"mesh3d\nvolumeelements\n1\nx\n", ":4: not understood (a material expected, 'x' found)"}});
}

TEST(NetgenSections, WhatIsNoVolumeIsTold) {
  const ScratchFolder folder;
  const Reading reading = read_any(
      folder.write("a.vol",
                   "\n# c\nmesh3d\ngeomtype\n0\nsurfaceelementsgi\n2\n1 1 0 0 3 1 2 3 1 1 1\n"
                   "1 1 0 0 3 1 2 3 1 1 1\nedgesegmentsgi2\n1\n1 2 3\n" +
                       kVol.substr(7) + "curvedelements\n1\n2\nendmesh\n"));
  expect_unit_tetrahedron(reading.mesh);
  EXPECT_THAT(reading.notes,
              ElementsAre("dropped cells without volume: 2 surface elements",
                          "left out 'curvedelements': cells are straight between their nodes"));
  EXPECT_THAT(read_any(folder.write("b.vol", kVol + "surfaceelements\n0\n")).notes, IsEmpty());
}

TEST(NetgenSections, MaterialsWithoutANameAreTheirNumbers) {
  const ScratchFolder folder;
  const std::string path = folder.write(
      "a.vol",
      "mesh3d\nvolumeelements\n5\n2 4 1 3 2 4\n2 4 1 3 2 4\n11 4 1 3 2 4\n2 4 1 3 2 4\n"
      "7 4 1 3 2 4\npoints\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\nmaterials\n1\n7 the core\n");
  EXPECT_THAT(format_named("netgen").inspect(path).blocks, ElementsAre("2", "the core", "11"));
  for (const auto& [block, cells] :
       std::vector<std::pair<std::string, std::size_t>>{{"2", 3}, {"11", 1}, {"the core", 1}}) {
    ReadOptions options;
    options.block = block;
    EXPECT_EQ(read_any(path, options).mesh.cell_count(), cells) << block;
  }
}

// ---- Medit

const std::string kMeditVertices = "Vertices\n4\n0 0 0 1\n1 0 0 1\n0 1 0 1\n0 0 1 1\n";

TEST(MeditComplaints, TextsHaveKeywordsAndVertices) {
  const std::string head = "MeshVersionFormatted 2\nDimension 3\n";
  const std::string cell = "Tetrahedra\n1\n1 2 3 4 1\n";
  expect_complaints(
      "a.mesh",
      {{head + kMeditVertices + cell, ""},
       {head + "End\n", ":3: no vertices found ('Vertices' expected)"},
       {head + cell + "End\n" + kMeditVertices, ":6: no vertices found ('Vertices' expected)"},
       {head, ":3: no vertices found ('Vertices' expected)"},
       {"MeshVersionFormatted 2\n\nDimension\n2\n", ":3: dimension 3 expected (2 found)"},
       {"MeshVersionFormatted 2\nDimension 4\n", ":2: dimension 3 expected (4 found)"},
       {head + "7\n" + kMeditVertices, ":3: a keyword expected ('7' found)"},
       {head + kMeditVertices + "1 2\n", ":9: a keyword expected ('1' found)"},
       {head + kMeditVertices + "Corners\n2\n1 2\n# c\n 3\n" + cell + "5\n",
        ":17: a keyword expected ('5' found)"},
       {head + "Vertices\n2\n0 0 0 1\n1 0 x 1\n",
        ":6: not understood (a coordinate expected, 'x' found)"}});
}

TEST(MeditSections, OthersAreLeftOutByName) {
  const ScratchFolder folder;
  const Reading reading =
      read_any(folder.write("a.mesh",
                            "MeshVersionFormatted\n2\nDimension\n3\nRidges 1 5\nCorners\n2\n1 2\n"
                            "# Corners of another kind\nTangents 1 0.5\n" +
                                kMeditVertices + "Corners 1 3\nTetrahedra 1 1 2 3 4 8\n"));
  expect_unit_tetrahedron(reading.mesh);
  EXPECT_THAT(reading.notes, Contains("left out: 'Corners', 'Ridges', 'Tangents'"));
}

/// What a binary file of version 2 with those bytes behind its head is refused for.
void expect_gmf(const std::string& bytes, const std::string& message, int version = 2) {
  const ScratchFolder folder;
  const std::string path = folder.write("a.meshb", raw_bytes<std::int32_t>({1, version}) + bytes);
  std::string found;
  try {
    static_cast<void>(medit::read_gmf(InputText(path)));
  } catch (const InputError& error) {
    found = error.what();
  }
  EXPECT_EQ(found, message.empty() ? "" : path + ": " + message);
}

/// A keyword of version 2, which begins at that byte, with the place of the next one behind it.
std::string gmf_keyword(std::int32_t code, std::int32_t at, const std::string& data) {
  return raw_bytes<std::int32_t>({code, at + 8 + static_cast<std::int32_t>(data.size())}) + data;
}

TEST(MeditComplaints, BinaryFilesHaveAVersionADimensionAndVertices) {
  const std::string dimension = gmf_keyword(3, 8, raw_bytes<std::int32_t>({3}));
  const std::string vertex = gmf_keyword(
      4, 20,
      raw_bytes<std::int32_t>({1}) + raw_bytes<double>({1, 2, 3}) + raw_bytes<std::int32_t>({9}));
  const std::string end = raw_bytes<std::int32_t>({54, 0});
  expect_gmf(dimension + vertex + end, "");
  expect_gmf(dimension + vertex + raw_bytes<std::int32_t>({54}), "");
  expect_gmf(dimension + vertex, "");
  expect_gmf(dimension + end, "at byte 28: no vertices found");
  expect_gmf("", "at byte 8: no vertices found");
  expect_gmf("", "at byte 8: version 1 to 4 expected (0 found)", 0);
  expect_gmf("", "at byte 8: version 1 to 4 expected (5 found)", 5);
  expect_gmf("", "at byte 8: no vertices found", 1);
  expect_gmf("", "at byte 8: no vertices found", 4);
  expect_gmf(gmf_keyword(3, 8, raw_bytes<std::int32_t>({2})),
             "at byte 20: dimension 3 expected (2 found)");
  expect_gmf(raw_bytes<std::int32_t>({3}),
             "at byte 12: the file ends too early (a position expected)");
}

TEST(MeditComplaints, BinaryPositionsAndCountsStayInTheFile) {
  const auto dimension = [](std::int32_t next) { return raw_bytes<std::int32_t>({3, next, 3}); };
  expect_gmf(dimension(20), "at byte 20: no vertices found");
  expect_gmf(dimension(21),
             "at byte 16: the next keyword's position: impossible (16 to 20 expected, 21 found)");
  expect_gmf(dimension(15),
             "at byte 16: the next keyword's position: impossible (16 to 20 expected, 15 found)");
  expect_gmf(dimension(-1),
             "at byte 16: the next keyword's position: impossible (16 to 20 expected, -1 found)");
  // 0: the last keyword
  expect_gmf(dimension(0) + raw_bytes<std::int32_t>({4}), "at byte 20: no vertices found");
  const auto vertices = [&](std::int32_t count, std::int32_t real) {
    return dimension(20) +
           gmf_keyword(4, 20,
                       raw_bytes<std::int32_t>({count}) + std::string(2 * 28, '\0') +
                           std::string(static_cast<std::size_t>(real), '\0'));
  };
  expect_gmf(vertices(2, 0), "");
  expect_gmf(vertices(2, 27), "");
  expect_gmf(vertices(3, 27),
             "at byte 32: the number of vertices: impossible (0 to 2 expected, 3 found)");
  expect_gmf(vertices(3, 28), "");
  expect_gmf(vertices(-1, 0),
             "at byte 32: the number of vertices: impossible (0 to 2 expected, -1 found)");
  // tetrahedra take five numbers each
  const auto cells = [&](std::int32_t count) {
    return vertices(1, 0) + gmf_keyword(8, 88,
                                        raw_bytes<std::int32_t>({count, 1, 1, 1, 1, 1}) +
                                            raw_bytes<std::int32_t>({1, 1, 1, 1}));
  };
  expect_gmf(cells(1), "");
  expect_gmf(cells(2), "at byte 100: the number of cells: impossible (0 to 1 expected, 2 found)");
}

TEST(MeditSections, BinaryKeywordsAreToldByNumber) {
  const ScratchFolder folder;
  const std::string vertices = gmf_keyword(
      4, 20,
      raw_bytes<std::int32_t>({1}) + raw_bytes<double>({1, 2, 3}) + raw_bytes<std::int32_t>({9}));
  const std::string path =
      folder.write("a.meshb", raw_bytes<std::int32_t>({1, 2, 3, 20, 3}) + vertices +
                                  gmf_keyword(13, 60, raw_bytes<std::int32_t>({1, 1})) +
                                  gmf_keyword(7, 76, raw_bytes<std::int32_t>({1, 1, 1, 1, 1, 5})) +
                                  raw_bytes<std::int32_t>({54, 0, 7}));
  const ForeignMesh mesh = medit::read_gmf(InputText(path));
  EXPECT_THAT(mesh.xyz, ElementsAre(1, 2, 3));
  EXPECT_THAT(mesh.notes, Contains("left out: keyword 13"));
  EXPECT_THAT(mesh.notes, Contains(HasSubstr("4 bytes")));
  ASSERT_EQ(mesh.cell_count(), 1U);
  EXPECT_EQ(mesh.types[0].name, "Quadrilaterals");
  EXPECT_THAT(mesh.fields.at(0).values(), ElementsAre(9));
  EXPECT_THAT(mesh.fields.at(1).values(), ElementsAre(5));
}

// The numbers of the keywords: libMeshb, GmfXxx in libmeshb7.h.
TEST(MeditSections, CellsOfEveryKeyword) {
  const std::vector<std::tuple<std::string, std::int32_t, std::size_t, CellFate>> rows{
      {"Edges", 5, 2, CellFate::no_volume},
      {"Triangles", 6, 3, CellFate::no_volume},
      {"Quadrilaterals", 7, 4, CellFate::no_volume},
      {"Tetrahedra", 8, 4, CellFate::converted},
      {"Prisms", 9, 6, CellFate::converted},
      {"Hexahedra", 10, 8, CellFate::converted},
      {"TrianglesP2", 24, 6, CellFate::no_volume},
      {"EdgesP2", 25, 3, CellFate::no_volume},
      {"QuadrilateralsQ2", 27, 9, CellFate::no_volume},
      {"TetrahedraP2", 30, 10, CellFate::converted},
      {"HexahedraQ2", 33, 27, CellFate::unsupported},
      {"Pyramids", 49, 5, CellFate::converted},
      {"PrismsP2", 86, 18, CellFate::unsupported},
      {"PyramidsP2", 87, 14, CellFate::unsupported},
      {"TetrahedraP3", 90, 20, CellFate::unsupported},
      {"TetrahedraP4", 94, 35, CellFate::unsupported}};
  const ScratchFolder folder;
  for (const auto& [name, code, nodes, fate] : rows) {
    std::string words;
    std::string data = raw_bytes<std::int32_t>({1});
    for (std::size_t n = 0; n < nodes; ++n) {
      words += fmt::format("{} ", n + 1);
      data += raw_bytes<std::int32_t>({static_cast<std::int32_t>(n + 1)});
    }
    const std::string vertex = raw_bytes<std::int32_t>({1}) + std::string(28, '\0');
    const std::string text = folder.write(
        "a.mesh", fmt::format("MeshVersionFormatted 2 Dimension 3 Vertices 1 0 0 0 0 {} 1 {} 6",
                              name, words));
    const std::string binary = folder.write(
        "a.meshb", raw_bytes<std::int32_t>({1, 2, 3, 20, 3}) + gmf_keyword(4, 20, vertex) +
                       gmf_keyword(code, 60, data + raw_bytes<std::int32_t>({6})));
    for (const std::string& path : {text, binary}) {
      const ForeignMesh mesh = medit::read_gmf(InputText(path));
      ASSERT_EQ(mesh.cell_count(), 1U) << name;
      EXPECT_EQ(mesh.types[0].name, name);
      EXPECT_EQ(mesh.types[0].conversion.fate, fate) << name;
      ASSERT_EQ(mesh.cell_nodes.size(), nodes) << name;
      EXPECT_EQ(mesh.cell_nodes.back(), static_cast<std::int64_t>(nodes)) << name;
      EXPECT_THAT(mesh.fields.at(1).values(), ElementsAre(6)) << name;
    }
  }
}

}  // namespace
}  // namespace hiac::formats
