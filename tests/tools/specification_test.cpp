#include "tools/common/picture/specification.hpp"

#include <fstream>

#include <gmock/gmock.h>

#include "hiac/base/error.hpp"
#include "hiac/image/image_io.hpp"
#include "hiac/scene/specification.hpp"
#include "tests/support/scratch_folder.hpp"

namespace hiac::tools {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

// Numbers that need all their digits.
constexpr const char* kView = R"([image]
width = 4
height = 3
[camera]
eye = [0.1, -3.0000000000000004, 1e-300]
look_at = [0.5, 0.5, 0.5]
up = [0.0, 0.0, 1.0]
fov = 33.333333333333336
[volume.color]
field = "Tempé\"rature\\"
points = [[0.0, 0.1, 0.2, 0.9], [0.30000000000000004, 0.9, 0.1, 0.1]]
)";

class Specification : public testing::Test {
 protected:
  Specification() : view_(folder_.write("view.toml", kView)) {}

  // A picture as hiac-render writes it.
  [[nodiscard]] std::string picture(const std::string& name) const {
    write_image(folder_.file(name), Image(4, 3, rgba_channels(), std::vector<double>(48, 0.5)),
                {.attributes = {{"Software", "hiac-render"},
                                {"hiac:specification", to_toml(read_scene(view_).scene)}}});
    return folder_.file(name);
  }

  test::ScratchFolder folder_;
  std::string view_;
};

TEST_F(Specification, PicturesGiveTheirOwn) {
  const std::string expected = to_toml(read_scene(view_).scene);
  for (const char* name : {"a.png", "a.exr", "a.tiff", "a.tif"})
    EXPECT_EQ(to_toml(read_specification(picture(name), {}).scene), expected) << name;
}

TEST_F(Specification, OfAPictureIsOverridden) {
  const std::vector<std::string> overrides{"camera.fov=20", "image.width=8"};
  EXPECT_EQ(to_toml(read_specification(picture("a.png"), overrides).scene),
            to_toml(read_specification(view_, overrides).scene));
  EXPECT_THAT([&] { read_specification(picture("a.png"), {"camera.fov=200"}); },
              ThrowsMessage<UsageError>(HasSubstr("--set camera.fov=200")));
}

TEST_F(Specification, PicturesWithoutOneAreRefused) {
  const Image image(4, 3, rgba_channels(), std::vector<double>(48, 0.5));
  for (const char* name : {"a.png", "a.exr", "a.tiff", "a.npy", "a.sgi", "a.f32"}) {
    write_image(folder_.file(name), image, {.attributes = {{"hiac:mesh", "0123"}}});
    EXPECT_THAT([&] { read_specification(folder_.file(name), {}); },
                ThrowsMessage<InputError>(HasSubstr(
                    std::string(name) + ": is a picture that does not hold its specification")))
        << name;
  }
  EXPECT_THAT([&] { read_specification(folder_.write("b.png", "[image]"), {}); },
              ThrowsMessage<InputError>(HasSubstr("b.png: ")));
}

// What a picture says is checked as a file is.
TEST_F(Specification, FaultsInAPictureNameIt) {
  write_image(folder_.file("a.png"), Image(1, 1, rgba_channels(), std::vector<double>(4, 0.5)),
              {.attributes = {{"hiac:specification", "[image]\nwidth = 0\n"}}});
  EXPECT_THAT([&] { read_specification(folder_.file("a.png"), {}); },
              ThrowsMessage<InputError>(HasSubstr("a.png:2: key `image.width`")));
}

}  // namespace
}  // namespace hiac::tools
