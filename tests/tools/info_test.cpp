#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "hiac/base/error.hpp"
#include "hiac/image/image_io.hpp"
#include "hiac/mesh/parted/write_parts.hpp"
#include "hiac/mesh/zoo_container.hpp"
#include "hiac/order/order_file.hpp"
#include "hiac/scene/specification.hpp"
#include "hiac/session/session.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/scratch_folder.hpp"

namespace hiac::tools {
namespace {

using testing::HasSubstr;
using Vec = std::array<double, 3>;

/// n x n x n bricks that fill the box from `low` to `high`, with the fields "x" (node by node, what
/// the coordinate is) and "one" (cell by cell).
ZooMesh box_of_bricks(const Vec& low, const Vec& high, std::uint32_t n) {
  std::vector<double> xyz, x;
  for (std::uint32_t k = 0; k <= n; ++k)
    for (std::uint32_t j = 0; j <= n; ++j)
      for (std::uint32_t i = 0; i <= n; ++i) {
        const std::array<std::uint32_t, 3> at{i, j, k};
        for (std::size_t a = 0; a < 3; ++a) xyz.push_back(low[a] + (high[a] - low[a]) * at[a] / n);
        x.push_back(xyz[xyz.size() - 3]);
      }
  std::vector<NodeId> nodes;
  std::vector<std::uint64_t> elems{0};
  const auto id = [n](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    return (k * (n + 1) + j) * (n + 1) + i;
  };
  for (std::uint32_t k = 0; k < n; ++k)
    for (std::uint32_t j = 0; j < n; ++j)
      for (std::uint32_t i = 0; i < n; ++i) {
        for (const std::uint32_t top : {0u, 1u})
          for (const auto& [di, dj] : {std::pair{0u, 0u}, {1u, 0u}, {1u, 1u}, {0u, 1u}})
            nodes.push_back(id(i + di, j + dj, k + top));
        elems.push_back(nodes.size());
      }
  ZooMesh mesh;
  const std::size_t cells = elems.size() - 1;
  mesh.elems = std::move(elems);
  mesh.nodes = std::move(nodes);
  mesh.xyz = std::move(xyz);
  mesh.kinds = std::vector<CellKind>(cells, CellKind::brick8);
  mesh.fields.push_back({"x", "m", FieldLocation::node, 1, std::move(x)});
  mesh.fields.push_back({"one", "", FieldLocation::cell, 1, std::vector<double>(cells, 1.0)});
  mesh.metadata.emplace_back("source", "a test");
  validate(mesh, "box");
  return mesh;
}

Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vec unit(const Vec& a) {
  const double length = std::hypot(a[0], a[1], a[2]);
  return {a[0] / length, a[1] / length, a[2] / length};
}

/// The mean over the pixels whose rays meet the box of the optical depth along them, for an
/// extinction that is linear in the coordinate x: marched in small steps.
double marched_depth(const Scene& scene, const Vec& low, const Vec& high) {
  const auto extinction = scene.volume.extinction->function();
  const Camera& camera = scene.camera;
  const Vec ahead = unit(view_direction(camera));
  const Vec right = unit(cross(ahead, camera.up));
  const Vec up = cross(right, ahead);
  const double tangent = std::tan(camera.fov * std::numbers::pi / 360);
  constexpr int kWidth = 128, kHeight = 96, kSteps = 400;
  double sum = 0;
  int hits = 0;
  for (int j = 0; j < kHeight; ++j)
    for (int i = 0; i < kWidth; ++i) {
      const double v = (1 - 2 * (j + 0.5) / kHeight) * tangent;
      const double u = (2 * (i + 0.5) / kWidth - 1) * tangent * kWidth / kHeight;
      Vec d;
      for (std::size_t a = 0; a < 3; ++a) d[a] = ahead[a] + u * right[a] + v * up[a];
      d = unit(d);
      double enter = 0, leave = 1e300;
      for (std::size_t a = 0; a < 3; ++a) {
        const auto [t0, t1] =
            std::minmax({(low[a] - camera.eye[a]) / d[a], (high[a] - camera.eye[a]) / d[a]});
        enter = std::max(enter, t0);
        leave = std::min(leave, t1);
      }
      if (enter >= leave) continue;
      ++hits;
      const double step = (leave - enter) / kSteps;
      for (int s = 0; s < kSteps; ++s)
        sum += step * extinction(camera.eye[0] + (enter + (s + 0.5) * step) * d[0])[0];
    }
  EXPECT_GT(hits, kWidth * kHeight / 10);
  return sum / hits;
}

TEST(StarterView, HasAMeanOpticalDepthNearOne) {
  const std::pair<Vec, Vec> boxes[] = {{{0, 0, 0}, {1, 1, 1}},
                                       {{-3e-6, 2e-6, 0}, {5e-6, 3e-6, 1e-6}},
                                       {{1e6, 1e6, 1e6}, {1e6 + 1, 1e6 + 20, 1e6 + 2}}};
  for (const auto& [low, high] : boxes) {
    const Scene scene = starter_view(box_of_bricks(low, high, 6), "box");
    EXPECT_EQ(scene.volume.color->field, "x");
    EXPECT_NEAR(marched_depth(scene, low, high), 1, 0.03);
  }
}

TEST(StarterView, HasTheWholeModelInSight) {
  const Vec low{-1, 0, 3}, high{9, 1, 4};
  const Scene scene = starter_view(box_of_bricks(low, high, 2), "box");
  const Vec ahead = unit(view_direction(scene.camera));
  const Vec right = unit(cross(ahead, scene.camera.up));
  const Vec up = cross(right, ahead);
  const double tangent = std::tan(scene.camera.fov * std::numbers::pi / 360);
  const double aspect = static_cast<double>(scene.image.width) / scene.image.height;
  double largest = 0;
  for (int corner = 0; corner < 8; ++corner) {
    double x = 0, y = 0, z = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const double p = ((corner >> a & 1) != 0 ? high[a] : low[a]) - scene.camera.eye[a];
      x += p * right[a];
      y += p * up[a];
      z += p * ahead[a];
    }
    EXPECT_GT(z, 0);
    largest =
        std::max({largest, std::fabs(x) / (z * tangent * aspect), std::fabs(y) / (z * tangent)});
  }
  EXPECT_LT(largest, 0.96);
  EXPECT_GT(largest, 0.9);
}

TEST(StarterView, IsASpecificationThatCanBeParsed) {
  const Scene scene = starter_view(box_of_bricks({0, 0, 0}, {1, 2, 3}, 2), "box");
  EXPECT_EQ(parse_scene(to_toml(scene, Comments::explain), "text").scene, scene);
}

/// What hiac-info answers.
struct Answer {
  int exit_code;
  std::string output;  ///< stdout and stderr together
};

class Info : public testing::Test {
 protected:
  [[nodiscard]] std::string path(const std::string& name) const { return folder_.file(name); }
  [[nodiscard]] Answer run(const std::string& arguments) const {
    const std::string out = path("answer.txt");
    const int status =
        std::system((std::string(HIAC_INFO) + " " + arguments + " > " + out + " 2>&1").c_str());
    std::ifstream file(out);
    return {WEXITSTATUS(status), {std::istreambuf_iterator<char>(file), {}}};
  }

