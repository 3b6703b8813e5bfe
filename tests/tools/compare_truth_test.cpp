// hiac-compare --truth: a picture against the exact one of a mesh.

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "hiac/image/image_io.hpp"
#include "hiac/mesh/zoo_container.hpp"
#include "hiac/scene/specification.hpp"
#include "hiac/session/session.hpp"
#include "tests/support/instrumented.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/scratch_folder.hpp"

namespace hiac {
namespace {

using testing::HasSubstr;

// A mesh and its view, and pictures of it that the session makes.
class CompareTruth : public testing::Test {
 protected:
  CompareTruth() {
    ZooMesh mesh = test::structured(3, test::Cut::tetrahedra);
    test::add_node_field(mesh, "f", test::smooth_field);
    scene_ = starter_view(mesh);
    scene_.image = {64, 48};
    scene_.background.color = {0.2, 0.3, 0.4};
    scene_.edges.reset();
    write_zoo_file(folder_.file("m.zoo"), {mesh, {}});
    static_cast<void>(folder_.write("v.toml", to_toml(scene_)));
    session_.emplace(std::move(mesh));
    session_->require_drawable(scene_);
  }

  [[nodiscard]] Image picture(const Scene& scene, bool background = true) {
    PictureRequest request;
    request.background = background;
    return session_->picture(scene, request).image;
  }
  void write(const std::string& name, const Image& image, const WriteOptions& options = {}) const {
    write_image(folder_.file(name), image, options);
  }
  // Exit code; what was printed is in out_ and errors_.
  int run(const std::string& arguments) {
    const int status = std::system(fmt::format("cd '{}' && {} {} > out.txt 2> err.txt",
                                               folder_.path().string(), HIAC_COMPARE, arguments)
                                       .c_str());
    out_ = test::bytes_of(folder_.file("out.txt"));
    errors_ = test::bytes_of(folder_.file("err.txt"));
    return WEXITSTATUS(status);
  }
  nlohmann::json facts(const std::string& arguments) {
    EXPECT_EQ(run(arguments + " -q --json -"), 0) << errors_;
    return nlohmann::json::parse(out_);
  }
  nlohmann::json channels(const std::string& arguments) { return facts(arguments)["channels"]; }

