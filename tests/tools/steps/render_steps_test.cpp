// hiac-render on the time steps of a series.

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "hiac/frame/projection.hpp"
#include "hiac/scene/specification.hpp"
#include "tests/tools/steps/step_files.hpp"

namespace hiac::test {
namespace {

using testing::HasSubstr;
using testing::Not;

class RenderSteps : public StepFiles {
 protected:
  void SetUp() override {
    StepFiles::SetUp();
    for (const std::string input : {"still.msh", "moving.pvd"})
      ASSERT_EQ(run("$CONVERT -q " + input + " --steps all -o " + stem(input) + "-%02d.zoo"), 0)
          << complaint();
  }

  static std::string stem(const std::string& input) { return input.substr(0, input.find('.')); }

  /// The range of T over steps, by looking at every value.
  [[nodiscard]] std::array<double, 2> range_of(const std::string& name,
                                               const std::vector<int>& steps) const {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const int step : steps) {
      const ZooMesh mesh = read_zoo_file(file(fmt::format("{}-{:02}.zoo", name, step))).mesh;
      for (const double value : mesh.fields.at(0).values.view()) {
        low = std::min(low, value);
        high = std::max(high, value);
      }
    }
    return {low, high};
  }

  /// Renders single steps with an explicit range, as truth-K.png.
  void render_truth(const std::string& name, const std::vector<int>& steps) {
    const auto [low, high] = range_of(name, steps);
    write("fixed.toml", view(fmt::format("range = [{:.17g}, {:.17g}]", low, high)));
    for (const int step : steps)
      ASSERT_EQ(run(fmt::format("$RENDER -q {}-{:02}.zoo --view fixed.toml -o truth-{}.png", name,
                                step, step)),
                0)
          << complaint();
  }

