// Indices of PLOT3D files and sizes of theirs: what is refused, and what is just allowed.
#include <filesystem>

#include <fmt/format.h>

#include "formats/plot3d/index_file.hpp"
#include "formats/plot3d/sections.hpp"
#include "tests/formats/complaints.hpp"
#include "tests/formats/raw_bytes.hpp"

namespace hiac::formats {
namespace {

using testing::ElementsAre;

const std::string kCubeText = "2 2 2\n0 1 0 1 0 1 0 1\n0 0 1 1 0 0 1 1\n0 0 0 0 1 1 1 1\n";

TEST(Plot3dIndices, NameStepsWithGrids) {
  const std::string whole = ": is no whole JSON object (an index of PLOT3D files expected)";
  const std::string list = ": names no files (a list under 'filenames' expected)";
  const auto step = [](int number) {
    return fmt::format(": step {} names no grid (a name under 'xyz' expected)", number);
  };
  expect_complaints("a.p3d",
                    {{R"({"filenames": [{"xyz": "g.x"}])", whole},
                     {R"({"filenames": [)", whole},
                     {R"({"filenames": {}})", list},
                     {R"({"filenames": []})", list},
                     {R"({"filenames": {"a": {"xyz": "g.x"}}})", list},
                     {R"({"filenames": "g.x"})", list},
                     {R"({"files": "filenames", "a": {"filenames": 1}})", list},
                     {R"({"filenames": [{}]})", step(0)},
                     {R"({"filenames": [{"xyz": "g.x"}, {"time": 1, "q": "g.q"}]})", step(1)},
                     {R"({"filenames": [{"xyz": 1}]})", step(0)},
                     {R"({"filenames": [1]})", step(0)},
                     {R"({"filenames": ["g.x"]})", step(0)}});
}

TEST(Plot3dIndices, StepsComeInTheOrderOfTheirTimes) {
  const ScratchFolder folder;
  const std::string path = folder.write(
      "a.p3d", R"( {"filenames": [{"time": 2.5, "xyz": "b.x", "q": "b.q", "function": "b.f"},
                                {"time": "late", "xyz": "a.x"}, {"xyz": "c.x", "time": 0}],
                  "function-names": ["p", 7, "T"]})");
  const auto files = plot3d::files_of(path);
  ASSERT_EQ(files.steps.size(), 3U);
  EXPECT_EQ(files.steps[0].grid, folder.file("a.x"));
  EXPECT_EQ(files.steps[0].q, "");
  EXPECT_EQ(files.steps[1].grid, folder.file("c.x"));
  EXPECT_EQ(files.steps[2].time, 2.5);
  EXPECT_EQ(files.steps[2].grid, folder.file("b.x"));
  EXPECT_EQ(files.steps[2].q, folder.file("b.q"));
  EXPECT_EQ(files.steps[2].function, folder.file("b.f"));
  EXPECT_THAT(files.function_names, ElementsAre("p", "T"));
  static_cast<void>(
      folder.write("b.p3d", R"({"filenames": [{"xyz": "b.x"}], "function-names": {"a": "p"}})"));
  EXPECT_TRUE(plot3d::files_of(folder.file("b.p3d")).function_names.empty());
}

TEST(Plot3dIndices, StepsAreReadByTheirTimes) {
  const ScratchFolder folder;
  static_cast<void>(folder.write("g.x", kCubeText));
  for (const int step : {1, 2})
    static_cast<void>(folder.write(fmt::format("{}.f", step),
                                   fmt::format("2 2 2 2\n8*{} 8*{}\n", step, 10 * step)));
  const std::string path =
      folder.write("a.p3d", R"({"filenames": [{"time": 1.5, "xyz": "g.x", "function": "2.f"},
                               {"time": 0.5, "xyz": "g.x", "function": "1.f"}],
                 "function-names": ["p"]})");
  EXPECT_THAT(format_to_read(path).inspect(path).times, ElementsAre(0.5, 1.5));
  const ZooMesh last = read_any(path).mesh;
  ASSERT_EQ(last.fields.size(), 2U);
  EXPECT_EQ(last.fields[0].name, "p");
  EXPECT_EQ(last.fields[1].name, "Function1");
  EXPECT_EQ(last.fields[1].values[7], 20);
  ReadOptions options;
  options.time = 0.5;
  EXPECT_EQ(read_any(path, options).mesh.fields[1].values[0], 10);
  static_cast<void>(folder.write("b.p3d", R"({"filenames": [{"time": 1.5, "xyz": "g.x"}]})"));
  EXPECT_EQ(read_any(folder.file("b.p3d")).mesh.cell_count(), 1U);
  EXPECT_TRUE(format_named("plot3d").inspect(folder.file("b.p3d")).times.empty());
}

