// hiac-render-mpi as a user calls it, by as many processes as the machine has no cores for.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "hiac/image/image_io.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/mesh/parted/write_parts.hpp"
#include "hiac/mesh/zoo_container.hpp"
#include "hiac/scene/toml/edited_text.hpp"
#include "tests/support/cube_view.hpp"
#include "tests/support/meshes.hpp"
#include "tests/tools/tool_folder.hpp"

namespace hiac::test {
namespace {

using testing::HasSubstr;

std::string view() {
  return with_key(cube_view_with_surface(150, 90), "volume.color.range", "\"auto\"") +
         "[render]\ntolerance = 1e-13\n";
}

class RenderMpi : public ToolFolder {
 protected:
  static constexpr std::uint32_t kParts = 5;

  void SetUp() override {
    ToolFolder::SetUp();
    mesh_ = random_delaunay(120, 4);
    add_node_field(mesh_, "f", smooth_field);
    add_node_field(mesh_, "g", [](const Position& p) { return p[2]; });
    write_zoo_file(file("m.zoo"), {mesh_, {}});
    write_parts("m.zparts", mesh_);
    std::ofstream(file("view.toml")) << view();
    std::ofstream(file("turn.toml")) << view() << "[turntable]\nframes = 3\n";
  }

  void write_parts(const std::string& name, const ZooMesh& mesh) const {
    std::mt19937_64 random(1);
    std::vector<std::uint32_t> part(mesh.cell_count());
    for (std::uint32_t& p : part) p = static_cast<std::uint32_t>(random() % kParts);
    write_parted_mesh(file(name), mesh, part, kParts, [](const std::string&) {});
  }

  // Both implementations of MPI understand what concerns them.
  [[nodiscard]] static std::string mpi(int ranks, const std::string& limit = "timeout 60") {
    return fmt::format(
        "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
        "OMPI_MCA_rmaps_base_oversubscribe=1 {} '" HIAC_MPIEXEC "' -n {} ",
        limit, ranks);
  }
  [[nodiscard]] int render(int ranks, const std::string& arguments) const {
    return run(mpi(ranks) + "'" HIAC_RENDER_MPI "' --threads 1 " + arguments);
  }
  // What takes seconds, and writes x.npy.
  [[nodiscard]] static std::string long_work(const std::string& input) {
    return fmt::format(
        "\"" HIAC_RENDER_MPI "\" -q {} --view view.toml --threads 1 --samples 40 -o x.npy", input);
  }
  // The processes that work in the folder.
  [[nodiscard]] std::size_t processes() const {
    std::size_t count = 0;
    std::error_code gone;
    for (const auto& entry : std::filesystem::directory_iterator("/proc"))
      if (std::filesystem::read_symlink(entry.path() / "cwd", gone) == folder_.path()) ++count;
    return count;
  }
  // A command that is ended ends soon, and leaves neither a picture nor a process. Returns its exit
  // code: that of an interrupted launcher may be 0.
  int expect_an_early_end(const std::string& command) {
    const auto start = std::chrono::steady_clock::now();
    const int code = run(command);
    EXPECT_NE(code, 124);  // as after a minute
    const auto has_passed = [&](int seconds) {
      return std::chrono::steady_clock::now() - start > std::chrono::seconds(seconds);
    };
    EXPECT_FALSE(has_passed(10));
    while (processes() > 0 && !has_passed(15))
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_EQ(processes(), 0U);
    EXPECT_FALSE(exists("x.npy"));
    return code;
  }
  void expect_same_picture(const std::string& name, const std::string& expected) const {
    const Image found = read_image(file(name), {.width = 150}).image;
    const Image wanted = read_image(file(expected), {.width = 150}).image;
    ASSERT_EQ(found.values().size(), wanted.values().size());
    for (std::size_t k = 0; k < wanted.values().size(); ++k)
      ASSERT_NEAR(found.values()[k], wanted.values()[k], 1e-13);
  }
  [[nodiscard]] bool exists(const std::string& name) const {
    return std::filesystem::exists(file(name));
  }
  // The lines of the program itself: what runs the processes adds its own.
  [[nodiscard]] std::vector<std::string> told() const {
    std::ifstream text(file("err.txt"));
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);)
      if (line.starts_with("hiac-render-mpi: ")) lines.push_back(line);
    return lines;
  }

  ZooMesh mesh_;
};

