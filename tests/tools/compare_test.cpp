#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "hiac/image/heat_map.hpp"
#include "hiac/image/image_io.hpp"
#include "hiac/image/srgb.hpp"
#include "tests/support/scratch_folder.hpp"

namespace hiac {
namespace {

using testing::HasSubstr;

struct Answer {
  int exit_code;
  std::string output;  ///< stdout
  std::string errors;  ///< stderr
};

Image picture(std::size_t width = 16, std::size_t height = 12) {
  Image image(width, height, rgba_channels());
  for (std::size_t i = 0; i < image.values().size(); ++i)
    image.values()[i] = i % 4 == 3 ? 1 : static_cast<double>(i * 7 % 64) / 64;
  return image;
}

class Compare : public testing::Test {
 protected:
  [[nodiscard]] std::string path(const std::string& name) const { return folder_.file(name); }
  static std::string text_of(const std::string& file) { return test::bytes_of(file); }
  [[nodiscard]] Answer run(const std::string& arguments) const {
    const int status = std::system(("cd " + folder_.path().string() + " && " HIAC_COMPARE " " +
                                    arguments + " > out.txt 2> err.txt")
                                       .c_str());
    return {WEXITSTATUS(status), text_of(path("out.txt")), text_of(path("err.txt"))};
  }

