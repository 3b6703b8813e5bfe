// Options that do not fit one another or are malformed: what is said of them, word by word.
#include <fstream>
#include <string>

#include <gmock/gmock.h>

#include "hiac/image/image_io.hpp"
#include "hiac/mesh/zoo_container.hpp"
#include "tests/support/meshes.hpp"
#include "tests/tools/tool_folder.hpp"

namespace hiac::test {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

constexpr const char* kSmallView =
    "[image]\nwidth = 8\nheight = 6\n[camera]\nprojection = \"orthographic\"\n"
    "eye = [0.5, 0.5, -3.0]\nlook_at = [0.5, 0.5, 0.0]\nup = [0.0, 1.0, 0.0]\nheight = 2.0\n"
    "[volume.extinction]\nfield = \"f\"\npoints = [[0.0, 1.0], [1.0, 1.0]]\n"
    "[volume.color]\nfield = \"f\"\npoints = [[0.0, 1.0, 0.0, 0.0], [1.0, 0.0, 1.0, 0.0]]\n";

struct WrongOptions {
  const char* command;
  int code;
  std::string message;  ///< the end of the line on stderr
};

class OptionComplaints : public ToolFolder {
 protected:
  void SetUp() override {
    ToolFolder::SetUp();
    ZooMesh mesh = structured(1, Cut::tetrahedra);
    add_node_field(mesh, "f", [](const Position& p) { return p[0]; });
    write_zoo_file(file("m.zoo"), {mesh, {}});
    text("v.toml", kSmallView);
    text("t.toml", std::string(kSmallView) + "[turntable]\nframes = 4\n");
  }
  void text(const std::string& name, const std::string& content) const {
    std::ofstream(file(name), std::ios::binary) << content;
  }
  [[nodiscard]] int run_tools(const std::string& command) const {
    return run("CHECK='" HIAC_CHECK "'; INFO='" HIAC_INFO "'; " + command);
  }
  void expect_complaints(const std::vector<WrongOptions>& rows) const {
    for (const WrongOptions& row : rows) {
      EXPECT_EQ(run_tools(row.command), row.code) << row.command << "\n" << complaint();
      EXPECT_THAT(complaint(), EndsWith(": " + row.message + "\n")) << row.command;
    }
  }
};

TEST_F(OptionComplaints, OfChecks) {
  expect_complaints({
      {"$CHECK m.zoo --view v.toml", 2, "--view, --directions: only for --cycles"},
      {"$CHECK m.zoo --directions 1", 2, "--view, --directions: only for --cycles"},
      {"$CHECK m.zoo --cycles --directions 1 --set image.width=3", 2,
       "--set: no specification to override (--view SPEC)"},
      {"$CHECK m.zoo --size 8x6", 2, "--size: only for --picture"},
      {"$CHECK m.zoo --picture x.png --size 8", 2,
       "--size: expected WIDTHxHEIGHT, as 1024x768 (found 8)"},
  });
  EXPECT_EQ(run_tools("$CHECK m.zoo --cycles --view v.toml --set image.width=3"), 0) << complaint();
}

TEST_F(OptionComplaints, OfSizes) {
  const auto size = [](const char* text, const std::string& message) {
    return WrongOptions{text, 2, message};
  };
  const WrongOptions rows[] = {
      size("8", "--size: expected WIDTHxHEIGHT, as 1024x768 (found 8)"),
      size("8x", "--size: expected WIDTHxHEIGHT, as 1024x768 (found 8x)"),
      size("x6", "--size: expected WIDTHxHEIGHT, as 1024x768 (found x6)"),
      size("8X6", "--size: expected WIDTHxHEIGHT, as 1024x768 (found 8X6)"),
      size("8x6x", "--size: expected WIDTHxHEIGHT, as 1024x768 (found 8x6x)"),
      size("8x-6", "--size: expected WIDTHxHEIGHT, as 1024x768 (found 8x-6)"),
      size("0x6", "--size: expected 1 to 65536 pixels (found 0)"),
      size("8x0", "--size: expected 1 to 65536 pixels (found 0)"),
      size("65537x1", "--size: expected 1 to 65536 pixels (found 65537)"),
      size("1x65537", "--size: expected 1 to 65536 pixels (found 65537)"),
  };
  for (const WrongOptions& row : rows) {
    EXPECT_EQ(run_tools("$RENDER m.zoo --view v.toml -o x.png --size " + std::string(row.command)),
              row.code);
    EXPECT_THAT(complaint(), EndsWith(": " + row.message + "\n"));
  }
  EXPECT_EQ(run_tools("$RENDER m.zoo --view v.toml -o x.npy --size 1x2"), 0) << complaint();
  EXPECT_EQ(read_image(file("x.npy")).image.height(), 2U);
}

TEST_F(OptionComplaints, OfPictures) {
  expect_complaints({
      {"$RENDER m.zoo --view v.toml -o - --format f32", 2,
       "--format .f32: is several files (-o - is one)"},
      {"$RENDER m.zoo --view v.toml -o -", 2,
       "-o -: the picture's format is not known (--format EXTENSION expected)"},
      {"$RENDER m.zoo --view t.toml -o - --format png --frames", 2,
       "--frames: a picture a frame does not fit stdout (-o FILE expected)"},
      {"$RENDER m.zoo --view v.toml -o - --format png --json -", 2,
       "--json -: stdout carries the picture (a file for --json expected)"},
      {"$RENDER m.zoo --view v.toml -o x.png --save-view w.toml", 2,
       "--save-view: only for the starter view (found beside --view)"},
      {"$RENDER m.zoo --view v.toml -o x.png --dark", 2,
       "--field, --preset, --isovalues, --dark: only for the starter view (found beside --view)"},
      {"$RENDER m.zoo --view v.toml -o x.png --field f", 2,
       "--field, --preset, --isovalues, --dark: only for the starter view (found beside --view)"},
      {"$RENDER m.zoo --view v.toml -o x.png --frames", 2,
       "--frames: v.toml has no camera path (keyframes [[camera]], or a [turntable])"},
      {"$RENDER m.zoo --view t.toml -o x.png", 2,
       "t.toml: holds a camera path of 4 frames: --frames renders all frames, --frame N one"},
      {"$RENDER m.zoo --view v.toml -o x.png --block top", 2,
       "--block top: m.zoo is a zoo container, which has no blocks (only for foreign files)"},
      {"$RENDER m.zoo --view v.toml -o x.png --method m0", 2,
       "--method: only for --engine preview (found m0)"},
      {"$RENDER m.zoo --view v.toml -o x.png --channels depth", 2,
       "--channels: this format holds only colours (.exr, .npy or .f32 expected, x.png found)"},
  });
}

TEST_F(OptionComplaints, OfPixels) {
  const std::string draw = "$RENDER m.zoo --view v.toml -o x.npy ";
  for (const char* crop : {"1,1,2", "1,1,2,2,2", "1;1,2,2", "1,1,2,2x", "-1,1,2,2", "a", ",1,2,2",
                           "1,1,,2", "1,1,2,99999999999"}) {
    EXPECT_EQ(run_tools(draw + "--crop '" + crop + "'"), 2) << crop;
    EXPECT_THAT(complaint(),
                EndsWith(": --crop: expected X,Y,WIDTH,HEIGHT in pixels, as 300,200,64,64 (found " +
                         std::string(crop) + ")\n"));
  }
  EXPECT_EQ(run_tools(draw + "--crop 1,2,3,4"), 0) << complaint();
  EXPECT_EQ(read_image(file("x.npy")).image.width(), 3U);
  EXPECT_EQ(read_image(file("x.npy")).image.height(), 4U);
  for (const char* pixel : {"1", "1,", "1,2,3", "1.5,2"}) {
    EXPECT_EQ(run_tools("$RENDER m.zoo --view v.toml --pixel " + std::string(pixel)), 2) << pixel;
    EXPECT_THAT(complaint(), EndsWith(": --pixel: expected a column and a row, as 300,200 (found " +
                                      std::string(pixel) + ")\n"));
  }
}

TEST_F(OptionComplaints, OfSortsAndOrders) {
  const std::string tiles = "--tiles: expected COLUMNSxROWS of 1 to 4096 each, as 8x6 (found ";
  ASSERT_EQ(run_tools("$SORT m.zoo --view v.toml -o m.order && $SORT m.zoo --view v.toml > s.zoo"),
            0)
      << complaint();
  expect_complaints({
      {"$SORT m.zoo --view v.toml -o o.order --tiles 3x3", 2,
       "--tiles, --balanced: only for --algorithm multitiled (found exact)"},
      {"$SORT m.zoo --view v.toml -o o.order --balanced --algorithm mpvo", 2,
       "--tiles, --balanced: only for --algorithm multitiled (found mpvo)"},
      {"$SORT m.zoo --view v.toml -o o.order --algorithm multitiled --tiles 4097x1", 2,
       tiles + "4097x1)"},
      {"$SORT m.zoo --view v.toml -o o.order --algorithm multitiled --tiles 1x4097", 2,
       tiles + "1x4097)"},
      {"$SORT m.zoo --view v.toml -o o.order --algorithm multitiled --tiles 0x1", 2,
       tiles + "0x1)"},
      {"$SORT m.zoo --view v.toml -o o.order --algorithm multitiled --tiles 1x0", 2,
       tiles + "1x0)"},
      {"$SORT m.zoo --view v.toml -o o.order --algorithm multitiled --tiles 2x2x", 2,
       tiles + "2x2x)"},
      {"$SORT m.zoo --view v.toml --order m.order", 2,
       "--order: a given order can only be verified (expected --verify)"},
      {"$RENDER s.zoo --view v.toml -o x.png --overlap", 2,
       "--overlap: s.zoo already has an order (hiac-sort --overlap makes a new one)"},
  });
  EXPECT_EQ(run_tools("$SORT m.zoo --view v.toml -o o.order --algorithm multitiled --tiles 1x4096"),
            0)
      << complaint();
}

TEST_F(OptionComplaints, OfInformationAndConversions) {
  expect_complaints({
      {"$INFO m.zoo --dark", 2, "--field, --preset, --isovalues, --dark: only for --starter-view"},
      {"$INFO m.zoo --field f", 2,
       "--field, --preset, --isovalues, --dark: only for --starter-view"},
      {"$INFO m.zoo --starter-view --json -", 2,
       "--json -: stdout carries the specification here; name a file"},
      {"$CONVERT m.zoo -o n.vtu --time nearest:", 2,
       "--time nearest:: a number, or nearest:NUMBER expected"},
      {"$CONVERT m.zoo -o n.vtu --time now", 2, "--time now: a number, or nearest:NUMBER expected"},
      {"$CONVERT m.zoo -o n.vtu --time 1s", 2, "--time 1s: a number, or nearest:NUMBER expected"},
  });
}

TEST_F(OptionComplaints, OfFilesOfOtherKinds) {
  write_image(file("p.png"), Image(8, 6, {"Y"}));
  write_image(file("d.npy"), Image(8, 6, {"R", "G", "B", "A", "d"}));
  write_image(file("d.exr"), Image(8, 6, {"depth", "order"}));
  text("stub.toml", kSmallView);
  expect_complaints({
      {"$CHECK p.png", 3, "p.png: is an image (a mesh expected)"},
      {"$RENDER v.toml --view v.toml -o x.png", 3,
       "v.toml: is an image specification, a colour map or a state of ParaView (a mesh expected)"},
      {"$RENDER m.zoo --view v.toml -o x.npy --under d.exr", 3,
       "d.exr: a picture without colour (channels depth order)"},
      {"$RENDER m.zoo --view v.toml -o x.npy --size 9x6 --under p.png", 3,
       "p.png: a picture of another size (9 x 6 pixels expected, 8 x 6 found)"},
  });
  EXPECT_EQ(run_tools("$RENDER m.zoo --view v.toml -o x.npy --under d.npy"), 0) << complaint();
}

TEST_F(OptionComplaints, ReportsOfPicturesHaveTheirNumbers) {
  EXPECT_EQ(run_tools("$RENDER m.zoo --view v.toml -o x.npy"), 0);
  EXPECT_THAT(complaint(), HasSubstr("hiac-render: colour by f from 0 to 1\n"));
  EXPECT_THAT(complaint(), HasSubstr("hiac-render: extinction by f from 0 to 1\n"));
  EXPECT_THAT(complaint(), HasSubstr("hiac-render: diagonal 1.73205\n"));
  EXPECT_THAT(complaint(), HasSubstr("hiac-render: optical depth 1 in the mean, 1 at most\n"));
  text("s.toml", std::string(kSmallView) + "[skin]\nopacity = 1\n");  // hides the medium
  EXPECT_EQ(run_tools("$RENDER m.zoo --view s.toml -o x.npy"), 0);
  EXPECT_THAT(complaint(), testing::Not(HasSubstr("colour by f")));
  EXPECT_EQ(run_tools("$RENDER m.zoo --view t.toml --frames -o x-%d.npy"), 0);
  EXPECT_THAT(complaint(), HasSubstr("x-1.npy: 2 of 4 frames, about "));
  EXPECT_THAT(complaint(), HasSubstr("x-3.npy: 4 of 4 frames, about 0 s left\n"));
}

TEST_F(OptionComplaints, StrictPicturesShowSomething) {
  const std::string aside = " --set camera.eye=[9,9,-3] --set camera.look_at=[9,9,0]";
  EXPECT_EQ(run_tools("$RENDER m.zoo --view v.toml -o x.png --strict" + aside), 1);
  EXPECT_THAT(complaint(), HasSubstr("hiac-render: x.png: not written: "));
  EXPECT_THAT(complaint(), EndsWith(" (--strict)\n"));
  EXPECT_FALSE(std::filesystem::exists(file("x.png")));
}

TEST_F(OptionComplaints, AnnotationIsNotDrawnOnNumbers) {
  text("a.toml", std::string(kSmallView) + "[annotation.axes]\nshow = true\n");
  ASSERT_EQ(run_tools("$RENDER m.zoo --view a.toml --size 200x150 -o x.npy"), 0) << complaint();
  EXPECT_THAT(complaint(),
              HasSubstr("hiac-render: annotation: not drawn, because the format stores "
                        "floating-point numbers (annotation.formats = \"all\" draws it)\n"));
  ASSERT_EQ(run_tools("$RENDER m.zoo --view a.toml --size 200x150 -o x.png"), 0) << complaint();
  EXPECT_THAT(complaint(), testing::Not(HasSubstr("not drawn")));
}

}  // namespace
}  // namespace hiac::test
