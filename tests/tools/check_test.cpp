// hiac-check as a user calls it: alone, in pipes, and on the files of others.

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "hiac/image/image_io.hpp"
#include "hiac/mesh/zoo_container.hpp"
#include "hiac/order/order_file.hpp"
#include "tests/order/hard_meshes.hpp"
#include "tests/order/order_meshes.hpp"
#include "tests/support/meshes.hpp"
#include "tests/tools/tool_folder.hpp"

namespace hiac::test {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string kView = R"([image]
width = 40
height = 30
[camera]
eye = [2.3, 1.9, 1.4]
look_at = [0.5, 0.5, 0.5]
up = [0.0, 0.0, 1.0]
fov = 35.0
[volume.extinction]
field = "f"
points = [[0.0, 0.1], [1.0, 3.0]]
)";

class CheckTool : public ToolFolder {
 protected:
  void SetUp() override {
    ToolFolder::SetUp();
    std::ofstream(file("view.toml")) << kView;
  }

  // hiac-check with the arguments, its streams in out.txt and err.txt.
  [[nodiscard]] int check(const std::string& arguments) const {
    return run("CHECK='" HIAC_CHECK "'; $CHECK " + arguments);
  }
  void write(const std::string& name, ZooMesh mesh) const {
    add_node_field(mesh, "f", smooth_field);
    write_zoo_file(file(name), {mesh, {}});
  }
  [[nodiscard]] nlohmann::json facts() const {
    return nlohmann::json::parse(bytes_of(file("facts.json")));
  }
};

const ZooMesh kTangled = inverted(structured(2, Cut::tetrahedra), [](CellId c) { return c == 5; });

TEST_F(CheckTool, AValidMeshIsPassedOnAsItIs) {
  write("m.zoo", structured(2, Cut::bricks));
  ASSERT_EQ(check("m.zoo --overlap --cycles --directions 5 --json facts.json"), 0) << complaint();
  EXPECT_TRUE(bytes_of(file("out.txt")) == bytes_of(file("m.zoo")));
  EXPECT_EQ(facts()["valid"], true);
  EXPECT_EQ(facts()["acyclic"], "delaunay");
  EXPECT_EQ(facts()["overlap"]["by_boundary"], true);
  EXPECT_EQ(facts()["views"].size(), 5U);
  EXPECT_TRUE(facts()["findings"].empty());
  EXPECT_THAT(complaint(), HasSubstr("8 brick8; 27 nodes"));
}

TEST_F(CheckTool, AnInvalidMeshIsNamedAndStopsAPipe) {
  write("m.zoo", kTangled);
  EXPECT_EQ(check("m.zoo --json facts.json"), 1);
  EXPECT_EQ(bytes_of(file("out.txt")), "");
  EXPECT_THAT(complaint(), HasSubstr("hiac-check: m.zoo: the mesh is invalid (1 inverted cells)"));
  EXPECT_EQ(facts()["valid"], false);
  EXPECT_EQ(facts()["findings"][0]["defect"], "inverted");
  EXPECT_EQ(facts()["findings"][0]["ids"], nlohmann::json::array({5}));
  EXPECT_EQ(facts()["exit_code"], 1);
  const std::string rest = " | $SORT --view view.toml | $RENDER --view view.toml -o p.npy";
  EXPECT_EQ(check("m.zoo" + rest), 3);
  EXPECT_THAT(complaint(), HasSubstr("hiac-render: stdin: stream ended before"));
  EXPECT_FALSE(std::filesystem::exists(file("p.npy")));
  EXPECT_EQ(check("m.zoo --repair" + rest), 0) << complaint();
  EXPECT_TRUE(std::filesystem::exists(file("p.npy")));
}

TEST_F(CheckTool, RepairSaysWhatItDid) {
  write("m.zoo", kTangled);
  ASSERT_EQ(check("m.zoo --repair -o mended.zoo --json facts.json"), 0) << complaint();
  EXPECT_THAT(complaint(), HasSubstr("repaired: 1 cells reoriented, 0 cells without volume"));
  EXPECT_EQ(facts()["repair"]["reoriented_cells"], 1);
  EXPECT_EQ(check("mended.zoo --overlap"), 0);
  ASSERT_EQ(check("m.zoo --repair -q --json - >facts.json"), 0);
  EXPECT_EQ(facts()["valid"], true);
}

// Orders belong to the mesh as it was: a mended mesh goes without them, any other keeps its own.
TEST_F(CheckTool, RepairDropsOrders) {
  for (const bool mended : {true, false}) {
    write("m.zoo", mended ? kTangled : structured(2, Cut::tetrahedra));
    ASSERT_EQ(run("$SORT m.zoo --view view.toml >sorted.zoo"), 0) << complaint();
    ASSERT_EQ(read_order_chunks(file("sorted.zoo")).size(), 1U);
    ASSERT_EQ(check("sorted.zoo --repair -o r.zoo"), 0) << complaint();
    EXPECT_EQ(read_zoo_file(file("r.zoo")).extras.size(), mended ? 0U : 1U);
    EXPECT_EQ(complaint().find("do not fit the repaired mesh") != std::string::npos, mended);
    EXPECT_EQ(run("$RENDER r.zoo --view view.toml -o p.npy"), 0) << complaint();
  }
}

