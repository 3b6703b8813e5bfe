#include "hiac/mesh/zoo_container.hpp"

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <thread>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include "hiac/base/error.hpp"
#include "tests/mesh/sample_meshes.hpp"
#include "tests/support/scratch_folder.hpp"

namespace hiac {
namespace {

using test::bytes_of;
using testing::ElementsAreArray;
using testing::HasSubstr;
namespace fs = std::filesystem;

ZooFile sample_file() {
  ZooFile file{samples::one_of_each_kind(), {}};
  file.extras.push_back({"ORDER", std::vector<std::uint8_t>{1, 2, 3}});
  file.extras.push_back({"ORDER", std::vector<std::uint8_t>{}});
  file.mesh.adjacency = FaceAdjacency{std::vector<CellId>(78, kNoCell), 7};
  return file;
}

void expect_equal(const ZooFile& a, const ZooFile& b) {
  EXPECT_THAT(a.mesh.kinds.view(), ElementsAreArray(b.mesh.kinds.view()));
  EXPECT_THAT(a.mesh.elems.view(), ElementsAreArray(b.mesh.elems.view()));
  EXPECT_EQ(content_hash(a.mesh), content_hash(b.mesh));
  EXPECT_EQ(a.mesh.metadata, b.mesh.metadata);
  ASSERT_EQ(a.mesh.adjacency.has_value(), b.mesh.adjacency.has_value());
  if (a.mesh.adjacency) {
    EXPECT_EQ(a.mesh.adjacency->overshared, b.mesh.adjacency->overshared);
    EXPECT_THAT(a.mesh.adjacency->neighbors.view(),
                ElementsAreArray(b.mesh.adjacency->neighbors.view()));
  }
  ASSERT_EQ(a.extras.size(), b.extras.size());
  for (std::size_t i = 0; i < a.extras.size(); ++i) {
    EXPECT_EQ(a.extras[i].type, b.extras[i].type);
    EXPECT_THAT(a.extras[i].payload.view(), ElementsAreArray(b.extras[i].payload.view()));
  }
}

class ZooContainer : public testing::Test {
 protected:
  [[nodiscard]] std::string path(const std::string& name) const { return folder_.file(name); }

