// hiac-preview as a user meets it.
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "hiac/image/image_io.hpp"
#include "hiac/mesh/zoo_container.hpp"
#include "tests/support/meshes.hpp"
#include "tests/tools/tool_folder.hpp"

namespace hiac {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class PreviewTool : public test::ToolFolder {
 protected:
  void SetUp() override {
    ToolFolder::SetUp();
    write("m.zoo", test::structured(3, test::Cut::tetrahedra));
    std::ofstream(file("v.toml"))
        << "[image]\nwidth = 60\nheight = 40\n[camera]\nprojection = \"perspective\"\n"
           "eye = [3.1, 2.3, 2.7]\nlook_at = [0.5, 0.5, 0.5]\nup = [0, 0, 1]\nfov = 30\n"
           "[volume.color]\nfield = \"f\"\npoints = [[0, 0, 0, 1], [1, 1, 0, 0]]\n"
           "[volume.extinction]\nfield = \"f\"\npoints = [[0, 0], [1, 5]]\n"
           "[background]\ncolor = [0.2, 0.3, 0.4]\n";
    if (preview("--list-devices") == 4) GTEST_SKIP() << complaint();
  }

  void write(const std::string& name, ZooMesh mesh) const {
    test::add_node_field(mesh, "f", test::smooth_field);
    write_zoo_file(file(name), ZooFile{std::move(mesh), {}});
  }
  [[nodiscard]] int preview(const std::string& arguments) const {
    return run("unset DISPLAY; '" HIAC_PREVIEW "' " + arguments);
  }
  // With faults of the driver: faulty_driver.cpp.
  [[nodiscard]] int preview_with(const std::string& faults, const std::string& arguments) const {
    return run("ASAN_OPTIONS=$ASAN_OPTIONS:verify_asan_link_order=0 " + faults +
               " LD_PRELOAD='" HIAC_FAULTY_DRIVER "' '" HIAC_PREVIEW "' " + arguments);
  }
  // What was drawn, even if in part; other files of the folder are the tests'.
  [[nodiscard]] std::vector<std::string> pictures() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
      if (const std::string name = entry.path().filename().string();
          name.find(".npy") != std::string::npos)
        names.push_back(name);
    std::ranges::sort(names);
    return names;
  }
  [[nodiscard]] double difference(const std::string& a, const std::string& b) const {
    const Image one = read_image(file(a)).image, two = read_image(file(b)).image;
    double most = one.values().size() == two.values().size() ? 0 : 1e9;
    for (std::size_t i = 0; most < 1e9 && i < one.values().size(); ++i)
      most = std::max(most, std::abs(one.values()[i] - two.values()[i]));
    return most;
  }
};

TEST_F(PreviewTool, IsWhatHiacRenderBecomes) {
  ASSERT_EQ(run("$RENDER m.zoo --view v.toml -o truth.npy"), 0) << complaint();
  const std::string folder = std::filesystem::path(HIAC_PREVIEW).parent_path().string();
  ASSERT_EQ(run("PATH=" + folder +
                ":$PATH; $RENDER m.zoo --view v.toml --engine preview "
                "--method exact -o a.npy --json a.json"),
            0)
      << complaint();
  EXPECT_LE(difference("truth.npy", "a.npy"), 2e-5);
  const auto facts = nlohmann::json::parse(bytes_of(file("a.json")));
  EXPECT_EQ(facts["tool"], "hiac-preview");
  EXPECT_EQ(facts["method"], "exact");
  EXPECT_FALSE(facts["device"].get<std::string>().empty());
  for (const char* stage : {"upload", "order", "regions", "draw", "read_back"})
    EXPECT_TRUE(facts["seconds"].contains(stage)) << stage;
}

