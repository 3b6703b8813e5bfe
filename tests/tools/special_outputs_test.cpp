// Outputs of several files, films, states of ParaView, and runs that end before their files are
// known: nothing is destroyed.

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "tests/tools/output_folder.hpp"

namespace hiac::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr const char* kRendered = HIAC_RENDER " mesh.zoo --view turn.toml --frames ";
constexpr const char* kParted = HIAC_CONVERT " mesh.zoo --parts 2 -o out.zparts";

class SpecialOutputs : public OutputFolder {
 protected:
  void SetUp() override {
    OutputFolder::SetUp();
    std::ofstream(path("turn.toml")) << kView << "[turntable]\nframes = 3\n";
    std::ofstream(path("notes")) << "what nobody can make again\n";
  }

  /// A file is as it was when a command ends with a code.
  void expect_kept(const std::string& file, const std::string& command, int code,
                   const std::string& told) const {
    SCOPED_TRACE(command);
    const std::string before = bytes_of(file);
    ASSERT_FALSE(before.empty());
    EXPECT_EQ(run("timeout 60 " + command), code) << complaint();
    EXPECT_THAT(complaint(), HasSubstr(told));
    EXPECT_EQ(bytes_of(file), before);
  }
};

TEST_F(SpecialOutputs, FramesReplaceNothingElse) {
  fs::create_symlink("mesh.zoo", path("out-1.png"));
  expect_kept("mesh.zoo", std::string(kRendered) + "-o out-%d.png", 2, "out-1.png: is an input");
  EXPECT_FALSE(fs::exists(path("out-0.png")));
  remove_outputs();
  fs::copy_file(path("view.toml"), path("out-2.png"));
  expect_kept("out-2.png", std::string(kRendered) + "-o out-%d.png", 2,
              "out-2.png: is a file of another kind");
  EXPECT_FALSE(fs::exists(path("out-0.png")));
  remove_outputs();
  make_full_device("out-1.png");
  EXPECT_EQ(run(std::string(kRendered) + "-o out-%d.png"), 3);
  EXPECT_THAT(complaint(), HasSubstr("out-1.png: cannot be written (No space left"));
  EXPECT_TRUE(fs::is_character_file(path("out-1.png")));
}

TEST_F(SpecialOutputs, FilmsReplaceNothingElse) {
  if (run("command -v ffmpeg") != 0) GTEST_SKIP() << "ffmpeg is not there";
  const std::string film = std::string(kRendered) + "-o out.mp4";
  fs::copy_file(path("mesh.zoo"), path("out.mp4"));
  expect_kept("out.mp4", film, 2, "out.mp4: is a file of another kind");
  remove_outputs();
  fs::create_symlink("mesh.zoo", path("out.mp4"));
  expect_kept("mesh.zoo", film, 2, "out.mp4: is an input");
  remove_outputs();
  make_full_device("out.mp4");
  EXPECT_EQ(run(film), 3);
  EXPECT_TRUE(fs::is_character_file(path("out.mp4")));
  remove_outputs();
  ASSERT_EQ(run(film), 0) << complaint();
  fs::copy_file(path("out.mp4"), path("out.order"));
  expect_kept("out.order", HIAC_SORT " mesh.zoo --view view.toml -o out.order", 2,
              "out.order: is a file of another kind");
  ASSERT_EQ(run(film), 0) << complaint();  // a film is made again
}

TEST_F(SpecialOutputs, PartsReplaceNothingElse) {
  for (const char* name : {"out.zparts", "out.1.zoo"}) {
    SCOPED_TRACE(name);
    remove_outputs();
    fs::create_symlink("mesh.zoo", path(name));
    expect_kept("mesh.zoo", kParted, 2, std::string(name) + ": is an input");
    remove_outputs();
    fs::copy_file(path("view.toml"), path(name));
    expect_kept(name, kParted, 2, std::string(name) + ": is a file of another kind");
    remove_outputs();
    make_full_device(name);
    EXPECT_EQ(run(kParted), 3);
    EXPECT_TRUE(fs::is_character_file(path(name)));
  }
  remove_outputs();
  ASSERT_EQ(mkfifo(path("out.zparts").c_str(), 0600), 0);
  EXPECT_EQ(run(std::string("timeout 60 ") + kParted), 3);
  EXPECT_TRUE(fs::is_fifo(path("out.zparts")));
}