 private:
  test::ScratchFolder folder_;
};

void write_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

template <typename Read>
std::string complaint(const Read& read) {
  try {
    read();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST_F(ZooContainer, FileComesBackAsItWas) {
  for (const ZooFile& file : {sample_file(), ZooFile{samples::make_mesh({}, 0), {}},
                              ZooFile{samples::brick_grid(5), {}}}) {
    write_zoo_file(path("a.zoo"), file);
    expect_equal(read_zoo_file(path("a.zoo")), file);
  }
}

TEST_F(ZooContainer, PipeComesBackAsItWas) {
  const ZooFile file{samples::tetrahedron_grid(20), {}};
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  std::thread writer([&] {
    write_zoo_stream(ends[1], file, "pipe");
    ::close(ends[1]);
  });
  const ZooFile read = read_zoo_stream(ends[0], "pipe");
  writer.join();
  ::close(ends[0]);
  expect_equal(read, file);
}

TEST_F(ZooContainer, ArraysAreAligned) {
  write_zoo_file(path("a.zoo"), sample_file());
  const ZooFile file = read_zoo_file(path("a.zoo"));
  const auto address = [](const auto& array) {
    return reinterpret_cast<std::uintptr_t>(array.data());
  };
  EXPECT_EQ(address(file.mesh.nodes) % 64, 0u);
  EXPECT_EQ(address(file.mesh.xyz) % 64, 0u);
  for (const Field& field : file.mesh.fields) EXPECT_EQ(address(field.values) % 64, 0u);
}

TEST_F(ZooContainer, ArraysOutliveTheFileAndItsRemoval) {
  write_zoo_file(path("a.zoo"), sample_file());
  SharedArray<double> xyz = read_zoo_file(path("a.zoo")).mesh.xyz;
  fs::remove(path("a.zoo"));
  EXPECT_THAT(xyz.view(), ElementsAreArray(sample_file().mesh.xyz.view()));
}

TEST_F(ZooContainer, WritingLeavesNothingBesideTheFile) {
  write_zoo_file(path("a.zoo"), sample_file());
  write_zoo_file(path("a.zoo"), sample_file());
  EXPECT_EQ(std::distance(fs::directory_iterator(path("")), fs::directory_iterator()), 1);
}

TEST_F(ZooContainer, FailedWritingLeavesTheOldFileWhole) {
  write_zoo_file(path("a.zoo"), sample_file());
  const std::string before = bytes_of(path("a.zoo"));
  ZooFile broken = sample_file();
  broken.mesh.xyz = std::vector<double>{1};
  EXPECT_THROW(write_zoo_file(path("a.zoo"), broken), InputError);
  EXPECT_EQ(bytes_of(path("a.zoo")), before);
  EXPECT_EQ(std::distance(fs::directory_iterator(path("")), fs::directory_iterator()), 1);
}

TEST_F(ZooContainer, SaysThatAFileIsMissingOrNoZoo) {
  EXPECT_THAT(complaint([&] { read_zoo_file(path("none.zoo")); }), HasSubstr("No such file"));
  write_bytes(path("text"), std::string(100, 'x'));
  EXPECT_THAT(
      complaint([&] { read_zoo_file(path("text")); }),
      HasSubstr("not a zoo container (the magic bytes 89 5a 4f 4f 0d 0a 1a 0a expected, 78"));
  write_bytes(path("empty"), "");
  EXPECT_THAT(complaint([&] { read_zoo_file(path("empty")); }), HasSubstr("stream ended before"));
  EXPECT_THAT(complaint([&] { read_zoo_file(path("")); }), HasSubstr("directory"));
}

TEST_F(ZooContainer, RefusesEveryTruncation) {
  write_zoo_file(path("a.zoo"), ZooFile{samples::brick_grid(1), {}});
  const std::string whole = bytes_of(path("a.zoo"));
  for (std::size_t size = 0; size < whole.size(); ++size) {
    write_bytes(path("cut"), whole.substr(0, size));
    EXPECT_THAT(complaint([&] { read_zoo_file(path("cut")); }), HasSubstr("stream ended before"));
    const int descriptor = ::open(path("cut").c_str(), O_RDONLY);
    EXPECT_THAT(complaint([&] { read_zoo_stream(descriptor, "pipe"); }),
                HasSubstr("stream ended before"));
    ::close(descriptor);
  }
  write_bytes(path("long"), whole + "x");
  EXPECT_THAT(complaint([&] { read_zoo_file(path("long")); }), HasSubstr("goes on after"));
}

TEST_F(ZooContainer, NoticesEveryByteThatIsFlipped) {
  write_zoo_file(path("a.zoo"), ZooFile{samples::brick_grid(1), {}});
  const std::string whole = bytes_of(path("a.zoo"));
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string flipped = whole;
    flipped[at] = static_cast<char>(flipped[at] ^ (1 << (at % 8)));
    write_bytes(path("flipped"), flipped);
    EXPECT_NE(complaint([&] { read_zoo_file(path("flipped")); }), "") << at;
  }
}

/// What `command` prints, or nothing when it fails.
std::optional<std::string> output_of(const std::string& command) {
  std::FILE* pipe = ::popen(command.c_str(), "r");
  std::string output;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) output += static_cast<char>(c);
  return ::pclose(pipe) == 0 ? std::optional(output) : std::nullopt;
}

// The layout's text is enough for a reader in another language.
TEST_F(ZooContainer, PythonSampleReadsIt) {
  std::string python;
  for (const std::string candidate : {"python3", "/usr/bin/python3"})
    if (python.empty() && output_of(candidate + " -c 'import numpy' 2>&1")) python = candidate;
  if (python.empty()) GTEST_SKIP() << "no python3 with numpy";
  write_zoo_file(path("a.zoo"), sample_file());
  EXPECT_EQ(output_of(python + " " HIAC_SOURCE_FOLDER "/samples/read_zoo.py " + path("a.zoo")),
            "15 cells, 232 nodes\n"
            "tetrahedron4 1\ntetrahedron10 1\ntetrahedron20 1\n"
            "pyramid5 1\npyramid13 1\npyramid21 1\n"
            "prism6 1\nprism15 1\nprism24 1\n"
            "wedge7 1\nwedge18 1\nwedge29 1\n"
            "brick8 1\nbrick20 1\nbrick32 1\n"
            "field temperature [K] on nodes, 1 components, -3.5 to 227.5\n"
            "field velocity [m/s] on nodes, 3 components, -3.5 to 691.5\n"
            "field stress [] on cells, 6 components, -3.5 to 85.5\n"
            "field damage [] on corners, 1 components, -3.5 to 227.5\n");
}

TEST_F(ZooContainer, WritesToADeviceWithoutReplacingIt) {
  write_zoo_file("/dev/null", sample_file());
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(ZooContainer, WritesThroughASymbolicLink) {
  fs::create_symlink("target.zoo", path("link.zoo"));
  write_bytes(path("target.zoo"), "old");
  write_zoo_file(path("link.zoo"), sample_file());
  EXPECT_TRUE(fs::is_symlink(path("link.zoo")));
  expect_equal(read_zoo_file(path("target.zoo")), sample_file());
}

TEST_F(ZooContainer, ReadsANamedPipe) {
  ASSERT_EQ(::mkfifo(path("pipe.zoo").c_str(), 0600), 0);
  std::thread writer([&] { write_zoo_file(path("pipe.zoo"), sample_file()); });
  const ZooFile read = read_zoo_file(path("pipe.zoo"));
  writer.join();
  expect_equal(read, sample_file());
}

TEST_F(ZooContainer, StreamIsReadToItsEndChunkAndNoFurther) {
  write_zoo_file(path("a.zoo"), sample_file());
  write_bytes(path("two.zoo"), bytes_of(path("a.zoo")) + bytes_of(path("a.zoo")));
  const int descriptor = ::open(path("two.zoo").c_str(), O_RDONLY);
  for (int i = 0; i < 2; ++i) expect_equal(read_zoo_stream(descriptor, "two"), sample_file());
  ::close(descriptor);
}

TEST_F(ZooContainer, ReportsAFolderThatCannotBeWritten) {
  EXPECT_THAT(complaint([&] { write_zoo_file(path("none/a.zoo"), sample_file()); }),
              HasSubstr("a.zoo: cannot be written (No such file"));
  EXPECT_THAT(complaint([&] { write_zoo_file("/dev/full", sample_file()); }),
              HasSubstr("/dev/full: cannot be written (No space left"));
}

TEST_F(ZooContainer, ReportsAPipeThatNobodyReads) {
  ::signal(SIGPIPE, SIG_IGN);
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  ::close(ends[0]);
  EXPECT_THAT(complaint([&] { write_zoo_stream(ends[1], sample_file(), "out"); }),
              HasSubstr("out: cannot be written (Broken pipe)"));
  ::close(ends[1]);
}

}  // namespace
}  // namespace hiac
