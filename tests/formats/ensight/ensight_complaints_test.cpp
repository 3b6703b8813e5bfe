// What cases of EnSight and their files are refused for, with the place, and what is just allowed.
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "formats/ensight/case_file.hpp"
#include "tests/formats/complaints.hpp"
#include "tests/formats/raw_bytes.hpp"
#include "tests/formats/unit_tetrahedron.hpp"

namespace hiac::formats {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// ---- the case

const std::string kCaseHead = "FORMAT\ntype: ensight gold\nGEOMETRY\nmodel: g.geo\n";

ensight::CaseFile case_file(const std::string& text) {
  const ScratchFolder folder;
  static_cast<void>(folder.write("t.txt", "0.5 1.5\n2.5\n"));
  static_cast<void>(folder.write("n.txt", "7\n8 9\n"));
  return ensight::read_case_file(folder.write("c.case", text));
}

TEST(EnSightComplaints, CasesNameTheirFilesAndTimes) {
  const auto expect = [](const std::string& text, const std::string& message) {
    const ScratchFolder folder;
    const std::string path = folder.write("c.case", text);
    std::string found;
    try {
      static_cast<void>(ensight::read_case_file(path));
    } catch (const InputError& error) {
      found = error.what();
    }
    EXPECT_EQ(found, message.empty() ? "" : path + message) << text;
  };
  expect(kCaseHead, "");
  expect("FORMAT\ntype: ensight 5\n",
         ":2: 'ensight gold' or 'ensight' expected ('ensight 5' found)");
  expect("FORMAT\ntype: ensight\n", ":3: ended before its model");
  expect("FORMAT\nkind: x\nGEOMETRY\nmodel: 1 2\n", ":4: the name of a file expected");
  expect(kCaseHead + "VARIABLE\nscalar per node: p\n", ":6: a name and its files expected");
  expect(kCaseHead + "VARIABLE\nscalar per node: p a\n", "");
  expect(kCaseHead + "VARIABLE\n\ncomplex scalar per node: p a\n",
         ":7: a name and its files expected");
  expect(kCaseHead + "VARIABLE\ncomplex vector per element: p a b\n", "");
  expect(kCaseHead + "TIME\n# c\nnumber of steps: 1\n", ":7: 'time set' expected");
  const std::string set = kCaseHead + "TIME\ntime set: 1\n";
  expect(set + "number of steps: 1\n", "");
  expect(set + "number of steps: 1000000\n", "");
  expect(set + "number of steps: 0\n", ":7: a number of steps expected");
  expect(set + "number of steps: 1000001\n", ":7: a number of steps expected");
  expect(set + "number of steps: some\n", ":7: a number of steps expected");
  expect(set + "time values: 0 x\n", ":7: a number expected ('x' found)");
  expect(set + "time values: 0\n1\n2 y\n", ":9: a number expected ('y' found)");
}

TEST(EnSightCaseFiles, NumbersOfFilesAreListedOrMade) {
  const std::string set = kCaseHead + "TIME\ntime set: 3 name\n";
  const auto made = case_file(set +
                              "number of steps: 3\nfilename start number: 5\n"
                              "filename increment: 10\ntime values: 0. 1\n2.5\n");
  ASSERT_EQ(made.time_sets.size(), 1U);
  EXPECT_EQ(made.time_sets[0].number, 3);
  EXPECT_THAT(made.time_sets[0].file_numbers, ElementsAre(5, 15, 25));
  EXPECT_THAT(made.time_sets[0].times, ElementsAre(0, 1, 2.5));
  const auto listed = case_file(set +
                                "number of steps: 3\nfilename numbers: 4\n6 9\n"
                                "time values:\n1\n2\n3\nVARIABLE\nscalar per node: p a\n");
  EXPECT_THAT(listed.time_sets.at(0).file_numbers, ElementsAre(4, 6, 9));
  EXPECT_THAT(listed.time_sets[0].times, ElementsAre(1, 2, 3));
  EXPECT_EQ(listed.variables.size(), 1U);
  const auto files = case_file(set +
                               "number of steps: 3\nfilename numbers file: n.txt\n"
                               "time values file: \"t.txt\"\n9 9\n");
  EXPECT_THAT(files.time_sets.at(0).file_numbers, ElementsAre(7, 8, 9));
  EXPECT_THAT(files.time_sets[0].times, ElementsAre(0.5, 1.5, 2.5));
}

TEST(EnSightCaseFiles, ListsEndWithTheNextEntry) {
  const std::string set = kCaseHead + "TIME\ntime set: 1\nnumber of steps: 1\n";
  const auto numbers = case_file(set + "filename numbers: 1\nnumber of steps: 1\n7 8\n");
  EXPECT_THAT(numbers.time_sets.at(0).file_numbers, ElementsAre(1));
  const auto times = case_file(set + "time values: 0.5\nfilename numbers: 1\n2\n");
  EXPECT_THAT(times.time_sets.at(0).times, ElementsAre(0.5));
  EXPECT_THAT(times.time_sets[0].file_numbers, ElementsAre(1, 2));
  for (const char* list : {"time values: 1\n", "filename numbers: 1\n"}) {
    const auto ended = case_file(set + list + "VARIABLE\n2 3\n");
    EXPECT_LE(ended.time_sets.at(0).times.size(), 1U);
    EXPECT_LE(ended.time_sets[0].file_numbers.size(), 1U);
  }
}

TEST(EnSightCaseFiles, NamesMayBeQuoted) {
  const auto model = [](const std::string& name) {
    return case_file("FORMAT\ntype: ensight gold\nGEOMETRY\nmodel: " + name + "\n").geometry;
  };
  EXPECT_EQ(model("\"g.geo\""), "g.geo");
  EXPECT_EQ(model("g.geo\""), "g.geo\"");
  EXPECT_EQ(model("\"g.geo"), "\"g.geo");
  EXPECT_EQ(model("\""), "\"");
  EXPECT_EQ(case_file("FORMAT\ntype: ensight gold\nGEOMETRY\nmodel: 3 g.geo\n").geometry_time_set,
            3);
}

TEST(EnSightCaseFiles, VariablesOfEverySort) {
  const std::vector<std::tuple<std::string, FieldLocation, std::size_t>> rows{
      {"scalar per node", FieldLocation::node, 1},
      {"scalar per element", FieldLocation::cell, 1},
      {"vector per node", FieldLocation::node, 3},
      {"vector per element", FieldLocation::cell, 3},
      {"tensor symm per node", FieldLocation::node, 6},
      {"tensor symm per element", FieldLocation::cell, 6},
      {"tensor asym per node", FieldLocation::node, 9},
      {"tensor asym per element", FieldLocation::cell, 9}};
  for (const auto& [key, location, components] : rows) {
    const auto parsed =
        case_file(kCaseHead + "VARIABLE\n" + key + ": p a\n" + key + ": 2 1 q \"b\"\n");
    ASSERT_EQ(parsed.variables.size(), 2U) << key;
    for (const auto& variable : parsed.variables) {
      EXPECT_EQ(variable.location, location) << key;
      EXPECT_EQ(variable.components, components) << key;
      EXPECT_EQ(variable.files.size(), 1U);
    }
    EXPECT_EQ(parsed.variables[0].name, "p");
    EXPECT_EQ(parsed.variables[0].time_set, std::nullopt);
    EXPECT_EQ(parsed.variables[1].name, "q");
    EXPECT_EQ(parsed.variables[1].time_set, 2);
    EXPECT_EQ(parsed.variables[1].files[0], "b");
  }
  const auto other = case_file(kCaseHead + "VARIABLE\nscalar per measured node: p a\n");
  EXPECT_THAT(other.variables, IsEmpty());
  EXPECT_THAT(other.notes, ElementsAre("left out 'scalar per measured node: p a'"));
}

TEST(EnSightCaseFiles, ComplexVariablesHaveTwoFiles) {
  const auto scalar = case_file(kCaseHead +
                                "VARIABLE\ncomplex scalar per node: p a b\n"
                                "complex scalar per element: 4 q a b 50.5\n");
  ASSERT_EQ(scalar.variables.size(), 2U);
  EXPECT_THAT(scalar.variables[0].files, ElementsAre("a", "b"));
  EXPECT_EQ(scalar.variables[0].components, 1U);
  EXPECT_EQ(scalar.variables[1].name, "q");
  EXPECT_EQ(scalar.variables[1].time_set, 4);
  EXPECT_THAT(scalar.variables[1].files, ElementsAre("a", "b"));
  EXPECT_EQ(scalar.variables[1].location, FieldLocation::cell);
  const auto vector = case_file(kCaseHead +
                                "VARIABLE\ncomplex vector per node: v a b\n"
                                "complex vector per element: w c d\n");
  ASSERT_EQ(vector.variables.size(), 4U);
  EXPECT_EQ(vector.variables[0].name, "v_r");
  EXPECT_THAT(vector.variables[0].files, ElementsAre("a"));
  EXPECT_EQ(vector.variables[1].name, "v_i");
  EXPECT_THAT(vector.variables[1].files, ElementsAre("b"));
  EXPECT_EQ(vector.variables[1].components, 3U);
  EXPECT_EQ(vector.variables[3].location, FieldLocation::cell);
}

TEST(EnSightCaseFiles, StepsOfTimesAndNamesWithStars) {
  ensight::TimeSet set;
  set.times = {1, 2, 4};
  set.file_numbers = {3, 12, 144};
  for (const auto& [time, step] : std::vector<std::pair<double, std::size_t>>{
           {0, 0}, {1, 0}, {1.5, 0}, {2, 1}, {3.9, 1}, {4, 2}, {9, 2}})
    EXPECT_EQ(set.step_at(time), step) << time;
  const auto name = [&](const std::string& pattern, std::size_t step) {
    return ensight::file_of_step("/folder/c.case", pattern, &set, step);
  };
  EXPECT_EQ(name("p.***", 0), "/folder/p.003");
  EXPECT_EQ(name("p.**.var", 1), "/folder/p.12.var");
  EXPECT_EQ(name("p.**", 2), "/folder/p.144");
  EXPECT_EQ(name("p*", 2), "/folder/p144");
  EXPECT_EQ(name("p.**", 3), "/folder/p.**");
  EXPECT_EQ(name("p", 0), "/folder/p");
  EXPECT_EQ(ensight::file_of_step("/folder/c.case", "p.*", nullptr, 0), "/folder/p.*");
  const auto parsed = case_file(kCaseHead + "TIME\ntime set: 4\ntime set: 2\n");
  EXPECT_EQ(parsed.time_set(2, "p"), &parsed.time_sets[1]);
  EXPECT_EQ(parsed.time_set(4, "p"), &parsed.time_sets[0]);
  EXPECT_EQ(parsed.time_set(3, "p*"), nullptr);
  EXPECT_EQ(parsed.time_set(std::nullopt, "p*"), &parsed.time_sets[0]);
  EXPECT_EQ(parsed.time_set(std::nullopt, "p"), nullptr);
}

// ---- the files of EnSight Gold

const std::string kGeoHead = "a\nb\nnode id off\nelement id off\n";
const std::string kGeoPart =
    "part\n1\nthe part\ncoordinates\n4\n0\n1\n0\n0\n0\n0\n1\n0\n0\n0\n0\n1\n";
const std::string kGeo = kGeoHead + kGeoPart + "tetra4\n1\n1 2 3 4\n";

/// That the file is refused so, where the case has that geometry and a variable with those values.
void expect_gold(const std::string& geometry, const std::string& values, const std::string& message,
                 const std::string& key = "scalar per node") {
  const ScratchFolder folder;
  static_cast<void>(folder.write("g.geo", geometry));
  static_cast<void>(folder.write("p.var", values));
  const std::string path = folder.write(
      "c.case", kCaseHead + (values.empty() ? "" : "VARIABLE\n" + key + ": p p.var\n"));
  EXPECT_EQ(refusal(path), message.empty() ? "" : folder.file(message)) << geometry << values;
}

TEST(EnSightComplaints, GeometriesHavePartsOfElements) {
  expect_gold(kGeo, "", "");
  expect_gold(kGeoHead + "extents\n0 1\n0 1\n0 1\n" + kGeoPart + "tetra4\n1\n1 2 3 4\n", "", "");
  expect_gold(kGeoHead + "parts\n1\n", "", "g.geo:5: 'part' expected ('parts' found)");
  expect_gold(kGeoHead + "part\n0\n", "", "g.geo:6: the number of a part expected (0 found)");
  expect_gold(kGeoHead + "part\n65536\n", "",
              "g.geo:6: the number of a part expected (65536 found)");
  expect_gold(kGeoHead + "part\n65535\n" + kGeoPart.substr(7) + "tetra4\n1\n1 2 3 4\n", "", "");
  // no elements of a type
  expect_gold(kGeoHead + kGeoPart + "tria3\n0\ntetra4\n1\n1 2 3 4\n", "", "");
  expect_gold(kGeo + "tetra5\n1\n1 2 3 4\n", "",
              "g.geo:25: an element's name expected ('tetra5' found)");
  expect_gold(kGeoHead + kGeoPart + "tetra4\n9\n1 2 3 4\n", "",
              "g.geo:23: a count that fits the file expected (at most 4; 9 found)");
  expect_gold(kGeoHead + kGeoPart + "tetra4\n-1\n1 2 3 4\n", "",
              "g.geo:23: a count that fits the file expected (at most 4; -1 found)");
  expect_gold(kGeoHead + kGeoPart + "tetra4\n4\n1 2 3 4\n", "",
              "g.geo:24: ended in a list of numbers");
}

TEST(EnSightComplaints, ElementsNameNodesOfTheirPart) {
  const auto tetrahedra = [](const std::string& nodes) {
    return kGeo + kGeoPart + "g_tria3\n1\n2 3 4\ntetra4\n1\n" + nodes + "\npoint\n1\n1\n";
  };
  expect_gold(tetrahedra("1 2 3 4"), "", "");
  expect_gold(tetrahedra("1 2 3 5"), "", "g.geo:47: tetra4 names node 5 (1 to 4 expected)");
  expect_gold(tetrahedra("0 2 3 4"), "", "g.geo:47: tetra4 names node 0 (1 to 4 expected)");
  expect_gold(tetrahedra("1 2 -3 4"), "", "g.geo:47: tetra4 names node -3 (1 to 4 expected)");
  // the line is that of the node in its list
  const auto two = [](const std::string& nodes) {
    return kGeoHead + kGeoPart + "tetra4\n2\n" + nodes;
  };
  expect_gold(two("1 2 3 4\n1 2 5 4\n"), "", "g.geo:25: tetra4 names node 5 (1 to 4 expected)");
  expect_gold(two("\n1 2 5 4\n1 2 3 4\n"), "", "g.geo:25: tetra4 names node 5 (1 to 4 expected)");
  expect_gold(two("1 2 3 4\n\n1\n2\n3\n5\n"), "",
              "g.geo:29: tetra4 names node 5 (1 to 4 expected)");
  const auto polyhedron = [](const std::string& nodes) {
    return kGeoHead + kGeoPart + "nsided\n1\n4\n1 2 3 4\nnfaced\n1\n4\n3 3 3 3\n" + nodes +
           "\npoint\n1\n1\n";
  };
  expect_gold(polyhedron("1 3 2 1 2 4 2 3 4 1 4 3"), "", "");
  expect_gold(polyhedron("1 3 2 1 2 4 2 3 4 1 4 5"), "",
              "g.geo:30: nfaced names node 5 (1 to 4 expected)");
  expect_gold(polyhedron("0 3 2 1 2 4 2 3 4 1 4 3"), "",
              "g.geo:30: nfaced names node 0 (1 to 4 expected)");
  expect_gold(kGeoHead + kGeoPart + "nfaced\n1\n-4\n3 3 3 3\n", "",
              "g.geo:24: a number of nodes expected");
  expect_gold(kGeoHead + kGeoPart + "nfaced\n1\n4\n3 3\n-3 3\n", "",
              "g.geo:26: a number of nodes expected");
  expect_gold(kGeoHead + kGeoPart + "nsided\n1\n9\n3 3 3 3\n", "",
              "g.geo:25: ended in a list of numbers");
}

TEST(EnSightComplaints, ValuesAreOfThePartsThatThereAre) {
  const std::string all = "p\npart\n1\ncoordinates\n1\n2\n3\n4\n";
  expect_gold(kGeo, all, "");
  expect_gold(kGeo, "p\n\npart\n1\ncoordinates\n1\n2\n3\n4\n\n", "");
  expect_gold(kGeo, "p\ncoordinates\n1\n", "p.var:2: 'part' expected ('coordinates' found)");
  expect_gold(kGeo, "p\npart\n2\ncoordinates\n1\n",
              "p.var:3: the number of a part of the geometry expected");
  expect_gold(kGeo, "p\npart\n1\ntetra4\n1\n",
              "p.var:4: 'coordinates' or 'block' expected ('tetra4' found)");
  expect_gold(kGeo, "p\npart\n1\ncoordinates\n1\n", "p.var:5: ended in a list of numbers");
  expect_gold(kGeo, "p\npart\n1\ntetra4\n7\n", "", "scalar per element");
  expect_gold(kGeo, "p\npart\n1\nhexa8\n7\n",
              "p.var:4: an element's name of the part expected ('hexa8' found)",
              "scalar per element");
  expect_gold(kGeo, "p\npart\n1\nhexa8 undef\n-1e9\n7\n",
              "p.var:4: an element's name of the part expected ('hexa8 undef' found)",
              "scalar per element");
  expect_gold(kGeo, "p\npart\n1\ncoordinates\n1\n2\nx\n4\n",
              "p.var:7: not understood (a number expected, 'x' found)");
}

TEST(EnSightComplaints, PartialValuesHavePlacesInThePart) {
  const auto partial = [](const std::string& place) {
    return "p\npart\n1\ncoordinates partial\n2\n1\n" + place + "\n8.5\n7.5\n";
  };
  expect_gold(kGeo, partial("4"), "");
  expect_gold(kGeo, partial("5"), "p.var:7: a place of partial values (1 to 4 expected, 5 found)");
  expect_gold(kGeo, partial("0"), "p.var:7: a place of partial values (1 to 4 expected, 0 found)");
  expect_gold(kGeo, "p\npart\n1\ncoordinates partial\n0\npart\n1\ncoordinates\n1\n2\n3\n4\n", "");
  expect_gold(kGeo, "p\npart\n1\ntetra4 partial\n1\n2\n8.5\n",
              "p.var:6: a place of partial values (1 to 1 expected, 2 found)",
              "scalar per element");
}

TEST(EnSightValues, UndefinedOnesAreNone) {
  const ScratchFolder folder;
  static_cast<void>(folder.write("g.geo", kGeo));
  static_cast<void>(
      folder.write("p.var", "p\npart\n1\ncoordinates undef\n-1e9\n5\n-1e9\n7\n-1e8\n"));
  const std::string path =
      folder.write("c.case", kCaseHead + "VARIABLE\nscalar per node: p p.var\n");
  const Inventory inventory = format_named("ensight").inspect(path);
  EXPECT_EQ(inventory.points, 4U);
  EXPECT_EQ(inventory.fields.at(0).type, "float");
  const ZooMesh mesh = read_any(path).mesh;
  const auto values = mesh.fields.at(0).values.view();
  EXPECT_EQ(values[0], 5);
  EXPECT_TRUE(std::isnan(values[1]));
  EXPECT_EQ(values[2], 7);
  EXPECT_EQ(values[3], -1e8);
}

// Solvers write some variables at some steps only.
TEST(EnSightSteps, VariablesMayLackFilesOfSomeSteps) {
  const ScratchFolder folder;
  static_cast<void>(folder.write("g.geo", kGeo));
  const auto values = [](int first) {
    return fmt::format("p\npart\n1\ncoordinates\n{}\n{}\n{}\n{}\n", first, first + 1, first + 2,
                       first + 3);
  };
  static_cast<void>(folder.write("p.0", values(10)));
  static_cast<void>(folder.write("q.0", values(20)));
  static_cast<void>(folder.write("q.1", values(30)));
  const std::string path = folder.write(
      "c.case", kCaseHead +
                    "VARIABLE\nscalar per node: 1 p p.*\nscalar per node: 1 q q.*\nTIME\n"
                    "time set: 1\nnumber of steps: 2\nfilename start number: 0\n"
                    "filename increment: 1\ntime values: 0.5 1.5\n");
  const Reading last = read_any(path);
  ASSERT_EQ(last.mesh.fields.size(), 1U);
  EXPECT_EQ(last.mesh.fields[0].name, "q");
  EXPECT_THAT(last.mesh.fields[0].values.view(), ElementsAre(30, 31, 32, 33));
  EXPECT_THAT(last.notes, testing::Contains(
                              "field 'p' is absent at step 1, time 1.5: it has values at step 0"));
  ReadOptions options;
  options.step = 0;
  const ZooMesh first = read_any(path, options).mesh;
  ASSERT_EQ(first.fields.size(), 2U);
  EXPECT_THAT(first.fields[0].values.view(), ElementsAre(10, 11, 12, 13));
  // a variable without any file
  std::filesystem::remove(folder.file("p.0"));
  EXPECT_THAT(refusal(path), testing::StartsWith(folder.file("p.1")));
}

// Every set has its own steps; between two of them, the earlier one holds.
TEST(EnSightSteps, OfSeveralSetsAreTheTimesOfAll) {
  const ScratchFolder folder;
  static_cast<void>(folder.write("g.geo", kGeo));
  for (int file = 1; file <= 3; ++file)
    static_cast<void>(
        folder.write(fmt::format("p.{}", file),
                     fmt::format("p\npart\n1\ncoordinates\n{0}\n{0}\n{0}\n{0}\n", file)));
  const std::string path = folder.write(
      "c.case", kCaseHead +
                    "VARIABLE\nscalar per node: 2 p p.*\nTIME\ntime set: 1\nnumber of steps: 2\n"
                    "time values: 0 3\ntime set: 2\nnumber of steps: 3\nfilename numbers: 1 2 3\n"
                    "time values: 1 2 3\n");
  EXPECT_THAT(format_named("ensight").inspect(path).times, ElementsAre(0, 1, 2, 3));
  for (const auto& [step, value] :
       std::vector<std::pair<std::size_t, double>>{{0, 1}, {1, 1}, {2, 2}, {3, 3}}) {
    ReadOptions options;
    options.step = step;
    EXPECT_EQ(read_any(path, options).mesh.fields.at(0).values[0], value) << step;
  }
}

TEST(EnSightBlocks, BlankPointsHideTheirCells) {
  const ScratchFolder folder;
  const std::string path =
      folder.write("c.case", kCaseHead + "VARIABLE\nscalar per element: p p.var\n");
  std::string block = kGeoHead + "part\n1\nx\nblock iblanked\n4 2 2\n";
  for (const int axis : {0, 1, 2})
    for (int n = 0; n < 16; ++n)
      block += fmt::format("{}\n", axis == 0 ? n % 4 : axis == 1 ? n / 4 % 2 : n / 8);
  // the middle cell lies at a blank point
  for (int n = 0; n < 16; ++n) block += fmt::format("{}\n", n == 1 ? 0 : 1);
  static_cast<void>(folder.write("g.geo", block));
  static_cast<void>(folder.write("p.var", "p\npart\n1\nblock\n7\n8\n9\n"));
  const ZooMesh mesh = read_any(path).mesh;
  ASSERT_EQ(mesh.cell_count(), 1U);
  EXPECT_EQ(mesh.position(mesh.cell_nodes(0)[0])[0], 2);
  EXPECT_THAT(mesh.fields.at(0).values.view(), ElementsAre(9));
}

// ---- binary files

std::string gold_text(std::string words) {
  words.resize(80, ' ');
  return words;
}
std::string gold_binary(const std::string& rest) {
  std::string text;
  for (const char* line : {"C Binary", "a", "b", "node id off", "element id off", "part"})
    text += gold_text(line);
  return text + raw_bytes<std::int32_t>({1}) + gold_text("x") + gold_text("coordinates") + rest;
}

TEST(EnSightComplaints, BinaryFilesEndWhereTheyAreRead) {
  const std::string points =
      raw_bytes<std::int32_t>({4}) + raw_bytes<float>({0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
  const std::string cell = gold_text("tetra4") + raw_bytes<std::int32_t>({1, 1, 2, 3, 4});
  // 480 bytes of texts, a number, two texts, a number, twelve floats
  expect_gold(gold_binary(points + cell), "", "");
  expect_gold(gold_binary(points + "tetra4"), "", "g.geo: byte 696: ended in a text");
  expect_gold(gold_binary(points + gold_text("tetra4").substr(1)), "",
              "g.geo: byte 696: ended in a text");
  expect_gold(gold_binary("\4"), "", "g.geo: byte 644: ended in a list of numbers");
  expect_gold(gold_binary(points.substr(0, 51)), "", "g.geo: byte 680: ended in a list of numbers");
  expect_gold(gold_binary(points.substr(0, 15)), "",
              "g.geo: byte 648: a count that fits the file expected (at most 2; 4 found)");
  expect_gold(gold_binary(points + gold_text("tetra4") + raw_bytes<std::int32_t>({2, 1, 2, 3, 4})),
              "", "g.geo: byte 780: a count that fits the file expected (at most 1; 2 found)");
  expect_gold(gold_binary(points + gold_text("tetra5")), "",
              "g.geo: byte 776: an element's name expected ('tetra5' found)");
}

TEST(EnSightComplaints, RecordsOfFortranHaveTwoMarks) {
  const auto record = [](const std::string& data) {
    const std::string mark = raw_bytes<std::int32_t>({static_cast<std::int32_t>(data.size())});
    return mark + data + mark;
  };
  const std::string head = record(gold_text("Fortran Binary"));
  const std::string said = "a record between two marks of its length expected";
  expect_gold(head + "1234567", "", "g.geo: byte 88: " + said);
  expect_gold(head + record("12").substr(0, 9), "", "g.geo: byte 88: " + said);
  expect_gold(head + raw_bytes<std::int32_t>({2}) + "12" + raw_bytes<std::int32_t>({3}), "",
              "g.geo: byte 88: " + said);
  expect_gold(head + raw_bytes<std::int32_t>({-2, 7, 7}), "", "g.geo: byte 88: " + said);
  // the last record may be empty
  expect_gold(head + record(""), "", "g.geo: byte 80: ended in a text");
  expect_gold(head + record("") + record(std::string(9, ' ')), "",
              "g.geo: byte 80: ended in a text");
}

}  // namespace
}  // namespace hiac::formats
