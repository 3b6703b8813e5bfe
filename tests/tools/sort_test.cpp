// hiac-sort and hiac-render as a user calls them: orders told about, verified, and made for every
// frame of a camera path.

#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "hiac/image/image_io.hpp"
#include "hiac/mesh/zoo_container.hpp"
#include "hiac/order/algorithm.hpp"
#include "hiac/order/order_file.hpp"
#include "hiac/scene/camera_path.hpp"
#include "hiac/scene/specification.hpp"
#include "tests/order/order_meshes.hpp"
#include "tests/support/cube_view.hpp"
#include "tests/support/meshes.hpp"
#include "tests/tools/tool_folder.hpp"

namespace hiac::test {
namespace {

using testing::HasSubstr;

const std::string kView = cube_view(40, 30);

class SortTool : public ToolFolder {
 protected:
  void SetUp() override {
    ToolFolder::SetUp();
    mesh_ = random_delaunay(12, 4);
    add_node_field(mesh_, "f", smooth_field);
    write_zoo_file(file("m.zoo"), {mesh_, {}});
    std::ofstream(file("view.toml")) << kView;
    std::ofstream(file("turn.toml")) << kView << "[turntable]\nframes = 5\n";
  }

  [[nodiscard]] nlohmann::json facts() const {
    return nlohmann::json::parse(bytes_of(file("facts.json")));
  }

