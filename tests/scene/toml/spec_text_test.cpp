#include "hiac/scene/toml/spec_text.hpp"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/toml/edited_text.hpp"
#include "tests/support/scratch_folder.hpp"

namespace hiac {
namespace {

using testing::HasSubstr;

template <typename Work>
std::string told_of_work(const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string told_of_file(const std::string& path) {
  return told_of_work([&] { static_cast<void>(read_text_file(path)); });
}

TEST(SpecText, FilesAreReadWhole) {
  const test::ScratchFolder folder;
  std::string text;
  for (int i = 0; i < 10000; ++i) text += std::to_string(i) + "\n\r";
  text += '\0';
  text += "end";
  EXPECT_EQ(read_text_file(folder.write("a.toml", text)), text);
  EXPECT_EQ(read_text_file(folder.write("empty.toml", "")), "");
}

TEST(SpecText, FilesThatCannotBeReadAreNamed) {
  const test::ScratchFolder folder;
  EXPECT_EQ(told_of_file(folder.file("none.toml")),
            folder.file("none.toml") + ": cannot be opened: No such file or directory");
  EXPECT_EQ(told_of_file(folder.path()),
            folder.path().string() + ": cannot be read: Is a directory");
}

TEST(SpecText, FilesHave64MebibytesAtMost) {
  const test::ScratchFolder folder;
  const std::string path = folder.write("a.toml", "");
  std::filesystem::resize_file(path, kMaxTextBytes);
  EXPECT_EQ(read_text_file(path).size(), std::size_t{64} << 20);
  std::filesystem::resize_file(path, kMaxTextBytes + 1);
  EXPECT_EQ(told_of_file(path), path +
                                    ": too large for a text file of this kind (expected at most "
                                    "67108864 bytes)");
}

TEST(SpecText, ControlCharactersBecomeBlanks) {
  EXPECT_EQ(in_one_line("a\nb\tc\x1f"
                        "d\x7f"
                        "e f~\xc3\xa4"),
            "a b c d e f~\xc3\xa4");
}

std::string dotted(int parts, const std::string& by = ".") {
  std::string key = "a";
  for (int i = 1; i < parts; ++i) key += by + "a";
  return key;
}

std::string told_of_toml(const std::string& text) {
  return told_of_work([&] { parse_toml(text, "a.toml"); });
}

TEST(SpecText, DotsCountWithinOneKey) {
  EXPECT_EQ(told_of_toml(dotted(32) + " = 1\nb = 2\n"), "");
  EXPECT_EQ(told_of_toml("# one\n" + dotted(33) + " = 1\n"),
            "a.toml:2: a key of more than 32 parts");
  EXPECT_EQ(told_of_toml("[" + dotted(33) + "]\n"), "a.toml:1: a key of more than 32 parts");
  // each of these has some dots of its own, and more than 32 together
  std::string lines, list = "c = [", table = "d = {";
  for (int i = 0; i < 40; ++i) {
    lines += "k" + std::to_string(i) + ".x = 1.5\n";
    list += "1.5, ";
    table += (i == 0 ? "k" : ", k") + std::to_string(i) + ".x = 1.5";
  }
  EXPECT_EQ(told_of_toml("[t]\n" + lines), "");
  EXPECT_EQ(told_of_toml(list + "]\n"), "");
  EXPECT_EQ(told_of_toml(table + "}\n"), "");
  EXPECT_EQ(told_of_toml("e = [" + list.substr(5) + "[1.5], [1.5]]\n"), "");
}

TEST(SpecText, DotsInStringsAndCommentsDoNotCount) {
  const std::string dots(40, '.');
  EXPECT_EQ(told_of_toml("a = '" + dots + "'\nb = \"\\\"" + dots + "\" # " + dots), "");
  EXPECT_EQ(told_of_toml("a = \"\"\"\n\n" + dots + "\"\"\"\n" + dotted(40) + " = 1\n"),
            "a.toml:4: a key of more than 32 parts");
}

TEST(SpecText, WhatTheParserRefusesHasItsLine) {
  EXPECT_THAT(told_of_toml("a = 1\nb = \n"), testing::StartsWith("a.toml:2: "));
  EXPECT_THAT(told_of_toml("a = 1\n\na = 2\n"), testing::StartsWith("a.toml:3: "));
}

TEST(EditedTextComplaints, NameTheKey) {
  const auto told = [](const std::string& text, const std::string& key, const std::string& value) {
    return told_of_work([&] { static_cast<void>(with_key(text, key, value)); });
  };
  EXPECT_EQ(told("", "a..x", "2"), "key `a..x`: malformed key (expected one such as camera.fov)");
  EXPECT_EQ(told("", "", "2"), "key ``: malformed key (expected one such as camera.fov)");
  EXPECT_EQ(told("", "a\nb", "2"), "key `a b`: malformed key (expected one such as camera.fov)");
  EXPECT_EQ(told("[a]\n", "a", "2"), "key `a`: is a table (its keys can be set)");
  EXPECT_EQ(told("a.b = 1\n", "a", "2"), "key `a`: is a table (its keys can be set)");
  EXPECT_EQ(told("[a.b]\n", "a", "2"), "key `a`: is a table (its keys can be set)");
  EXPECT_EQ(told("a = 1\n", "a.x", "2"), "key `a.x`: `x` lies below a plain value");
  EXPECT_EQ(told("a = [1, 2]\n", "a.3", "2"),
            "key `a.3`: no element `3` (the list has 2, counted from 0)");
  EXPECT_EQ(told("a = [1, 2]\n", "a.x", "2"),
            "key `a.x`: no element `x` (the list has 2, counted from 0)");
  EXPECT_EQ(told("", "a", "1, 2"), "key `a`: no value in TOML (found 1, 2)");
  EXPECT_EQ(told("", "a", "1\n# b"), "key `a`: no value in TOML (found 1 # b)");
  EXPECT_EQ(told("", "a", "[1,\n2]"), "");
  EXPECT_THAT(told_of_work([] { static_cast<void>(without_key("[a]\n", "a")); }),
              "key `a`: is a table with a header");
}

TEST(EditedTextComplaints, TablesThatExistAreNotAdded) {
  const std::pair<std::string, std::string> keys[] = {{"x", "1"}, {"y", "2"}};
  const auto told = [&](const std::string& text, const std::string& table) {
    return told_of_work([&] { static_cast<void>(with_table(text, table, keys)); });
  };
  EXPECT_EQ(told("[a]\n", "a"), "key `a`: exists");
  EXPECT_EQ(told("a = 1\n", "a"), "key `a`: exists");
  EXPECT_EQ(told("a.b = 1\n", "a"), "key `a`: exists");
  EXPECT_EQ(told("[[s]]\n", "s.0"), "key `s.0`: exists");
  EXPECT_EQ(told("[s]\n a = 1\n", "a\tb"),
            "key `a b`: malformed key (expected one such as camera.fov)");
  EXPECT_EQ(with_table("[[s]]\nx = 0\n", "s.1", keys), "[[s]]\nx = 0\n\n[[s]]\nx = 1\ny = 2\n");
  EXPECT_EQ(with_table("[ab]\nx = 0\n", "a", keys), "[ab]\nx = 0\n\n[a]\nx = 1\ny = 2\n");
}

TEST(EditedTextComplaints, ElementsLieInBrackets) {
  const auto told = [](const std::string& text, const std::string& element) {
    return told_of_work([&] { static_cast<void>(with_element(text, element, "1")); });
  };
  EXPECT_EQ(told("p = {a = 1}\n", "p.a"), "key `p.a`: no element of a list in brackets");
  EXPECT_EQ(told("p = 1\n", "p"), "key `p`: no element of a list in brackets");
  EXPECT_EQ(told("p = 1\n", "q"), "key `q`: no element of a list in brackets");
  EXPECT_EQ(told("p = [1]\n", "p.2"), "key `p.2`: no element `2` (the list has 1, counted from 0)");
  EXPECT_EQ(with_element("p = []\n", "p.0", "1"), "p = [1]\n");
  EXPECT_EQ(with_element("p = [[1], [2]]\n", "p.1.0", "5"), "p = [[1], [5, 2]]\n");
}

}  // namespace
}  // namespace hiac