  void expect_truth(const std::string& pattern, const std::vector<int>& numbers,
                    const std::vector<int>& steps) {
    for (std::size_t k = 0; k < steps.size(); ++k) {
      const std::string truth = bytes_of(file(fmt::format("truth-{}.png", steps[k])));
      EXPECT_FALSE(truth.empty());
      EXPECT_EQ(bytes_of(file(fmt::format(fmt::runtime(pattern), numbers[k]))), truth)
          << pattern << " of step " << steps[k];
    }
  }
};

TEST_F(RenderSteps, PicturesAreThoseOfTheRangeOfAllSteps) {
  for (const std::string input : {"still.msh", "moving.pvd"}) {
    ASSERT_EQ(run("$RENDER " + input + " --steps all --view view.toml -o run-%03d.png"), 0)
        << complaint();
    EXPECT_THAT(complaint(), HasSubstr("over 3 steps"));
    EXPECT_THAT(complaint(), HasSubstr("run-001.png: 2 of 3 steps"));
    render_truth(stem(input), {0, 1, 2});
    expect_truth("run-{:03}.png", {0, 1, 2}, {0, 1, 2});
  }
  EXPECT_NE(bytes_of(file("run-000.png")), bytes_of(file("run-002.png")));
}

TEST_F(RenderSteps, TheRangeIsThatOfTheChosenSteps) {
  ASSERT_EQ(run("$RENDER -q still.msh --steps 0:2:2 --view view.toml -o run.png"), 0)
      << complaint();
  render_truth("still", {0, 2});
  expect_truth("run-{:04}.png", {0, 2}, {0, 2});
  EXPECT_NE(range_of("still", {0, 2}), range_of("still", {0, 1, 2}));
}

TEST_F(RenderSteps, ASeriesMayBeFiles) {
  render_truth("still", {0, 1, 2});
  ASSERT_EQ(run("$RENDER -q still-%02d.zoo --view view.toml -o a%d.png --json facts.json"), 0)
      << complaint();
  expect_truth("a{}.png", {0, 1, 2}, {0, 1, 2});
  const auto facts = nlohmann::json::parse(bytes_of(file("facts.json")));
  ASSERT_EQ(facts["steps"].size(), 3U);
  EXPECT_EQ(facts["steps"][2]["step"], 2);
  EXPECT_EQ(facts["steps"][2]["file"], "a2.png");
  ASSERT_EQ(run("$RENDER -q still-02.zoo still-00.zoo still-01.zoo --view view.toml -o b%d.png"), 0)
      << complaint();
  expect_truth("b{}.png", {0, 1, 2}, {2, 0, 1});
  render_truth("still", {1, 2});
  ASSERT_EQ(run("$RENDER -q still-%02d.zoo --steps 1:2 --view view.toml -o c%d.png"), 0);
  expect_truth("c{}.png", {1, 2}, {1, 2});
}

TEST_F(RenderSteps, OrdersServeAllStepsOfOneGeometry) {
  const std::string again = "the geometry is that of the step before";
  ASSERT_EQ(run("$RENDER -v still-%02d.zoo --view view.toml -o a%d.png"), 0);
  EXPECT_THAT(complaint(), HasSubstr(again));
  const auto count = [&](const std::string& text) {
    std::size_t found = 0;
    const std::string lines = complaint();
    for (std::size_t at = lines.find(text); at != std::string::npos; at = lines.find(text, at + 1))
      ++found;
    return found;
  };
  EXPECT_EQ(count("hiac-render: order: 0."), 1U);  // the stage is timed once
  ASSERT_EQ(run("$RENDER -v moving-%02d.zoo --view view.toml -o a%d.png"), 0);
  EXPECT_THAT(complaint(), Not(HasSubstr(again)));
  EXPECT_EQ(count("hiac-render: order: 0."), 3U);
  // and so does an order file, which does not fit another geometry
  ASSERT_EQ(run("$SORT -q still-00.zoo --view view.toml -o still.order"), 0) << complaint();
  EXPECT_EQ(run("$RENDER -q still-%02d.zoo --view view.toml --order still.order -o b%d.png"), 0)
      << complaint();
  EXPECT_EQ(run("$RENDER -q moving-%02d.zoo --view view.toml --order still.order -o b%d.png"), 3);
}

TEST_F(RenderSteps, AStarterViewIsThatOfTheSeries) {
  ASSERT_EQ(run("$RENDER still.msh --steps all --size 40x30 --save-view saved.toml -o a%d.png"), 0)
      << complaint();
  EXPECT_THAT(complaint(), HasSubstr("the range of all steps"));
  const Scene saved = read_scene(file("saved.toml")).scene;
  const auto [low, high] = range_of("still", {0, 1, 2});
  EXPECT_EQ(saved.volume.color->points.front().scalar, low);
  EXPECT_EQ(saved.volume.color->points.back().scalar, high);
  for (const int step : {0, 1, 2}) {
    ASSERT_EQ(run(fmt::format("$RENDER -q still-0{}.zoo --view saved.toml -o one.png", step)), 0)
        << complaint();
    EXPECT_EQ(bytes_of(file(fmt::format("a{}.png", step))), bytes_of(file("one.png"))) << step;
  }
}

TEST_F(RenderSteps, AStarterCameraSeesAllSteps) {
  for (const std::string steps : {"moving-00.zoo moving-02.zoo", "moving-02.zoo moving-00.zoo"}) {
    ASSERT_EQ(run("$RENDER -q " + steps + " --size 80x60 --save-view saved.toml -o a%d.png"), 0)
        << complaint();
    const Scene saved = read_scene(file("saved.toml")).scene;
    const Projector projector(saved.camera, saved.image);
    for (const std::string step : {"moving-00.zoo", "moving-02.zoo"}) {
      const ZooMesh mesh = read_zoo_file(file(step)).mesh;
      for (NodeId node = 0; node < mesh.node_count(); ++node) {
        const auto at = projector.project_extended(mesh.position(node));
        EXPECT_TRUE(at[2] < 0 && 0 <= at[0] && at[0] <= 80 && 0 <= at[1] && at[1] <= 60)
            << steps << ": node " << node << " of " << step << " at " << at[0] << ", " << at[1];
      }
    }
  }
}

// Six frames over three steps: two of each.
TEST_F(RenderSteps, StepsAreSpreadOverTheFramesOfAPath) {
  write("path.toml", view("range = [-1, 5]", "") + "[turntable]\nframes = 6\n");
  ASSERT_EQ(run("$RENDER -q moving-%02d.zoo --frames --view path.toml -o f%d.png"), 0)
      << complaint();
  for (int frame = 0; frame < 6; ++frame) {
    ASSERT_EQ(run(fmt::format("$RENDER -q moving-0{}.zoo --frame {} --view path.toml -o one.png",
                              frame / 2, frame)),
              0);
    EXPECT_EQ(bytes_of(file(fmt::format("f{}.png", frame))), bytes_of(file("one.png"))) << frame;
  }
  // one frame is a camera for all steps
  ASSERT_EQ(run("$RENDER -q moving-%02d.zoo --frame 3 --view path.toml -o g%d.png"), 0);
  ASSERT_EQ(run("$RENDER -q moving-01.zoo --frame 3 --view path.toml -o one.png"), 0);
  EXPECT_EQ(bytes_of(file("g1.png")), bytes_of(file("one.png")));
  EXPECT_EQ(run("$RENDER moving-%02d.zoo --frames --view path.toml --set turntable.frames=2 "
                "-o h%d.png"),
            2);
  EXPECT_THAT(complaint(), HasSubstr("has 2 frames, fewer than the 3 steps"));
}

TEST_F(RenderSteps, WrongUsageNamesTheOption) {
  const std::vector<std::pair<std::string, std::string>> rows{
      {"still.msh --steps 0:3", "--steps 0:3: still.msh has no step 3"},
      {"still-%02d.zoo --steps 2:3", "--steps 2:3: still-%02d.zoo has no step 3"},
      {"still-00.zoo still-01.zoo --steps 1:2", "--steps 1:2: the list of meshes has no step 2"},
      {"%s-%02d.zoo", "MESH %s-%02d.zoo: a name with one place"},
      {"- --steps all <still-00.zoo", "--steps: stdin holds one step"},
      {"still.msh --steps all --fps 3", "--fps: only for a film"},
      {"still.msh --steps all --pixel 1,1", "excludes"}};
  for (const auto& [arguments, message] : rows) {
    EXPECT_EQ(run("$RENDER --view view.toml -o a%d.png " + arguments), 2) << arguments;
    EXPECT_THAT(complaint(), HasSubstr(message)) << arguments;
  }
  EXPECT_EQ(run("$RENDER still.msh --steps all --view view.toml -o a%d-%d.png"), 2);
  EXPECT_EQ(run("$RENDER still.msh --steps all --view view.toml --format png -o - >a.png"), 2);
  EXPECT_EQ(run("$RENDER none-%d.zoo --view view.toml -o a%d.png"), 3);
  EXPECT_THAT(complaint(), HasSubstr("none-%d.zoo: no file has a name of this pattern"));
  // a step without the field is named
  ASSERT_EQ(run("$CONVERT -q still-01.zoo --field T=U -o still-03.zoo"), 0);
  EXPECT_EQ(run("$RENDER still-%02d.zoo --view view.toml -o a%d.png"), 2);
  EXPECT_THAT(complaint(), HasSubstr("still-03.zoo: field 'T'"));
}

}  // namespace
}  // namespace hiac::test
