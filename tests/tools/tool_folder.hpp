#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace hiac::test {

/// The tools in a folder of their own, which goes when the test ends.
class ToolFolder : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "hiac-tools-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] std::string file(const std::string& name) const {
    return (folder_ / name).string();
  }

  /// Runs a shell command in the folder, in which $CONVERT, $SORT and $RENDER are the tools; its
  /// streams go to out.txt and err.txt, and the status is that of the last command of a pipe.
  [[nodiscard]] int run(const std::string& command) const {
    const std::string line = "CONVERT='" HIAC_CONVERT "'; SORT='" HIAC_SORT
                             "'; RENDER='" HIAC_RENDER "'; cd '" +
                             folder_.string() + "'; { " + command + " ; } >out.txt 2>err.txt";
    const int status = std::system(line.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  [[nodiscard]] static std::string bytes_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream bytes;
    bytes << file.rdbuf();
    return bytes.str();
  }
  /// What the last command wrote to stderr.
  [[nodiscard]] std::string complaint() const { return bytes_of(file("err.txt")); }

  std::filesystem::path folder_;
};

}  // namespace hiac::test
