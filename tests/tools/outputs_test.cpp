// No output of any tool, under any extension, destroys a device, a pipe, an input, or a file of
// another kind.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "tests/support/instrumented.hpp"
#include "tests/tools/output_folder.hpp"

namespace hiac::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr const char* kMeshExtensions = ".zoo .vtu .vtkhdf .msh .stl .ply .vtp";

std::vector<std::string> words(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

/// The programs that draw pictures: as they are there.
std::vector<std::string> picture_programs() {
  std::vector<std::string> programs{HIAC_RENDER};
#ifdef HIAC_PREVIEW
  programs.emplace_back(HIAC_PREVIEW);
#endif
#ifdef HIAC_RENDER_MPI
  programs.emplace_back(HIAC_RENDER_MPI);
#endif
  return programs;
}

/// Whether each start of an output's program costs what ten others do: MPI starts processes of its
/// own, and sanitizers take their time.
bool starts_slowly([[maybe_unused]] const Output& output) {
#ifdef HIAC_RENDER_MPI
  if (output.command.starts_with(HIAC_RENDER_MPI)) return true;
#endif
  return kInstrumented;
}

void add_pictures(std::vector<Output>& all) {
  for (const std::string& extension : words(image_extensions())) {
    for (const std::string& program : picture_programs())
      all.push_back({program + " mesh.zoo --view view.toml", "-o", extension});
    all.push_back({HIAC_RENDER " mesh.zoo --view view.toml -o other.png", "--colorbar", extension});
    all.push_back({HIAC_RENDER " mesh.zoo --view view.toml", "--colorbar", extension});
    all.push_back({HIAC_CHECK " mesh.zoo --size 16x12 --picture", "", extension});
    all.push_back({HIAC_COMPARE " a.png b.png", "--heatmap", extension});
    all.push_back(
        {HIAC_COMPARE " right.png --truth mesh.zoo --view view.toml", "--heatmap", extension});
  }
  all.push_back({HIAC_UMBRELLA " picture mesh.zoo", "-o", ".png"});
  all.push_back({HIAC_UMBRELLA " render mesh.zoo --view view.toml", "-o", ".exr"});
#ifdef HIAC_RENDER_MPI
  all.push_back({HIAC_RENDER_MPI " parts.zparts --view view.toml", "-o", ".png"});
#endif
}

void add_views(std::vector<Output>& all) {
  all.push_back({HIAC_INFO " mesh.zoo --starter-view", "-o", ".toml"});
  for (const std::string& program : picture_programs())
    all.push_back({program + " mesh.zoo --size 16x12 -o other.png", "--save-view", ".toml"});
  all.push_back({HIAC_RENDER " mesh.zoo --pixel 3,3", "--save-view", ".toml"});
  all.push_back({HIAC_RENDER " mesh.zoo --colorbar other.png", "--save-view", ".toml"});
}

void add_reports(std::vector<Output>& all) {
  std::vector<std::string> commands{HIAC_CONVERT " mesh.zoo -o other.zoo",
                                    HIAC_CONVERT " mesh.zoo --list",
                                    HIAC_CONVERT " mesh.zoo --parts 2 -o other.zparts",
                                    HIAC_CHECK " mesh.zoo -o other.zoo",
                                    HIAC_TETRAHEDRALIZE " mesh.zoo --cells -o other.zoo",
                                    HIAC_SORT " mesh.zoo --view view.toml -o other.order",
                                    HIAC_INFO " mesh.zoo -o other.txt",
                                    HIAC_RENDER " mesh.zoo --view view.toml --pixel 3,3",
                                    HIAC_RENDER " mesh.zoo --view view.toml --colorbar other.png",
                                    HIAC_COMPARE " a.png b.png",
                                    HIAC_COMPARE " right.png --truth mesh.zoo --view view.toml"};
  for (const std::string& program : picture_programs())
    commands.push_back(program + " mesh.zoo --view view.toml -o other.png");
#ifdef HIAC_RENDER_MPI
  commands.emplace_back(HIAC_RENDER_MPI " parts.zparts --view view.toml -o other.png");
#endif
  for (const std::string& command : commands) all.push_back({command, "--json", ".json", false});
}

std::vector<Output> all_outputs() {
  std::vector<Output> all;
  for (const std::string& extension : words(kMeshExtensions))
    all.push_back({HIAC_CONVERT " mesh.zoo", "-o", extension, extension != ".vtkhdf"});
  all.push_back({HIAC_CHECK " mesh.zoo", "-o", ".zoo"});
  all.push_back({HIAC_TETRAHEDRALIZE " mesh.zoo --cells", "-o", ".zoo"});
  all.push_back({HIAC_SORT " mesh.zoo --view view.toml", "-o", ".order"});
  all.push_back({HIAC_INFO " mesh.zoo", "-o", ".txt"});
  add_pictures(all);
  add_views(all);
  add_reports(all);
  // an option's further extensions are left out where starts are slow
  std::set<std::string> seen;
  std::erase_if(all, [&](const Output& output) {
    return !seen.insert(output.command + output.option).second && starts_slowly(output);
  });
  return all;
}

/// What a file is, by the name that the tests give it.
std::string kind_of(const std::string& name) {
  const std::string extension = fs::path(name).extension().string();
  const auto meshes = words(kMeshExtensions);
  if (std::ranges::find(meshes, extension) != meshes.end() || extension == ".zparts" ||
      extension == ".inp")
    return "mesh";
  if (has_image_extension(name)) return "image";
  if (extension == ".order") return "order";
  const bool is_map = name.starts_with("map.");
  if (extension == ".toml" || extension == ".pvsm" || extension == ".pvcc" || is_map) return "view";
  return "facts";
}

class Outputs : public OutputFolder {
 protected:
  void SetUp() override {
    OutputFolder::SetUp();
    ASSERT_EQ(run(HIAC_CONVERT " mesh.zoo --parts 2 -o parts.zparts"), 0) << complaint();
    // what is wrong with a picture as a whole is searched for long
    ASSERT_EQ(run(HIAC_RENDER " mesh.zoo --view view.toml --size 4x3 -o right.png"), 0);
  }

  /// A file of every kind that our tools make or read; the first six are of all kinds.
  [[nodiscard]] std::vector<std::string> make_one_of_each() const {
    std::vector<std::string> names{"mesh.zoo",  "kept.vtu", "kept.order",
                                   "view.toml", "a.png",    "kept.json"};
    EXPECT_EQ(run(HIAC_SORT " mesh.zoo --view view.toml -o kept.order"), 0) << complaint();
    EXPECT_EQ(run(HIAC_COMPARE " a.png b.png --json kept.json"), 0) << complaint();
    for (const std::string& extension : words(kMeshExtensions)) {
      EXPECT_EQ(run(HIAC_CONVERT " mesh.zoo -o kept" + extension), 0) << complaint();
      names.push_back("kept" + extension);
    }
    for (const std::string& extension : words(image_extensions())) {
      if (extension == ".f32") continue;  // values alone: only its name tells what it is
      EXPECT_EQ(run(HIAC_RENDER " mesh.zoo --view view.toml -o kept" + extension), 0);
      names.push_back("kept" + extension);
    }
    const std::vector<std::pair<const char*, const char*>> texts{
        {"state.pvsm", "<ParaView>\n <ServerManagerState version=\"5.11.0\">\n"},
        {"camera.pvcc", "<PVCameraConfiguration description=\"c\" version=\"1.0\">\n"},
        {"map.json", "[{\"Name\": \"a\", \"RGBPoints\": [0, 0, 0, 1, 1, 1, 0, 0]}]\n"},
        {"map.xml", "<ColorMaps><ColorMap name=\"a\" space=\"RGB\">"}};
    for (const auto& [name, text] : texts) {
      std::ofstream(path(name)) << text;
      names.emplace_back(name);
    }
    names.emplace_back("parts.zparts");
    return names;
  }
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

TEST_F(Outputs, RegularFilesKeepTheirModeAndPipesAreWrittenTo) {
  for (const Output& output : all_outputs()) {
    SCOPED_TRACE(output.command + " " + output.option + " " + output.extension);
    remove_outputs();
    std::ofstream(path(written(output))) << "?";
    fs::permissions(path(written(output)), fs::perms(0604));
    ASSERT_EQ(run(output, named(output)), 0) << complaint();
    EXPECT_EQ(fs::status(path(written(output))).permissions(), fs::perms(0604));
    const std::string expected = bytes_of(written(output));
    EXPECT_NE(expected, "?");
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

TEST_F(Outputs, InputsAreNotOverwritten) {
  for (const Output& output : all_outputs()) {
    SCOPED_TRACE(output.command + " " + output.option + " " + output.extension);
    for (const char* input : {"mesh.zoo", "parts.zparts", "view.toml", "a.png", "right.png"}) {
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
  constexpr std::size_t kOfEachKind = 6;
  const std::vector<std::string> all = make_one_of_each();
  std::set<std::string> seen;  // every file is tried once with every option of every tool
  std::size_t turn = 0;        // and one of each kind, in turns, with each further extension
  for (const Output& output : all_outputs()) {
    std::vector<std::string> others = all;
    const bool is_new = seen.insert(output.command + output.option).second;
    if (!is_new || starts_slowly(output)) others.resize(kOfEachKind);
    std::erase_if(
        others, [&](const std::string& kept) { return kind_of(kept) == kind_of(written(output)); });
    if (!is_new) others = {others[turn++ % others.size()]};
    for (const std::string& kept : others) {
      SCOPED_TRACE(output.command + " " + output.option + " " + output.extension + " on " + kept);
      remove_outputs();
      fs::copy_file(path(kept), path(written(output)));
      EXPECT_EQ(run(output, named(output)), 2);
      EXPECT_THAT(complaint(), HasSubstr(written(output) + ": is a file of another kind"));
      EXPECT_EQ(bytes_of(written(output)), bytes_of(kept));
    }
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
