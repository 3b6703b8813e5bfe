#include "hiac/tetrahedralize/meshing/child_process.hpp"

#include <csignal>
#include <cstdlib>
#include <stdexcept>

#include <gtest/gtest.h>
#include <unistd.h>

namespace hiac {
namespace {

TEST(ChildProcess, ReturnsWhatItsWorkReturns) {
  EXPECT_EQ(in_child_process([] { return std::string("an answer"); }), "an answer");
  EXPECT_EQ(in_child_process([] { return std::string(); }), "");
  const std::string long_one(3'000'000, 'x');  // more than a pipe holds
  EXPECT_EQ(in_child_process([&] { return long_one; }), long_one);
}

TEST(ChildProcess, TakesItsEndWithIt) {
  EXPECT_EQ(in_child_process([]() -> std::string { _exit(0); }), "");
  EXPECT_EQ(in_child_process([]() -> std::string { _exit(3); }), std::nullopt);
  EXPECT_EQ(in_child_process([]() -> std::string { throw std::runtime_error("no"); }),
            std::nullopt);
  EXPECT_EQ(in_child_process([]() -> std::string {
              std::signal(SIGSEGV, SIG_DFL);
              std::raise(SIGSEGV);
              return "";
            }),
            std::nullopt);
}

TEST(ChildProcess, ChangesNothingHere) {
  int value = 1;
  in_child_process([&] {
    value = 2;
    return std::string();
  });
  EXPECT_EQ(value, 1);
}

}  // namespace
}  // namespace hiac
