// Annotated pictures as a user makes them.

#include <algorithm>
#include <fstream>

#include <gmock/gmock.h>

#include "hiac/image/image_io.hpp"
#include "hiac/mesh/zoo_container.hpp"
#include "hiac/scene/toml/edited_text.hpp"
#include "tests/support/cube_view.hpp"
#include "tests/support/meshes.hpp"
#include "tests/tools/tool_folder.hpp"

namespace hiac::test {
namespace {

using testing::HasSubstr;
using testing::Not;

// colours over positive values: a logarithmic scale takes no others
const std::string kView = with_key(cube_view(240, 180), "volume.color.points",
                                   "[[0.1, 0.1, 0.2, 0.9], [1.0, 0.9, 0.1, 0.1]]");
const std::string kAnnotation = R"([annotation.title]
text = "A cube"
[annotation.time]
unit = "s"
[annotation.axes]
[annotation.scale]
[annotation.colorbar]
)";

class AnnotationOption : public ToolFolder {
 protected:
  void SetUp() override {
    ToolFolder::SetUp();
    ZooMesh mesh = random_delaunay(30, 4);
    add_node_field(mesh, "f", smooth_field);
    mesh.metadata.emplace_back("time", "0.125");
    write_zoo_file(file("m.zoo"), {mesh, {}});
    std::ofstream(file("plain.toml")) << kView;
    std::ofstream(file("view.toml")) << kView << kAnnotation;
  }
  void draw(const std::string& options) const {
    ASSERT_EQ(run("$RENDER m.zoo " + options), 0) << complaint();
  }
};

TEST_F(AnnotationOption, IsDrawnIntoIntegerFormatsAlone) {
  draw("--view plain.toml -o plain.png");
  draw("--view view.toml -o drawn.png --json facts.json");
  EXPECT_THAT(complaint(), HasSubstr("annotation: title, time, axes, scale, colorbar drawn"));
  EXPECT_THAT(bytes_of(file("facts.json")), HasSubstr("\"annotation\": "));
  const Image plain = read_image(file("plain.png")).image,
              drawn = read_image(file("drawn.png")).image;
  EXPECT_FALSE(std::ranges::equal(plain.values(), drawn.values()));
  for (const char* name : {"a.npy", "a.exr", "a.hdr", "a.pfm"}) {
    draw(std::string("--view plain.toml -o plain-") + name);
    draw(std::string("--view view.toml -o ") + name);
    EXPECT_THAT(complaint(), HasSubstr("annotation: not drawn"));
    const Image a = read_image(file(std::string("plain-") + name)).image;
    const Image b = read_image(file(name)).image;
    EXPECT_TRUE(std::ranges::equal(a.values(), b.values())) << name;
  }
  draw("--view view.toml --depth 32 -o a.tiff");
  EXPECT_THAT(complaint(), HasSubstr("annotation: not drawn"));
  draw("--view view.toml --set annotation.formats=all -o all.npy");
  EXPECT_FALSE(std::ranges::equal(read_image(file("a.npy")).image.values(),
                                  read_image(file("all.npy")).image.values()));
}

TEST_F(AnnotationOption, OffIsThePlainPictureToTheLastByte) {
  draw("--view plain.toml -o plain.png");
  std::string off = "--view view.toml -o off.png";
  for (const char* part : {"title", "time", "axes", "scale", "colorbar"})
    off += std::string(" --set annotation.") + part + ".show=false";
  draw(off);
  EXPECT_THAT(complaint(), Not(HasSubstr("annotation")));
  EXPECT_EQ(bytes_of(file("off.png")), bytes_of(file("plain.png")));
}

TEST_F(AnnotationOption, IsRepeatedFromThePicture) {
  for (const char* name : {"first.png", "first.tiff"}) {
    draw(std::string("--view view.toml --set volume.color.scale=log -o ") + name);
    const std::string second = "second" + std::string(name).substr(5);
    draw(std::string("--view ") + name + " -o " + second);
    EXPECT_EQ(bytes_of(file(name)), bytes_of(file(second)));
  }
}

TEST_F(AnnotationOption, ABarAloneIsRepeatedFromThePicture) {
  for (const std::string scale : {"linear", "log"}) {
    const std::string scaled = "--view plain.toml --set volume.color.scale=" + scale;
    draw(scaled + " -o " + scale + ".png --colorbar first-" + scale + ".png");
    draw("--view " + scale + ".png -o again.png --colorbar second.png");
    EXPECT_EQ(bytes_of(file("first-" + scale + ".png")), bytes_of(file("second.png"))) << scale;
    EXPECT_EQ(bytes_of(file(scale + ".png")), bytes_of(file("again.png"))) << scale;
  }
  EXPECT_NE(bytes_of(file("first-linear.png")), bytes_of(file("first-log.png")));
}

TEST_F(AnnotationOption, ChangesNoOrderAndNoExplanation) {
  ASSERT_EQ(run("$SORT m.zoo --view plain.toml -o m.order"), 0) << complaint();
  draw("--view view.toml --order m.order -o ordered.png");
  draw("--view plain.toml --pixel 120,90 --json plain.json -q");
  draw("--view view.toml --pixel 120,90 --json drawn.json -q");
  const auto pixel = [&](const char* name) {
    const std::string text = bytes_of(file(name));
    return text.substr(text.find("\"pixel\""), text.find("\"peak_memory") - text.find("\"pixel\""));
  };
  EXPECT_FALSE(pixel("plain.json").empty());
  EXPECT_EQ(pixel("plain.json"), pixel("drawn.json"));
}

TEST_F(AnnotationOption, APartOfAPictureIsCutFromTheAnnotatedWhole) {
  draw("--view view.toml -o whole.png");
  draw("--view view.toml --crop 150,20,80,140 -o part.png");
  const Image whole = read_image(file("whole.png")).image,
              part = read_image(file("part.png")).image;
  for (std::size_t y = 0; y < 140; ++y)
    for (std::size_t x = 0; x < 80; ++x)
      ASSERT_TRUE(std::ranges::equal(part.pixel(x, y), whole.pixel(150 + x, 20 + y)));
}

TEST_F(AnnotationOption, TheBarAloneNeedsNoPicture) {
  draw("--view view.toml --colorbar bar.png");
  EXPECT_EQ(read_image(file("bar.png")).image.width(), 800U);
  draw("--view plain.toml -o p.png --colorbar beside.png");
  EXPECT_EQ(bytes_of(file("bar.png")), bytes_of(file("beside.png")));
  draw("--view plain.toml --set volume.color.scale=log --colorbar log.png");
  EXPECT_NE(bytes_of(file("bar.png")), bytes_of(file("log.png")));
  EXPECT_EQ(run("$RENDER m.zoo --view view.toml --colorbar bar.png --crop 1,1,2,2"), 2);
  EXPECT_THAT(complaint(), HasSubstr("--crop: of a picture (-o IMAGE expected beside --colorbar)"));
  EXPECT_EQ(run("$RENDER m.zoo --view view.toml"), 2);
  EXPECT_THAT(complaint(), HasSubstr("--output is required"));
}

TEST_F(AnnotationOption, WhatCannotBeDrawnIsRefusedBeforeThePicture) {
  const std::string draw_no = "$RENDER m.zoo --view view.toml -o no.png --set annotation.";
  EXPECT_EQ(run(draw_no + "axes.size=179px"), 3);
  EXPECT_THAT(complaint(), HasSubstr("view.toml: key `annotation.axes`: does not fit the picture"));
  EXPECT_EQ(run(draw_no + "axes.size=wide"), 2);
  EXPECT_THAT(complaint(), HasSubstr("annotation.axes.size=wide: key"));
  EXPECT_EQ(run(draw_no + "scale.length=1e6"), 3);
  EXPECT_EQ(run("$RENDER m.zoo --view view.toml -o no.png --set volume.color="), 2);
  EXPECT_FALSE(std::filesystem::exists(file("no.png")));
  draw("--view view.toml -o small.png --size 60x60");
  EXPECT_THAT(complaint(), HasSubstr("letters of 2 pixels are hard to read"));
}

}  // namespace
}  // namespace hiac::test
