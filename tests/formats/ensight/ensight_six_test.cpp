// Files of EnSight 6, whose numbers stand in columns, and the element types of both versions.
#include <cmath>

#include <fmt/format.h>

#include "formats/ensight/element_types.hpp"
#include "formats/ensight/six_file.hpp"
#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

using ensight::SixMesh;
using testing::ElementsAre;

std::string six_reals(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) text += fmt::format("{:12.5e}", value);
  return text + "\n";
}
std::string six_integers(std::initializer_list<int> values) {
  std::string text;
  for (const int value : values) text += fmt::format("{:8}", value);
  return text + "\n";
}
const std::string kSixPoints =
    six_reals({0, 0, 0}) + six_reals({1, 0, 0}) + six_reals({0, 1, 0}) + six_reals({0, 0, 1});
const std::string kSixHead = "a\nb\nnode id off\nelement id off\ncoordinates\n       4\n";
const std::string kSixPart = "part 1\ncore\ntetra4\n       1\n";

/// All behind the path of the refusal; empty: the geometry is read.
std::string six_refusal(const std::string& text) {
  const ScratchFolder folder;
  const std::string path = folder.write("g.geo", text);
  ForeignMesh mesh;
  try {
    SixMesh().read(path, mesh);
  } catch (const InputError& error) {
    return std::string(error.what()).substr(path.size());
  }
  return "";
}

TEST(EnSight6, GeometriesAreRefusedByLine) {
  EXPECT_EQ(six_refusal(kSixHead + kSixPoints + kSixPart + six_integers({1, 2, 3, 4})), "");
  EXPECT_EQ(six_refusal(kSixHead + kSixPoints), "");
  EXPECT_EQ(six_refusal("a\nb\nnode id off\nelement id off\npoints\n"),
            ":5: 'coordinates' expected");
  EXPECT_EQ(six_refusal("a\nb\nnode id off\nelement id off\ncoordinates\n      -1\n"),
            ":6: a count that fits the file expected ('      -1' found)");
  EXPECT_EQ(six_refusal("a\nb\nnode id off\nelement id off\ncoordinates\n    9999\n"),
            ":6: a count that fits the file expected ('    9999' found)");
  EXPECT_EQ(
      six_refusal(kSixHead + six_reals({0, 0, 0}) + "         1.0         2.0\n" + kSixPoints),
      ":8: a real in columns 25 to 36 expected ('' found)");
  EXPECT_EQ(six_refusal(kSixHead + kSixPoints + "tetra4\n       1\n"),
            ":11: a part or an element's name expected ('tetra4' found)");
  EXPECT_EQ(six_refusal(kSixHead + kSixPoints + "part 1\ncore\ntetra5\n"),
            ":13: a part or an element's name expected ('tetra5' found)");
  EXPECT_EQ(six_refusal(kSixHead + kSixPoints + kSixPart + "       1       2       x       4\n"),
            ":15: an integer in columns 17 to 24 expected ('       x' found)");
  EXPECT_EQ(six_refusal(kSixHead + kSixPoints + kSixPart + six_integers({1, 2, 3})),
            ":15: an integer in columns 25 to 32 expected ('' found)");
  const std::string binary = ": is a binary file of EnSight 6 (a text, or EnSight Gold, expected)";
  EXPECT_EQ(six_refusal("C Binary" + kSixHead), binary);
  EXPECT_EQ(six_refusal("    Fortran Binary" + kSixHead), binary);
}

TEST(EnSight6, NumbersAreGivenIgnoredOrOff) {
  const ScratchFolder folder;
  for (const std::string nodes : {"off", "assign", "given", "ignore"})
    for (const std::string elements : {"off", "assign", "given", "ignore"}) {
      const auto there = [](const std::string& word) {
        return word == "given" || word == "ignore";
      };
      std::string text = "a\nb\nnode id " + nodes + "\nelement id " + elements +
                         " \ncoordinates\n" + six_integers({2});
      text += (there(nodes) ? "      70" : "") + six_reals({1, 2, 3});
      text += (there(nodes) ? "      80" : "") + six_reals({4, 5, 6});
      text += "part  12 \nthe part\ng_bar2\n" + six_integers({1}) +
              (there(elements) ? "       9" : "") + six_integers({1, 2}) + "bar2\n" +
              six_integers({1}) + (there(elements) ? "       8" : "") + six_integers({2, 1});
      ForeignMesh mesh;
      SixMesh().read(folder.write("g.geo", text), mesh);
      EXPECT_THAT(mesh.xyz, ElementsAre(1, 2, 3, 4, 5, 6)) << nodes << elements;
      if (nodes == "given")
        EXPECT_THAT(mesh.node_numbers, ElementsAre(70, 80));
      else
        EXPECT_TRUE(mesh.node_numbers.empty());
      EXPECT_EQ(mesh.first_node, 1);
      EXPECT_THAT(mesh.cell_nodes, ElementsAre(1, 2, 2, 1)) << nodes << elements;
      ASSERT_EQ(mesh.types.size(), 2U);
      EXPECT_EQ(mesh.types[0].name, "g_bar2");
      EXPECT_EQ(mesh.blocks.at(0).name, "the part");
      EXPECT_EQ(mesh.blocks[0].cells.at(1).begin, 1U);
    }
}