  test::ScratchFolder folder_;
};

// JSON is UTF-8; texts in files need not be.
TEST_F(Info, TextsThatAreNotUtf8AreReplacedInFacts) {
  write_image(path("a.png"), Image(1, 1, rgba_channels(), std::vector<double>(4, 0.5)),
              {.attributes = {{"Comment", "caf\xe9"}}});
  const Answer answer = run(path("a.png") + " --json " + path("facts.json"));
  EXPECT_EQ(answer.exit_code, 0) << answer.output;
  const auto facts = nlohmann::json::parse(test::bytes_of(path("facts.json")));
  EXPECT_EQ(facts["attributes"]["Comment"], "caf\xef\xbf\xbd");
}

TEST_F(Info, DescribesAMesh) {
  write_zoo_file(path("box.zoo"), {box_of_bricks({0, 0, 0}, {1, 2, 2}, 2), {}});
  const Answer answer = run(path("box.zoo"));
  EXPECT_EQ(answer.exit_code, 0);
  for (const char* words :
       {"8 (8 brick8)", "27", "x (node, scalar): 0 to 1 m", "diagonal     3", "source: a test"})
    EXPECT_THAT(answer.output, HasSubstr(words));
  EXPECT_EQ(run("< " + path("box.zoo")).exit_code, 0);

  const auto facts = nlohmann::json::parse(run(path("box.zoo") + " --json -").output);
  EXPECT_EQ(facts["holds"], "mesh");
  EXPECT_EQ(facts["kinds"]["brick8"], 8);
  EXPECT_EQ(facts["fields"][0]["maximum"], 1.0);
  EXPECT_EQ(facts["bounds"][1][1], 2.0);
}

#ifdef HIAC_WITH_FORMATS
// Two boxes of 2 x 2 x 2 bricks, one in front of the other, in three parts: the first box's left
// and right half, and the second one, which is apart.
TEST_F(Info, DescribesTheParts) {
  const ZooMesh mesh = test::side_by_side(box_of_bricks({0, 0, 0}, {1, 1, 1}, 2),
                                          box_of_bricks({0, 0, 2}, {1, 1, 3}, 2));
  std::vector<std::uint32_t> part;
  for (CellId cell = 0; cell < 16; ++cell) part.push_back(cell >= 8 ? 2 : cell % 2);
  write_parted_mesh(path("box.zparts"), mesh, part, 3, [](const std::string&) {});
  const Answer answer = run(path("box.zparts"));
  EXPECT_EQ(answer.exit_code, 0) << answer.output;
  for (const char* words :
       {"16 (16 brick8)",
        "3; the largest weighs 1.500 times the mean and has 1.500 times the mean's cells",
        "63 nodes in all parts", "4 faces cut",
        "part 1       box.1.zoo: 4 cells, 18 nodes; 4 faces to 1 neighbours: 0 (4)",
        "part 2       box.2.zoo: 8 cells, 27 nodes; no neighbour"})
    EXPECT_THAT(answer.output, HasSubstr(words));
  ASSERT_EQ(run(path("box.zparts") + " --json " + path("facts.json")).exit_code, 0);
  const auto parts = nlohmann::json::parse(test::bytes_of(path("facts.json")))["parts"];
  EXPECT_EQ(parts["count"], 3);
  EXPECT_EQ(parts["balance"], 1.5);
  EXPECT_EQ(parts["cell_balance"], 1.5);
  EXPECT_EQ(parts["nodes"], 63);
  EXPECT_EQ(parts["cut_faces"], 4);
  EXPECT_EQ(parts["each"][0]["file"], "box.0.zoo");
  EXPECT_EQ(parts["each"][0]["cells"], 4);
  EXPECT_EQ(parts["each"][0]["neighbours"][0]["part"], 1);
  EXPECT_EQ(parts["each"][0]["neighbours"][0]["faces"], 4);
  EXPECT_TRUE(parts["each"][2]["neighbours"].empty());
}
#endif

TEST_F(Info, DescribesAnOrder) {
  OrderRecord record{std::string(32, 'a'), std::string(32, 'b'), {}};
  record.order.cells = std::vector<CellId>{2, 0, 1};
  record.order.groups = std::vector<CellGroup>{{1, 2}};
  record.order.algorithm = "exact";
  write_order_file(path("box.order"), record);
  const auto facts = nlohmann::json::parse(run(path("box.order") + " --json -").output);
  EXPECT_EQ(facts["holds"], "order");
  EXPECT_EQ(facts["order"]["cells"], 3);
  EXPECT_EQ(facts["order"]["largest_group"], 2);
  EXPECT_EQ(facts["order"]["mesh_hash"], record.mesh_hash);
  EXPECT_THAT(run(path("box.order")).output, HasSubstr("3 cells by exact; 1 groups of 2 cells"));
}

TEST_F(Info, DescribesAnImage) {
  Image image(4, 2, rgba_channels());
  image.at(3, 1, 0) = 0.75;
  image.at(0, 0, 1) = std::nan("");
  write_image(path("a.exr"), image, {false, false, {{"hiac:mesh", "0123"}}});
  const Answer answer = run(path("a.exr"));
  EXPECT_EQ(answer.exit_code, 0);
  for (const char* words :
       {"4 x 2 pixels", "R: 0 to 0.75", "G: 0 to 0, 1 not finite", "hiac:mesh: 0123"})
    EXPECT_THAT(answer.output, HasSubstr(words));
  for (const char* name : {"a.png", "a.tiff", "a.sgi", "a.rgba", "a.pfm", "a.hdr"}) {
    write_image(path(name), image);
    EXPECT_THAT(run(path(name)).output, HasSubstr("4 x 2 pixels")) << name;
  }
  image.at(3, 1, 3) = 1;
  write_image(path("a.tif"), image, {.linear = true});
  EXPECT_THAT(run(path("a.tif")).output, testing::Not(HasSubstr("R: 0 to 0.74902\n")));
  EXPECT_THAT(run(path("a.tif") + " --linear").output, HasSubstr("R: 0 to 0.74902\n"));
  write_image(path("a.f32"), image);
  EXPECT_EQ(run(path("a.f32")).exit_code, 2);
  EXPECT_THAT(run(path("a.f32") + " --width 2").output, HasSubstr("2 x 4 pixels"));
}

TEST_F(Info, WritesAStarterView) {
  write_zoo_file(path("box.zoo"), {box_of_bricks({0, 0, 0}, {1, 2, 2}, 2), {}});
  EXPECT_EQ(run(path("box.zoo") + " --starter-view -o " + path("view.toml")).exit_code, 0);
  EXPECT_EQ(read_scene(path("view.toml")).scene.volume.extinction->field, "x");
  EXPECT_THAT(run(path("box.zoo") + " --starter-view").output, HasSubstr("[camera]"));
}

TEST_F(Info, AnswersBadInputInOneLine) {
  std::ofstream(path("text")) << "hello";
  std::ofstream(path("a.png")) << "hello";
#ifdef HIAC_WITH_FORMATS
  const int foreign = 3;
#else
  const int foreign = 4;  // the program that would read it is not there
#endif
  const std::pair<std::string, int> cases[] = {{path("none"), 3},
                                               {path("text"), foreign},
                                               {path("a.png"), 3},
                                               {path("text") + " --starter-view", foreign},
                                               {folder_.path().string(), 3},
                                               {"< /dev/null", 3},
                                               {"--unknown", 2}};
  for (const auto& [arguments, exit_code] : cases) {
    const Answer answer = run(arguments);
    EXPECT_EQ(answer.exit_code, exit_code) << arguments << "\n" << answer.output;
    EXPECT_EQ(std::count(answer.output.begin(), answer.output.end(), '\n'), 1) << answer.output;
    EXPECT_THAT(answer.output, testing::StartsWith("hiac-info: "));
  }
}

}  // namespace
}  // namespace hiac::tools