TEST_F(CheckTool, TheMeshsConvexityIsToldWithWhatRefutesIt) {
  write("box.zoo", structured(2, Cut::bricks));
  ASSERT_EQ(check("box.zoo -o out.zoo --cycles --json facts.json"), 0) << complaint();
  EXPECT_THAT(complaint(), HasSubstr("the mesh is convex"));
  EXPECT_EQ(facts()["convexity"]["verdict"], "convex");
  EXPECT_TRUE(facts().contains("acyclic"));  // a proof needs no view
  write("l.zoo", keep_cells(structured(2, Cut::bricks),
                            [](const Position& p, CellId) { return p[0] < 0.5 || p[1] < 0.5; }));
  ASSERT_EQ(check("l.zoo -o out.zoo --json facts.json"), 0) << complaint();
  EXPECT_THAT(complaint(), HasSubstr("not convex: 2 edges of its boundary bend inwards: "));
  EXPECT_EQ(facts()["convexity"]["verdict"], "not convex");
  EXPECT_EQ(facts()["convexity"]["edges"].size(), 2U);
  ASSERT_EQ(check("l.zoo -o out.zoo --picture p.npy --size 40x30"), 0) << complaint();
  EXPECT_EQ(read_image(file("p.npy")).image.width(), 40U);
}

TEST_F(CheckTool, QualityInTextAndJson) {
  write("m.zoo", side_by_side(structured(2, Cut::bricks),
                              moved(structured(1, Cut::tetrahedra), [](const Position& p) {
                                return Position{p[0] + 3, p[1], p[2]};
                              })));
  ASSERT_EQ(check("m.zoo -o out.zoo --quality --json facts.json"), 0) << complaint();
  EXPECT_THAT(complaint(), HasSubstr("components 2, boundary faces 36, boundary shells 2, "
                                     "cavities 0, tunnels 0"));
  EXPECT_THAT(complaint(), HasSubstr("quality of 8 brick8, volume 1\n"));
  EXPECT_THAT(complaint(), HasSubstr("least dihedral angle, degrees"));
  EXPECT_THAT(complaint(), HasSubstr("0.5..0.6: 6"));  // the tetrahedra's scaled Jacobians
  const auto quality = facts()["quality"];
  EXPECT_EQ(quality["components"], 2);
  EXPECT_EQ(quality["tunnels"], 0);
  ASSERT_EQ(quality["kinds"].size(), 2U);
  EXPECT_EQ(quality["kinds"][1]["kind"], "brick8");
  const auto angles = quality["kinds"][1]["figures"][2];
  EXPECT_EQ(angles["figure"], "largest_dihedral");
  EXPECT_EQ(angles["unit"], "degrees");
  EXPECT_EQ(angles["largest"], 90);
  EXPECT_EQ(angles["percentiles"]["99"], 90);
  EXPECT_EQ(angles["histogram"]["counts"].size(), angles["histogram"]["edges"].size() + 1);
  ASSERT_EQ(check("m.zoo -o out.zoo --json facts.json"), 0) << complaint();
  EXPECT_FALSE(facts().contains("quality"));
}

TEST_F(CheckTool, FactsThatCannotBeWrittenAreAnInputError) {
  write("m.zoo", structured(1, Cut::bricks));
  EXPECT_EQ(check("m.zoo -o out.zoo --json nowhere/facts.json"), 3);
  EXPECT_THAT(complaint(), HasSubstr("hiac-check: nowhere/facts.json: "));
  write("t.zoo", kTangled);
  EXPECT_EQ(check("t.zoo --json /dev/full"), 1);  // what went wrong first decides
}

// Numbers that no mesh may have arrive in containers that others wrote.
TEST_F(CheckTool, NumbersAreJudgedNotRefused) {
  write("m.zoo", structured(1, Cut::bricks));
  std::string bytes = bytes_of(file("m.zoo"));
  const ZooFile whole = read_zoo_file(file("m.zoo"));
  EXPECT_NO_THROW(read_zoo_file(file("m.zoo"), MeshNumbers::as_given));
  EXPECT_EQ(check("nothing.zoo"), 3);
  bytes.resize(bytes.size() - 8);
  std::ofstream(file("short.zoo"), std::ios::binary) << bytes;
  EXPECT_EQ(check("short.zoo"), 3);
  EXPECT_THAT(complaint(), HasSubstr("short.zoo: "));
}

TEST_F(CheckTool, CyclesAreNamedWithTheirCells) {
  write("m.zoo", pinwheel());
  ASSERT_EQ(check("m.zoo --cycles --view view.toml --set 'camera.eye=[0,0,9]' --set "
                  "'camera.up=[1,0,0]' --set 'camera.look_at=[0,0,0]' --json facts.json"),
            0)
      << complaint();
  const auto group = facts()["views"][0]["groups"][0];
  EXPECT_EQ(group["cells"], nlohmann::json::array({1, 2, 3}));
  EXPECT_EQ(group["cycle"].size(), 3U);
  EXPECT_EQ(group["cycle"][0]["step"], "face");
  EXPECT_EQ(facts()["acyclic"], "unknown");
  EXPECT_THAT(complaint(), HasSubstr("1 -face->"));
}

