// No output of any tool, under any extension, destroys a device, a pipe, an input, or a file of
// another kind.

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <sys/wait.h>
#include <unistd.h>

#include "hiac/image/image_io.hpp"
#include "hiac/mesh/zoo_container.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/scratch_folder.hpp"

namespace hiac::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr const char* kView =
    "[image]\nwidth = 8\nheight = 6\n[camera]\nprojection = \"orthographic\"\n"
    "eye = [0.5, 0.5, -3.0]\nlook_at = [0.5, 0.5, 0.0]\nup = [0.0, 1.0, 0.0]\nheight = 2.0\n"
    "[volume.extinction]\nfield = \"f\"\npoints = [[0.0, 1.0], [1.0, 1.0]]\n"
    "[volume.color]\nfield = \"f\"\npoints = [[0.0, 1.0, 0.0, 0.0], [1.0, 0.0, 1.0, 0.0]]\n";

/// An output of a tool: its command without it, the option that names it, and its extension.
struct Output {
  std::string command, option, extension;
  bool repeatable = true;  ///< the same run writes the same bytes
};

std::vector<std::string> words(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

std::vector<Output> all_outputs() {
  std::vector<Output> all;
  for (const char* extension : {".zoo", ".vtu", ".vtkhdf", ".msh", ".stl", ".ply", ".vtp"})
    all.push_back({HIAC_CONVERT " mesh.zoo", "-o", extension, std::string(".vtkhdf") != extension});
  all.push_back({HIAC_CHECK " mesh.zoo", "-o", ".zoo"});
  all.push_back({HIAC_TETRAHEDRALIZE " mesh.zoo --cells", "-o", ".zoo"});
  all.push_back({HIAC_SORT " mesh.zoo --view view.toml", "-o", ".order"});
  all.push_back({HIAC_INFO " mesh.zoo", "-o", ".txt"});
  all.push_back({HIAC_INFO " mesh.zoo --starter-view", "-o", ".toml"});
  for (const std::string& extension : words(image_extensions())) {
    all.push_back({HIAC_RENDER " mesh.zoo --view view.toml", "-o", extension});
    all.push_back({HIAC_RENDER " mesh.zoo --view view.toml -o other.png", "--colorbar", extension});
    all.push_back({HIAC_CHECK " mesh.zoo --picture", "", extension});
    all.push_back({HIAC_COMPARE " a.png b.png", "--heatmap", extension});
  }
  for (const char* command :
       {HIAC_CONVERT " mesh.zoo -o other.zoo", HIAC_CHECK " mesh.zoo -o other.zoo",
        HIAC_TETRAHEDRALIZE " mesh.zoo --cells -o other.zoo",
        HIAC_SORT " mesh.zoo --view view.toml -o other.order", HIAC_INFO " mesh.zoo -o other.txt",
        HIAC_RENDER " mesh.zoo --view view.toml -o other.png", HIAC_COMPARE " a.png b.png"})
    all.push_back({command, "--json", ".json", false});
  return all;
}

class Outputs : public testing::Test {
 protected:
  void SetUp() override {
    ZooMesh mesh = random_delaunay(12, 1);
    add_node_field(mesh, "f", [](const Position& p) { return p[0]; });
    write_zoo_file(path("mesh.zoo"), {mesh, {}});
    std::ofstream(path("view.toml")) << kView;
    write_image(path("a.png"), Image(4, 3, rgba_channels(), std::vector<double>(48, 0.5)));
    write_image(path("b.png"), Image(4, 3, rgba_channels(), std::vector<double>(48, 0.25)));
  }
  [[nodiscard]] std::string path(const std::string& name) const { return folder_.file(name); }

  /// The exit status of a shell command in the folder; complaint() is what it printed.
  [[nodiscard]] int run(const std::string& command) const {
    const std::string line = "cd '" + folder_.path().string() + "' && { " + command +
                             " ; } >stdout.txt 2>stderr.txt </dev/null";
    const int status = std::system(line.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  [[nodiscard]] int run(const Output& output, const std::string& name) const {
    return run("timeout 60 " + output.command + " " + output.option + " " + name);
  }
  [[nodiscard]] std::string bytes_of(const std::string& name) const {
    return test::bytes_of(path(name));
  }
  [[nodiscard]] std::string complaint() const { return bytes_of("stderr.txt"); }

  /// The name to give for an output, and the file that is written for it.
  static std::string named(const Output& output) { return "out" + output.extension; }
  static std::string written(const Output& output) {
    return output.extension == ".f32" ? "out.r.f32" : named(output);
  }
  void remove_outputs() const {
    for (const auto& entry : fs::directory_iterator(folder_.path()))
      if (entry.path().filename().string().starts_with("out")) fs::remove_all(entry.path());
  }

  /// A device of no space; where none can be made, a link to the system's.
  void make_full_device(const std::string& name) const {
    if (mknod(path(name).c_str(), S_IFCHR | 0666, makedev(1, 7)) != 0)
      fs::create_symlink("/dev/full", path(name));
  }

 private:
  ScratchFolder folder_;
};

TEST_F(Outputs, DevicesAreWrittenTo) {
  for (const Output& output : all_outputs()) {
    SCOPED_TRACE(output.command + " " + output.option + " " + output.extension);
    remove_outputs();
    make_full_device(written(output));
    EXPECT_EQ(run(output, named(output)), 3);
    EXPECT_THAT(complaint(), HasSubstr(written(output) + ": cannot be written (No space left"));
    EXPECT_TRUE(fs::is_character_file(path(written(output))));
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
  }
}

TEST_F(Outputs, PipesAreWrittenTo) {
  for (const Output& output : all_outputs()) {
    SCOPED_TRACE(output.command + " " + output.option + " " + output.extension);
    remove_outputs();
    ASSERT_EQ(run(output, named(output)), 0) << complaint();
    const std::string expected = bytes_of(written(output));
    remove_outputs();
    ASSERT_EQ(mkfifo(path(written(output)).c_str(), 0600), 0);
    EXPECT_EQ(run("timeout 60 cat " + written(output) + " > got & timeout 60 " + output.command +
                  " " + output.option + " " + named(output) + "; s=$?; wait; exit $s"),
              0)
        << complaint();
    EXPECT_TRUE(fs::is_fifo(path(written(output))));
    const std::string got = bytes_of("got");
    EXPECT_FALSE(got.empty());
    if (output.repeatable) {
      EXPECT_EQ(got, expected);
    }
  }
}

TEST_F(Outputs, RegularFilesKeepTheirMode) {
  for (const Output& output : all_outputs()) {
    SCOPED_TRACE(output.command + " " + output.option + " " + output.extension);
    remove_outputs();
    std::ofstream(path(written(output))) << "?";
    fs::permissions(path(written(output)), fs::perms(0604));
    EXPECT_EQ(run(output, named(output)), 0) << complaint();
    EXPECT_NE(bytes_of(written(output)), "?");
    EXPECT_EQ(fs::status(path(written(output))).permissions(), fs::perms(0604));
  }
}

TEST_F(Outputs, InputsAreNotOverwritten) {
  for (const Output& output : all_outputs()) {
    SCOPED_TRACE(output.command + " " + output.option + " " + output.extension);
    for (const char* input : {"mesh.zoo", "view.toml", "a.png"}) {
      if (output.command.find(input) == std::string::npos) continue;
      // a link has the extension that the tool wants
      remove_outputs();
      const std::string name = written(output);
      fs::create_symlink(input, path(name));
      const std::string before = bytes_of(input);
      const bool converts_or_checks =
          name == "out.zoo" && output.command.find(HIAC_TETRAHEDRALIZE) == std::string::npos;
      if (converts_or_checks) {
        EXPECT_EQ(run(output, named(output)), 0) << complaint();
        EXPECT_EQ(bytes_of(input).substr(0, 8), before.substr(0, 8));
        continue;
      }
      EXPECT_EQ(run(output, named(output)), 2);
      EXPECT_THAT(complaint(), HasSubstr(name + ": is "));
      EXPECT_EQ(bytes_of(input), before);
    }
  }
}

TEST_F(Outputs, FilesOfAnotherKindAreNotOverwritten) {
  ASSERT_EQ(run(HIAC_SORT " mesh.zoo --view view.toml -o kept.order"), 0) << complaint();
  ASSERT_EQ(run(HIAC_COMPARE " a.png b.png --json kept.json"), 0) << complaint();
  ASSERT_EQ(run(HIAC_CONVERT " mesh.zoo -o kept.vtu"), 0) << complaint();
  const auto is_made = [](const std::string& kept, const Output& output) {
    const std::set<std::string> meshes{".zoo", ".vtu", ".vtkhdf", ".msh", ".stl", ".ply", ".vtp"};
    const bool mesh = meshes.contains(output.extension);
    if (kept == "mesh.zoo" || kept == "kept.vtu") return mesh;
    if (kept == "kept.order") return output.extension == ".order";
    if (kept == "view.toml") return output.extension == ".toml";
    if (kept == "a.png") return has_image_extension("a" + output.extension);
    return output.extension == ".json" || output.extension == ".txt";
  };
  for (const Output& output : all_outputs())
    for (const char* kept :
         {"mesh.zoo", "kept.vtu", "kept.order", "view.toml", "a.png", "kept.json"}) {
      if (is_made(kept, output)) continue;
      SCOPED_TRACE(output.command + " " + output.option + " " + output.extension + " on " + kept);
      remove_outputs();
      fs::copy_file(path(kept), path(written(output)));
      EXPECT_EQ(run(output, named(output)), 2);
      EXPECT_THAT(complaint(), HasSubstr(written(output) + ": is a file of another kind"));
      EXPECT_EQ(bytes_of(written(output)), bytes_of(kept));
    }
}

TEST_F(Outputs, TwoOutputsAreTwoFiles) {
  for (const Output& output : all_outputs()) {
    if (output.option == "--json") continue;
    SCOPED_TRACE(output.command + " " + output.option + " " + output.extension);
    remove_outputs();
    EXPECT_EQ(run(output, named(output) + " --json ./" + written(output)), 2);
    EXPECT_THAT(complaint(), HasSubstr("is also the file of --json"));
    EXPECT_FALSE(fs::exists(path(written(output))));
  }
}

TEST_F(Outputs, WhatCannotBeWrittenIsToldBeforeTheWork) {
  for (const Output& output : all_outputs()) {
    SCOPED_TRACE(output.command + " " + output.option + " " + output.extension);
    remove_outputs();
    // the mesh cannot be read either, but that is found later
    const std::string bytes = bytes_of("mesh.zoo");
    std::ofstream(path("mesh.zoo")) << "damaged";
    EXPECT_EQ(run(output, "none/" + named(output)), 3);
    EXPECT_THAT(complaint(), HasSubstr("none/" + written(output) + ": cannot be written"));
    std::ofstream(path("mesh.zoo"), std::ios::binary) << bytes;
    fs::create_directory(path(written(output)));
    EXPECT_EQ(run(output, named(output)), 3);
    EXPECT_THAT(complaint(), HasSubstr(written(output) + ": cannot be written (Is a directory)"));
  }
}

TEST_F(Outputs, APictureGoesToStdoutInTheFormatThatIsNamed) {
  for (const std::string& extension : words(image_extensions())) {
    if (extension == ".f32") continue;
    SCOPED_TRACE(extension);
    const std::string command = HIAC_RENDER " mesh.zoo --view view.toml";
    ASSERT_EQ(run(command + " -o named" + extension), 0) << complaint();
    ASSERT_EQ(run(command + " -o - --format " + extension.substr(1)), 0) << complaint();
    EXPECT_EQ(bytes_of("stdout.txt"), bytes_of("named" + extension));
    ASSERT_EQ(run(command + " -o - --format " + extension + " | cat > piped"), 0) << complaint();
    EXPECT_EQ(bytes_of("piped"), bytes_of("named" + extension));
  }
  EXPECT_EQ(run(HIAC_RENDER " mesh.zoo --view view.toml -o -"), 2);
  EXPECT_THAT(complaint(), HasSubstr("--format EXTENSION expected"));
}

}  // namespace
}  // namespace hiac::test