TEST_F(PreviewTool, DrawsByThePapersMethods) {
  ASSERT_EQ(run("$RENDER m.zoo --view v.toml -o truth.npy"), 0) << complaint();
  double before = 1;
  for (const std::string method : {"M0", "M1", "M3"}) {
    ASSERT_EQ(preview("m.zoo --view v.toml --method " + method + " -o a.npy --json a.json"), 0)
        << complaint();
    const double error = difference("truth.npy", "a.npy");
    EXPECT_LT(error, before) << method;
    before = error;
    const auto facts = nlohmann::json::parse(bytes_of(file("a.json")));
    EXPECT_EQ(facts["method"], method);
    EXPECT_GT(facts["regions"]["triangles"], 0);
    EXPECT_EQ(facts["regions"]["reverted_to_M1"], 0);
  }
  EXPECT_EQ(preview("m.zoo --view v.toml --method M2 -o a.npy"), 0) << complaint();
  EXPECT_THAT(complaint(), HasSubstr("M2 fell back to M1 at"));
  EXPECT_EQ(preview("m.zoo --view v.toml --method M4 -o a.npy"), 2);
  EXPECT_EQ(preview("m.zoo --view v.toml --method M1 --precision double -o a.npy"), 2);
  EXPECT_THAT(complaint(), HasSubstr("--precision double: for --method exact alone"));
}

TEST_F(PreviewTool, ThatIsMissingIsSaidInOneLine) {
  EXPECT_EQ(run("PATH=/usr/bin:/bin; cp $RENDER lonely; ./lonely m.zoo --view v.toml "
                "--engine=preview -o a.npy"),
            4);
  EXPECT_THAT(complaint(), HasSubstr("hiac-preview is neither beside"));
  EXPECT_EQ(run("$RENDER m.zoo --view v.toml --method M1 -o a.npy"), 2);
  EXPECT_THAT(complaint(), HasSubstr("only for --engine preview"));
}

TEST_F(PreviewTool, SaysWhatWasTriedWithoutADriver) {
  EXPECT_EQ(run("LIBGL_DRIVERS_PATH=/nowhere __EGL_VENDOR_LIBRARY_FILENAMES=/nowhere '" HIAC_PREVIEW
                "' m.zoo --view v.toml -o a.npy"),
            4);
  EXPECT_THAT(complaint(), HasSubstr("no OpenGL 4.5 driver was found (tried"));
  EXPECT_THAT(complaint(), HasSubstr("libgl1-mesa-dri"));
  EXPECT_EQ(std::ranges::count(complaint(), '\n'), 1);
  EXPECT_FALSE(std::filesystem::exists(file("a.npy")));
}

// Wherever in its work the tool first hears of it, and whichever way the driver tells.
TEST_F(PreviewTool, ALostContextLeavesNoPicture) {
  for (const std::string fault : {"FAULT_LOST_AFTER=", "FAULT_ERROR_AFTER="})
    for (const std::string method : {"exact", "M1"}) {
      int losses = 0;
      for (int after = 0; after < 20; ++after) {
        const std::string arguments = "m.zoo --view v.toml -o a.npy --method " + method;
        const int status = preview_with(fault + std::to_string(after), arguments);
        if (status == 0) break;
        ++losses;
        EXPECT_EQ(status, 4);
        EXPECT_THAT(complaint(), HasSubstr(": the context was lost while "));
        EXPECT_EQ(std::ranges::count(complaint(), '\n'), 1) << complaint();
        EXPECT_THAT(pictures(), IsEmpty());
      }
      EXPECT_GE(losses, 4) << method;  // making a target, drawing, waiting, reading
      EXPECT_THAT(pictures(), ElementsAre("a.npy"));
      std::filesystem::remove(file("a.npy"));
    }
}

// Frames before the loss are whole, and there are none after it.
TEST_F(PreviewTool, AContextThatIsLostBetweenFramesLeavesThoseBefore) {
  ASSERT_EQ(run("{ cat v.toml; echo '[turntable]'; echo 'frames = 3'; } > t.toml"), 0);
  ASSERT_EQ(preview("m.zoo --view t.toml --frames -o whole.npy"), 0) << complaint();
  ASSERT_THAT(pictures(), ElementsAre("whole-0000.npy", "whole-0001.npy", "whole-0002.npy"));
  const std::string first = bytes_of(file("whole-0000.npy"));
  ASSERT_EQ(run("rm whole-*.npy"), 0);
  int losses = 0;
  for (int after = 1; after < 40 && losses == 0; ++after) {
    const int status = preview_with("FAULT_LOST_AFTER=" + std::to_string(after),
                                    "m.zoo --view t.toml --frames -o f.npy");
    EXPECT_EQ(status, 4);
    if (pictures().empty()) continue;
    ++losses;
    EXPECT_THAT(pictures(), ElementsAre("f-0000.npy"));
    EXPECT_EQ(bytes_of(file("f-0000.npy")), first);
  }
  EXPECT_EQ(losses, 1);
}

