// Blocks of .frd files in their columns: what they are refused for, with the line, and what is just
// allowed; lines that go on, materials, steps, and binary blocks to the last byte.
#include <cmath>

#include <fmt/format.h>

#include "hiac/mesh/shape_functions.hpp"
#include "tests/formats/complaints.hpp"
#include "tests/formats/field_named.hpp"
#include "tests/formats/raw_bytes.hpp"
#include "tests/formats/unit_tetrahedron.hpp"

namespace hiac::formats {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::IsNan;

std::string frd_head(const std::string& key, const std::string& count,
                     const std::string& encoding) {
  return fmt::format("{:24}{:>12}{:37}{:2}\n", "    " + key, count, "", encoding);
}

std::string frd_values(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += fmt::format("{:12.5E}", value);
  return text + "\n";
}

std::string frd_four_nodes() {
  std::string text = frd_head("2C", "4", "1");
  for (int n = 1; n <= 4; ++n)
    text += fmt::format(" -1{:10}", n) +
            frd_values({n == 2 ? 1.0 : 0.0, n == 3 ? 1.0 : 0.0, n == 4 ? 1.0 : 0.0});
  return text + " -3\n";
}

std::string frd_element(int number, int type, const std::string& material,
                        const std::vector<int>& nodes) {
  std::string text = fmt::format(" -1{:10}{:5}{:5}{:>5}", number, type, 0, material);
  for (std::size_t n = 0; n < nodes.size(); ++n)
    text += fmt::format("{}{:10}", n % 10 == 0 ? "\n -2" : "", nodes[n]);
  return text + "\n";
}

/// Lines 1 to 7 and 8 to 11.
const std::string kFrdNodes = "    1C\n" + frd_four_nodes();
const std::string kFrdMesh =
    kFrdNodes + frd_head("3C", "1", "1") + frd_element(9, 3, "1", {1, 2, 3, 4}) + " -3\n";

/// The lines before the values of a result.
std::string frd_result_head(const std::string& time, const std::string& count, int number,
                            const std::string& encoding, const std::string& name, int components) {
  std::string text = fmt::format("{:12}{:>12}{:>12}{:20} 0{:5}{:10}{:>2}\n", "  100CL  101", time,
                                 count, "", number, "", encoding);
  text += fmt::format(" -4  {:8}{:5}    1\n", name, components);
  for (int c = 0; c < components; ++c)
    text += fmt::format(" -5  {:8}{:5}{:5}{:5}    0\n", c, 1, 2, 1);
  return text;
}

TEST(FrdComplaints, BlocksAreOfNodesElementsAndResults) {
  const auto block = [](const std::string& line) {
    return Complaint{kFrdMesh + line + "\n",
                     ":12: a block '    2C', '    3C' or '  100C' expected ('" + line + "' found)"};
  };
  expect_complaints(
      "a.frd",
      {{kFrdMesh, ""},
       {kFrdMesh + " 9999\nx\n", ""},
       {kFrdMesh + "\n  \n    1Uuser\n    1PSTEP\n", ""},
       block("    4C"),
       block("    2D"),
       block("    2"),
       block("   1xC"),
       {"    1C\n 9999\n", ":3: the file ends too early (a block of nodes, '    2C' expected)"},
       {kFrdNodes, ":8: the file ends too early (a block of elements, '    3C' expected)"}});
}

TEST(FrdComplaints, HeadsTellTheNumberOfRecordsAndTheFormat) {
  const auto nodes = [](const std::string& count, const std::string& encoding) {
    return kFrdMesh + frd_head("2C", count, encoding) + " -3\n";
  };
  const std::string number = ":12: a number of records in columns 25 to 36 expected (";
  const std::string format = ":12: a format number 0 to 3 in columns 74 and 75 expected (";
  expect_complaints("a.frd", {{nodes("4", "0"), ""},
                              {nodes("", "1"), ""},
                              {nodes("4", ""), ""},
                              {nodes("x", "1"), number + "'           x' found)"},
                              {nodes("-1", "1"), number + "'          -1' found)"},
                              {nodes("", "2"), number + "'            ' found)"},
                              {nodes("4", "4"), format + "'4 ' found)"},
                              {nodes("4", "-1"), format + "'-1' found)"},
                              {nodes("4", "x"), format + "'x ' found)"}});
}

TEST(FrdComplaints, RecordsHaveANumberAndValues) {
  const auto nodes = [](const std::string& lines, const std::string& encoding = "1") {
    return kFrdMesh + frd_head("2C", "1", encoding) + lines;
  };
  const std::string rest = frd_values({1, 2, 3});
  expect_complaints(
      "a.frd",
      {{nodes(" -1         7" + rest + " -3\n"), ""},
       {nodes("\n -1         7" + rest + "   \n -3\n"), ""},
       {nodes(" -1    7" + rest + " -3\n", "0"), ""},
       {nodes(" -1         7" + rest), ":14: the file ends too early (' -3' expected)"},
       {nodes(" -2         7" + rest + " -3\n"),
        ":13: a record ' -1' or ' -3' expected (' -2         7 1.00000E+00 2.00000E+00 3....' "
        "found)"},
       {nodes("   x\n -3\n"), ":13: a record ' -1' or ' -3' expected ('   x' found)"},
       {nodes(" -1       7.x" + rest + " -3\n"),
        ":13: a number in columns 4 to 13 expected ('       7.x' found)"},
       {nodes(" -1   7x" + rest + " -3\n", "0"),
        ":13: a number in columns 4 to 8 expected ('   7x' found)"},
       {nodes(" -1         7 1.00000E+00 2.0000xE+00 3.00000E+00\n -3\n"),
        ":13: a value of 12 columns expected (' 2.0000xE+00' found)"},
       {nodes(" -1         7 1.00000E+00 2.00000E+00\n -3\n"),
        ":13: a value of 12 columns expected ('' found)"}});
}

TEST(FrdComplaints, ElementsHaveTheNodesOfTheirTypes) {
  const auto element = [](const std::string& lines) {
    return kFrdNodes + frd_head("3C", "1", "1") + lines + " -3\n";
  };
  const std::string first = " -1         9    3    0    1\n";
  expect_complaints("a.frd",
                    {{element(first + " -2         1         2         3         4\n"), ""},
                     {element(first + " -1         1         2         3         4\n"),
                      ":10: the nodes of element 9 (' -2') expected (' -1         1         2      "
                      "   3       ...' "
                      "found)"},
                     {element(first), ":10: the nodes of element 9 (' -2') expected (' -3' found)"},
                     {element(first + " -2         1         2         3\n"),
                      ":9: an integer of 0 columns expected ('' found)"},
                     {element(first + " -2         1         x         3         4\n"),
                      ":9: an integer of 10 columns expected ('         x' found)"},
                     {element(" -1         x    3    0    1\n"),
                      ":9: an integer of 10 columns expected ('         x' found)"},
                     {element(" -1         9    t    0    1\n"),
                      ":9: an integer of 5 columns expected ('    t' found)"}});
}

TEST(FrdComplaints, ResultsHaveATimeANameAndComponents) {
  const auto result = [](const std::string& time, const std::string& lines) {
    return kFrdMesh + fmt::format("{:12}{:>12}{:12}{:37} 1\n", "  100CL  101", time, 0, "") +
           lines + " -3\n";
  };
  const auto components = [](int announced, int there) {
    std::string text = fmt::format(" -4  T       {:5}    1\n", announced);
    for (int c = 0; c < there; ++c) text += " -5  T           1    1    0    0\n";
    return text;
  };
  const auto head = [](const std::string& found) {
    return ":13: the name and number of components (' -4') expected ('" + found + "' found)";
  };
  expect_complaints(
      "a.frd",
      {{result("0.5", components(1, 1)), ""},
       {result("x", components(1, 1)),
        ":12: a time in columns 13 to 24 expected ('           x' found)"},
       {result("", components(1, 1)),
        ":12: a time in columns 13 to 24 expected ('            ' found)"},
       {result("inf", components(1, 1)),
        ":12: a time in columns 13 to 24 expected ('         inf' found)"},
       {result("0.5", components(0, 0)), ""},
       {result("0.5", components(200, 200)), ""},
       {result("0.5", components(201, 201)), head(" -4  T         201    1")},
       {result("0.5", components(-1, 0)), head(" -4  T          -1    1")},
       {result("0.5", " -4  T           x    1\n"), head(" -4  T           x    1")},
       {result("0.5", " -5  T           1    1\n"), head(" -5  T           1    1")},
       {result("0.5", components(2, 1)), ":15: a component (' -5') expected (' -3' found)"},
       {kFrdMesh + frd_result_head("0.5", "1", 1, "1", "T", 1) + " -1         1 1.00000E+00\n",
        ":15: the file ends too early (' -3' expected)"}});
}

TEST(FrdResults, GoOnInFurtherLines) {
  const ScratchFolder folder;
  std::string text = kFrdMesh + frd_result_head("0.5", "3", 1, "1", "P", 8);
  text += " -1         2" + frd_values({1, 2, 3, 4, 5, 6}) + " -2          " + frd_values({7, 8});
  text += " -1         3" + frd_values({1, 2, 3, 4, 5, 6e-100}) + " -2          " +
          frd_values({-7e100, 8});
  text +=
      " -1         4 1.00000E+00         NaN    Infinity************         inf 6.00000E+00\n" +
      (" -2          " + frd_values({7, 8})) + " -3\n";
  const ZooMesh mesh = read_any(folder.write("a.frd", text)).mesh;
  const auto values = field_named(mesh, "P").values.view();
  ASSERT_EQ(values.size(), 32U);
  EXPECT_THAT(values.first(8), testing::Each(IsNan()));
  EXPECT_THAT(values.subspan(8, 8), ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
  EXPECT_THAT(values.subspan(16, 8), ElementsAre(1, 2, 3, 4, 5, 6e-100, -7e100, 8));
  EXPECT_EQ(values[24], 1);
  EXPECT_THAT(values[25], IsNan());
  EXPECT_FALSE(std::isfinite(values[26]));
  EXPECT_THAT(values[27], IsNan());
  EXPECT_EQ(values[29], 6);
  const std::string wrong = kFrdMesh + frd_result_head("0.5", "1", 1, "1", "P", 7) +
                            " -1         2" + frd_values({1, 2, 3, 4, 5, 6});
  expect_complaints("a.frd", {{wrong + " -1          " + frd_values({7}) + " -3\n",
                               ":22: a continuation ' -2' expected (' -1           7.00000E+00' "
                               "found)"}});
}

// The edges of cgx's brick go round the bottom, up the sides and round the top.
TEST(FrdElements, OfShortTextHaveFifteenNodesALine) {
  const ScratchFolder folder;
  const auto corners = reference_nodes(CellKind::brick8);
  std::vector<std::array<double, 3>> places(corners.begin(), corners.end());
  for (const auto& [a, b] : std::vector<std::array<std::size_t, 2>>{{0, 1},
                                                                    {1, 2},
                                                                    {2, 3},
                                                                    {3, 0},
                                                                    {0, 4},
                                                                    {1, 5},
                                                                    {2, 6},
                                                                    {3, 7},
                                                                    {4, 5},
                                                                    {5, 6},
                                                                    {6, 7},
                                                                    {7, 4}})
    places.push_back({(corners[a][0] + corners[b][0]) / 2, (corners[a][1] + corners[b][1]) / 2,
                      (corners[a][2] + corners[b][2]) / 2});
  std::string text = "    1C\n" + frd_head("2C", "20", "0");
  std::string element = " -1    7    4    0    1";
  for (std::size_t n = 0; n < 20; ++n) {
    const std::size_t number = 90000 - 7 * n;
    text += fmt::format(" -1{:5}", number) + frd_values({places[n].begin(), places[n].end()});
    element += fmt::format("{}{:5}", n % 15 == 0 ? "\n -2" : "", number);
  }
  text += " -3\n" + frd_head("3C", "1", "0") + element;
  const ZooMesh mesh = read_any(folder.write("a.frd", text + "\n -3\n 9999\n")).mesh;
  ASSERT_EQ(mesh.kinds[0], CellKind::brick20);
  const auto reference = reference_nodes(CellKind::brick20);
  for (std::size_t n = 0; n < 20; ++n)
    EXPECT_THAT(mesh.position(mesh.cell_nodes(0)[n]),
                ElementsAre(reference[n][0], reference[n][1], reference[n][2]));
  EXPECT_THAT(refusal(folder.write("a.frd", text.substr(0, text.rfind(" -2")) + " -3\n")),
              testing::HasSubstr("the nodes of element 7 (' -2') expected"));
}

TEST(FrdElements, OfOneMaterialAreABlock) {
  const ScratchFolder folder;
  std::string text = kFrdNodes + frd_head("3C", "6", "1");
  int number = 0;
  for (const char* material : {"2", "2", "", "STEEL", "2", "0"})
    text += frd_element(++number, 3, material, {1, 2, 3, 4});
  const std::string path = folder.write("a.frd", text + " -3\n");
  EXPECT_THAT(format_named("frd").inspect(path).blocks,
              ElementsAre("material 0", "material 2", "material STEEL"));
  for (const auto& [block, cells] : std::vector<std::pair<std::string, std::size_t>>{
           {"material 0", 2}, {"material 2", 3}, {"material STEEL", 1}}) {
    ReadOptions options;
    options.block = block;
    EXPECT_EQ(read_any(path, options).mesh.cell_count(), cells) << block;
  }
}

TEST(FrdResults, OfOneTimeNumberAndNameAreSeveralSteps) {
  const ScratchFolder folder;
  const auto result = [](const std::string& time, int number, const std::string& name) {
    return frd_result_head(time, "1", number, "1", name, 1) + " -1         1 1.00000E+00\n -3\n";
  };
  const auto times = [&](const std::string& results) {
    return format_named("frd").inspect(folder.write("a.frd", kFrdMesh + results)).times;
  };
  EXPECT_THAT(times(result("0.5", 1, "A") + result("0.5", 1, "B")), ElementsAre(0.5));
  EXPECT_THAT(times(result("0.5", 1, "A") + result("0.5", 1, "A")), ElementsAre(0.5, 0.5));
  EXPECT_THAT(times(result("0.5", 1, "A") + result("0.5", 2, "B")), ElementsAre(0.5, 0.5));
  EXPECT_THAT(times(result("0.5", 1, "A") + result("1.5", 1, "A") + result("0.5", 1, "B")),
              ElementsAre(0.5, 1.5));
  // a result that cgx computes from others has no values of its own
  std::string computed = frd_result_head("7", "0", 1, "1", "C", 1);
  computed.insert(computed.size() - 1, "    1ALL");
  EXPECT_THAT(times(computed + " -3\n"), ElementsAre());
}

std::string frd_binary_mesh(int beams) {
  std::string text = "    1C\n" + frd_head("2C", "4", "2");
  for (int n = 1; n <= 4; ++n)
    text += raw_bytes<std::int32_t>({n}) +
            raw_bytes<float>({n == 2 ? 1.0F : 0.0F, n == 3 ? 1.0F : 0.0F, n == 4 ? 1.0F : 0.0F});
  text += frd_head("3C", std::to_string(beams + 1), "2") +
          raw_bytes<std::int32_t>({1, 3, 0, 7, 1, 2, 3, 4});
  for (int beam = 0; beam < beams; ++beam)
    text += raw_bytes<std::int32_t>({beam + 2, 11, 0, 8, 1, 2});
  return text;
}

TEST(FrdBinary, BlocksReachToTheLastByte) {
  const ScratchFolder folder;
  for (const int beams : {0, 1, 60}) {
    const std::string path = folder.write("a.frd", frd_binary_mesh(beams));
    expect_unit_tetrahedron(read_any(path).mesh);
    EXPECT_EQ(format_named("frd").inspect(path).blocks.size(), beams == 0 ? 1U : 2U);
  }
  const std::string ends = frd_binary_mesh(1);
  EXPECT_THAT(refusal(folder.write("a.frd", ends.substr(0, ends.size() - 1))),
              testing::HasSubstr("the file ends within an element (4 bytes expected, 3 found)"));
  std::string more = "    1C\n" + frd_head("2C", "5", "2") + std::string(79, '\0');
  EXPECT_THAT(refusal(folder.write("a.frd", more)),
              testing::HasSubstr(":3: 5 records announced, more than the file can hold"));
  more = kFrdNodes + frd_head("3C", "3", "2") + std::string(47, '\0');
  EXPECT_THAT(refusal(folder.write("a.frd", more)),
              testing::HasSubstr(":9: 3 records announced, more than the file can hold"));
}

TEST(FrdBinary, ResultsOfFloatsAndDoubles) {
  const ScratchFolder folder;
  for (const bool wide : {false, true}) {
    std::string values;
    for (const int node : {2, 9, 4}) {
      values += raw_bytes<std::int32_t>({node});
      for (const double value : {0.5 * node, 1.0 + node})
        values += wide ? raw_bytes<double>({value}) : raw_bytes<float>({static_cast<float>(value)});
    }
    const std::string head = frd_result_head("0.5", "3", 1, wide ? "3" : "2", "P", 2);
    const Reading reading = read_any(folder.write("a.frd", kFrdMesh + head + values));
    EXPECT_THAT(field_named(reading.mesh, "P").values.view(),
                ElementsAre(IsNan(), IsNan(), 1, 3, IsNan(), IsNan(), 2, 5));
    EXPECT_THAT(reading.notes,
                ElementsAre("left out values of 1 nodes that the file does not have, the first of "
                            "them is node 9"));
    EXPECT_THAT(
        refusal(folder.write("a.frd", kFrdMesh + head + values.substr(0, values.size() - 1))),
        testing::HasSubstr(":16: 3 records announced, more than the file can hold"));
  }
  EXPECT_THAT(read_any(folder.write("a.frd", kFrdMesh)).notes, IsEmpty());
}

}  // namespace
}  // namespace hiac::formats