/// Two parts: one tetrahedron, and two with a ghost besides.
ForeignMesh six_parts(const ScratchFolder& folder, SixMesh& six) {
  ForeignMesh mesh;
  const std::string cell = six_integers({1, 2, 3, 4});
  six.read(folder.write("g.geo", kSixHead + kSixPoints + kSixPart + cell + "part 2\nx\ng_tetra4\n" +
                                     six_integers({1}) + cell + "tetra4\n" + six_integers({2}) +
                                     cell + cell),
           mesh);
  return mesh;
}

TEST(EnSight6, ValuesOfCellsStandByPartAndElement) {
  const ScratchFolder folder;
  SixMesh six;
  const ForeignMesh mesh = six_parts(folder, six);
  EXPECT_EQ(mesh.types.at(1).conversion.fate, CellFate::no_volume);
  const auto values =
      six.values(folder.write("v", "v\npart 2\ntetra4\n" + six_reals({1, 2, 3, 4, 5, 6}) +
                                       "\npart 1\ntetra4\n" + six_reals({7, 8, 9})),
                 FieldLocation::cell, 3);
  ASSERT_EQ(values.size(), 12U);
  EXPECT_EQ(values[0], 7);
  EXPECT_EQ(values[2], 9);
  EXPECT_TRUE(std::isnan(values[3]));
  EXPECT_EQ(values[6], 1);
  EXPECT_EQ(values[11], 6);
  const auto refused = [&](const std::string& text, FieldLocation location) {
    const std::string path = folder.write("w", text);
    try {
      static_cast<void>(six.values(path, location, 1));
    } catch (const InputError& error) {
      return std::string(error.what()).substr(path.size());
    }
    return std::string();
  };
  const std::string name = "a part or an element's name of the geometry expected (";
  EXPECT_EQ(refused("v\npart 3\ntetra4\n", FieldLocation::cell), ":3: " + name + "'tetra4' found)");
  EXPECT_EQ(refused("v\ntetra4\n", FieldLocation::cell), ":2: " + name + "'tetra4' found)");
  EXPECT_EQ(refused("v\npart 1\nhexa8\n", FieldLocation::cell), ":3: " + name + "'hexa8' found)");
  EXPECT_EQ(refused("v\n" + six_reals({1, 2, 3}), FieldLocation::node),
            ":2: a real in columns 37 to 48 expected ('' found)");
  EXPECT_EQ(refused("v\n1\n", FieldLocation::node),
            ":1: more values expected than the file can hold");
}

TEST(EnSight6, ValuesOfNodesStandSixALine) {
  const ScratchFolder folder;
  SixMesh six;
  static_cast<void>(six_parts(folder, six));
  const auto values = six.values(
      folder.write("v", "v\n" + six_reals({1, 2, 3, 4, 5, 6}) + six_reals({7, 8, 9, 10, 11, 12})),
      FieldLocation::node, 3);
  ASSERT_EQ(values.size(), 12U);
  for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(values[i], static_cast<double>(i + 1));
}

TEST(EnSightTypes, ElementsHaveTheirNodesAndKinds) {
  const std::vector<std::tuple<std::string, std::size_t, bool, CellKind>> rows{
      {"point", 1, false, {}},
      {"bar2", 2, false, {}},
      {"bar3", 3, false, {}},
      {"tria3", 3, false, {}},
      {"tria6", 6, false, {}},
      {"quad4", 4, false, {}},
      {"quad8", 8, false, {}},
      {"tetra4", 4, true, CellKind::tetrahedron4},
      {"tetra10", 10, true, CellKind::tetrahedron10},
      {"pyramid5", 5, true, CellKind::pyramid5},
      {"pyramid13", 13, true, CellKind::pyramid13},
      {"penta6", 6, true, CellKind::prism6},
      {"penta15", 15, true, CellKind::prism15},
      {"hexa8", 8, true, CellKind::brick8},
      {"hexa20", 20, true, CellKind::brick20}};
  ASSERT_EQ(ensight::elements().size(), rows.size());
  for (const auto& [name, nodes, solid, kind] : rows) {
    const ensight::Element& element = ensight::elements().at(name);
    EXPECT_EQ(element.nodes, nodes) << name;
    EXPECT_EQ(element.conversion.fate, solid ? CellFate::converted : CellFate::no_volume) << name;
    EXPECT_EQ(element.conversion.kind, kind) << name;
  }
}

}  // namespace
}  // namespace hiac::formats