TEST_F(PreviewTool, AContextThatCannotBeUsedLeavesNoPicture) {
  EXPECT_EQ(preview_with("FAULT_NOT_CURRENT=1", "m.zoo --view v.toml -o a.npy"), 4);
  EXPECT_THAT(complaint(), HasSubstr(": its context cannot be used"));
  EXPECT_EQ(std::ranges::count(complaint(), '\n'), 1) << complaint();
  EXPECT_THAT(pictures(), IsEmpty());
}

TEST_F(PreviewTool, TooSmallALimitLeavesNoPicture) {
  for (const auto& [fault, message] :
       {std::pair{"FAULT_TEXTURE_SIDE=0", "draws no pictures of any size"},
        {"FAULT_STORAGE_BYTES=100", "bytes in one buffer, and the driver has 100 at most"}}) {
    EXPECT_EQ(preview_with(fault, "m.zoo --view v.toml -o a.npy"), 4);
    EXPECT_THAT(complaint(), HasSubstr(message));
    EXPECT_EQ(std::ranges::count(complaint(), '\n'), 1) << complaint();
    EXPECT_FALSE(std::filesystem::exists(file("a.npy")));
  }
}

TEST_F(PreviewTool, APictureAboveTheDriversLimitIsDrawnInParts) {
  ASSERT_EQ(preview("m.zoo --view v.toml -o whole.npy"), 0) << complaint();
  ASSERT_EQ(preview_with("FAULT_TEXTURE_SIDE=17", "m.zoo --view v.toml -o a.npy --json a.json"), 0)
      << complaint();
  EXPECT_EQ(nlohmann::json::parse(bytes_of(file("a.json")))["parts"], 12);
  EXPECT_EQ(bytes_of(file("whole.npy")), bytes_of(file("a.npy")));
}

TEST_F(PreviewTool, TwoProcessesAtOnceDrawTheSame) {
  ASSERT_EQ(run("'" HIAC_PREVIEW "' m.zoo --view v.toml -o a.npy & '" HIAC_PREVIEW
                "' m.zoo --view v.toml -o b.npy; first=$?; wait $!; exit $((first + $?))"),
            0)
      << complaint();
  EXPECT_EQ(bytes_of(file("a.npy")), bytes_of(file("b.npy")));
}

// Without a home folder, and without a screen as everywhere here.
TEST_F(PreviewTool, DrawsForAUserWithoutRights) {
  const std::string user = "setpriv --reuid 65534 --regid 65534 --clear-groups ";
  if (run(user + "test -x '" HIAC_PREVIEW "'") != 0)
    GTEST_SKIP() << "the tests run without the rights to become another user";
  ASSERT_EQ(preview("m.zoo --view v.toml -o a.npy"), 0) << complaint();
  ASSERT_EQ(run("chmod a+rx . && mkdir -m 777 theirs"), 0);
  ASSERT_EQ(run(user + "env -u DISPLAY HOME=/nonexistent '" HIAC_PREVIEW
                       "' m.zoo --view v.toml -o theirs/a.npy"),
            0)
      << complaint();
  EXPECT_EQ(bytes_of(file("a.npy")), bytes_of(file("theirs/a.npy")));
}