TEST_F(RenderMpi, WholeMeshesMakeThePictureOfHiacRender) {
  const std::vector<std::string> all{"--channels depth,cells,error -o {}.npy", "-o {}.png",
                                     "--samples 2 --crop 20,10,90,64 -o {}.npy"};
  for (const std::string& options : all) {
    const std::string name = options.ends_with("png") ? "{}.png" : "{}.npy";
    const std::string common = "-q m.zoo --view view.toml ";
    ASSERT_EQ(run("$RENDER " + common + fmt::format(fmt::runtime(options), "one")), 0);
    for (const int ranks : name.ends_with("png") ? std::vector{1, 2, 8} : std::vector{3}) {
      ASSERT_EQ(render(ranks, common + fmt::format(fmt::runtime(options), "many")), 0)
          << complaint();
      EXPECT_EQ(bytes_of(file(fmt::format(fmt::runtime(name), "one"))),
                bytes_of(file(fmt::format(fmt::runtime(name), "many"))))
          << ranks << options;
    }
  }
}

TEST_F(RenderMpi, PartsMakeOnePictureWhateverTheRanks) {
  ASSERT_EQ(run("$RENDER -q m.zoo --view view.toml -o whole.npy"), 0);
  std::string first;
  for (const int ranks : {1, 2, 3, 8}) {
    ASSERT_EQ(render(ranks, "-q m.zparts --view view.toml -o parts.npy"), 0) << complaint();
    expect_same_picture("parts.npy", "whole.npy");
    if (first.empty()) first = bytes_of(file("parts.npy"));
    EXPECT_EQ(bytes_of(file("parts.npy")), first) << ranks;
  }
}

TEST_F(RenderMpi, PartsHaveTheSkinTheEdgesAndThePercentilesOfTheWhole) {
  const std::string options =
      " --view view.toml --set skin.opacity=0.5 --set edges.width=2.5 --set edges.angle=10"
      " --set 'volume.color.range=\"percentile:5,80\"'";
  ASSERT_EQ(run("$RENDER -q m.zoo -o whole.npy" + options), 0) << complaint();
  std::string first;
  for (const int ranks : {1, 3}) {
    ASSERT_EQ(render(ranks, "-q m.zparts -o parts.npy" + options), 0) << complaint();
    expect_same_picture("parts.npy", "whole.npy");
    if (first.empty()) first = bytes_of(file("parts.npy"));
    EXPECT_EQ(bytes_of(file("parts.npy")), first) << ranks;
  }
}

// Two processes make the first of three frames together, and then each one alone. What is told of
// them is what one process tells, in the order of the frames.
TEST_F(RenderMpi, FramesAreHandedOut) {
  // the mesh lies behind the eye: a warning each
  std::ofstream(file("away.toml")) << with_key(view(), "camera.look_at", "[50.0, 50.0, 50.0]")
                                   << "[turntable]\nframes = 5\ndegrees = 30\n";
  for (const char* spec : {"turn.toml", "away.toml"})
    for (const int ranks : {2, 3, 4}) {
      SCOPED_TRACE(testing::Message() << spec << ' ' << ranks);
      const std::string options = fmt::format("--view {} --frames --json ", spec);
      ASSERT_EQ(run("$RENDER -q m.zoo -o one-%d.png " + options + "one.json"), 0);
      ASSERT_EQ(render(ranks, "-q m.zoo -o many-%d.png " + options + "many.json"), 0)
          << complaint();
      const auto one = nlohmann::json::parse(bytes_of(file("one.json")));
      const auto many = nlohmann::json::parse(bytes_of(file("many.json")));
      ASSERT_EQ(many["frames"].size(), one["frames"].size());
      for (std::size_t k = 0; k < one["frames"].size(); ++k) {
        EXPECT_EQ(bytes_of(file(fmt::format("one-{}.png", k))),
                  bytes_of(file(fmt::format("many-{}.png", k))));
        for (const char* fact : {"frame", "segments", "covered_pixels", "optical_depth"})
          EXPECT_EQ(many["frames"][k][fact], one["frames"][k][fact]) << fact;
        EXPECT_EQ(many["frames"][k]["file"], fmt::format("many-{}.png", k));
      }
      EXPECT_EQ(many["warnings"].size(), one["warnings"].size());
      if (spec[0] == 'a') {
        EXPECT_GE(one["warnings"].size(), 5U);
      }
    }
}