  ZooMesh mesh_;
};

TEST_F(SortTool, ToldWhatItMet) {
  ASSERT_EQ(run("$SORT m.zoo --view view.toml -o m.order --stats --json facts.json"), 0)
      << complaint();
  for (const char* words : {"tetrahedron4", "crossed one way", "edge-on", "gap arrows", "groups",
                            "components", "basis", "bytes a cell"})
    EXPECT_THAT(complaint(), HasSubstr(words));
  const auto order = facts()["order"];
  EXPECT_EQ(order["cells"], mesh_.cell_count());
  EXPECT_EQ(order["algorithm"], "exact");
  EXPECT_EQ(order["arrows_one_way"].get<int>() + order["edge_on"].get<int>() +
                order["arrows_both_ways"].get<int>(),
            order["shared_faces"].get<int>());
  EXPECT_GT(facts()["bytes_per_cell"], 0);
  for (const char* stage : {"read", "adjacency", "basis", "order"})
    EXPECT_GE(facts()["seconds"][stage], 0) << stage;
}

TEST_F(SortTool, ARightOrderIsProven) {
  ASSERT_EQ(run("$SORT m.zoo --view view.toml -o m.order --verify --json facts.json"), 0)
      << complaint();
  const std::size_t n = mesh_.cell_count();
  EXPECT_THAT(complaint(), HasSubstr("verified: " + std::to_string(n * (n - 1) / 2) + " pairs"));
  EXPECT_EQ(facts()["order"]["verified"]["pairs"], n * (n - 1) / 2);
  EXPECT_EQ(run("$SORT m.zoo --view view.toml --order m.order --verify"), 0) << complaint();
  EXPECT_EQ(bytes_of(file("out.txt")), "");
}

TEST_F(SortTool, AWrongOrderIsRefusedByItsFirstPair) {
  ASSERT_EQ(run("$SORT m.zoo --view view.toml -o m.order"), 0);
  OrderRecord record = read_order_file(file("m.order"));
  std::vector<CellId> cells(record.order.cells.begin(), record.order.cells.end());
  std::ranges::reverse(cells);
  record.order.cells = std::vector<CellId>(cells);
  write_order_file(file("m.order"), record);
  EXPECT_EQ(run("$SORT m.zoo --view view.toml --order m.order --verify --json facts.json"), 1);
  EXPECT_THAT(complaint(),
              HasSubstr("the order is wrong: cell " + std::to_string(cells[0]) + " comes before "));
  EXPECT_THAT(complaint(), HasSubstr(" that a ray meets first"));
  EXPECT_EQ(std::ranges::count(complaint(), '\n'), 1);
}

TEST_F(SortTool, EveryAlgorithmSignsItsOrder) {
  for (const OrderAlgorithm algorithm : kOrderAlgorithms) {
    const std::string name(algorithm_name(algorithm));
    ASSERT_EQ(run("$SORT m.zoo --view view.toml -o m.order --stats --algorithm " + name), 0)
        << complaint();
    EXPECT_THAT(complaint(), HasSubstr(name));
    EXPECT_EQ(read_order_file(file("m.order")).order.algorithm, name);
    ASSERT_EQ(run("$RENDER m.zoo --view view.toml --order m.order -o x.npy"), 0) << complaint();
    EXPECT_EQ(complaint().find("not by the exact algorithm") == std::string::npos, name == "exact");
  }
  ASSERT_EQ(run("$SORT m.zoo --view view.toml -o a.order --algorithm stein --verify"), 0)
      << complaint();
  ASSERT_EQ(run("$SORT m.zoo --view view.toml -o b.order --algorithm multitiled --tiles 3x2 "
                "--balanced --verify"),
            0)
      << complaint();
  EXPECT_TRUE(std::ranges::equal(read_order_file(file("a.order")).order.cells,
                                 read_order_file(file("b.order")).order.cells));
  EXPECT_EQ(run("$SORT m.zoo --view view.toml -o c.order --algorithm centroid --verify"), 1);
  EXPECT_FALSE(std::filesystem::exists(file("c.order")));
}

// Three bars each of which is in part in front of the next.
TEST_F(SortTool, ACycleIsAGroupOrARefusal) {
  write_zoo_file(file("cycle.zoo"), {pinwheel(), {}});
  const std::string view =
      " --view view.toml --set 'camera.eye=[0,0,9]' --set 'camera.up=[1,0,0]'"
      " --set 'camera.look_at=[0,0,0]'";
  ASSERT_EQ(run("$SORT cycle.zoo -o m.order --verify" + view), 0) << complaint();
  EXPECT_EQ(read_order_file(file("m.order")).order.groups.size(), 1U);
  EXPECT_EQ(run("$SORT cycle.zoo -o n.order --algorithm stein" + view), 1);
  EXPECT_THAT(complaint(), HasSubstr("a cycle of 3 found"));
  EXPECT_EQ(std::ranges::count(complaint(), '\n'), 1);
  EXPECT_FALSE(std::filesystem::exists(file("n.order")));
}

// A cube and a bar through it: what does not overlap is in order where what does is looked for.
TEST_F(SortTool, CellsThatOverlapAreKeptTogetherWhereTheyAreLookedFor) {
  const ZooMesh cube = structured(3, Cut::bricks);
  const ZooMesh bar = moved(cube, [](const Position& p) {
    return Position{p[0] + 0.1, 0.3 * p[1] + 0.2, 0.3 * p[2] + 0.3};
  });
  ZooMesh both = side_by_side(cube, bar);
  add_node_field(both, "f", smooth_field);
  write_zoo_file(file("both.zoo"), {both, {}});
  EXPECT_EQ(run("$SORT both.zoo --view view.toml -o m.order --verify"), 1);
  ASSERT_EQ(run("$SORT both.zoo --view view.toml -o m.order --verify --overlap --json facts.json"),
            0)
      << complaint();
  EXPECT_GT(facts()["order"]["overlapping_pairs"], 20);
  EXPECT_EQ(run("$SORT both.zoo --view view.toml --order m.order --verify --overlap"), 0)
      << complaint();
  const std::string draw = "$RENDER both.zoo --view view.toml -o ";
  EXPECT_EQ(run(draw + "given.npy --order m.order"), 0) << complaint();
  EXPECT_EQ(run(draw + "looked.npy --overlap"), 0) << complaint();
  EXPECT_EQ(bytes_of(file("given.npy")), bytes_of(file("looked.npy")));
  EXPECT_EQ(run(draw + "both.npy --order m.order --overlap"), 2);
}

TEST_F(SortTool, OptionsThatDoNotFitAreUsageErrors) {
  for (const char* options :
       {"--algorithm best -o o.order", "--tiles 3x3 -o o.order", "--balanced -o o.order",
        "--algorithm multitiled --tiles 3 -o o.order",
        "--algorithm multitiled --tiles 0x3 -o o.order",
        "--algorithm multitiled --tiles 3x3x -o o.order", "--order m.order",
        "--order m.order --verify -o o.order", "--frame 0 -o o.order"})
    EXPECT_EQ(run(std::string("$SORT m.zoo --view view.toml ") + options), 2) << options;
  for (const char* options : {"", "--frames --frame 1", "--frame 5"})
    EXPECT_EQ(run(std::string("$RENDER m.zoo --view turn.toml -o x.png ") + options), 2) << options;
  EXPECT_THAT(complaint(), HasSubstr("expected 0 to 4, found 5"));
  EXPECT_EQ(run("$RENDER m.zoo --view turn.toml -o x.png"), 2);
  EXPECT_THAT(complaint(), HasSubstr("turn.toml: holds a camera path of 5 frames: --frames"));
  EXPECT_EQ(run("$RENDER m.zoo --view view.toml --frames -o x.png"), 2);
  EXPECT_EQ(run("$RENDER m.zoo --view view.toml --frame 0 -o x.png"), 2);
  EXPECT_EQ(run("$RENDER m.zoo --view turn.toml --frames -o x-%d-%d.png"), 2);
  EXPECT_FALSE(std::filesystem::exists(file("x.png")));
}

// Each frame as if it had been asked for alone, from its own specification.
TEST_F(SortTool, FramesAreTheirViewsPictures) {
  ASSERT_EQ(run("$SORT m.zoo --view turn.toml -o m.order"), 0) << complaint();
  EXPECT_EQ(read_order_chunks(file("m.order")).size(), 5U);
  ASSERT_EQ(run("$RENDER m.zoo --view turn.toml --order m.order --frames -o a.npy"), 0)
      << complaint();
  EXPECT_THAT(complaint(), HasSubstr("a-0004.npy: 5 of 5 frames"));
  ASSERT_EQ(run("$RENDER m.zoo --view turn.toml --frames -o b-%02d.npy --json facts.json"), 0);
  ASSERT_EQ(run("cat m.zoo | $SORT --view turn.toml | $RENDER --view turn.toml --frames -o c.npy"),
            0)
      << complaint();
  const Scene scene = read_scene(file("turn.toml")).scene;
  for (std::uint32_t frame = 0; frame < 5; ++frame) {
    const std::string number = std::to_string(frame);
    const auto eye = camera_at(scene, frame).eye;
    char set[200];
    std::snprintf(set, sizeof set, "--set 'camera.eye=[%.17g, %.17g, %.17g]'", eye[0], eye[1],
                  eye[2]);
    ASSERT_EQ(run("$RENDER m.zoo --view view.toml -o alone.npy " + std::string(set)), 0);
    const std::string alone = bytes_of(file("alone.npy"));
    EXPECT_GT(alone.size(), 9600U);
    EXPECT_TRUE(bytes_of(file("a-000" + number + ".npy")) == alone) << frame;
    EXPECT_TRUE(bytes_of(file("b-0" + number + ".npy")) == alone) << frame;
    EXPECT_TRUE(bytes_of(file("c-000" + number + ".npy")) == alone) << frame;
    ASSERT_EQ(
        run("$RENDER m.zoo --view turn.toml --order m.order --frame " + number + " -o one.npy"), 0);
    EXPECT_TRUE(bytes_of(file("one.npy")) == alone) << frame;
    EXPECT_EQ(facts()["frames"][frame]["frame"], frame);
    EXPECT_EQ(facts()["frames"][frame]["file"], "b-0" + number + ".npy");
  }
}

TEST_F(SortTool, AFramesSpecificationIsInItsFile) {
  ASSERT_EQ(run("$RENDER m.zoo --view turn.toml --frame 3 -o x-%d.exr"), 0) << complaint();
  const Scene scene = scene_of_frame(read_scene(file("turn.toml")).scene, 3);
  for (const auto& [name, text] : read_image(file("x-3.exr")).attributes)
    if (name == "hiac:specification") {
      EXPECT_EQ(parse_scene(text, "header").scene, scene);
    }
}

TEST_F(SortTool, AnOrderIsNeededForEveryFrame) {
  ASSERT_EQ(run("$SORT m.zoo --view turn.toml --frame 2 -o m.order"), 0);
  EXPECT_EQ(run("$RENDER m.zoo --view turn.toml --order m.order --frame 2 -o x.npy"), 0);
  EXPECT_EQ(run("$RENDER m.zoo --view turn.toml --order m.order --frames -o y.npy"), 3);
  EXPECT_THAT(complaint(), HasSubstr("m.order: the order belongs to another view"));
  EXPECT_FALSE(std::filesystem::exists(file("y-0002.npy")));
  EXPECT_EQ(run("$RENDER m.zoo --view view.toml --order m.order -o y.npy"), 3);
}

// Frames that only zoom have one view's order.
TEST_F(SortTool, ViewsAreOrderedOnce) {
  std::ofstream(file("zoom.toml"))
      << std::string(kView).replace(kView.find("[camera]"), 8, "[[camera]]\nframe = 0")
      << "[[camera]]\nframe = 6\nfov = 10\n";
  ASSERT_EQ(run("$SORT m.zoo --view zoom.toml -o m.order --stats --verify --json facts.json"), 0)
      << complaint();
  EXPECT_EQ(read_order_chunks(file("m.order")).size(), 1U);
  ASSERT_EQ(run("$RENDER m.zoo --view zoom.toml --order m.order --frames -o x.npy"), 0);
  EXPECT_TRUE(std::filesystem::exists(file("x-0006.npy")));
}

TEST_F(SortTool, AnInterruptLeavesWholeFrames) {
  // (a shell lets no command that it runs aside hear SIGINT; the tools take both alike)
  // it tells of each frame that it has written: the fourth one ends it
  ASSERT_EQ(run("mkfifo told; $RENDER m.zoo --view turn.toml --set turntable.frames=2000 "
                "--size 160x120 --frames -v -o f.npy 2>told & pid=$!; n=0; "
                "while read -r line; do case $line in *' write: '*) n=$((n+1)); "
                "[ $n = 4 ] && kill -TERM $pid;; esac; done <told; wait $pid; [ $? -ge 128 ]"),
            0)
      << complaint();
  std::size_t frames = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with("f-")) continue;
    ++frames;
    EXPECT_TRUE(name.ends_with(".npy")) << name;
    EXPECT_EQ(read_image(entry.path().string()).image.width(), 160U);
  }
  EXPECT_GE(frames, 4U);
  EXPECT_LT(frames, 2000U);
}