TEST(Plot3dIndices, AreToldByTheirFirstCharacter) {
  EXPECT_TRUE(plot3d::may_be_index(" \t\r\n{\"filenames\": []}"));
  EXPECT_FALSE(plot3d::may_be_index("[{\"filenames\": []}]"));
  EXPECT_FALSE(plot3d::may_be_index("{\"files\": []}"));
  EXPECT_FALSE(plot3d::may_be_index("  "));
}

TEST(Plot3dFiles, LieBesideTheirGrids) {
  const ScratchFolder folder;
  const auto files = [&](const std::string& grid) {
    return plot3d::files_of(folder.write(grid, kCubeText)).steps.at(0);
  };
  static_cast<void>(folder.write("a.q", "x"));
  static_cast<void>(folder.write("a.f", "x"));
  EXPECT_EQ(files("a.x").q, folder.file("a.q"));
  EXPECT_EQ(files("a.x").function, folder.file("a.f"));
  EXPECT_EQ(files("b.x").q, "");
  EXPECT_EQ(files("b.x").grid, folder.file("b.x"));
  static_cast<void>(folder.write("1q2.bin", "x"));
  EXPECT_EQ(files("1xyz2.bin").q, folder.file("1q2.bin"));
  EXPECT_EQ(files("1xyz2.bin").function, "");
  // the last "xyz" of the name counts
  static_cast<void>(folder.write("xyzf.bin", "x"));
  EXPECT_EQ(files("xyzxyz.bin").function, folder.file("xyzf.bin"));
  // a file is not its own solution
  static_cast<void>(folder.write("c.f", kCubeText));
  EXPECT_EQ(files("c.f").function, "");
}

const std::string kNoGrid = ": is no whole PLOT3D grid (its size fits no dialect)";

TEST(Plot3dComplaints, GridsAreAsLongAsTheirExtentsSay) {
  const std::string numbers = "0 1 0 1 0 1 0 1 0 0 1 1 0 0 1 1 0 0 0 0 1 1 1 1";
  const auto repeated = [](int times) { return fmt::format("2 2 2 {}*0.5 1", times); };
  expect_complaints("a.p3dfmt",
                    {{kCubeText, ""},
                     {"2 2 2\n0 1 0 1, 0,1,\n0 1 0 0 1 1 0 0 1 1 0 0 0 0 1 1 1 1", ""},
                     {"1 2 2 2 " + numbers, ""},
                     {"2 2 2 " + numbers + " 1 1 1 1 1 1 1 1", ""},
                     {"2 2 2 +0 1 0 1d0 0 1.D0 0 1e+0 0 0 1 1 0 0 1 1 0 0 0 0 1 1 1 1", ""},
                     {"2 2 2 " + numbers + " 1", kNoGrid},
                     {"2 2 2 " + numbers.substr(2), kNoGrid},
                     {"2 2 2 0 1 0 1 x" + numbers.substr(9), kNoGrid},
                     {"0 2 2 2 " + numbers, kNoGrid},
                     {"2 2 0 " + numbers, kNoGrid},
                     {"2  1 1 1  1 1", kNoGrid},
                     {"3 1 1 1 1 1 1 1 1 1 1 1 1", kNoGrid},
                     {"2 2 -2 " + numbers, kNoGrid},
                     {"9999999 9999999 9999999 " + numbers, kNoGrid},
                     {"2 2 2 0.5*3 " + numbers, kNoGrid},
                     {"2 2 2 3* " + numbers, kNoGrid},
                     {"2 2 2 1e " + numbers, kNoGrid},
                     {repeated(999), kNoGrid}});
  const ScratchFolder folder;
  const auto grid = plot3d::read_grid(folder.write("a.x", "2 2 1 1 1 1 1 3*5 2*7 3*-8.5 0"));
  ASSERT_EQ(grid.blocks.size(), 2U);
  EXPECT_THAT(grid.blocks[0], ElementsAre(2, 1, 1));
  EXPECT_THAT(grid.coordinates[0], ElementsAre(5, 5, 5, 7, 7, -8.5));
  EXPECT_THAT(grid.coordinates[1], ElementsAre(-8.5, -8.5, 0));
  EXPECT_TRUE(grid.iblank.empty());
}