  test::ScratchFolder folder_;
};

TEST_F(Compare, TellsHowFarImagesAreApart) {
  const Image reference = picture();
  Image image = reference;
  image.at(5, 7, 1) += 0.25;
  write_image(path("a.npy"), image);
  write_image(path("b.npy"), reference);
  const Answer answer = run("a.npy b.npy");
  EXPECT_EQ(answer.exit_code, 0) << answer.errors;
  EXPECT_EQ(answer.errors, "");
  for (const char* words :
       {"a.npy against b.npy: 16 x 12 pixels\n", "RMSE", "0.25  5,7", "PSNR", "SSIM", "FLIP"})
    EXPECT_THAT(answer.output, HasSubstr(words));

  const auto facts = nlohmann::json::parse(run("a.npy b.npy --json -").output);
  EXPECT_EQ(facts["equal"], false);
  EXPECT_EQ(facts["channels"][1]["name"], "G");
  EXPECT_EQ(facts["channels"][1]["largest_error"], 0.25);
  EXPECT_EQ(facts["channels"][1]["largest_at"], (nlohmann::json{5, 7}));
  EXPECT_NEAR(facts["channels"][1]["rmse"], std::sqrt(0.0625 / 192), 1e-15);
  EXPECT_EQ(facts["channels"][0]["rmse"], 0.0);
  EXPECT_NEAR(facts["psnr"], -10 * std::log10(0.0625 / 192 / 3), 1e-12);
  EXPECT_LT(facts["ssim"], 1.0);
  EXPECT_GT(facts["flip"]["mean"], 0.0);
  EXPECT_GT(facts["flip"]["largest"], facts["flip"]["mean"]);
}

TEST_F(Compare, JudgesWhereAsked) {
  Image image = picture();
  write_image(path("b.npy"), image);
  image.at(5, 7, 1) += 0.25;
  write_image(path("a.npy"), image);
  EXPECT_EQ(run("a.npy b.npy --max-error 0.25 --max-rmse 0.02").exit_code, 0);
  const Answer error = run("a.npy b.npy --max-error 0.2");
  EXPECT_EQ(error.exit_code, 1);
  EXPECT_EQ(error.errors,
            "hiac-compare: a.npy: too far from b.npy (at most 0.2 allowed; 0.25 found "
            "in channel G at pixel 5,7)\n");
  EXPECT_THAT(error.output, HasSubstr("RMSE"));
  EXPECT_EQ(run("a.npy b.npy --max-rmse 0.01").exit_code, 1);
  EXPECT_EQ(run("b.npy b.npy --max-error 0 --max-rmse 0").exit_code, 0);
  EXPECT_THAT(run("b.npy b.npy").output, HasSubstr("pixels, equal"));
  const auto facts = nlohmann::json::parse(run("a.npy b.npy -q --max-error 0 --json -").output);
  EXPECT_EQ(facts["exit_code"], 1);
}

TEST_F(Compare, FailsImagesThatCannotBeCompared) {
  write_image(path("a.npy"), picture());
  write_image(path("b.npy"), picture(12, 16));
  Image depth(16, 12, {"depth"});
  write_image(path("d.exr"), depth);
  const Answer size = run("a.npy b.npy");
  EXPECT_EQ(size.exit_code, 1);
  EXPECT_THAT(size.errors, HasSubstr("(12 x 16 pixels expected, as b.npy has; 16 x 12 found)"));
  const Answer channels = run("-q a.npy d.exr");
  EXPECT_EQ(channels.exit_code, 1);
  EXPECT_THAT(channels.errors, HasSubstr("no channel in common with d.exr"));
}

TEST_F(Compare, CountsWhatIsNotANumber) {
  Image image = picture();
  image.at(1, 0, 0) = std::nan("");
  write_image(path("a.npy"), image);
  EXPECT_EQ(run("a.npy a.npy --max-error 0").exit_code, 0);
  image.at(1, 0, 0) = 0;
  write_image(path("b.npy"), image);
  const Answer answer = run("a.npy b.npy --max-error 1e300");
  EXPECT_EQ(answer.exit_code, 1);
  EXPECT_THAT(answer.output, HasSubstr("(1 infinite)"));
  EXPECT_THAT(answer.output, HasSubstr("SSIM      not defined"));
  const auto facts = nlohmann::json::parse(run("a.npy b.npy --json -").output);
  EXPECT_TRUE(facts["channels"][0]["rmse"].is_null());
  EXPECT_EQ(facts["channels"][0]["infinite"], 1);
  EXPECT_TRUE(facts["flip"]["mean"].is_null());
}

TEST_F(Compare, ReadsEveryFormatThatIsWritten) {
  const Image image = picture();
  write_image(path("a.npy"), image);
  const struct {
    const char* name;
    WriteOptions options;
    double error;
  } files[] = {{"b.exr", {}, 1e-7},
               {"b.f32", {}, 1e-7},
               {"b.png", {}, 5e-3},
               {"b.tiff", {}, 5e-3},
               {"b.tif", {.depth = 32}, 1e-7},
               {"b.sgi", {.depth = 16}, 2e-5},
               {"b.rgba", {}, 5e-3},
               {"b.pfm", {}, 1e-7},
               {"b.hdr", {}, 4e-3}};
  for (const auto& file : files) {
    write_image(path(file.name), image, file.options);
    const Answer answer =
        run(std::string(file.name) + " a.npy --width 16 --max-error " + std::to_string(file.error));
    EXPECT_EQ(answer.exit_code, 0) << file.name << answer.errors;
    const bool has_alpha = std::string(file.name) != "b.pfm" && std::string(file.name) != "b.hdr";
    EXPECT_EQ(answer.errors, has_alpha ? ""
                                       : "hiac-compare: warning: channel A is only in a.npy and is "
                                         "not compared\n");
  }
  write_image(path("l.tiff"), image, {.linear = true, .depth = 16});
  EXPECT_EQ(run("l.tiff a.npy --max-error 1e-3").exit_code, 1);
  EXPECT_EQ(run("l.tiff a.npy --max-error 1e-3 --linear").exit_code, 0);
}

TEST_F(Compare, DrawsHeatMaps) {
  Image image = picture();
  write_image(path("b.npy"), image);
  image.at(5, 7, 1) += 0.25;
  image.at(6, 7, 2) += 0.5;
  write_image(path("a.npy"), image);
  const Answer answer = run("a.npy b.npy --heatmap h.png");
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_THAT(answer.errors, HasSubstr("to 0.5 (yellow)"));
  const Image map = read_image(path("h.png")).image;
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_EQ(map.at(0, 0, c), srgb_decode(kViridis[0][c] / 255.0));
    EXPECT_EQ(map.at(5, 7, c), srgb_decode(kViridis[3][c] / 255.0));
    EXPECT_EQ(map.at(6, 7, c), srgb_decode(kViridis[6][c] / 255.0));
  }
  EXPECT_EQ(run("a.npy b.npy --heatmap f.png --heatmap-of flip").exit_code, 0);
  EXPECT_GT(read_image(path("f.png")).image.at(6, 7, 1), map.at(0, 0, 1));
}

TEST_F(Compare, AnswersBadInputInOneLine) {
  write_image(path("a.npy"), picture());
  write_image(path("a.f32"), picture());
  std::ofstream(path("text.png")) << "hello";
  const std::pair<const char*, int> cases[] = {{"a.npy", 2},
                                               {"a.npy none.npy", 3},
                                               {"a.npy text.png", 3},
                                               {"a.npy a.jpg", 2},
                                               {"a.npy a.f32", 2},
                                               {"a.npy a.npy --max-error -1", 2},
                                               {"a.npy a.npy --max-rmse x", 2},
                                               {"-q a.npy a.npy --heatmap none/h.png", 3},
                                               {"a.npy a.npy --heatmap h.jpg", 2}};
  for (const auto& [arguments, exit_code] : cases) {
    const Answer answer = run(arguments);
    EXPECT_EQ(answer.exit_code, exit_code) << arguments << "\n" << answer.errors;
    EXPECT_EQ(std::count(answer.errors.begin(), answer.errors.end(), '\n'), 1) << answer.errors;
    EXPECT_THAT(answer.errors, testing::StartsWith("hiac-compare: "));
  }
  EXPECT_THAT(run("--help").output, HasSubstr("Examples:"));
}

}  // namespace
}  // namespace hiac
