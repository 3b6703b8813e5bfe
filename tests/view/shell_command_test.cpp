#include "tools/view/window/shell_command.hpp"

#include <gtest/gtest.h>

namespace hiac::view {
namespace {

TEST(ShellCommand, QuotesWhatAShellWouldTakeApart) {
  EXPECT_EQ(shell_word("part-1.zoo"), "part-1.zoo");
  EXPECT_EQ(shell_word(""), "''");
  EXPECT_EQ(shell_word("a b"), "'a b'");
  EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
  EXPECT_EQ(shell_word("$HOME"), "'$HOME'");
}

TEST(ShellCommand, NamesEverythingThatDecidesThePicture) {
  tools::PictureCommand command;
  command.input = "/data/run 1.exo";
  command.conversion = "--step 3";
  command.block = "top";
  command.threshold = "stress=100,";
  EXPECT_EQ(shell_command(command, "/data/view.toml", 7, 2, true),
            "hiac-render '/data/run 1.exo' --view /data/view.toml --convert '--step 3' --block top "
            "--threshold stress=100, --frame 7 --samples 2 --skip-invalid -o picture.png");
  tools::PictureCommand plain;
  plain.input = "/a.zoo";
  EXPECT_EQ(shell_command(plain, "/v.toml", {}, 1, false),
            "hiac-render /a.zoo --view /v.toml -o picture.png");
}

}  // namespace
}  // namespace hiac::view
