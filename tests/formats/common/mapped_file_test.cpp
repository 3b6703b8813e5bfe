// Files in memory, and files that are written whole or not at all: what they hold, and that nothing
// of them is left behind.
#include "formats/common/io/mapped_file.hpp"

#include <cerrno>
#include <csignal>
#include <filesystem>

#include <sys/resource.h>
#include <sys/stat.h>

#include "formats/common/io/binary_output.hpp"
#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::size_t open_files() {
  const std::filesystem::directory_iterator open("/proc/self/fd");
  return static_cast<std::size_t>(std::distance(begin(open), end(open)));
}

std::string mapping_complaint(const std::string& path) {
  try {
    const MappedFile file(path);
  } catch (const InputError& error) {
    return std::string(error.what()).substr(path.size());
  }
  return "none";
}

TEST(MappedFile, HoldsTheTextAsLongAsItLives) {
  const ScratchFolder folder;
  const std::string path = folder.write("a.mapped", std::string("one\0two\n", 8));
  {
    const MappedFile file(path);
    EXPECT_EQ(file.text(), std::string_view("one\0two\n", 8));
    EXPECT_THAT(text_of("/proc/self/maps"), HasSubstr(path));
  }
  EXPECT_THAT(text_of("/proc/self/maps"), Not(HasSubstr(path)));
  EXPECT_EQ(MappedFile(folder.write("empty", "")).text(), "");
}

TEST(MappedFile, IsARegularFile) {
  const ScratchFolder folder;
  const std::string irregular = ": is not a regular file (this format is not read from a stream)";
  EXPECT_EQ(mapping_complaint(folder.path().string()), irregular);
  const std::string pipe = folder.file("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(mapping_complaint(pipe), irregular);
  EXPECT_EQ(mapping_complaint(folder.file("none")),
            ": cannot be opened (No such file or directory)");
  EXPECT_EQ(mapping_complaint(folder.write("a", "x")), "none");
}

TEST(MappedFile, LeavesNoFileOpen) {
  const ScratchFolder folder;
  const std::string path = folder.write("a", "x");
  const std::size_t before = open_files();
  const MappedFile file(path);
  EXPECT_EQ(open_files(), before);
  EXPECT_NE(mapping_complaint(folder.path().string()), "none");
  EXPECT_EQ(open_files(), before);
}

TEST(MemoryFile, IsReadUnderItsNameWithItsChanges) {
  std::string large(300'000, 'x');
  large += "end";
  MemoryFile file(large, "f");
  EXPECT_EQ(text_of(file.path()), large);
  file.put_zero(1, 4);
  file.put_blanks(300'000, 2);
  large.replace(1, 4, "0   ");
  large.replace(300'000, 2, "  ");
  EXPECT_EQ(text_of(file.path()), large);
  file.put_zero(0, 1);
  large[0] = '0';
  EXPECT_EQ(text_of(file.path()), large);
}

TEST(BinaryOutput, IsWrittenWhole) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.bin");
  std::string expected = "head";
  {
    BinaryOutput out(path);
    out.text("head");
    // more than is kept in memory, in pieces and at once
    for (std::int32_t i = 0; i < 400'000; ++i) out.number(i);
    out.text(std::string(3'000'000, 'y'));
    out.number(std::int16_t{0x0102});
    EXPECT_FALSE(std::filesystem::exists(path));
    out.finish();
  }
  for (std::int32_t i = 0; i < 400'000; ++i)
    for (const int shift : {0, 8, 16, 24}) expected += static_cast<char>(i >> shift);
  expected += std::string(3'000'000, 'y') + "\2\1";
  EXPECT_TRUE(text_of(path) == expected);
  EXPECT_THAT(folder.names(), ElementsAre("a.bin"));
}

/// No file of this process may become larger, as long as this lives.
class SizeLimit {
 public:
  explicit SizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  SizeLimit(const SizeLimit&) = delete;
  SizeLimit& operator=(const SizeLimit&) = delete;

 private:
  void (*handler_)(int);
  rlimit before_{};
};

// A short text goes to the file when that is closed, a long one before.
TEST(BinaryOutput, ThatCannotBeWrittenLeavesNothing) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.bin");
  for (const std::size_t bytes : {100UL, 20'000UL, 3'000'000UL}) {
    SCOPED_TRACE(bytes);
    std::string said;
    {
      const SizeLimit limit(64);
      BinaryOutput out(path);
      out.text(std::string(bytes, 'x'));
      try {
        out.finish();
      } catch (const InputError& error) {
        said = error.what();
      }
    }
    EXPECT_EQ(said, path + ": cannot be written (File too large)");
    EXPECT_THAT(folder.names(), IsEmpty());
  }
}

}  // namespace
}  // namespace hiac::formats
