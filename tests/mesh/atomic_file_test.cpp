#include "hiac/mesh/atomic_file.hpp"

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <sys/stat.h>

#include "hiac/base/error.hpp"
#include "hiac/mesh/file_descriptor.hpp"
#include "tests/support/scratch_folder.hpp"

namespace hiac {
namespace {

namespace fs = std::filesystem;
using test::bytes_of;
using testing::ElementsAre;

class AtomicFile : public testing::Test {
 protected:
  [[nodiscard]] std::string path(const std::string& name) const { return folder_.file(name); }
  [[nodiscard]] std::vector<std::string> names() const { return folder_.names(); }
  static void put(const std::string& path, const std::string& text) {
    write_atomically(path, [&](int descriptor) {
      write_fully(descriptor, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()},
                  path);
    });
  }

 private:
  test::ScratchFolder folder_;
};

TEST_F(AtomicFile, CreatesAndReplaces) {
  put(path("a"), "first");
  put(path("a"), "second");
  EXPECT_EQ(bytes_of(path("a")), "second");
  EXPECT_THAT(names(), ElementsAre("a"));
}

TEST_F(AtomicFile, NothingIsSeenUntilItIsWhole) {
  put(path("a"), "old");
  write_atomically(path("a"), [&](int) { EXPECT_EQ(bytes_of(path("a")), "old"); });
  EXPECT_EQ(bytes_of(path("a")), "");
}

TEST_F(AtomicFile, FailureLeavesTheOldFileAndNothingElse) {
  put(path("a"), "old");
  EXPECT_THROW(write_atomically(path("a"), [](int) { throw std::runtime_error("no"); }),
               std::runtime_error);
  EXPECT_EQ(bytes_of(path("a")), "old");
  EXPECT_THAT(names(), ElementsAre("a"));
}

TEST_F(AtomicFile, ObeysTheUsersMask) {
  const mode_t before = ::umask(027);
  put(path("a"), "x");
  ::umask(before);
  struct stat status {};
  ASSERT_EQ(::stat(path("a").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0640u);
}

TEST_F(AtomicFile, WorksInTheCurrentFolder) {
  const fs::path before = fs::current_path();
  fs::current_path(path(""));
  put("a", "x");
  fs::current_path(before);
  EXPECT_EQ(bytes_of(path("a")), "x");
}

TEST_F(AtomicFile, RefusesAFolder) {
  EXPECT_THROW(put(path(""), "x"), InputError);
  EXPECT_THROW(put(path("none/a"), "x"), InputError);
}

}  // namespace
}  // namespace hiac
