#include "hiac/image/files/isolated_image.hpp"

#include <csignal>

#include <gmock/gmock.h>
#include <sys/resource.h>

#include "hiac/base/error.hpp"
#include "tests/image/test_folder.hpp"

namespace hiac::image_files {
namespace {

std::string complaint_of(const std::function<ImageFile()>& read) {
  try {
    read_isolated_image("a.png", "libpng", read);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(IsolatedImage, ArrivesWhole) {
  for (const auto& [width, height] : {std::pair<std::size_t, std::size_t>{1, 1}, {301, 203}}) {
    const ImageFile file{random_picture(width, height, {"R", "G", "B", "A", "depth"}),
                         {{"hiac:mesh", "abc"}, {"Software", ""}}};
    const ImageFile found = read_isolated_image("a.exr", "OpenEXR", [&] { return file; });
    EXPECT_EQ(found.image.width(), width);
    EXPECT_EQ(found.image.height(), height);
    EXPECT_THAT(found.image.channels(), testing::ElementsAreArray(file.image.channels()));
    EXPECT_THAT(found.image.values(), testing::ElementsAreArray(file.image.values()));
    EXPECT_EQ(found.attributes, file.attributes);
  }
}

TEST(IsolatedImage, CrashesAndErrorsAreTheFiles) {
  EXPECT_EQ(complaint_of([]() -> ImageFile { throw InputError("a.png", "is bad"); }),
            "a.png: is bad");
  EXPECT_THAT(complaint_of([]() -> ImageFile {
                std::raise(SIGSEGV);
                return {};
              }),
              testing::HasSubstr("a.png: libpng breaks down on it (a damaged file; signal 11)"));
}

long faults_of_children() {
  struct rusage usage {};
  getrusage(RUSAGE_CHILDREN, &usage);
  return usage.ru_minflt;
}

class ReadImages : public FolderTest {};

TEST_F(ReadImages, ThatALibraryReadsAreReadInAnotherProcess) {
  const Image image = random_picture(7, 5, rgba_channels());
  for (const char* extension : {".exr", ".png", ".tiff"}) {
    write_image(path(std::string("a") + extension), image);
    const long before = faults_of_children();
    read_image(path(std::string("a") + extension));
    EXPECT_GT(faults_of_children(), before) << extension;
  }
}

}  // namespace
}  // namespace hiac::image_files
