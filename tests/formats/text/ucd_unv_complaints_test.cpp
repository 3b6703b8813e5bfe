// What UCD and universal files are refused for, with the place, and what is just allowed.
#include <cmath>
#include <cstdint>
#include <map>

#include <fmt/format.h>

#include "formats/common/io/input_text.hpp"
#include "formats/ucd/ucd_file.hpp"
#include "formats/unv/unv_elements.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "tests/formats/complaints.hpp"
#include "tests/formats/field_named.hpp"
#include "tests/formats/raw_bytes.hpp"
#include "tests/formats/unit_tetrahedron.hpp"

namespace hiac::formats {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// ---- UCD

const std::string kUcdNodes = "1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n";
// AVS lists a tetrahedron's top first
const std::string kUcd = kUcdNodes + "7 1 tet 1 2 4 3\n";

TEST(UcdComplaints, CellsHaveOneOfEightTypes) {
  const auto cell = [](const std::string& name, int nodes) {
    std::string text = "4 2 0 0 0\n" + kUcd + "8 1 " + name;
    for (int n = 0; n < nodes; ++n) text += fmt::format(" {}", n % 4 + 1);
    return text + "\n";
  };
  std::vector<Complaint> rows;
  for (const auto& [name, nodes] : std::vector<std::pair<std::string, int>>{{"pt", 1},
                                                                            {"PT", 1},
                                                                            {"line", 2},
                                                                            {"LIN", 2},
                                                                            {"tri", 3},
                                                                            {"Tri", 3},
                                                                            {"quad", 4},
                                                                            {"qua", 4},
                                                                            {"tet", 4},
                                                                            {"TET", 4}})
    rows.push_back({cell(name, nodes), ""});
  for (const std::string name : {"tetra", "te", "qu", "wedge", "p", "pyramid", "li"})
    rows.push_back({cell(name, 4), fmt::format(":7: unknown cell type (pt, line, tri, quad, tet, "
                                               "pyr, prism or hex expected, '{}' found)",
                                               name)});
  // the words are read on
  rows.push_back({cell("line", 3), ""});
  expect_complaints("a.inp", rows);
}

TEST(UcdComplaints, DataAreOfNodesAndCellsThatThereAre) {
  const std::string head = "4 1 1 0 0\n" + kUcd;
  expect_complaints(
      "a.inp",
      {{head + "1 1\nT, K\n1 5\n2 6\n3 7\n4 8\n", ""},
       {head + "1 1\nT, K\n1 5\n2 6\n3 7\n9 8\n", ":12: a value for 9, which there is not"},
       {head + "1 1\nT, K\n1 5\n2 6\n3 x\n", ":11: not understood (a value expected, 'x' found)"},
       {"4 1 0 1 0\n" + kUcd + "1 1\nT, K\n1 5\n", ":9: a value for 1, which there is not"},
       {"4 1 9 0 0\n" + kUcd + "1 9\nT\n1 5\n",
        ":9: 9 values expected, more than the file can hold"},
       {"4 1 9 0 0\n" + kUcd + "1 9\nT\n1 1 2 3 4 5 6 7 8 9\n",
        ":9: more values expected than the file can hold"}});
}

TEST(UcdData, SeveralFieldsShareALineANode) {
  const ScratchFolder folder;
  const ZooMesh mesh =
      read_any(folder.write("a.inp", "# c\n\n4 1 4 2 0\n" + kUcd +
                                         "3 1 0 3\nT , deg C\nempty, m\nv\n"
                                         "3 1 11 12 13\n1 2 21 22 23\n4 3 31 32 33\n"
                                         "2 4 41 42 43\n2 1 1\na,b\nc, d, e\n7 8.5 9.5\n"))
          .mesh;
  expect_unit_tetrahedron(mesh);
  ASSERT_EQ(mesh.fields.size(), 5U);
  const Field& t = field_named(mesh, "T");
  EXPECT_EQ(t.unit, "deg C");
  EXPECT_THAT(t.values.view(), ElementsAre(2, 4, 1, 3));
  const Field& v = field_named(mesh, "v");
  EXPECT_EQ(v.unit, "");
  EXPECT_EQ(v.components, 3U);
  EXPECT_THAT(v.values.view(), ElementsAre(21, 22, 23, 41, 42, 43, 11, 12, 13, 31, 32, 33));
  EXPECT_EQ(field_named(mesh, "a").location, FieldLocation::cell);
  EXPECT_EQ(field_named(mesh, "a").values[0], 8.5);
  EXPECT_EQ(field_named(mesh, "c").unit, "d, e");
  EXPECT_EQ(field_named(mesh, "c").values[0], 9.5);
}

/// A binary file of one tetrahedron: its head, cells, entries, the nodes, and the rest.
std::string ucd_binary(std::initializer_list<std::int32_t> head,
                       std::initializer_list<std::int32_t> cells, const std::string& rest = "") {
  return "\7" + raw_bytes(head) + raw_bytes(cells) +
         raw_bytes<float>({0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}) + rest;
}
std::string ucd_binary_data(std::int32_t components, std::initializer_list<std::int32_t> widths,
                            std::size_t bytes) {
  return std::string(2048, '\0') + raw_bytes<std::int32_t>({components}) + raw_bytes(widths) +
         std::string(bytes, '\0');
}

TEST(UcdComplaints, BinaryFilesAreAsLongAsTheirCountsSay) {
  const std::string message = ": the counts do not make the file's size (";
  const std::string one = ucd_binary({4, 1, 0, 0, 0, 4}, {1, 8, 4, 4, 1, 2, 3, 4});
  ASSERT_EQ(one.size(), 1U + 24 + 32 + 48);
  expect_complaints(
      "a.inp",
      {{one, ""},
       {one + "x", message + "106 bytes found)"},
       {one.substr(0, 104), message + "104 bytes found)"},
       {ucd_binary({4, 1, 0, 0, 0, 5}, {1, 8, 4, 4, 1, 2, 3, 4}), message + "105 bytes found)"},
       {ucd_binary({-4, 1, 0, 0, 0, 4}, {1, 8, 4, 4, 1, 2, 3, 4}), message + "105 bytes found)"},
       // data of nodes, of cells and of the model: labels, units, counts, ranges, values, marks
       {ucd_binary({4, 1, 1, 0, 0, 4}, {1, 8, 4, 4, 1, 2, 3, 4},
                   ucd_binary_data(1, {1}, 8 + 16 + 4)),
        ""},
       {ucd_binary({4, 1, 0, 1, 0, 4}, {1, 8, 4, 4, 1, 2, 3, 4},
                   ucd_binary_data(1, {1}, 8 + 4 + 4)),
        ""},
       {ucd_binary({4, 1, 0, 0, 1, 4}, {1, 8, 4, 4, 1, 2, 3, 4}, ucd_binary_data(1, {1}, 16)),
        ""}});
}

TEST(UcdComplaints, BinaryCellsAndDataFit) {
  const auto cell = [](std::int32_t nodes, std::int32_t type) {
    return ucd_binary({4, 1, 0, 0, 0, 4}, {6, 8, nodes, type, 1, 2, 3, 4});
  };
  const auto data = [](std::int32_t components, std::initializer_list<std::int32_t> widths) {
    return ucd_binary({4, 1, 2, 0, 0, 4}, {1, 8, 4, 4, 1, 2, 3, 4},
                      ucd_binary_data(components, widths, 16 + 32 + 8));
  };
  const std::string widths = ": numbers of components do not fit the number of data";
  expect_complaints("a.inp", {{cell(4, 4), ""},
                              {cell(4, 8), ": cell 6: type 8 with 4 nodes is not known"},
                              {cell(4, -1), ": cell 6: type -1 with 4 nodes is not known"},
                              {cell(3, 4), ": cell 6: type 4 with 3 nodes is not known"},
                              {cell(3, 2), ": the cells' nodes do not fit (4 expected, 3 found)"},
                              {data(2, {1, 1}), ""},
                              {data(1, {2, 0}), ""},
                              {data(9, {1, 1}), ""},
                              {data(2, {0, 2}), widths},
                              {data(1, {3, 0}), widths},
                              {data(2, {1, 2}), widths},
                              {data(1, {1, 1}), ": 2 data expected (1 found)"},
                              {data(0, {1, 1}), ": 2 data expected (0 found)"}});
}

/// Cells of that type, `own` of them in AVS's order, the others in its mirror image.
ForeignMesh ucd_cells(const std::string& name, CellKind kind, std::size_t own,
                      std::size_t mirrored) {
  // AVS lists the top first; a prism has its bottom where others have the top
  const std::map<CellKind, std::array<std::vector<std::size_t>, 2>> orders{
      {CellKind::tetrahedron4, {{{0, 1, 3, 2}, {0, 1, 2, 3}}}},
      {CellKind::pyramid5, {{{4, 0, 1, 2, 3}, {4, 0, 3, 2, 1}}}},
      {CellKind::prism6, {{{0, 1, 2, 3, 4, 5}, {0, 2, 1, 3, 5, 4}}}},
      {CellKind::brick8, {{{4, 5, 6, 7, 0, 1, 2, 3}, {0, 1, 2, 3, 4, 5, 6, 7}}}}};
  const auto places = reference_nodes(kind);
  std::string text = fmt::format("{} {} 0 0 0\n", places.size(), own + mirrored);
  for (std::size_t n = 0; n < places.size(); ++n)
    text += fmt::format("{} {} {} {}\n", n + 1, places[n][0], places[n][1], places[n][2]);
  for (std::size_t cell = 0; cell < own + mirrored; ++cell) {
    text += fmt::format("{} 1 {}", cell + 1, name);
    for (const std::size_t node : orders.at(kind)[cell < own ? 0 : 1])
      text += fmt::format(" {}", node + 1);
    text += "\n";
  }
  const ScratchFolder folder;
  return ucd::read_ucd(InputText(folder.write("a.inp", text)));
}

TEST(UcdOrders, AreThatOfMostCellsOfAType) {
  for (const auto& [name, kind] :
       std::vector<std::pair<std::string, CellKind>>{{"tet", CellKind::tetrahedron4},
                                                     {"pyr", CellKind::pyramid5},
                                                     {"prism", CellKind::prism6},
                                                     {"hex", CellKind::brick8}}) {
    const auto turned = [&](const ForeignMesh& mesh, std::size_t cell) {
      // whether the cell's nodes are the reference's in the order that was chosen
      const auto& permutation = mesh.types[mesh.cell_types[cell]].conversion.permutation;
      for (std::size_t n = 0; n < node_count(kind); ++n) {
        const std::size_t place = permutation.empty() ? n : permutation[n];
        if (mesh.cell_nodes[cell * node_count(kind) + place] != static_cast<std::int64_t>(n + 1))
          return false;
      }
      return true;
    };
    const std::string note = name +
                             " cells have their nodes in the mirror image of AVS's order, which "
                             "is how they are read";
    const ForeignMesh own = ucd_cells(name, kind, 2, 1);
    EXPECT_THAT(own.notes, IsEmpty()) << name;
    EXPECT_TRUE(turned(own, 0)) << name;
    EXPECT_FALSE(turned(own, 2)) << name;
    const ForeignMesh mirrored = ucd_cells(name, kind, 1, 2);
    EXPECT_THAT(mirrored.notes, ElementsAre(note));
    EXPECT_FALSE(turned(mirrored, 0)) << name;
    EXPECT_TRUE(turned(mirrored, 2)) << name;
    // as many of each: AVS's own
    EXPECT_THAT(ucd_cells(name, kind, 1, 1).notes, IsEmpty()) << name;
  }
}

// Cells without a volume, or with nodes that there are not, say nothing of the order.
TEST(UcdOrders, AreNotThatOfFlatCells) {
  const ScratchFolder folder;
  const auto notes = [&](const std::string& others) {
    return ucd::read_ucd(InputText(folder.write(
                             "a.inp", "4 3 0 0 0\n" + kUcdNodes + others + "9 1 tet 1 2 3 4\n")))
        .notes.size();
  };
  EXPECT_EQ(notes("7 1 tet 1 1 2 3\n8 1 tet 1 2 3 3\n"), 1U);
  EXPECT_EQ(notes("7 1 tet 1 2 4 5\n8 1 tet 6 2 4 3\n"), 1U);
  EXPECT_EQ(notes("7 1 tet 1 2 4 3\n8 1 tet 1 2 2 3\n"), 0U);
}

// ---- universal files

std::string unv_fields(std::initializer_list<int> fields) {
  std::string text;
  for (const int field : fields) text += fmt::format("{:10}", field);
  return text + "\n";
}
std::string unv_dataset(int number, const std::string& lines) {
  return fmt::format("    -1\n{:6}\n", number) + lines + "    -1\n";
}
std::string unv_nodes() {
  std::string text;
  for (int i = 0; i < 4; ++i)
    text += unv_fields({i + 1, 1, 1, 11}) + fmt::format("{:25.16E}{:25.16E}{:25.16E}\n",
                                                        i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0,
                                                        i == 3 ? 1.0 : 0.0);
  return unv_dataset(2411, text);
}
const std::string kUnv =
    unv_nodes() + unv_dataset(2412, unv_fields({19, 111, 1, 1, 7, 4}) + unv_fields({1, 2, 3, 4}));

TEST(UnvComplaints, ElementsHaveAsManyNodesAsTheirTypes) {
  const auto element = [](int descriptor, int nodes) {
    std::string text = unv_fields({5, descriptor, 1, 1, 7, nodes});
    for (int n = 0; n < nodes; ++n)
      text += fmt::format("{:10}{}", n % 4 + 1, n % 8 == 7 || n + 1 == nodes ? "\n" : "");
    return kUnv + unv_dataset(2412, text);
  };
  const auto refused = [&](int descriptor, int nodes, const std::string& name, int own) {
    return Complaint{element(descriptor, nodes),
                     fmt::format(":19: element 5: a {} has {} nodes ({} found)", name, own, nodes)};
  };
  expect_complaints("a.unv", {{element(111, 4), ""},
                              refused(111, 3, "tet4", 4),
                              refused(111, 5, "tet4", 4),
                              refused(118, 4, "tet10", 10),
                              refused(161, 2, "lumped mass", 1),
                              refused(91, 4, "surface3", 3),
                              {element(45, 8), ""},
                              refused(45, 9, "surface8", 8)});
}

TEST(UnvComplaints, GroupsAnnounceTheirMembers) {
  const auto group = [](int count, const std::string& members) {
    return kUnv +
           unv_dataset(2467, unv_fields({3, 0, 0, 0, 0, 0, 0, count}) + "the core\n" + members);
  };
  const std::string one = unv_fields({8, 19, 0, 0});
  expect_complaints("a.unv",
                    {{group(1, one), ""},
                     {group(0, ""), ""},
                     {group(-1, one), ":19: group 3: -1 members announced"},
                     {group(9999, one), ":19: group 3: 9999 members announced"},
                     {group(2, one), ":21: an integer in columns 41 to 50 expected ('' found)"}});
}

TEST(UnvSets, GroupsAreBlocksOfTheirElements) {
  const ScratchFolder folder;
  std::string cells;
  for (const int number : {19, 20, 21})
    cells += unv_fields({number, 111, 1, 1, 7, 4}) + unv_fields({1, 2, 3, 4});
  const std::string path = folder.write(
      "a.unv",
      unv_nodes() + unv_dataset(2412, cells) +
          unv_dataset(2467, unv_fields({3, 0, 0, 0, 0, 0, 0, 3}) + "the core\n" +
                                unv_fields({8, 19, 0, 0, 7, 20, 0, 0}) + unv_fields({8, 21, 0, 0}) +
                                unv_fields({5, 0, 0, 0, 0, 0, 0, 2}) + "\n" +
                                unv_fields({8, 77, 0, 0, 8, 20, 0, 0}) +
                                unv_fields({6, 0, 0, 0, 0, 0, 0, 1}) + "nodes\n" +
                                unv_fields({7, 1, 0, 0})));
  EXPECT_THAT(format_named("unv").inspect(path).blocks, ElementsAre("the core", "5"));
  for (const auto& [block, count] :
       std::vector<std::pair<std::string, std::size_t>>{{"the core", 2}, {"5", 1}}) {
    ReadOptions options;
    options.block = block;
    EXPECT_EQ(read_any(path, options).mesh.cell_count(), count) << block;
  }
}

TEST(UnvComplaints, DatasetsHaveNumbersAndEnds) {
  expect_complaints(
      "a.unv",
      {{kUnv + "\nnote\n    -1\n", ""},
       {kUnv + "    -1\n  x\n    -1\n", ":18: the number of a dataset expected ('  x' found)"},
       {kUnv + "    -1\n   999\nx\n", ":18: the file ends within a dataset ('    -1' expected)"},
       {kUnv + "    -1\n   164\n         1  SI\n    -1\n", ""},
       {kUnv + "    -1\n   164\n        10  SI\n    -1\n", ""},
       {kUnv + "    -1\n   164\n        11  SI\n    -1\n",
        ":19: unknown units (a code from 1 to 10 expected, '11' found)"},
       {kUnv + unv_dataset(2412, unv_fields({19, 111, 1, 1, 7, 4})),
        ":20: an integer in columns 11 to 20 expected ('' found)"}});
}

// Dataset 164 is I10,20A1,I10: the name may follow the ten columns of the code at once. Some
// programs write the code further to the right.
TEST(UnvUnits, HaveACodeAndAName) {
  const ScratchFolder folder;
  const auto units = [&](const std::string& line) {
    for (const auto& [key, value] :
         read_any(folder.write("a.unv", kUnv + unv_dataset(164, line + "\n"))).mesh.metadata)
      if (key == "units") return value;
    return std::string();
  };
  EXPECT_EQ(units("         1SI: Meter (newton)           2"), "SI: Meter (newton)");
  EXPECT_EQ(units("         1  SI: Meter (newton)         2"), "SI: Meter (newton)");
  EXPECT_EQ(units("        10User's units                 2"), "User's units");
  EXPECT_EQ(units("         53rd of our systems           2"), "3rd of our systems");
  EXPECT_EQ(units("         7"), "");
  EXPECT_EQ(units("1 SI"), "");
  EXPECT_EQ(units("          1  SI: Meter (newton)         2"), "SI: Meter (newton)");
  EXPECT_EQ(units("         10 User's units                 2"), "User's units");
  const auto complaint = [](const std::string& found) {
    return fmt::format(":19: unknown units (a code from 1 to 10 expected, '{}' found)", found);
  };
  expect_complaints("b.unv", {{kUnv + unv_dataset(164, "         0SI\n"), complaint("0SI")},
                              {kUnv + unv_dataset(164, "        11SI\n"), complaint("11SI")},
                              {kUnv + unv_dataset(164, "         12  SI\n"), complaint("12")},
                              {kUnv + unv_dataset(164, "          1SI\n"), complaint("1SI")},
                              {kUnv + unv_dataset(164, "SI\n"), complaint("SI")},
                              {kUnv + unv_dataset(164, "\n"), complaint("")}});
}

// Universal File Datasets, appendix "FE descriptors"; the last digit of a surface's tells its
// shape.
TEST(UnvTypes, DescriptorsHaveTheirNodes) {
  const std::vector<std::tuple<int, std::size_t, bool>> beams{
      {11, 2, true}, {21, 2, true}, {22, 2, true}, {23, 3, true}, {24, 3, true}, {161, 1, false}};
  for (const auto& [descriptor, nodes, oriented] : beams) {
    const auto element = unv::unv_element(descriptor);
    ASSERT_TRUE(element) << descriptor;
    EXPECT_EQ(element->type.nodes, nodes) << descriptor;
    EXPECT_EQ(element->is_beam, oriented) << descriptor;
    EXPECT_EQ(element->type.conversion.fate, CellFate::no_volume) << descriptor;
  }
  const std::vector<std::tuple<int, std::size_t, CellKind>> solids{
      {111, 4, CellKind::tetrahedron4}, {112, 6, CellKind::prism6},
      {113, 15, CellKind::prism15},     {115, 8, CellKind::brick8},
      {116, 20, CellKind::brick20},     {118, 10, CellKind::tetrahedron10}};
  for (const auto& [descriptor, nodes, kind] : solids) {
    const auto element = unv::unv_element(descriptor);
    ASSERT_TRUE(element) << descriptor;
    EXPECT_EQ(element->type.nodes, nodes) << descriptor;
    EXPECT_EQ(element->type.conversion.kind, kind) << descriptor;
    EXPECT_FALSE(element->is_beam);
  }
  for (const auto& [descriptor, nodes] :
       std::vector<std::pair<int, std::size_t>>{{114, 24}, {117, 32}}) {
    EXPECT_EQ(unv::unv_element(descriptor)->type.nodes, nodes);
    EXPECT_EQ(unv::unv_element(descriptor)->type.conversion.fate, CellFate::unsupported);
  }
  const std::vector<std::size_t> surface{0, 3, 6, 9, 4, 8, 12, 0, 0, 0};
  for (int descriptor = 25; descriptor < 125; ++descriptor) {
    if (descriptor >= 111 && descriptor <= 118) continue;
    const auto element = unv::unv_element(descriptor);
    const std::size_t nodes = descriptor < 40 || descriptor > 109
                                  ? 0
                                  : surface[static_cast<std::size_t>(descriptor % 10)];
    ASSERT_EQ(element.has_value(), nodes > 0) << descriptor;
    if (!element) continue;
    EXPECT_EQ(element->type.nodes, nodes) << descriptor;
    EXPECT_EQ(element->type.conversion.fate, CellFate::no_volume) << descriptor;
  }
}

// Springs and rigid bodies have as many nodes as their records say, and beams a record more.
TEST(UnvTypes, BeamsHaveARecordOfOrientationsAndOthersTheNodesOfTheirRecords) {
  const ScratchFolder folder;
  const Reading reading = read_any(folder.write(
      "a.unv",
      unv_nodes() + unv_dataset(2412, unv_fields({1, 21, 1, 1, 7, 2}) + unv_fields({0, 0, 0}) +
                                          unv_fields({1, 2}) + unv_fields({2, 136, 1, 1, 7, 2}) +
                                          unv_fields({3, 4}) + unv_fields({3, 136, 1, 1, 7, 1}) +
                                          unv_fields({3}) + unv_fields({19, 111, 1, 1, 7, 4}) +
                                          unv_fields({1, 2, 3, 4}))));
  expect_unit_tetrahedron(reading.mesh);
  EXPECT_THAT(reading.notes, Contains(HasSubstr("dropped cells without volume: ")));
  expect_complaints("b.unv", {{kUnv + unv_dataset(2412, unv_fields({5, 136, 1, 1, 7, -1})),
                               ":19: -1 nodes of an element announced"},
                              {kUnv + unv_dataset(2412, unv_fields({5, 136, 1, 1, 7, 999})),
                               ":19: 999 nodes of an element announced"}});
}

// Datasets 15, 781 and 780 are older forms of 2411 and 2412.
TEST(UnvTypes, OlderDatasetsHoldTheSame) {
  const ScratchFolder folder;
  std::string nodes;
  for (int i = 0; i < 4; ++i)
    nodes += fmt::format("{:10}{:10}{:10}{:10}{:13.5E}{:13.5E}{:13.5E}\n", i + 1, 1, 1, 11,
                         i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0, i == 3 ? 1.0 : 0.0);
  const std::string cells =
      unv_dataset(780, unv_fields({19, 111, 1, 1, 1, 1, 7, 4}) + unv_fields({1, 2, 3, 4}));
  expect_unit_tetrahedron(read_any(folder.write("a.unv", unv_dataset(15, nodes) + cells)).mesh);
  std::string two_lines = unv_nodes();
  two_lines.replace(two_lines.find("  2411"), 6, "   781");
  expect_unit_tetrahedron(read_any(folder.write("b.unv", two_lines + cells)).mesh);
  const Reading left_out = read_any(folder.write(
      "c.unv", kUnv + unv_dataset(151, "x\n") + unv_dataset(2420, "x\n") + unv_dataset(58, "x\n") +
                   unv_dataset(99, "x\n") + "stray\n\nlines\n"));
  EXPECT_THAT(left_out.notes,
              ElementsAre("left out datasets 58, 99", "left out 2 lines that are in no dataset"));
}

}  // namespace
}  // namespace hiac::formats
