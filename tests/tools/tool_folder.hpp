#pragma once

#include <cstdlib>
#include <filesystem>
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

  /// A shell script takes the place of a program in the commands of with_stand_ins.
  void stand_in(const std::string& program, const std::string& script) const {
    std::filesystem::create_directories(file("bin"));
    std::filesystem::permissions(folder_.write("bin/" + program, "#!/bin/sh\n" + script),
                                 std::filesystem::perms::owner_all);
  }
  [[nodiscard]] static std::string with_stand_ins(const std::string& command) {
    return "PATH=$PWD/bin:$PATH; export PATH; " + command;
  }

  ScratchFolder folder_;
};

}  // namespace hiac::test
