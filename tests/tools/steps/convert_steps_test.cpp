// hiac-convert --steps.

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/tools/steps/step_files.hpp"

namespace hiac::test {
namespace {

using testing::HasSubstr;

class ConvertSteps : public StepFiles {
 protected:
  [[nodiscard]] std::vector<std::string> files_with(const std::string& beginning) const {
    std::vector<std::string> found;
    for (const std::string& name : folder_.names())
      if (name.starts_with(beginning)) found.push_back(name);
    return found;
  }
};

// The truth is the conversion of one step alone.
TEST_F(ConvertSteps, AreThoseOfSingleConversions) {
  for (const std::string input : {"still.msh", "moving.pvd"}) {
    ASSERT_EQ(run("$CONVERT " + input + " --steps all -o all-%04d.zoo"), 0) << complaint();
    EXPECT_THAT(complaint(), HasSubstr("all-0001.zoo: 2 of 3 steps, about "));
    for (int step = 0; step < 3; ++step) {
      const std::string one = fmt::format("one{}.zoo", step);
      ASSERT_EQ(run(fmt::format("$CONVERT -q {} --step {} -o {}", input, step, one)), 0);
      const std::string truth = bytes_of(file(one));
      EXPECT_FALSE(truth.empty());
      EXPECT_EQ(bytes_of(file(fmt::format("all-000{}.zoo", step))), truth) << input << step;
    }
    EXPECT_NE(bytes_of(file("one0.zoo")), bytes_of(file("one2.zoo")));
  }
}

TEST_F(ConvertSteps, OtherOptionsHoldForEveryStep) {
  const std::string options = " --derive 'q = 2*T' --field T=t --threshold T=0.5, --block left ";
  ASSERT_EQ(run("$CONVERT -q still.msh --steps 0:2:2" + options + "-o s%d.zoo"), 0) << complaint();
  EXPECT_EQ(files_with("s"), (std::vector<std::string>{"s0.zoo", "s2.zoo", "still.msh"}));
  for (const std::string step : {"0", "2"}) {
    ASSERT_EQ(run("$CONVERT -q still.msh --step " + step + options + "-o one.zoo"), 0);
    EXPECT_EQ(bytes_of(file("s" + step + ".zoo")), bytes_of(file("one.zoo"))) << step;
  }
  // cells that differ from step to step have an adjacency each
  ASSERT_EQ(run("$CONVERT -q still.msh --steps all --threshold T=-0.3, -o cut%d.zoo"), 0);
  ASSERT_EQ(run("$CONVERT -q still.msh --step 2 --threshold T=-0.3, -o one.zoo"), 0);
  EXPECT_EQ(bytes_of(file("cut2.zoo")), bytes_of(file("one.zoo")));
  EXPECT_NE(read_zoo_file(file("cut0.zoo")).mesh.cell_count(),
            read_zoo_file(file("cut2.zoo")).mesh.cell_count());
}

// As many cells of the same kinds, in another order: their adjacency is another.
TEST_F(ConvertSteps, TheAdjacencyIsThatOfTheStepsCells) {
  const ZooMesh mesh = mesh_of_step(0);
  std::vector<Cell> cells = cells_of(mesh);
  std::ranges::reverse(cells);
  write_zoo_file(file("part1.zoo"), {make_mesh(positions_of(mesh), cells), {}});
  ASSERT_EQ(run("$CONVERT -q part1.zoo -o part1.vtu"), 0);
  ASSERT_EQ(run("$CONVERT -q moving.pvd --steps all -o all%d.zoo"), 0) << complaint();
  for (const std::string step : {"0", "1", "2"}) {
    ASSERT_EQ(run("$CONVERT -q moving.pvd --step " + step + " -o one.zoo"), 0);
    EXPECT_EQ(bytes_of(file("all" + step + ".zoo")), bytes_of(file("one.zoo"))) << step;
  }
}

TEST_F(ConvertSteps, OtherFormatsAndPipesHaveSteps) {
  ASSERT_EQ(run("$CONVERT -q moving.pvd --steps 1:2 -o v%d.vtu"), 0) << complaint();
  ASSERT_EQ(run("$CONVERT -q moving.pvd --step 2 -o one.vtu"), 0);
  EXPECT_EQ(bytes_of(file("v2.vtu")), bytes_of(file("one.vtu")));
  ASSERT_EQ(run("cat still.msh | $CONVERT -q --format gmsh --steps all -o p%d.zoo"), 0)
      << complaint();
  ASSERT_EQ(run("cat still.msh | $CONVERT -q --format gmsh --step 1 -o one.zoo"), 0);
  EXPECT_EQ(bytes_of(file("p1.zoo")), bytes_of(file("one.zoo")));
  // a file without times is one step
  ASSERT_EQ(run("$CONVERT -q part1.vtu --steps all -o w%d.zoo --json facts.json"), 0);
  EXPECT_EQ(files_with("w"), std::vector<std::string>{"w0.zoo"});
  const auto facts = nlohmann::json::parse(bytes_of(file("facts.json")));
  EXPECT_EQ(facts["steps"].size(), 1U);
  EXPECT_EQ(facts["steps"][0]["file"], "w0.zoo");
}

TEST_F(ConvertSteps, WrongUsageWritesNothing) {
  const std::vector<std::pair<std::string, std::string>> rows{
      {"--steps all -o run.zoo", "-o run.zoo: a name with one place for the step's number"},
      {"--steps all -o run-%d-%d.zoo", "one place"},
      {"--steps all -o run-%s.zoo", "one place"},
      {"--steps all -o 'run %d %.zoo'", "no other %"},
      {"--steps all", "one place"},
      {"--steps all -o -", "one place"},
      {"--steps all -o run-%d.xyz", "-o run-0.xyz: no format with the extension '.xyz'"},
      {"--steps 0:3 -o run-%d.zoo", "--steps 0:3: still.msh has no step 3 (3 steps from 0 to 2"},
      {"--steps 2:1 -o run-%d.zoo", "--steps 2:1: FIRST is above LAST"},
      {"--steps some -o run-%d.zoo", "--steps some: all|FIRST:LAST[:STRIDE] expected"},
      {"--steps all --step 1 -o run-%d.zoo", "excludes"},
      {"--steps all --time 1 -o run-%d.zoo", "excludes"},
      {"--steps all --list", "excludes"}};
  for (const auto& [arguments, message] : rows) {
    EXPECT_EQ(run("$CONVERT still.msh " + arguments), 2) << arguments;
    EXPECT_THAT(complaint(), HasSubstr(message)) << arguments;
  }
  EXPECT_EQ(files_with("run"), std::vector<std::string>{});
  EXPECT_EQ(run("cat part0.zoo | $CONVERT --steps all -o run-%d.zoo"), 2);
  EXPECT_THAT(complaint(), HasSubstr("--steps: a zoo stream holds one step"));
}

// All outputs are tried before the first is written.
TEST_F(ConvertSteps, OutputsAreProtected) {
  write("run-2.zoo", bytes_of(file("view.toml")));
  EXPECT_EQ(run("$CONVERT still.msh --steps all -o run-%d.zoo"), 2);
  EXPECT_THAT(complaint(), HasSubstr("run-2.zoo: is a file of another kind"));
  EXPECT_EQ(files_with("run"), std::vector<std::string>{"run-2.zoo"});
  EXPECT_EQ(run("$CONVERT still.msh --steps all -o none/run-%d.zoo"), 3);
  EXPECT_EQ(run("$CONVERT part1.vtu --steps all -o part%d.vtu"), 0) << complaint();
  EXPECT_EQ(run("$CONVERT part0.vtu --steps all -o part%d.zoo"), 0) << complaint();
  EXPECT_EQ(run("mkdir run-1.vtu; $CONVERT still.msh --steps all -o run-%d.vtu"), 3);
  EXPECT_EQ(files_with("run-0"), std::vector<std::string>{});
}

}  // namespace
}  // namespace hiac::test