/// Bytes without marks: three extents and three coordinates of four points.
std::string binary_row() {
  return raw_bytes<std::int32_t>({4, 1, 1}) +
         raw_bytes<float>({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
}

TEST(Plot3dComplaints, OldSystemsFillTheLastBlockOf512Bytes) {
  const ScratchFolder folder;
  const auto read = [&](const std::string& bytes) {
    try {
      return plot3d::read_grid(folder.write("a.x", bytes)).coordinates.at(0);
    } catch (const InputError& error) {
      EXPECT_EQ(error.what(), folder.file("a.x") + kNoGrid);
    }
    return std::vector<double>();
  };
  const std::vector<double> all{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  EXPECT_EQ(read(binary_row()), all);
  EXPECT_EQ(read(binary_row() + std::string(512 - 60, '\0')), all);
  EXPECT_TRUE(read(binary_row() + std::string(511 - 60, '\0')).empty());
  EXPECT_TRUE(read(binary_row() + std::string(1024 - 60, '\0')).empty());
  EXPECT_TRUE(read(binary_row() + std::string(511 - 60, '\0') + "\1").empty());
}

TEST(Plot3dComplaints, RecordsHaveTwoMarksOfTheirLengths) {
  const ScratchFolder folder;
  const auto read = [&](const std::string& bytes) {
    try {
      return plot3d::read_grid(folder.write("a.x", bytes)).coordinates.at(0).size();
    } catch (const InputError&) {
      return std::size_t{0};
    }
  };
  const auto mark = [](std::int32_t length) { return raw_bytes<std::int32_t>({length}); };
  const std::string extents = binary_row().substr(0, 12);
  const std::string points = binary_row().substr(12);
  EXPECT_EQ(read(mark(12) + extents + mark(12) + mark(48) + points + mark(48)), 12U);
  EXPECT_EQ(read(mark(12) + extents + mark(12) + mark(48) + points + mark(47)), 0U);
  EXPECT_EQ(read(mark(12) + extents + mark(12) + mark(49) + points + mark(49)), 0U);
  EXPECT_EQ(read(mark(12) + extents + mark(12) + mark(-48) + points + mark(-48)), 0U);
  EXPECT_EQ(read(mark(12) + extents + mark(12) + mark(48) + points + mark(48) + "1234567"), 0U);
  EXPECT_EQ(read(mark(12) + extents + mark(12) + mark(48) + points + mark(48) + mark(0) + mark(0)),
            12U);
}

TEST(Plot3dComplaints, SolutionsAreOfTheBlocksOfTheGrid) {
  const ScratchFolder folder;
  const std::vector<plot3d::Extents> blocks{{2, 1, 1}};
  const auto q = [&](const std::string& text) {
    try {
      return plot3d::read_q(folder.write("a.q", text), blocks).values.at(0);
    } catch (const InputError& error) {
      EXPECT_EQ(error.what(), folder.file("a.q") +
                                  ": is no whole PLOT3D Q file of the grid (its size fits no "
                                  "dialect)");
    }
    return std::vector<double>();
  };
  // four conditions, then five variables
  EXPECT_THAT(q("2 1 1  0 0 0 0  1 2 3 4 5 6 7 8 9 10"),
              ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9, 10));
  EXPECT_THAT(q("1 2 1 1  0 0 0 0  1 2 3 4 5 6 7 8 9 10"),
              ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9, 10));
  EXPECT_TRUE(q("1 2 1  0 0 0 0  1 2 3 4 5 6 7 8 9 10").empty());
  EXPECT_TRUE(q("2 1 1  0 0 0 0  1 2 3 4 5 6 7 8 9").empty());
  const auto function = [&](const std::string& text) {
    try {
      return plot3d::read_function(folder.write("a.f", text), blocks).values.at(0);
    } catch (const InputError& error) {
      EXPECT_EQ(error.what(), folder.file("a.f") +
                                  ": is no whole PLOT3D function file of the grid (its size fits "
                                  "no dialect)");
    }
    return std::vector<double>();
  };
  EXPECT_THAT(function("2 1 1 2  1 2 3 4"), ElementsAre(1, 2, 3, 4));
  EXPECT_EQ(function("2 1 1 1000  2000*1" + std::string(2000, ' ')).size(), 2000U);
  EXPECT_TRUE(function("2 1 1 1001  2002*1" + std::string(2000, ' ')).empty());
  EXPECT_TRUE(function("2 1 1 2  1 2 3").empty());
  EXPECT_TRUE(function("2 1 1 0 ").empty());
}

TEST(Plot3dSolutions, OfOverflowTellTheirVariables) {
  const ScratchFolder folder;
  const std::vector<plot3d::Extents> blocks{{2, 1, 1}};
  const auto overflow = [&](int variables, int before, int values) {
    std::string text = fmt::format("2 1 1 {} 0 {}*0{:99}", variables, before, "");
    for (int v = 0; v < values; ++v) text += fmt::format(" {}", v);
    try {
      const auto solution = plot3d::read_q(folder.write("a.q", text), blocks);
      EXPECT_EQ(solution.variables.at(0), static_cast<std::size_t>(variables));
      EXPECT_EQ(solution.values.at(0).back(), values - 1);
      return solution.values.at(0).size();
    } catch (const InputError&) {
      return std::size_t{0};
    }
  };
  EXPECT_EQ(overflow(6, 13, 12), 12U);
  EXPECT_EQ(overflow(6, 64, 12), 12U);
  EXPECT_EQ(overflow(5, 16, 10), 10U);
  EXPECT_EQ(overflow(6, 12, 12), 0U);
  EXPECT_EQ(overflow(6, 65, 12), 0U);
  EXPECT_EQ(overflow(4, 20, 8), 0U);
  // the grid's field names
  static_cast<void>(folder.write("g.x", kCubeText));
  static_cast<void>(folder.write("g.q", "2 2 2 7 0 16*0 8*1 8*2 8*3 8*4 8*5 8*1.4 8*9"));
  const ZooMesh mesh = read_any(folder.file("g.x")).mesh;
  std::vector<std::string> names;
  for (const Field& field : mesh.fields) names.push_back(field.name);
  EXPECT_THAT(names, ElementsAre("Density", "Momentum", "StagnationEnergy", "Gamma", "Variable 7"));
  EXPECT_EQ(mesh.fields[1].components, 3U);
  EXPECT_EQ(mesh.fields[1].values[2], 4);
  EXPECT_EQ(mesh.fields[2].values[0], 5);
  EXPECT_EQ(mesh.fields[4].values[7], 9);
}

TEST(Plot3dBlocks, HaveNamesAndHideTheirBlankCells) {
  const ScratchFolder folder;
  // two cubes, the second blank at one point; then one alone
  std::string text = "2\n2 2 2 3 2 2\n0 1 0 1 0 1 0 1 0 0 1 1 0 0 1 1 4*0 4*1 8*1\n";
  text += "2 3 4 2 3 4 2 3 4 2 3 4 3*0 3*1 3*0 3*1 6*0 6*1 11*1 0\n";
  const std::string path = folder.write("a.x", text);
  EXPECT_THAT(format_named("plot3d").inspect(path).blocks, ElementsAre("block 1", "block 2"));
  const Reading reading = read_any(path);
  EXPECT_EQ(reading.mesh.cell_count(), 2U);
  EXPECT_THAT(reading.notes, testing::Contains("left out 1 cells that IBLANK hides"));
  ReadOptions options;
  options.block = "block 2";
  const ZooMesh second = read_any(path, options).mesh;
  ASSERT_EQ(second.cell_count(), 1U);
  EXPECT_THAT(second.position(second.cell_nodes(0)[0]), ElementsAre(2, 0, 0));
  const std::string one = folder.write("b.x", kCubeText);
  EXPECT_TRUE(format_named("plot3d").inspect(one).blocks.empty());
  EXPECT_TRUE(read_any(one).notes.empty());
}

// Blocks may have different numbers of functions; those that all have are fields.
TEST(Plot3dSolutions, HaveTheFunctionsOfAllBlocks) {
  const ScratchFolder folder;
  const std::string cube = "0 1 0 1 0 1 0 1 0 0 1 1 0 0 1 1 4*0 4*1\n";
  const std::string path = folder.write("a.x", "2\n2 2 2 2 2 2\n" + cube + cube);
  static_cast<void>(folder.write("a.f", "2\n2 2 2 3 2 2 2 2\n8*1 8*2 8*3 8*4 8*5\n"));
  const ZooMesh mesh = read_any(path).mesh;
  ASSERT_EQ(mesh.fields.size(), 2U);
  EXPECT_EQ(mesh.fields[0].name, "Function0");
  EXPECT_EQ(mesh.fields[1].values[0], 2);
  EXPECT_EQ(mesh.fields[1].values[15], 5);
}

TEST(Plot3dFiles, BeginWithASmallCountOrANumber) {
  const std::string zeros(8, '\0');
  EXPECT_TRUE(plot3d::may_be_grid(raw_bytes<std::int32_t>({1}) + zeros));
  EXPECT_TRUE(plot3d::may_be_grid(raw_bytes<std::int32_t>({65535}) + zeros));
  EXPECT_FALSE(plot3d::may_be_grid(raw_bytes<std::int32_t>({65537}) + zeros));
  EXPECT_TRUE(plot3d::may_be_grid(std::string("\0\0\0\1", 4) + zeros));
  EXPECT_FALSE(plot3d::may_be_grid(std::string(4, '\0') + zeros));
  EXPECT_FALSE(plot3d::may_be_grid(raw_bytes<std::int32_t>({1}) + zeros.substr(0, 7)));
}

// A text begins with numbers as the reader takes them.
TEST(Plot3dFiles, OfTextBeginWithThreeNumbers) {
  for (const std::string text :
       {" 2 -1.5e+3 4*1", "2, 2, 2\n0 1 0 1", "2,2,2,0,1,0,1", "3*2 0.D0 1.d0", "1\n+2\t2D0\r\n2 2",
        "           2           2           2", "2 2 2 0.5 1x"})
    EXPECT_TRUE(plot3d::may_be_grid(text)) << text;
  for (const std::string text :
       {" 2 -1.5e+3*4", " 2 -1.5e+3*x", "added, added, added", "3\ndeed\nD 0 0 0", "2 2 d 0 1 0 1",
        "2;2;2;0;1;0;1", ",,,,,,,,,,,,", "            ", "2           2", "2 2 2 3 4 5"})
    EXPECT_FALSE(plot3d::may_be_grid(text)) << text;
  const std::string commas = "2, 2, 2\n" + kCubeText.substr(kCubeText.find('\n') + 1);
  const ScratchFolder folder;
  EXPECT_EQ(read_any(folder.write("a.p3dfmt", commas)).mesh.cell_count(), 1U);
  EXPECT_EQ(read_any(folder.write("b.x", "2D0 2D0 2D0\n" + commas.substr(8))).mesh.cell_count(),
            1U);
  EXPECT_THAT(refusal(folder.write("c.xyz", "3\nwater\nO 0 0 0\nH 1 0 0\nH 0 1 0\n")),
              testing::StartsWith(folder.file("c.xyz") + ": is not a plot3d file"));
}

}  // namespace
}  // namespace hiac::formats