TEST_F(RenderMpi, FramesOfPartsAndOfTheWhole) {
  ASSERT_EQ(run("$RENDER -q m.zoo --view turn.toml --frames -o one-%d.png"), 0);
  ASSERT_EQ(render(2, "-q m.zoo --view turn.toml --frames -o many-%d.png"), 0) << complaint();
  ASSERT_EQ(render(3, "-q m.zparts --view turn.toml --frames --samples 2 -o parts-%d.npy"), 0)
      << complaint();
  ASSERT_EQ(render(1, "-q m.zparts --view turn.toml --frame 2 --samples 2 -o alone.npy"), 0);
  for (const int frame : {0, 1, 2}) {
    EXPECT_EQ(bytes_of(file(fmt::format("one-{}.png", frame))),
              bytes_of(file(fmt::format("many-{}.png", frame))));
    EXPECT_TRUE(exists(fmt::format("parts-{}.npy", frame)));
  }
  EXPECT_EQ(bytes_of(file("parts-2.npy")), bytes_of(file("alone.npy")));
}

TEST_F(RenderMpi, PartsLieBeforeThePictureBehindAndHaveTheColorBarOfTheWhole) {
  ASSERT_EQ(run("$RENDER -q m.zoo --view view.toml --set background.color=[0.2,0.9,0.4] "
                "-o behind.png"),
            0);
  const std::string options =
      " --view view.toml --under behind.png --colorbar {0}-bar.png -o {0}.npy";
  ASSERT_EQ(run("$RENDER -q m.zoo" + fmt::format(fmt::runtime(options), "whole")), 0)
      << complaint();
  for (const int ranks : {1, 3}) {
    ASSERT_EQ(render(ranks, "-q m.zparts" + fmt::format(fmt::runtime(options), "parts")), 0)
        << complaint();
    expect_same_picture("parts.npy", "whole.npy");
    EXPECT_EQ(bytes_of(file("parts-bar.png")), bytes_of(file("whole-bar.png")));
  }
  ASSERT_EQ(render(2, "-q m.zparts --view view.toml --colorbar alone.png"), 0) << complaint();
  EXPECT_EQ(bytes_of(file("alone.png")), bytes_of(file("whole-bar.png")));
}

// By a stand-in for ffmpeg that keeps what it is given.
TEST_F(RenderMpi, PartsMakeTheFilmOfTheWhole) {
  stand_in("ffmpeg", "for last; do :; done\ncat >\"$last\"\n");
  ASSERT_EQ(run(with_stand_ins("$RENDER -q m.zoo --view turn.toml --frames -o whole.mp4")), 0)
      << complaint();
  ASSERT_EQ(run(with_stand_ins(mpi(2) + "'" HIAC_RENDER_MPI
                                        "' -q m.zparts --view turn.toml --frames -o parts.mp4")),
            0)
      << complaint();
  EXPECT_EQ(bytes_of(file("whole.mp4")).size(), 3U * 150 * 90 * 3);
  EXPECT_EQ(bytes_of(file("parts.mp4")), bytes_of(file("whole.mp4")));
}