  test::ScratchFolder folder_;
  Scene scene_;
  std::optional<Session> session_;
  std::string out_, errors_;
};

TEST_F(CompareTruth, FindsNoErrorInTheExactPicture) {
  write("a.npy", picture(scene_));
  ASSERT_EQ(run("a.npy --truth m.zoo --view v.toml --max-error 0"), 0) << errors_;
  EXPECT_THAT(out_, HasSubstr("a.npy against the truth of m.zoo: 64 x 48 pixels, equal"));
  EXPECT_THAT(out_, HasSubstr("the truth is exact to "));
  EXPECT_THAT(out_, testing::Not(HasSubstr("the picture is")));
  const auto told = facts("a.npy --truth m.zoo --view v.toml");
  EXPECT_EQ(told["equal"], true);
  EXPECT_GT(told["truth_error"], 0.0);
  EXPECT_LT(told["truth_error"], 1e-8);
  EXPECT_EQ(told["misfit"]["rmse"], 0.0);
}

TEST_F(CompareTruth, TakesThePicturesSizeAndItsOwnSpecification) {
  Scene small = scene_;
  small.image = {40, 30};
  write("a.exr", picture(small), {.attributes = {{"hiac:specification", to_toml(scene_)}}});
  const auto told = facts("a.exr --truth m.zoo");
  EXPECT_EQ(told["width"], 40);
  for (const auto& channel : told["channels"]) EXPECT_LT(channel["largest_error"], 1e-7);
  write("plain.npy", picture(small));
  EXPECT_EQ(run("plain.npy --truth m.zoo"), 3);
  EXPECT_THAT(errors_, HasSubstr("plain.npy"));
}

// An error that is put in is found where it is, with its size.
TEST_F(CompareTruth, FindsTheErrorOfAPixel) {
  Image image = picture(scene_);
  image.at(20, 30, 1) += 0.125;
  write("a.npy", image);
  EXPECT_EQ(run("a.npy --truth m.zoo --view v.toml --max-error 0.1 --heatmap h.png"), 1);
  EXPECT_THAT(errors_, HasSubstr("0.125 found in channel G at pixel 20,30"));
  EXPECT_TRUE(std::filesystem::exists(folder_.file("h.png")));
  EXPECT_EQ(run("a.npy --truth m.zoo --view v.toml --max-error 0.1251"), 0);
}

TEST_F(CompareTruth, KnowsWhichPicturesHaveABackground) {
  scene_.image = {32, 24};
  // integers with an alpha that varies hold none
  write("alpha.png", picture(scene_, false), {.depth = 16});
  for (const auto& channel : channels("alpha.png --truth m.zoo --view v.toml"))
    EXPECT_LT(channel["largest_error"], 1e-4) << channel["name"];
  // an alpha of 1 everywhere says nothing
  write("opaque.png", picture(scene_), {.background_included = true, .depth = 16});
  const auto opaque = channels("opaque.png --truth m.zoo --view v.toml");
  EXPECT_EQ(opaque.size(), 3U);
  for (const auto& channel : opaque) EXPECT_LT(channel["largest_error"], 1e-4) << channel["name"];
  write("bare.npy", picture(scene_, false));
  EXPECT_EQ(facts("bare.npy --truth m.zoo --view v.toml --no-background")["equal"], true);
  EXPECT_EQ(facts("bare.npy --truth m.zoo --view v.toml")["equal"], false);
}

TEST_F(CompareTruth, TellsWhatIsWrongWithThePictureAsAWhole) {
  scene_.image = {32, 24};
  const Image right = picture(scene_);
  Image mirrored = right;
  for (std::size_t y = 0; y < right.height(); ++y)
    for (std::size_t x = 0; x < right.width(); ++x)
      for (std::size_t c = 0; c < 4; ++c)
        mirrored.at(x, y, c) = right.at(right.width() - 1 - x, y, c);
  write("mirrored.npy", mirrored);
  const auto told = facts("mirrored.npy --truth m.zoo --view v.toml");
  EXPECT_EQ(told["misfit"]["orientation"]["name"], "mirrored left to right");
  EXPECT_EQ(told["misfit"]["orientation"]["rmse_without"], 0.0);
  ASSERT_EQ(run("mirrored.npy --truth m.zoo --view v.toml"), 0);
  EXPECT_THAT(out_, HasSubstr("the picture is mirrored left to right: RMSE "));

  // linear values in a file whose values are taken as sRGB-encoded
  write("dark.sgi", right, {.linear = true, .background_included = true, .depth = 16});
  EXPECT_EQ(facts("dark.sgi --truth m.zoo --view v.toml")["misfit"]["encoding"]["name"],
            "linear values where sRGB-encoded ones are expected");
  EXPECT_FALSE(
      facts("dark.sgi --linear --truth m.zoo --view v.toml")["misfit"].contains("encoding"));

  // the camera a little to the side: the picture moves the other way
  Scene aside = scene_;
  aside.image = {640, 480};
  const auto axes = [&] {
    std::array<double, 3> ahead{}, right_of{};
    double length = 0;
    for (std::size_t c = 0; c < 3; ++c) ahead[c] = aside.camera.look_at[c] - aside.camera.eye[c];
    for (std::size_t c = 0; c < 3; ++c)
      right_of[c] = ahead[(c + 1) % 3] * aside.camera.up[(c + 2) % 3] -
                    ahead[(c + 2) % 3] * aside.camera.up[(c + 1) % 3];
    for (const double part : right_of) length += part * part;
    for (double& part : right_of) part /= std::sqrt(length);
    return right_of;
  }();
  aside.camera.projection = Projection::orthographic;
  aside.camera.height = 2;  // 240 pixels to a world unit
  static_cast<void>(folder_.write("p.toml", to_toml(aside)));
  for (std::size_t c = 0; c < 3; ++c) {
    aside.camera.eye[c] += 2.5 / 240 * axes[c];
    aside.camera.look_at[c] += 2.5 / 240 * axes[c];
  }
  write("aside.npy", picture(aside));
  const auto place = facts("aside.npy --truth m.zoo --view p.toml")["misfit"]["place"];
  EXPECT_NEAR(place["shift"][0], -2.5, 0.05);
  EXPECT_NEAR(place["shift"][1], 0, 0.05);
}

// The projection: what is drawn with one camera is judged by the truth of another.
class CompareProjection : public CompareTruth {
 protected:
  CompareProjection() {
    scene_.image = test::kInstrumented ? ImageSize{32, 24} : ImageSize{160, 120};
  }

