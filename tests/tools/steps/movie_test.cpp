// Films of hiac-render, by a stand-in for ffmpeg that records what it is given, and by ffmpeg.

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "hiac/image/files/integer_pixels.hpp"
#include "hiac/image/image_io.hpp"
#include "tests/tools/steps/step_files.hpp"

namespace hiac::test {
namespace {

using testing::HasSubstr;

class MovieTest : public StepFiles {
 protected:
  static constexpr const char* kRender =
      "$RENDER still.msh --steps all --view view.toml --set render.tolerance=1e-6 ";

  /// A shell script takes the place of ffmpeg.
  void stand_in(const std::string& script) const { ToolFolder::stand_in("ffmpeg", script); }

  [[nodiscard]] int film(const std::string& arguments) const {
    return run(with_stand_ins(kRender + arguments));
  }

  /// The samples of a picture as a film has them.
  [[nodiscard]] std::string samples_of(const std::string& name) const {
    const Image image = read_image(file(name)).image;
    const auto pixels = image_files::encode_integers(
        name, ".png", image,
        {.linear = false, .background_included = true, .attributes = {}, .depth = 8, .format = {}});
    return {pixels.samples.begin(), pixels.samples.end()};
  }

  void expect_no_film() const {
    for (const std::string& name : folder_.names()) EXPECT_FALSE(name.starts_with("run.mp4"));
  }
};

constexpr const char* kRecord =
    "printf '%s\\n' \"$@\" >arguments.txt\n"
    "cat >frames.rgb\n"
    "for last; do :; done\n"
    "printf film >\"$last\"\n";

TEST_F(MovieTest, PicturesGoIntoThePipeInOrder) {
  stand_in(kRecord);
  ASSERT_EQ(film("--fps 12.5 -o 'run of $HOME;.mp4'"), 0) << complaint();
  EXPECT_EQ(bytes_of(file("run of $HOME;.mp4")), "film");
  const std::string arguments = bytes_of(file("arguments.txt"));
  EXPECT_THAT(arguments, HasSubstr("-video_size\n31x22\n-framerate\n12.5\n"));
  EXPECT_THAT(arguments, HasSubstr("\n-y\nrun of $HOME;.mp4."));
  ASSERT_EQ(run(kRender + std::string("-o run%d.png")), 0);
  std::string frames;
  for (int step = 0; step < 3; ++step) frames += samples_of(fmt::format("run{}.png", step));
  EXPECT_EQ(frames.size(), 3U * 31 * 22 * 3);
  EXPECT_EQ(bytes_of(file("frames.rgb")), frames);
  EXPECT_NE(samples_of("run0.png"), samples_of("run1.png"));
}

TEST_F(MovieTest, FramesOfAPathMakeAFilm) {
  stand_in(kRecord);
  write("path.toml", view("range = [-1, 5]", "") + "[turntable]\nframes = 4\n");
  ASSERT_EQ(run(with_stand_ins("$RENDER -q part0.zoo --view path.toml --frames --crop 1,2,8,6 "
                               "-o run.mp4")),
            0)
      << complaint();
  EXPECT_THAT(bytes_of(file("arguments.txt")), HasSubstr("-framerate\n25\n"));
  ASSERT_EQ(run("$RENDER -q part0.zoo --view path.toml --frames --crop 1,2,8,6 -o f%d.png"), 0);
  std::string frames;
  for (int frame = 0; frame < 4; ++frame) frames += samples_of(fmt::format("f{}.png", frame));
  EXPECT_EQ(bytes_of(file("frames.rgb")), frames);
}

TEST_F(MovieTest, AFailureLeavesNoFilm) {
  stand_in(
      "cat >/dev/null\nfor last; do :; done\nprintf half >\"$last\"\n"
      "echo 'first line' >&2\necho 'no such encoder' >&2\nexit 7\n");
  EXPECT_EQ(film("-o run.mp4"), 3);
  EXPECT_THAT(complaint(), HasSubstr("hiac-render: run.mp4: ffmpeg failed with exit code 7 (no "
                                     "such encoder)"));
  expect_no_film();
  stand_in("echo early >&2\nexit 1\n");  // before it has read anything
  EXPECT_EQ(film("--size 1200x900 --crop 0,0,1200,200 -o run.mp4"), 3);
  EXPECT_THAT(complaint(), HasSubstr("ffmpeg failed with exit code 1 (early)"));
  expect_no_film();
  stand_in("kill -9 $$\n");
  EXPECT_EQ(film("-o run.mp4"), 4);
  EXPECT_THAT(complaint(), HasSubstr("run.mp4: ffmpeg was ended by signal 9"));
  expect_no_film();
  stand_in("exit 0\n");  // without reading: what it wrote is no film of these pictures
  EXPECT_EQ(film("--size 1200x900 --crop 0,0,1200,200 -o run.mp4"), 3);
  expect_no_film();
}

TEST_F(MovieTest, AFailedRunLeavesTheOldFilm) {
  write("run.mp4", "old");
  stand_in("cat >/dev/null\nexit 2\n");
  EXPECT_EQ(film("-o run.mp4"), 3);
  EXPECT_EQ(bytes_of(file("run.mp4")), "old");
  // the third step cannot be drawn: the film of the first two is none
  ASSERT_EQ(run("$CONVERT -q part1.zoo --field T=U -o part2.zoo"), 0);
  stand_in(kRecord);
  EXPECT_EQ(
      run(with_stand_ins("$RENDER part%d.zoo --view view.toml "
                         "--set 'volume.color.range=[0, 1]' --set 'volume.extinction.range=[0, 1]' "
                         "-o run.mp4")),
      2)
      << complaint();
  EXPECT_EQ(bytes_of(file("run.mp4")), "old");
  EXPECT_EQ(run("ls | grep -c 'run.mp4'"), 0);
  EXPECT_EQ(bytes_of(file("out.txt")), "1\n");
}

TEST_F(MovieTest, ASignalEndsBothAndLeavesNoFilm) {
  stand_in("cat >/dev/null\necho $$ >pid.txt\nmv pid.txt started.txt\nexec sleep 60\n");
  EXPECT_EQ(
      run(with_stand_ins("$RENDER -q still.msh --steps all --view view.toml "
                         "-o run.mp4 & child=$!; while ! test -e started.txt; do sleep 0.05; done; "
                         "kill -TERM $child; wait $child; status=$?; "
                         "for k in 1 2 3 4 5 6 7 8 9 10; do kill -0 $(cat started.txt) || break; "
                         "sleep 0.2; done; kill -0 $(cat started.txt) && exit 1; exit $status")),
      128 + 15)
      << complaint();
  expect_no_film();
}

TEST_F(MovieTest, WithoutFfmpegALineNamesThePackage) {
  EXPECT_EQ(run("PATH=/nowhere; " + std::string(kRender) + "-o run.mp4"), 4);
  EXPECT_THAT(complaint(), HasSubstr("hiac-render: run.mp4: the program ffmpeg is not on PATH (the "
                                     "package ffmpeg has it"));
  expect_no_film();
}

TEST_F(MovieTest, WrongUsageIsToldBeforeAnythingIsDrawn) {
  stand_in(kRecord);
  const std::vector<std::pair<std::string, std::string>> rows{
      {"$RENDER part0.zoo --view view.toml -o run.mp4", "a film is of several pictures"},
      {"$RENDER part%d.zoo --view view.toml --depth 16 -o run.mp4",
       "--depth 16: a film has 8 bits"},
      {"$RENDER part%d.zoo --view view.toml --format png -o run.mp4", "--format: not for a film"},
      {"$RENDER part%d.zoo --view view.toml --channels depth -o run.mp4",
       "--channels: this format holds only colours"},
      {"$RENDER part%d.zoo --view view.toml --fps 0 -o run.mp4", "--fps"}};
  for (const auto& [command, message] : rows) {
    EXPECT_EQ(run(with_stand_ins(command)), 2) << command;
    EXPECT_THAT(complaint(), HasSubstr(message)) << command;
  }
  EXPECT_FALSE(std::filesystem::exists(file("arguments.txt")));
}

// The film of a real ffmpeg, taken apart by it: as many pictures, each near the one drawn.
TEST_F(MovieTest, FfmpegMakesAFilm) {
  if (std::system("ffmpeg -version >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "ffmpeg is not on PATH (the package ffmpeg has it)";
  ASSERT_EQ(run(kRender + std::string("-o run.mp4")), 0) << complaint();
  ASSERT_EQ(run("ffmpeg -v error -i run.mp4 -vf scale=in_color_matrix=bt709 -f rawvideo -pix_fmt "
                "rgb24 frames.rgb"),
            0)
      << complaint();
  const std::string frames = bytes_of(file("frames.rgb"));
  ASSERT_EQ(frames.size(), 3U * 32 * 22 * 3);  // a column is added to an odd width
  ASSERT_EQ(run(kRender + std::string("-o run%d.png")), 0);
  for (std::size_t step = 0; step < 3; ++step) {
    const std::string truth = samples_of(fmt::format("run{}.png", step));
    double sum = 0;
    for (std::size_t y = 0; y < 22; ++y)
      for (std::size_t i = 0; i < std::size_t{31} * 3; ++i)
        sum += std::abs(static_cast<std::uint8_t>(frames[(step * 22 + y) * 96 + i]) -
                        static_cast<std::uint8_t>(truth[y * 93 + i]));
    EXPECT_LT(sum / (22 * 31 * 3), 6) << step;
  }
}

}  // namespace
}  // namespace hiac::test