// Each cell is convex, and so is the boundary along its edges; but they go around twice.
TEST_F(CheckTool, CyclesAreNotClaimedOfCellsThatOverlap) {
  write("m.zoo", wound(5, 2));
  EXPECT_EQ(check("m.zoo --overlap --cycles --directions 3 --json facts.json"), 1);
  EXPECT_EQ(facts()["convexity"]["verdict"], "unknown");
  EXPECT_EQ(facts()["acyclic"], "unknown");
  EXPECT_EQ(facts()["not_proven_acyclic"], "cells overlap");
  EXPECT_EQ(facts()["cells_overlap"], true);
  EXPECT_THAT(complaint(), HasSubstr("; but cells overlap: between them there is no order"));
  EXPECT_THAT(complaint(), HasSubstr("not proven free of cycles from everywhere: cells overlap"));
  EXPECT_EQ(check("m.zoo --cycles --directions 3 -o out.zoo --json facts.json"), 0);
  EXPECT_THAT(complaint(), HasSubstr(", if no cells overlap (--overlap)"));
  EXPECT_EQ(facts()["acyclic"], "unknown");
  write("grid.zoo", structured(2, Cut::tetrahedra));
  EXPECT_EQ(check("grid.zoo --cycles --directions 3 -o out.zoo --json facts.json"), 0);
  EXPECT_THAT(complaint(), HasSubstr("3 of 3 views without cycles\n"));
  EXPECT_THAT(complaint(), HasSubstr("  Delaunay; some neighbours have a circumsphere in common"));
  EXPECT_EQ(facts()["delaunay"], "weak");
  EXPECT_EQ(facts()["acyclic"], "regular");
}

TEST_F(CheckTool, ThePictureShowsTheOffenders) {
  write("m.zoo", kTangled);
  EXPECT_EQ(check("m.zoo --picture bad.npy --size 160x120"), 1) << complaint();
  write("valid.zoo", structured(2, Cut::tetrahedra));
  EXPECT_EQ(check("valid.zoo --picture good.npy --size 160x120"), 0) << complaint();
  const auto reddest = [&](const std::string& name) {
    const Image image = read_image(file(name)).image;
    double most = 0;
    for (std::size_t i = 0; i + 3 < image.values().size(); i += 4)
      most = std::max(most, image.values()[i] - image.values()[i + 1]);
    return most;
  };
  EXPECT_GT(reddest("bad.npy"), 0.4);  // the glass in front shines through
  EXPECT_LT(reddest("good.npy"), 0.05);
}

TEST_F(CheckTool, ThePictureShowsThousandsOfOffenders) {
  write("m.zoo", inverted(structured(8, Cut::tetrahedra), [](CellId c) { return c % 5 < 2; }));
  EXPECT_EQ(check("m.zoo --picture bad.npy --size 80x60"), 1) << complaint();
  const Image image = read_image(file("bad.npy")).image;
  std::size_t red = 0;
  for (std::size_t i = 0; i + 3 < image.values().size(); i += 4)
    red += image.values()[i] - image.values()[i + 1] > 0.3 ? 1 : 0;
  EXPECT_GT(red, 800U);
}

// Saddles in one another's hollows: whether they overlap is not decided.
TEST_F(CheckTool, UndecidedOverlapsAreOneLineWithExamples) {
  const auto saddle = [](double x, double z) {
    return moved(structured(1, Cut::bricks), [&](const Position& p) {
      return Position{p[0] + x, p[1], p[2] + z + 0.4 * (p[0] - 0.5) * (p[1] - 0.5)};
    });
  };
  ZooMesh mesh = side_by_side(saddle(0, 0), saddle(0, 1.01));
  for (int i = 1; i < 5; ++i)
    mesh = side_by_side(mesh, side_by_side(saddle(3 * i, 0), saddle(3 * i, 1.01)));
  write("m.zoo", mesh);
  ASSERT_EQ(check("m.zoo --overlap -o out.zoo --json facts.json"), 0) << complaint();
  EXPECT_THAT(complaint(),
              HasSubstr("5 pairs of cells, curved or with bent faces, whose overlap is "
                        "undecided: 0+1 2+3 4+5 ...\n"));
  EXPECT_THAT(facts()["findings"].dump(), HasSubstr("[8,9]"));  // all of them, up to --max-ids
}

TEST_F(CheckTool, OptionsThatDoNotFitAreUsageErrors) {
  write("m.zoo", structured(1, Cut::bricks));
  for (const char* options :
       {"--size 8x6", "--picture x.png --size 8", "--directions 3", "--view view.toml",
        "--planarity -1", "--cycles --directions 3 --set a=1", "--picture x.txt", "-o - --json -"})
    EXPECT_EQ(check(std::string("m.zoo ") + options), 2) << options;
}

}  // namespace
}  // namespace hiac::test