TEST_F(PreviewTool, OrdersAsHiacSort) {
  ASSERT_EQ(run("$SORT m.zoo --view v.toml -o m.order"), 0) << complaint();
  ASSERT_EQ(preview("m.zoo --view v.toml --order m.order -o a.npy"), 0) << complaint();
  ASSERT_EQ(preview("m.zoo --view v.toml --algorithm mpvo -o b.npy"), 0) << complaint();
  ASSERT_EQ(preview("m.zoo --view v.toml --algorithm centroid -o c.npy"), 0) << complaint();
  EXPECT_LE(difference("a.npy", "b.npy"), 1e-6);
  EXPECT_LE(difference("a.npy", "c.npy"), 0.5);
  EXPECT_EQ(preview("m.zoo --view v.toml --algorithm nonsense -o c.npy"), 2);
}

TEST_F(PreviewTool, CutsOtherCellsIntoTetrahedraAndSaysSo) {
  write("b.zoo", test::structured(3, test::Cut::prisms));
  ASSERT_EQ(preview("b.zoo --view v.toml -o b.npy"), 0) << complaint();
  EXPECT_THAT(complaint(), HasSubstr("54 of 54 cells are no linear tetrahedra"));
  ASSERT_EQ(run("$RENDER b.zoo --view v.toml -o truth.npy"), 0);
  EXPECT_LE(difference("b.npy", "truth.npy"), 0.1);
}

TEST_F(PreviewTool, DrawsFramesAndCrops) {
  ASSERT_EQ(run("{ cat v.toml; echo '[turntable]'; echo 'frames = 3'; } > t.toml"), 0);
  ASSERT_EQ(preview("m.zoo --view t.toml --frames -o f.npy --json f.json"), 0) << complaint();
  ASSERT_EQ(run("$RENDER m.zoo --view t.toml --frame 2 -o truth.npy"), 0) << complaint();
  EXPECT_LE(difference("f-0002.npy", "truth.npy"), 2e-5);
  ASSERT_EQ(preview("m.zoo --view v.toml --crop 10,5,20,12 -o c.npy"), 0) << complaint();
  ASSERT_EQ(run("$RENDER m.zoo --view v.toml --crop 10,5,20,12 -o truth.npy"), 0);
  EXPECT_LE(difference("c.npy", "truth.npy"), 2e-5);
  EXPECT_EQ(preview("m.zoo --view v.toml --crop 50,5,20,12 -o c.npy"), 2);
}

TEST_F(PreviewTool, SaysWhatIsNotDrawn) {
  const std::string rule =
      "render.integration is the accurate engine's: --method says how previews integrate\n";
  const std::string slices = "cells are not sliced at breakpoints (render.integration)\n";
  const std::string splats =
      "render.splat_below is the accurate engine's: previews splat no cells\n";
  const std::string surfaces =
      "[skin] and [edges] are the accurate engine's: previews draw neither\n";
  const struct {
    std::string view;  ///< behind v.toml
    const char* method;
    std::string note;  ///< empty: none of them
  } cases[] = {
      {"", "exact", ""},
      {"[render]\nintegration = 'gauss5'\n", "exact", rule},
      {"[render]\nintegration = 'gauss5'\n", "M0", rule},
      {"[render]\nintegration = 'approximate-unsliced'\n", "M0", slices},
      {"[render]\nintegration = 'approximate-unsliced'\n", "exact", rule},
      {"[render]\nsplat_below = 1\n", "exact", splats},
      {"[skin]\n", "exact", surfaces},
      {"[edges]\n", "exact", surfaces},
  };
  const std::string plain = bytes_of(file("v.toml"));
  for (const auto& c : cases) {
    std::ofstream(file("w.toml")) << plain << c.view;
    ASSERT_EQ(preview("m.zoo --view w.toml -o a.npy --method " + std::string(c.method)), 0)
        << complaint();
    for (const std::string& note : {rule, slices, splats, surfaces})
      EXPECT_EQ(complaint().find("hiac-preview: " + note) != std::string::npos, note == c.note)
          << c.view << c.method << note;
  }
}