// A mesh that does not arrive before the progress is shown, read on a terminal (which `script`
// plays) and, at the same time, on none.
TEST_F(SortTool, ProgressIsShownOnATerminalAlone) {
  std::ofstream(file("feed.sh")) << "read -r _ <$1; cat m.zoo\n";
  std::ofstream(file("shown.sh")) << "sh feed.sh gate | \"$1\" --view view.toml -o x.npy\n";
  // the line is shown again and again: the first one lets both meshes in
  ASSERT_EQ(run("mkfifo gate other; "
                "timeout 60 sh feed.sh other | $RENDER --view view.toml -o y.npy 2>quiet.txt & "
                "quiet=$!; "
                "TERM=xterm timeout 60 script -qefc \"sh shown.sh $RENDER\" /dev/null </dev/null | "
                "stdbuf -o0 tee seen.txt | stdbuf -o0 tr '\\r' '\\n' | { open=; "
                "while read -r line; do case $open$line in no*) ;; *'read, 1 s') open=no; "
                "echo >gate; echo >other;; esac; done; }; wait $quiet"),
            0)
      << complaint();
  EXPECT_THAT(bytes_of(file("seen.txt")), HasSubstr("hiac-render: read, 1 s\r\x1b[K"));
  EXPECT_EQ(bytes_of(file("x.npy")), bytes_of(file("y.npy")));
  const std::string quiet = bytes_of(file("quiet.txt"));
  EXPECT_THAT(quiet, HasSubstr("hiac-render: "));
  EXPECT_EQ(quiet.find("read,"), std::string::npos);
  EXPECT_EQ(quiet.find('\r'), std::string::npos);
}