  // A camera that sees as much of what is at look_at, with a view angle (0: parallel).
  [[nodiscard]] static Camera framed(Camera camera, double fov) {
    const double half = std::tan(radians(camera.fov) / 2) * distance(camera);
    if (fov == 0) {
      camera.projection = Projection::orthographic;
      camera.height = 2 * half;
    } else {
      const double farther = half / std::tan(radians(fov) / 2) / distance(camera);
      for (std::size_t c = 0; c < 3; ++c)
        camera.eye[c] = camera.look_at[c] + farther * (camera.eye[c] - camera.look_at[c]);
    }
    camera.fov = fov;
    return camera;
  }
  [[nodiscard]] static double distance(const Camera& camera) {
    const auto ahead = view_direction(camera);
    return std::hypot(ahead[0], ahead[1], ahead[2]);
  }
  // The misfit of a picture by one camera from the truth of another.
  nlohmann::json misfit(const Camera& drawn, const Camera& view, bool is_mirrored = false) {
    Scene other = scene_;
    other.camera = drawn;
    Image image = picture(other);
    if (is_mirrored)
      for (std::size_t y = 0; y < image.height(); ++y)
        for (std::size_t x = 0; x < image.width() / 2; ++x)
          for (std::size_t c = 0; c < 4; ++c)
            std::swap(image.at(x, y, c), image.at(image.width() - 1 - x, y, c));
    write("drawn.npy", image);
    other.camera = view;
    static_cast<void>(folder_.write("view.toml", to_toml(other)));
    return facts("drawn.npy --truth m.zoo --view view.toml")["misfit"];
  }

