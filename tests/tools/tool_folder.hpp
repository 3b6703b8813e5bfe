#pragma once

#include <cstdlib>
#include <string>

#include <gtest/gtest.h>
#include <sys/wait.h>

#include "tests/support/scratch_folder.hpp"

namespace hiac::test {

/// The tools in a folder of their own, which goes when the test ends.
class ToolFolder : public testing::Test {
 protected:
  [[nodiscard]] std::string file(const std::string& name) const { return folder_.file(name); }

  /// Runs a shell command in the folder, in which $CONVERT, $SORT and $RENDER are the tools; its
  /// streams go to out.txt and err.txt, and the status is that of the last command of a pipe.
  [[nodiscard]] int run(const std::string& command) const {
    const std::string line =
        "CONVERT='" HIAC_CONVERT "'; SORT='" HIAC_SORT "'; RENDER='" HIAC_RENDER "'; cd '" +
        folder_.path().string() + "'; { " + command + " ; } >out.txt 2>err.txt";
    const int status = std::system(line.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  [[nodiscard]] static std::string bytes_of(const std::string& path) {
    return test::bytes_of(path);
  }
  /// What the last command wrote to stderr.
  [[nodiscard]] std::string complaint() const { return bytes_of(file("err.txt")); }

  ScratchFolder folder_;
};

}  // namespace hiac::test
