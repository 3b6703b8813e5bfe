// hiac-render --pixel as a user calls it.

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "hiac/image/image_io.hpp"
#include "hiac/mesh/zoo_container.hpp"
#include "tests/support/cube_view.hpp"
#include "tests/support/meshes.hpp"
#include "tests/tools/tool_folder.hpp"

namespace hiac::test {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string kView = cube_view_with_surface(40, 30);

class PixelOption : public ToolFolder {
 protected:
  void SetUp() override {
    ToolFolder::SetUp();
    ZooMesh mesh = random_delaunay(30, 4);
    add_node_field(mesh, "f", smooth_field);
    add_node_field(mesh, "g", [](const Position& p) { return p[2]; });
    write_zoo_file(file("m.zoo"), {mesh, {}});
    std::ofstream(file("view.toml")) << kView;
    std::ofstream(file("turn.toml")) << kView << "[turntable]\nframes = 5\n";
  }

  [[nodiscard]] std::string output() const { return bytes_of(file("out.txt")); }
  [[nodiscard]] std::vector<std::string> lines() const {
    std::istringstream text(output());
    std::vector<std::string> result;
    for (std::string line; std::getline(text, line);) result.push_back(line);
    return result;
  }
  [[nodiscard]] Image picture(const std::string& name) const {
    return read_image(file(name), {}).image;
  }

  // What the table's last line should say.
  static std::string pixel_line(const Image& image, std::size_t x, std::size_t y) {
    std::ostringstream line;
    line.precision(17);
    line << "pixel " << x << ',' << y << ": R " << image.at(x, y, 0) << " G " << image.at(x, y, 1)
         << " B " << image.at(x, y, 2) << " A " << image.at(x, y, 3);
    return line.str();
  }
};

TEST_F(PixelOption, EndsWithThePixelOfThePicture) {
  const std::string render = "$RENDER -q m.zoo --view view.toml ";
  const std::string more = "--size 50x40 --set camera.fov=30 --no-background ";
  ASSERT_EQ(run("$SORT -q m.zoo --view view.toml -o m.order && " + render + "-o a.npy && " +
                render + more + "-o b.npy && $RENDER -q m.zoo --view turn.toml --frame 3 -o c.npy"),
            0)
      << complaint();
  ASSERT_EQ(run(render + "--order m.order --pixel 21,14"), 0) << complaint();
  EXPECT_EQ(lines().back(), pixel_line(picture("a.npy"), 21, 14));
  ASSERT_EQ(run(render + more + "--pixel 26,19"), 0) << complaint();
  EXPECT_EQ(lines().back(), pixel_line(picture("b.npy"), 26, 19));
  ASSERT_EQ(run("$RENDER -q m.zoo --view turn.toml --frame 3 --pixel 20,15"), 0) << complaint();
  EXPECT_EQ(lines().back(), pixel_line(picture("c.npy"), 20, 15));
  ASSERT_EQ(run(render + "--pixel 0,0"), 0) << complaint();  // nothing but background
  EXPECT_EQ(lines().back(), "pixel 0,0: R 0.25 G 0.5 B 0.75 A 0");
}

TEST_F(PixelOption, PrintsColumnsThatStandBelowTheirNames) {
  ASSERT_EQ(run("$RENDER -q m.zoo --view view.toml --pixel 21,14"), 0) << complaint();
  EXPECT_THAT(output(), HasSubstr("isosurface"));
  EXPECT_THAT(output(), HasSubstr("f = 0.5, opacity 0."));
  const auto table = lines();
  EXPECT_THAT(table.front(), HasSubstr("cell"));
  for (const char* name : {"cell", "kind", "depth", "g", "tau", "kappa R", "G"}) {
    const std::size_t end = table.front().find(std::string("  ") + name + "  ");
    ASSERT_NE(end, std::string::npos) << name;
    const std::size_t last = end + 1 + std::string(name).size();
    // the first cell's number ends there, and a space follows
    ASSERT_LT(last + 1, table[1].size());
    EXPECT_NE(table[1][last], ' ') << name;
    EXPECT_EQ(table[1][last + 1], ' ') << name;
  }
  for (const std::string& line : table) EXPECT_LT(line.size(), 170U);
}

TEST_F(PixelOption, SaysAllOfItAsJson) {
  ASSERT_EQ(run("$RENDER -q m.zoo --view view.toml -o a.npy --channels error,cells"), 0);
  const Image image = picture("a.npy");
  ASSERT_EQ(run("$RENDER -q m.zoo --view view.toml --pixel 21,14 --json -"), 0) << complaint();
  const auto pixel = nlohmann::json::parse(output()).at("pixel");
  EXPECT_EQ(pixel["x"], 21);
  EXPECT_EQ(pixel["fields"]["extinction"], "g");
  for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(pixel["color"][c], image.at(21, 14, c));
  EXPECT_EQ(pixel["alpha"], image.at(21, 14, 3));
  EXPECT_EQ(pixel["error"].get<double>(), image.at(21, 14, 4));
  const auto& segments = pixel["segments"];
  EXPECT_EQ(static_cast<double>(segments.size()), image.at(21, 14, 5));
  std::size_t surfaces = 0;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const auto& s = segments[i];
    EXPECT_EQ(s["kind"], "tetrahedron4");
    if (i > 0) {
      EXPECT_NEAR(s["front"]["depth"], segments[i - 1]["back"]["depth"], 1e-12);
    }
    // tau is 0.1 + 2.9 g
    EXPECT_NEAR(s["back"]["tau"], 0.1 + 2.9 * s["back"]["extinction_field"].get<double>(), 1e-14);
    surfaces += s["isosurfaces"].size();
  }
  EXPECT_GT(surfaces, 0U);
  // in a file: the table is on stdout
  ASSERT_EQ(run("$RENDER -q m.zoo --view view.toml --pixel 21,14 --json f.json"), 0);
  EXPECT_EQ(lines().back(), pixel_line(image, 21, 14));
  EXPECT_EQ(nlohmann::json::parse(bytes_of(file("f.json"))).at("pixel"), pixel);
}

TEST_F(PixelOption, ClaimsNoErrorOfOtherIntegrations) {
  ASSERT_EQ(run("$RENDER -q m.zoo --view view.toml --set 'render.integration=\"approximate\"' "
                "--pixel 21,14 --json -"),
            0)
      << complaint();
  EXPECT_TRUE(nlohmann::json::parse(output()).at("pixel").at("error").is_null());
}

TEST_F(PixelOption, RefusesWhatItIsNotFor) {
  const std::string render = "$RENDER m.zoo --view view.toml ";
  for (const char* wrong : {"--pixel 21,14 -o a.png", "--pixel 21,14 --crop 0,0,9,9", "--pixel 21",
                            "--pixel 21,14,3", "--pixel -1,4", "--pixel ''", "--pixel 40,0",
                            "--pixel 0,30", "--pixel 21,14 --set render.splat_below=2",
                            "--pixel 21,14 --channels error", "--pixel 1,1 --frames"}) {
    EXPECT_EQ(run(render + wrong), 2) << wrong << '\n' << complaint();
    EXPECT_THAT(output(), Not(HasSubstr("pixel"))) << wrong;
  }
  EXPECT_EQ(run(render), 2);
  EXPECT_THAT(complaint(), HasSubstr("--output is required"));
  EXPECT_EQ(run("$RENDER m.zoo --view turn.toml --pixel 1,1"), 2);  // of which frame
}

}  // namespace
}  // namespace hiac::test