 private:
  static double radians(double degrees) { return degrees * std::acos(-1.0) / 180; }
};

TEST_F(CompareProjection, FindsAParallelPictureOfAViewInPerspective) {
  const Camera view = framed(scene_.camera, 40), parallel = framed(view, 0);
  const auto told = misfit(parallel, view);
  EXPECT_GT(told["rmse"], 0.01);
  ASSERT_TRUE(told.contains("projection")) << told;
  EXPECT_EQ(told["projection"]["name"], "orthographic");
  EXPECT_NEAR(told["projection"]["height"], parallel.height, 1e-9);
  EXPECT_LT(told["projection"]["rmse_without"], 1e-9);
  ASSERT_EQ(run("drawn.npy --truth m.zoo --view view.toml"), 0);
  EXPECT_THAT(out_, HasSubstr("the picture is in parallel projection, "));
  EXPECT_THAT(out_, HasSubstr("(the view is of 40.0 degrees, from "));
}

TEST_F(CompareProjection, FindsAPictureInPerspectiveOfAParallelView) {
  for (const double fov : test::tried(std::vector{35.0, 12.0, 70.0})) {
    const Camera drawn = framed(scene_.camera, fov);
    const auto told = misfit(drawn, framed(scene_.camera, 0));
    ASSERT_TRUE(told.contains("projection")) << fov << told;
    EXPECT_EQ(told["projection"]["name"], "perspective");
    EXPECT_NEAR(told["projection"]["fov"], fov, (test::kInstrumented ? 0.05 : 0.02) * fov);
    EXPECT_NEAR(told["projection"]["eye"][0], drawn.eye[0], 0.03 * distance(drawn));
    EXPECT_LT(told["projection"]["rmse_without"], 0.1 * told["rmse"].get<double>());
  }
}

TEST_F(CompareProjection, FindsAWrongViewAngle) {
  const Camera view = framed(scene_.camera, 30);
  for (const double fov : test::tried(std::vector{45.0, 18.0, 60.0})) {
    Camera drawn = view;
    drawn.fov = fov;  // the eye where it is
    const auto told = misfit(drawn, view);
    ASSERT_TRUE(told.contains("projection")) << fov << told;
    EXPECT_NEAR(told["projection"]["fov"], fov, 0.01 * fov);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(told["projection"]["eye"][c], view.eye[c], 1e-9);
  }
  const auto moved = misfit(framed(view, 75), view);
  ASSERT_TRUE(moved.contains("projection")) << moved;
  EXPECT_NEAR(moved["projection"]["fov"], 75, test::kInstrumented ? 3 : 1);  // in fewer pixels
}

TEST_F(CompareProjection, FindsAWrongHeight) {
  const Camera view = framed(scene_.camera, 0);
  for (const double share : test::tried(std::vector{0.5, 2.0})) {
    Camera drawn = view;
    drawn.height *= share;  // half the height where the whole is meant, or the other way
    const auto told = misfit(drawn, view);
    ASSERT_TRUE(told.contains("projection")) << share << told;
    EXPECT_EQ(told["projection"]["name"], "orthographic");
    EXPECT_NEAR(told["projection"]["height"], drawn.height, 0.005 * drawn.height);
  }
}

TEST_F(CompareProjection, FindsWhatElseIsWrong) {
  const Camera view = framed(scene_.camera, 40);
  const auto told = misfit(framed(view, 0), view, true);
  ASSERT_TRUE(told.contains("projection")) << told;
  EXPECT_EQ(told["projection"]["name"], "orthographic");
  EXPECT_EQ(told["orientation"]["name"], "mirrored left to right");
}

TEST_F(CompareProjection, FindsNoneInTheRightPicture) {
  const Camera view = framed(scene_.camera, 40);
  EXPECT_FALSE(misfit(view, view).contains("projection"));
  EXPECT_FALSE(misfit(view, view, true).contains("projection"));
  // errors that are no projection's: what is dark is darker
  scene_.camera = view;
  Image image = picture(scene_);
  for (double& value : image.values()) value = std::pow(value, 1.3);
  write("darker.npy", image);
  static_cast<void>(folder_.write("view.toml", to_toml(scene_)));
  EXPECT_FALSE(facts("darker.npy --truth m.zoo --view view.toml")["misfit"].contains("projection"));
}

TEST_F(CompareTruth, SaysWhereTheTruthHasNoBound) {
  scene_.render.integration = Integration::gauss5;
  static_cast<void>(folder_.write("g.toml", to_toml(scene_)));
  write("a.npy", picture(scene_));
  const auto told = facts("a.npy --truth m.zoo --view g.toml");
  EXPECT_TRUE(told["truth_error"].is_null());
  ASSERT_EQ(run("a.npy --truth m.zoo --view g.toml"), 0);
  EXPECT_THAT(errors_, HasSubstr("the truth has no error bound"));
}

TEST_F(CompareTruth, RefusesWhatDoesNotFit) {
  write("a.npy", picture(scene_));
  EXPECT_EQ(run("a.npy"), 2);
  EXPECT_THAT(errors_, HasSubstr("B or --truth MESH is required"));
  EXPECT_EQ(run("a.npy a.npy --truth m.zoo --view v.toml"), 2);
  EXPECT_EQ(run("a.npy a.npy --view v.toml"), 2);
  EXPECT_EQ(run("a.npy --truth missing.zoo --view v.toml"), 3);
  write("d.exr", Image(64, 48, {"depth"}));
  EXPECT_EQ(run("d.exr --truth m.zoo --view v.toml"), 3);
  EXPECT_THAT(errors_, HasSubstr("a picture of R, G and B expected (channels depth found)"));
}

TEST_F(CompareTruth, TellsThatTheTruthHasNoAnnotation) {
  write("a.npy", picture(scene_));
  const std::string note =
      "hiac-compare: [annotation] is not drawn on the truth: where A has it, it differs\n";
  ASSERT_EQ(run("a.npy --truth m.zoo --view v.toml"), 0) << errors_;
  EXPECT_THAT(errors_, testing::Not(HasSubstr(note)));
  static_cast<void>(folder_.write("w.toml", to_toml(scene_) + "[annotation.axes]\nshow = true\n"));
  ASSERT_EQ(run("a.npy --truth m.zoo --view w.toml --max-error 0"), 0) << errors_;
  EXPECT_THAT(errors_, HasSubstr(note));
}

}  // namespace
}  // namespace hiac