/// A state that shows the surface of a file.
std::string state_of(const std::string& file) {
  return "<ParaView><ServerManagerState version=\"5.11.0\">"
         "<Proxy group=\"views\" type=\"RenderView\" id=\"1\"><Property name=\"CameraPosition\">"
         "<Element value=\"0.5\"/><Element value=\"0.5\"/><Element value=\"-3\"/></Property>"
         "<Property name=\"CameraFocalPoint\"><Element value=\"0.5\"/><Element value=\"0.5\"/>"
         "<Element value=\"0\"/></Property><Property name=\"CameraViewUp\"><Element value=\"0\"/>"
         "<Element value=\"1\"/><Element value=\"0\"/></Property><Property name=\"ViewSize\">"
         "<Element value=\"8\"/><Element value=\"6\"/></Property>"
         "<Property name=\"Background\"><Element value=\"0\"/><Element value=\"0\"/>"
         "<Element value=\"0\"/></Property>"
         "<Property name=\"Representations\"><Proxy value=\"2\"/></Property></Proxy>"
         "<Proxy group=\"representations\" type=\"UnstructuredGridRepresentation\" id=\"2\">"
         "<Property name=\"Input\"><Proxy value=\"3\"/></Property>"
         "<Property name=\"DiffuseColor\"><Element value=\"1\"/><Element value=\"0.5\"/>"
         "<Element value=\"0\"/></Property>"
         "<Property name=\"Representation\"><Element value=\"Surface\"/></Property></Proxy>"
         "<Proxy group=\"sources\" type=\"XMLUnstructuredGridReader\" id=\"3\">"
         "<Property name=\"FileName\"><Element value=\"" +
         file +
         "\"/></Property></Proxy>"
         "<ProxyCollection name=\"views\"><Item id=\"1\" name=\"RenderView1\"/></ProxyCollection>"
         "</ServerManagerState></ParaView>";
}

TEST_F(SpecialOutputs, StatesOfParaViewAndTheirDataAreInputs) {
  // the name of the mesh tells nothing, nor do its first bytes
  std::ofstream(path("deck.dat")) << "CEND\nBEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\n"
                                     "GRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.\nCTETRA,1,1,1,2,3,4\n"
                                     "ENDDATA\n";
  std::ofstream(path("s.pvsm")) << state_of("deck.dat");
  ASSERT_EQ(run(HIAC_RENDER " --view s.pvsm#RenderView1 -o out.png"), 0) << complaint();
  for (const char* state : {"s.pvsm", "s.pvsm#RenderView1"}) {
    const std::string view = std::string(" --view ") + state;
    expect_kept("s.pvsm", HIAC_RENDER + view + " -o out.png --json s.pvsm", 2, "s.pvsm: is an");
    expect_kept("s.pvsm", HIAC_RENDER + view + " --format png -o s.pvsm", 2, "s.pvsm: is an");
    expect_kept("s.pvsm", HIAC_SORT " mesh.zoo" + view + " -o s.pvsm", 2, "s.pvsm: is an");
    expect_kept("s.pvsm", HIAC_CHECK " mesh.zoo --cycles" + view + " --json s.pvsm", 2,
                "s.pvsm: is an");
    expect_kept("deck.dat", HIAC_RENDER + view + " -o out.png --json deck.dat", 2,
                "deck.dat: is an input");
    expect_kept("deck.dat", HIAC_RENDER + view + " --format png -o deck.dat", 2,
                "deck.dat: is an input");
  }
}

TEST_F(SpecialOutputs, ReportsOfRunsThatEndEarlyReplaceNothing) {
  std::vector<std::string> wrong{HIAC_CONVERT " notes -o out.none",
                                 HIAC_CONVERT " notes -o out.zoo --steps 0",
                                 HIAC_CONVERT " notes --levels 2 -o out.zoo", HIAC_COMPARE " notes",
                                 HIAC_RENDER " notes --method M1 -o out.png"};
#ifdef HIAC_VIEW
  wrong.emplace_back("env -u DISPLAY -u WAYLAND_DISPLAY -u QT_QPA_PLATFORM " HIAC_VIEW " notes");
#endif
#ifdef HIAC_PREVIEW
  wrong.emplace_back(HIAC_PREVIEW " notes --method M1 --precision double -o out.png");
#endif
#ifdef HIAC_RENDER_MPI
  wrong.emplace_back(HIAC_RENDER_MPI " notes --engine preview -o out.png");
#endif
  for (const std::string& command : wrong) {
    expect_kept("notes", command + " --json notes", 2, "");
    // a report of a run before, or none, is replaced
    remove_outputs();
    ASSERT_EQ(run(command + " --json out.json"), 2);
    EXPECT_THAT(bytes_of("out.json"), HasSubstr("\"exit_code\": 2"));
    ASSERT_EQ(run(HIAC_INFO " mesh.zoo --json out.json"), 0);
    ASSERT_EQ(run(command + " --json out.json"), 2);
    EXPECT_THAT(bytes_of("out.json"), HasSubstr("\"exit_code\": 2"));
  }
}

TEST_F(SpecialOutputs, ThePictureOfAPictureIsNotThatPicture) {
  expect_kept("a.png", HIAC_UMBRELLA " picture a.png", 2, "a.png: is an input");
}

}  // namespace
}  // namespace hiac::test
