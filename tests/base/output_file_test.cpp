#include "hiac/base/output_file.hpp"

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include "hiac/base/error.hpp"
#include "tests/support/scratch_folder.hpp"

namespace hiac {
namespace {

namespace fs = std::filesystem;
using test::bytes_of;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

class OutputFiles : public testing::Test {
 protected:
  [[nodiscard]] std::string path(const std::string& name) const { return folder_.file(name); }
  [[nodiscard]] std::vector<std::string> names() const { return folder_.names(); }
  static void put(const std::string& path, const std::string& text) {
    OutputFile file(path);
    std::ofstream(file.temporary_path(), std::ios::binary) << text;
    file.commit();
  }

 private:
  test::ScratchFolder folder_;
};

TEST_F(OutputFiles, ReplacementKeepsTheMode) {
  put(path("a"), "first");
  fs::permissions(path("a"), fs::perms(0604));
  put(path("a"), "second");
  EXPECT_EQ(bytes_of(path("a")), "second");
  EXPECT_EQ(fs::status(path("a")).permissions(), fs::perms(0604));
}

TEST_F(OutputFiles, ADeviceStaysADevice) {
  fs::create_symlink("/dev/null", path("nowhere"));
  put(path("nowhere"), "text");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_TRUE(fs::is_symlink(path("nowhere")));
  EXPECT_THAT(names(), ElementsAre("nowhere"));
}

TEST_F(OutputFiles, AFullDeviceIsAnErrorAndStaysADevice) {
  EXPECT_THAT([] { put("/dev/full", "text"); },
              ThrowsMessage<InputError>("/dev/full: cannot be written (No space left on device)"));
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(OutputFiles, APipeGetsTheBytes) {
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  std::string got;
  std::thread reader([&] { got = bytes_of(path("pipe")); });
  put(path("pipe"), "text\0of bytes");
  reader.join();
  EXPECT_EQ(got, "text\0of bytes");
  EXPECT_TRUE(fs::is_fifo(path("pipe")));
}

TEST_F(OutputFiles, APipeGetsNothingOfWhatIsNotCommitted) {
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  {
    OutputFile file(path("pipe"));
    std::ofstream(file.temporary_path()) << "half";
  }
  const int reader = open(path("pipe").c_str(), O_RDONLY | O_NONBLOCK);
  char byte = 0;
  EXPECT_EQ(read(reader, &byte, 1), 0);
  close(reader);
}

TEST_F(OutputFiles, LinksStayLinks) {
  fs::create_directory(path("far"));
  fs::create_symlink("far/one", path("link"));
  fs::create_symlink("link", path("second"));
  put(path("second"), "new");  // what the links lead to is not there yet
  EXPECT_TRUE(fs::is_symlink(path("second")) && fs::is_symlink(path("link")));
  EXPECT_EQ(bytes_of(path("far/one")), "new");
  put(path("second"), "newer");
  EXPECT_EQ(bytes_of(path("far/one")), "newer");
}

TEST_F(OutputFiles, AnOpenFileOfTheProcessIsWrittenTo) {
  const int open_file = open(path("a").c_str(), O_CREAT | O_RDWR, 0600);
  ASSERT_EQ(write(open_file, "old ", 4), 4);
  put("/proc/self/fd/" + std::to_string(open_file), "new");
  close(open_file);
  EXPECT_EQ(bytes_of(path("a")), "old new");
}

TEST_F(OutputFiles, WhatCannotBeWrittenIsRefusedAtOnce) {
  EXPECT_THAT([&] { OutputFile file(path("none/a")); },
              ThrowsMessage<InputError>(HasSubstr("none/a: cannot be written (No such file")));
  EXPECT_THAT([&] { require_writable(path("")); },
              ThrowsMessage<InputError>(HasSubstr("cannot be written (Is a directory)")));
  EXPECT_NO_THROW(require_writable(path("a")));
  EXPECT_TRUE(names().empty());
}

class SeveralOutputFiles : public OutputFiles {
 protected:
  void SetUp() override {
    put(path("a"), "old a");
    put(path("c"), "old c");
    for (const char* name : {"a", "b", "c"}) {
      files_.push_back(std::make_unique<OutputFile>(path(name)));
      std::ofstream(files_.back()->temporary_path()) << "new " << name;
    }
  }
  std::vector<std::unique_ptr<OutputFile>> files_;
};

TEST_F(SeveralOutputFiles, AreReplacedTogether) {
  OutputFile::commit_all(files_);
  files_.clear();
  EXPECT_THAT(names(), ElementsAre("a", "b", "c"));
  for (const std::string name : {"a", "b", "c"}) EXPECT_EQ(bytes_of(path(name)), "new " + name);
}

TEST_F(SeveralOutputFiles, AreWhatTheyWereWhereOneIsAFolder) {
  fs::remove(path("c"));
  fs::create_directory(path("c"));
  EXPECT_THROW(OutputFile::commit_all(files_), InputError);
  files_.clear();
  EXPECT_THAT(names(), ElementsAre("a", "c"));
  EXPECT_EQ(bytes_of(path("a")), "old a");
}

TEST_F(SeveralOutputFiles, AreWhatTheyWereWhereOneCannotBeRenamed) {
  fs::remove(files_[2]->temporary_path());
  EXPECT_THROW(OutputFile::commit_all(files_), InputError);
  files_.clear();
  EXPECT_THAT(names(), ElementsAre("a", "c"));
  EXPECT_EQ(bytes_of(path("a")), "old a");
  EXPECT_EQ(bytes_of(path("c")), "old c");
}

}  // namespace
}  // namespace hiac