// A stream that is sorted has one order behind its mesh, that of the last sort; with a path, one
// for each of its views.
TEST_F(SortTool, ASecondSortReplacesTheOrdersOfTheFirst) {
  const std::string other = "--view view.toml --set 'camera.eye=[-2, 0.3, 0.2]'";
  ASSERT_EQ(run("$SORT m.zoo --view view.toml -o first.order && $SORT m.zoo " + other +
                " -o second.order"),
            0)
      << complaint();
  const auto first = read_order_file(file("first.order"));
  const auto second = read_order_file(file("second.order"));
  ASSERT_NE(first.view_hash, second.view_hash);
  ASSERT_EQ(run("cat m.zoo | $SORT --view view.toml | $SORT " + other + " >twice.zoo"), 0)
      << complaint();
  const auto chunks = read_order_chunks(file("twice.zoo"));
  ASSERT_EQ(chunks.size(), 1U);
  const OrderRecord left = decode_order(chunks[0], "twice.zoo");
  EXPECT_EQ(left.view_hash, second.view_hash);
  EXPECT_TRUE(std::ranges::equal(left.order.cells, second.order.cells));
  ASSERT_EQ(run("$SORT twice.zoo --view turn.toml >thrice.zoo"), 0) << complaint();
  EXPECT_EQ(read_order_chunks(file("thrice.zoo")).size(), 5U);
  // the first view's order is no longer there, the last one's is
  EXPECT_EQ(run("$RENDER twice.zoo " + other + " -o x.npy"), 0) << complaint();
}

TEST_F(SortTool, FactsThatCannotBeWrittenAreAnInputError) {
  for (const char* facts : {"nowhere/facts.json", "m.zoo/facts.json"}) {
    EXPECT_EQ(run(std::string("$SORT m.zoo --view view.toml -o m.order --json ") + facts), 3)
        << facts;
    EXPECT_THAT(complaint(), HasSubstr(std::string("hiac-sort: ") + facts + ": "));
    EXPECT_EQ(run(std::string("$RENDER m.zoo --view view.toml -o x.npy --json ") + facts), 3)
        << facts;
    EXPECT_THAT(complaint(), HasSubstr(std::string("hiac-render: ") + facts + ": "));
  }
  EXPECT_EQ(run("$RENDER m.zoo --view view.toml -o x.npy --json - >/dev/full"), 3);
  EXPECT_THAT(complaint(), HasSubstr("hiac-render: stdout: cannot be written"));
  // what went wrong first decides
  EXPECT_EQ(run("$RENDER m.zoo --view turn.toml -o x.npy --json /dev/full"), 2);
}

}  // namespace
}  // namespace hiac::test
