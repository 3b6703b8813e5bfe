// Words and texts that all tools share: what was meant by a word, options in one word, texts for
// terminals, kinds of files.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/common/file_kind.hpp"
#include "tools/common/foreign_mesh.hpp"
#include "tools/common/plain_text.hpp"
#include "tools/common/suggestion.hpp"

namespace hiac::tools {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(Suggestion, TheShortestWordThatBeginsSoIsMeant) {
  EXPECT_EQ(likely_meant("--ver", {"--version", "--verbose", "--verify"}), "--verify");
  EXPECT_EQ(likely_meant("--ver", {"--verify", "--verb", "--version"}), "--verb");
  EXPECT_EQ(likely_meant("", {}), "");
}

// Of 3 to 5 letters one may be wrong, of 6 to 8 two, of 9 three.
TEST(Suggestion, AThirdOfTheLettersMayBeWrong) {
  const auto meant = [](const std::string& word, const std::string& known) {
    return !likely_meant(word, {known}).empty();
  };
  EXPECT_FALSE(meant("ab", "ac"));
  EXPECT_TRUE(meant("abc", "abd"));
  EXPECT_FALSE(meant("abcde", "abxxe"));
  EXPECT_TRUE(meant("abcdef", "abxxef"));
  EXPECT_FALSE(meant("abcdefgh", "xbcxefgx"));
  EXPECT_TRUE(meant("abcdefghi", "xbcxefgxi"));
}

TEST(Suggestion, LettersAreChangedPutInLeftOutOrExchanged) {
  // each is one step from "mesh", and two from the other
  for (const char* word : {"mezh", "messh", "meh", "emsh", "mehs", "xmesh", "meshx", "esh"})
    EXPECT_EQ(likely_meant(word, {"light", "mesh"}), "mesh") << word;
  EXPECT_EQ(likely_meant("ehsm", {"mesh"}), "");
  EXPECT_EQ(likely_meant("hmes", {"mesh"}), "");  // two steps
  // the least one, and the first of those that are as near
  EXPECT_EQ(likely_meant("colour", {"color", "colours_", "volume"}), "colours_");
  EXPECT_EQ(likely_meant("xcolour", {"colors", "color", "colour"}), "colour");
  EXPECT_EQ(likely_meant("light", {"right", "fight"}), "right");
  EXPECT_EQ(likely_meant("ac bd", {"ca bd"}), "ca bd");
}

TEST(PlainText, ControlCharactersBecomeBlanks) {
  EXPECT_EQ(plain_text("a\x1b[31mb\x7f\x01\rc\td\n"), "a [31mb   c\td\n");
  EXPECT_EQ(plain_text(" ~\xc3\xa4\xe2\x82\xac"), " ~\xc3\xa4\xe2\x82\xac");
  EXPECT_EQ(plain_text("\xc2\x80|\xc2\x9b|\xc2\x9f|\xc2\xa0"), "  |  |  |\xc2\xa0");
  EXPECT_EQ(plain_text("\xc2"), "\xc2");
  EXPECT_EQ(plain_text("\x9b"), "\x9b");
  EXPECT_EQ(plain_line("a\nb\tc\x1f d\x7f"), "a b c  d ");
  EXPECT_EQ(plain_line(""), "");
}

TEST(Words, OptionsInOneWordAreThoseOfAShell) {
  EXPECT_THAT(words_of("--step 3  --block top "), ElementsAre("--step", "3", "--block", "top"));
  EXPECT_THAT(words_of(" a 'b c' \"d 'e\" f'g h'i"), ElementsAre("a", "b c", "d 'e", "fg hi"));
  EXPECT_THAT(words_of("'' x"), ElementsAre("", "x"));
  EXPECT_THAT(words_of(""), IsEmpty());
  EXPECT_THAT(words_of("   "), IsEmpty());
  EXPECT_THROW(words_of("a 'b"), UsageError);
  EXPECT_THROW(words_of("\"b'"), UsageError);
}

TEST(FileKinds, AreToldByTheFirstBytes) {
  const test::ScratchFolder folder;
  using std::string;
  const string zoo(kZooMagic);
  const std::pair<string, std::optional<FileKind>> cases[] = {
      {"", std::nullopt},
      {"something", std::nullopt},
      {zoo, FileKind::mesh},
      {zoo + string(56, '\0') + "ORDER", FileKind::order},
      {zoo + string(55, '\0') + "ORDER", FileKind::mesh},
      {zoo + string(57, '\0') + "ORDER", FileKind::mesh},
      {"\x89PNG\r\n\x1a\n", FileKind::image},
      {"II*" + string(1, '\0'), FileKind::image},
      {"PF\n", FileKind::image},
      {"PF 1", std::nullopt},
      {string(4, '\0') + "ftyp", FileKind::image},
      {string(5, '\0') + "ftyp", std::nullopt},
      {"abc", std::nullopt},
      {"solid x", FileKind::mesh},
      {"x <VTKFile", FileKind::mesh},
      {"[camera]\n", FileKind::specification},
      {"x [camera]\n", std::nullopt},
      {"# text\n[volume.color]", FileKind::specification},
      {string(4096 - 9, ' ') + "\n[camera]", FileKind::specification},
      {string(4096 - 8, ' ') + "\n[camera]", std::nullopt},
      {"{\n \"tool\": \"hiac-info\"", FileKind::facts},
  };
  int number = 0;
  for (const auto& [bytes, kind] : cases) {
    const string path = folder.write("file" + std::to_string(number++), bytes);
    EXPECT_EQ(kind_of_file(path), kind) << number << " " << bytes.substr(0, 20);
  }
  EXPECT_EQ(kind_of_file(folder.file("none.toml")), std::nullopt);
  EXPECT_EQ(kind_of_file(folder.path().string()), std::nullopt);
}

TEST(FileKinds, AreToldByTheNameWhereBytesProveNothing) {
  const test::ScratchFolder folder;
  const auto kind = [&](const std::string& name, const std::string& bytes = "x") {
    return kind_of_file(folder.write(name, bytes));
  };
  EXPECT_EQ(kind("a.toml"), FileKind::specification);
  EXPECT_EQ(kind("a.F32"), FileKind::image);
  EXPECT_EQ(kind("a.Stl"), FileKind::mesh);
  EXPECT_EQ(kind("a.med"), FileKind::mesh);
  EXPECT_EQ(kind("a.txt"), std::nullopt);
  EXPECT_EQ(kind("b.toml", ""), std::nullopt);  // there is nothing to lose
  EXPECT_EQ(kind("b.stl", "\x89PNG\r\n\x1a\n"), FileKind::image);
  EXPECT_EQ(kind_phrase(FileKind::order), "a visibility order");
}

}  // namespace
}  // namespace hiac::tools