TEST_F(PreviewTool, TellsWhatItDrew) {
  ASSERT_EQ(preview("m.zoo --view v.toml --method M1 -o a.npy --json a.json"), 0) << complaint();
  const auto facts = nlohmann::json::parse(bytes_of(file("a.json")));
  EXPECT_EQ(facts["cells"], 162);
  EXPECT_EQ(facts["parts"], 1);
  EXPECT_EQ(facts["regions"]["cells"], 162);
  EXPECT_FALSE(facts.contains("approximated_cells"));
  EXPECT_FALSE(facts.contains("frames"));
  EXPECT_TRUE(facts.contains("order"));
  ASSERT_EQ(preview("m.zoo --view v.toml -o a.npy --json a.json"), 0) << complaint();
  EXPECT_FALSE(nlohmann::json::parse(bytes_of(file("a.json"))).contains("regions"));
  // of a path every frame is told of by its file
  ASSERT_EQ(run("{ cat v.toml; echo '[turntable]'; echo 'frames = 3'; } > t.toml"), 0);
  ASSERT_EQ(preview("m.zoo --view t.toml --frames -o f.npy --json f.json"), 0) << complaint();
  const auto frames = nlohmann::json::parse(bytes_of(file("f.json")))["frames"];
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(frames[2]["file"], "f-0002.npy");
  EXPECT_TRUE(frames[2].contains("order"));
  ASSERT_EQ(preview("m.zoo --view t.toml --frame 1 -o g.npy --json g.json"), 0) << complaint();
  EXPECT_EQ(bytes_of(file("g.npy")), bytes_of(file("f-0001.npy")));
}

TEST_F(PreviewTool, ListsItsDevices) {
  ASSERT_EQ(preview("--list-devices --json d.json"), 0) << complaint();
  const auto devices = nlohmann::json::parse(bytes_of(file("d.json")))["devices"];
  ASSERT_FALSE(devices.empty());
  EXPECT_EQ(run("unset DISPLAY; '" HIAC_PREVIEW "' --list-devices > lines.txt"), 0);
  std::string expected;
  for (std::size_t k = 0; k < devices.size(); ++k)
    expected += std::to_string(k) + "  " + devices[k]["name"].get<std::string>() + " (" +
                devices[k]["platform"].get<std::string>() + ")\n";
  EXPECT_EQ(bytes_of(file("lines.txt")), expected);
  ASSERT_EQ(preview("m.zoo --view v.toml --device 0 -o a.npy --json a.json"), 0) << complaint();
  EXPECT_EQ(nlohmann::json::parse(bytes_of(file("a.json")))["device"], devices[0]["name"]);
  EXPECT_EQ(preview("m.zoo --view v.toml --device 99 -o a.npy"), 2);
  EXPECT_THAT(complaint(), HasSubstr("--device: there is no such device (expected one of 0 "));
}

TEST_F(PreviewTool, HalvesEdgesOfCurvedCellsAsOftenAsIsWanted) {
  // the corners of a tetrahedron and the middles of its edges
  const std::vector<test::Position> nodes{{0, 0, 0},     {1, 0, 0},     {0, 1, 0},   {0, 0, 1},
                                          {0.5, 0, 0},   {0.5, 0.5, 0}, {0, 0.5, 0}, {0, 0, 0.5},
                                          {0.5, 0, 0.5}, {0, 0.5, 0.5}};
  write("q.zoo",
        test::make_mesh(nodes, {{CellKind::tetrahedron10, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}}}));
  for (const auto& [option, levels, cells] :
       {std::tuple("", 2, 64), {" --levels 1", 1, 8}, {" --levels 0", 0, 1}}) {
    ASSERT_EQ(preview("q.zoo --view v.toml -o q.npy --json q.json" + std::string(option)), 0)
        << complaint();
    const auto facts = nlohmann::json::parse(bytes_of(file("q.json")));
    EXPECT_EQ(facts["levels"], levels);
    EXPECT_EQ(facts["approximated_cells"], 1);
    EXPECT_EQ(facts["cells"], cells);
    EXPECT_THAT(complaint(),
                HasSubstr("1 of 1 cells are no linear tetrahedra and are approximated: " +
                          std::to_string(cells) + " linear tetrahedra are drawn, edges halved " +
                          std::to_string(levels) + " times" + (levels > 0 ? " (--levels)" : "")));
  }
}

}  // namespace
}  // namespace hiac