TEST_F(RenderMpi, ErrorsEndAllProcessesWithOneLine) {
  struct Wrong {
    std::string arguments;
    int code;
    std::string told;
  };
  std::filesystem::copy(file("m.zparts"), file("less.zparts"));
  ASSERT_EQ(run("sed -i s/m.3.zoo/no.3.zoo/ less.zparts"), 0);
  ZooMesh other = mesh_;
  add_node_field(other, "h", smooth_field);
  write_parts("other.zparts", other);
  ASSERT_EQ(run("sed s/m.2.zoo/other.2.zoo/ m.zparts > mixed.zparts"), 0);
  // only the process with the last cells looks at this face
  ZooMesh one_way = mesh_;
  one_way.adjacency = build_face_adjacency(mesh_);
  std::vector<CellId> neighbors(one_way.adjacency->neighbors.begin(),
                                one_way.adjacency->neighbors.end());
  *std::ranges::find(neighbors.rbegin(), neighbors.rend(), kNoCell) = 0;
  one_way.adjacency->neighbors = std::move(neighbors);
  write_zoo_file(file("one-way.zoo"), {one_way, {}});
  const std::vector<Wrong> all{
      {"m.zoo --view view.toml --bad -o x.npy", 2, "--bad"},
      {"m.zoo --view view.toml", 2, "--output is required"},
      {"none.zoo --view view.toml -o x.npy", 3, "none.zoo"},
      {"m.zoo --view view.toml --engine preview -o x.npy", 2, "hiac-render expected"},
      {"one-way.zoo --view view.toml -o x.npy", 3, "are not neighbours of one another"},
      {"m.zparts -o x.npy", 2, "--view is required"},
      {"m.zparts --view view.toml --overlap -o x.npy", 2, "--overlap: not for a mesh in parts"},
      {"m.zparts --view view.toml -o none/x.npy", 3, "none/x.npy"},
      {"m.zparts --view view.toml --under none.png -o x.npy", 3, "none.png"},
      {"m.zparts --view view.toml -o x.mp4", 2, "a film is of several pictures"},
      {"m.zparts --view view.toml --size 99x50 --colorbar x.png", 2, "of a picture"},
      {"less.zparts --view view.toml -o x.npy", 3, "no.3.zoo"},
      {"mixed.zparts --view view.toml -o x.npy", 3, "other.2.zoo"}};
  for (const auto& [arguments, code, line] : all) {
    const int ranks = code == 2 ? 2 : 3;
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(render(ranks, "-q " + arguments), code) << arguments << complaint();
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10)) << arguments;
    EXPECT_THAT(told(), testing::ElementsAre(HasSubstr(line))) << complaint();
    EXPECT_FALSE(exists("x.npy"));
  }
}

// The disk is full once the work is under way: MPI itself needs files before. The program ignores
// SIGXFSZ, the lowest bit of the seventh digit from behind, when it has started MPI.
TEST_F(RenderMpi, AFullDiskLeavesNoPicture) {
  const std::string limit_when_started =
      "(while [ -e /proc/$$ ] && ! grep -q \"^SigIgn.*[13579bdf]......$\" /proc/$$/status; "
      "do sleep 0.01; done; prlimit --pid $$ --fsize=4096)";
  EXPECT_EQ(run(mpi(2) + "sh -c '" + limit_when_started +
                " & exec \"" HIAC_RENDER_MPI
                "\" -q m.zparts --view view.toml --threads 1 --samples 8 -o x.npy'"),
            3)
      << complaint();
  EXPECT_THAT(told(), testing::ElementsAre(HasSubstr("x.npy")));
  EXPECT_FALSE(exists("x.npy"));
}

// Each rank in turn is killed, early and late, or gets what Ctrl-C sends.
TEST_F(RenderMpi, ARankThatDiesEndsAllAndLeavesNoPicture) {
  struct Death {
    const char* input;
    int rank;
    double after;  // seconds
    const char* of;
  };
  for (const auto& [input, rank, after, of] : {Death{"m.zoo", 0, 0.3, "KILL"},
                                               {"m.zoo", 2, 1.2, "KILL"},
                                               {"m.zparts", 1, 0.3, "KILL"},
                                               {"m.zparts", 0, 0.8, "KILL"},
                                               {"m.zparts", 2, 1.2, "KILL"},
                                               {"m.zoo", 1, 0.8, "INT"},
                                               {"m.zparts", 0, 0.8, "INT"},
                                               {"m.zparts", 2, 0.8, "INT"}}) {
    SCOPED_TRACE(fmt::format("{} rank {} {}", input, rank, of));
    // the name of the process that dies is one of its own
    const int code = expect_an_early_end(
        fmt::format("{}sh -c 'r=${{OMPI_COMM_WORLD_RANK:-$PMI_RANK}}; [ $r = {} ] && "
                    "(sleep {}; kill -{} $$) & exec {}'",
                    mpi(3), rank, after, of, long_work(input)));
    EXPECT_NE(code, 0);
  }
}

// What runs the processes gets it, alone, or with them as from a terminal. Nothing is left of the
// picture under another name either.
TEST_F(RenderMpi, CtrlCEndsAllAndLeavesNoPicture) {
  for (const char* input : {"m.zoo", "m.zparts"})
    for (const char* whom : {"--foreground ", ""}) {
      SCOPED_TRACE(fmt::format("{} {}", input, whom));
      expect_an_early_end(mpi(3, fmt::format("timeout --preserve-status {}-s INT 0.8", whom)) +
                          long_work(input));
      EXPECT_THAT(folder_.names(), testing::Each(testing::Not(testing::StartsWith("x.npy"))));
    }
}

}  // namespace
}  // namespace hiac::test
