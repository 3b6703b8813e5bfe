#include "hiac/image/image_io.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

#include <gmock/gmock.h>

#include "hiac/base/error.hpp"
#include "hiac/image/files/image_formats.hpp"
#include "tests/image/test_folder.hpp"

namespace hiac {
namespace {

using testing::HasSubstr;

class ImageIo : public FolderTest {};

/// Expects the values that float32 can hold of `image`, to the bit.
void expect_floats(const Image& read, const Image& image) {
  ASSERT_EQ(read.width(), image.width());
  ASSERT_EQ(read.height(), image.height());
  for (std::size_t c = 0; c < read.channel_count(); ++c) {
    const std::size_t from = *image.channel_index(read.channels()[c]);
    for (std::size_t y = 0; y < image.height(); ++y)
      for (std::size_t x = 0; x < image.width(); ++x) {
        const auto expected = static_cast<float>(image.at(x, y, from));
        const auto found = static_cast<float>(read.at(x, y, c));
        ASSERT_EQ(std::memcmp(&expected, &found, sizeof found), 0) << x << " " << y << " " << c;
      }
  }
}

TEST_F(ImageIo, ExrKeepsFloatsChannelsAndTexts) {
  // more lines than one block, and not a multiple of it
  const Image image = random_image(29, 37, {"R", "G", "B", "A", "order", "depth"});
  const WriteOptions options{
      false, false, {{"hiac:specification", "[image]\nwidth = 29\n# ä"}, {"hiac:mesh", "0123"}}};
  write_image(path("a.exr"), image, options);
  const ImageFile file = read_image(path("a.exr"));
  EXPECT_THAT(file.image.channels(), testing::ElementsAre("R", "G", "B", "A", "depth", "order"));
  expect_floats(file.image, image);
  for (const auto& attribute : options.attributes)
    EXPECT_THAT(file.attributes, testing::Contains(attribute));
  // the same image makes the same file
  write_image(path("b.exr"), image, options);
  EXPECT_EQ(bytes_of(path("a.exr")), bytes_of(path("b.exr")));
  EXPECT_EQ(file_count(), 2u);
}

TEST_F(ImageIo, F32WritesOneRawFileAChannel) {
  const Image image = random_image(5, 3, {"R", "G", "B", "A", "depth"});
  write_image(path("a.f32"), image);
  EXPECT_EQ(file_count(), 5u);
  const std::string green = bytes_of(path("a.g.f32"));
  ASSERT_EQ(green.size(), 60u);
  float second = 0;
  std::memcpy(&second, &green[4], sizeof second);
  EXPECT_EQ(second, static_cast<float>(image.at(1, 0, 1)));
  EXPECT_EQ(bytes_of(path("a.depth.f32")).size(), 60u);
  expect_floats(read_image(path("a.f32"), {.width = 5}).image, image);

  EXPECT_THROW(read_image(path("a.f32")), UsageError);
  EXPECT_THROW(read_image(path("a.f32"), {.width = 7}), InputError);
  EXPECT_THROW(read_image(path("b.f32"), {.width = 5}), InputError);
  write_bytes(path("a.b.f32"), "12345");
  EXPECT_THROW(read_image(path("a.f32"), {.width = 5}), InputError);
  write_bytes(path("a.b.f32"), "12345678");
  EXPECT_THROW(read_image(path("a.f32"), {.width = 5}), InputError);
}

TEST_F(ImageIo, NamesTheExtensionsThatItKnows) {
  for (const char* name : {"a.jpg", "a", "npy"}) {
    try {
      write_image(path(name), Image(1, 1, {"Y"}));
      ADD_FAILURE() << name;
    } catch (const UsageError& error) {
      EXPECT_THAT(error.what(),
                  HasSubstr("(expected one of .exr .npy .f32 .png .tiff .tif .sgi .rgba .pfm "
                            ".hdr, found "));
    }
  }
  EXPECT_THROW(require_known_image_extension("a.jpg"), UsageError);
  EXPECT_NO_THROW(require_known_image_extension("a.EXR"));
}

TEST_F(ImageIo, KnowsNamesThatBeginWithADot) {
  for (const char* name : {".png", "./a.png", "../a.png", ".a.png", "./../a.b/c.png"})
    EXPECT_TRUE(has_image_extension(name)) << name;
  for (const char* name : {".", "..", "./a", "../png", "../.png", ".a", ".png/a", ""})
    EXPECT_FALSE(has_image_extension(name)) << name;
}

TEST_F(ImageIo, SaysWhenAFileCannotBeWrittenOrRead) {
  for (const char* name : {"none/a.exr", "none/a.npy", "none/a.f32", "none/a.png", "none/a.tiff",
                           "none/a.sgi", "none/a.pfm", "none/a.hdr"}) {
    EXPECT_THROW(write_image(path(name), random_image(1, 1, rgba_channels())), InputError) << name;
    EXPECT_THROW(read_image(path(name), {.width = 1}), InputError) << name;
  }
  for (const char* name : {"a.exr", "a.npy", "a.png", "a.tiff", "a.rgba", "a.pfm", "a.hdr"}) {
    std::filesystem::create_directory(path(name));
    EXPECT_THROW(write_image(path(name), random_image(1, 1, rgba_channels())), InputError) << name;
    EXPECT_THROW(read_image(path(name)), InputError) << name;
    std::filesystem::remove(path(name));
  }
  EXPECT_EQ(file_count(), 0u);
}

TEST_F(ImageIo, RefusesAnImageWithoutPixels) {
  for (const char* name : {"a.exr", "a.npy", "a.f32", "a.png", "a.tiff", "a.sgi", "a.pfm", "a.hdr"})
    EXPECT_THROW(write_image(path(name), Image(0, 3, rgba_channels())), UsageError);
}

TEST_F(ImageIo, IsReadByWhatTheFormatsSay) {
  const std::string python = python_with_numpy();
  if (python.empty()) GTEST_SKIP() << "SKIPPED: numpy is not installed";
  const Image image = random_picture(301, 23, {"R", "G", "B", "A", "depth"});
  for (const char* name : {"truth.npy", "a.sgi", "a.tiff", "a.pfm", "a.hdr"})
    write_image(path(name), image);
  for (const char* name : {"linear.sgi", "linear.tiff"})
    write_image(path(name), image, {.linear = true});
  for (const char* name : {"16.sgi", "16.tiff"}) write_image(path(name), image, {.depth = 16});
  write_image(path("float.tiff"), image, {.depth = 32});
  EXPECT_EQ(std::system((python + " " HIAC_READ_IMAGES " " + folder_.path().string()).c_str()), 0);
}

TEST_F(ImageIo, KnowsTheDepthsThatAFormatHas) {
  const Image image = random_picture(3, 2);
  const std::pair<const char*, int> wrong[] = {{"a.exr", 16}, {"a.npy", 32}, {"a.png", 32},
                                               {"a.sgi", 1},  {"a.pfm", 16}, {"a.tiff", 64}};
  for (const auto& [name, depth] : wrong) {
    EXPECT_THROW(write_image(path(name), image, {.depth = depth}), UsageError) << name;
    EXPECT_THROW(require_known_image_extension(name, depth), UsageError) << name;
  }
  EXPECT_NO_THROW(require_known_image_extension("a.tiff", 32));
  EXPECT_EQ(file_count(), 0u);
}

TEST_F(ImageIo, SurvivesDamagedExrFiles) {
  write_image(path("a.exr"), random_image(20, 40, rgba_channels(), false), {});
  const std::string good = bytes_of(path("a.exr"));
  const auto read = [&](const std::string& bytes) {
    write_bytes(path("damaged.exr"), bytes);
    // in this process, in which the sanitizers see what the library does
    return image_files::read_exr(path("damaged.exr"));
  };
  expect_survival(good, 400, 1500, read);
}

TEST(ImageSamples, KnowsWhichFormatsStoreWholeNumbers) {
  for (const char* path : {"a.png", "a.tiff", "a.TIF", "a.sgi", "a.rgba", ".png"})
    EXPECT_TRUE(has_integer_samples(path)) << path;
  for (const char* path : {"a.exr", "a.npy", "a.f32", "a.pfm", "a.hdr"})
    EXPECT_FALSE(has_integer_samples(path)) << path;
  EXPECT_TRUE(has_integer_samples("a.tiff", 16));
  EXPECT_FALSE(has_integer_samples("a.tiff", 32));
  EXPECT_THROW((void)has_integer_samples("a.png", 32), UsageError);
}

TEST(ImageSamples, EveryFormatHasItsDepths) {
  const struct {
    const char* name;
    std::vector<int> depths;  ///< the first is the usual one
    int most_of_integers;
  } formats[] = {{"a.exr", {32}, 0},     {"a.npy", {64}, 0},          {"a.f32", {32}, 0},
                 {"a.png", {8, 16}, 16}, {"a.tiff", {8, 16, 32}, 16}, {"a.tif", {8, 16, 32}, 16},
                 {"a.sgi", {8, 16}, 16}, {"a.rgba", {8, 16}, 16},     {"a.pfm", {32}, 0},
                 {"a.hdr", {8}, 0}};
  for (const auto& format : formats) {
    EXPECT_EQ(has_integer_samples(format.name), format.depths.front() <= format.most_of_integers);
    for (const int depth : {1, 4, 8, 12, 16, 24, 32, 48, 64, 128}) {
      if (std::ranges::find(format.depths, depth) == format.depths.end()) {
        EXPECT_THROW(require_known_image_extension(format.name, depth), UsageError)
            << format.name << depth;
        continue;
      }
      EXPECT_NO_THROW(require_known_image_extension(format.name, depth)) << format.name << depth;
      EXPECT_EQ(has_integer_samples(format.name, depth), depth <= format.most_of_integers)
          << format.name << depth;
    }
  }
}

// The window of a picture's pixels may begin anywhere: at 5,3 here, where hiac's begin at 0,0.
TEST_F(ImageIo, ExrFilesWhosePixelsBeginElsewhereAreRead) {
  const Image image = random_image(7, 4, {"R", "G", "B"});
  write_image(path("a.exr"), image);
  std::string bytes = bytes_of(path("a.exr"));
  const std::string name("dataWindow\0box2i\0\x10\0\0\0", 21);
  const std::size_t window = bytes.find(name) + name.size();
  ASSERT_NE(window, std::string::npos + name.size());
  const std::array<std::int32_t, 4> moved{5, 3, 11, 6};
  std::memcpy(&bytes[window], moved.data(), sizeof moved);
  // one block: its place stands before it, and it begins with the number of its first line
  std::size_t block = window;
  for (std::uint64_t place = 0; place != block; std::memcpy(&place, &bytes[block - 8], 8)) ++block;
  ASSERT_LT(block, bytes.size());
  std::memcpy(&bytes[block], &moved[1], 4);
  write_bytes(path("b.exr"), bytes);
  const Image read = read_image(path("b.exr")).image;
  ASSERT_EQ(read.channel_count(), 3U);
  expect_floats(read, image);
}

TEST_F(ImageIo, RawPlanesHaveTheNamesOfTheirChannels) {
  using testing::ElementsAre;
  EXPECT_THAT(files_of_image("p/a.f32", {"depth"}),
              ElementsAre("p/a.r.f32", "p/a.g.f32", "p/a.b.f32", "p/a.a.f32", "p/a.depth.f32"));
  EXPECT_THAT(files_of_image("p/a.f32"),
              ElementsAre("p/a.r.f32", "p/a.g.f32", "p/a.b.f32", "p/a.a.f32"));
  EXPECT_THAT(files_of_image("p/a.exr", {"depth"}), ElementsAre("p/a.exr"));
}

}  // namespace
}  // namespace hiac
