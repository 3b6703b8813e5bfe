#include "formats/common/io/text_cursor.hpp"

#include <cmath>
#include <limits>

#include "formats/common/io/comma_fields.hpp"
#include "formats/common/io/input_text.hpp"
#include "formats/common/io/number_index.hpp"
#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

using testing::HasSubstr;

TEST(TextCursor, NumbersOfFortranAndC) {
  for (const auto& [text, value] :
       std::vector<std::pair<std::string, double>>{{"1.5", 1.5},
                                                   {"+1.5", 1.5},
                                                   {"-1.5E+02", -150},
                                                   {"1.0D+5", 1e5},
                                                   {"1.0d-5", 1e-5},
                                                   {"1.0+5", 1e5},
                                                   {".5-3", 5e-4},
                                                   {"1.+2", 100},
                                                   {"-2.5-10", -2.5e-10},
                                                   {"7", 7},
                                                   {"1e-400", 0},
                                                   {"-1e999", -HUGE_VAL}}) {
    EXPECT_EQ(to_real(text), value) << text;
    TextCursor cursor(text, "f");
    EXPECT_EQ(cursor.real("x"), value) << text;
  }
  for (const std::string text : {"", "abc", "1.5x", "+-1", "1.0E", "--1", "1 2", "++1"})
    EXPECT_FALSE(to_real(text)) << text;
  EXPECT_EQ(to_integer(" +12 "), 12);
  EXPECT_FALSE(to_integer("+-12"));
  EXPECT_FALSE(to_integer("++12"));
  EXPECT_FALSE(to_integer("+"));
  EXPECT_FALSE(to_integer("12.5"));
  EXPECT_FALSE(to_integer("99999999999999999999"));
}

TEST(TextCursor, ErrorsNameFileAndLine) {
  const std::string text = "1 2\n\n three 4";
  const auto complaint = [&](const auto& read) {
    TextCursor cursor(text, "m.msh");
    cursor.integer("a");
    cursor.integer("b");
    try {
      read(cursor);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(complaint([](TextCursor& c) { c.integer("a node number"); }),
            "m.msh:3: not understood (a node number expected, 'three' found)");
  EXPECT_EQ(complaint([](TextCursor& c) { c.real("a coordinate"); }),
            "m.msh:3: not understood (a coordinate expected, 'three' found)");
  EXPECT_EQ(complaint([](TextCursor& c) {
              c.word();
              c.count("a count", 3);
            }),
            "m.msh:3: a count: impossible (0 to 3 expected, 4 found)");
  EXPECT_THAT(complaint([](TextCursor& c) {
                c.word();
                c.word();
                c.real("a value");
              }),
              HasSubstr("m.msh:3: the file ends too early (a value expected)"));
}

TEST(CommaFields, FieldsAndTheirEnds) {
  CommaFields fields(" 1 , 2.5,, abc ,\r");
  EXPECT_EQ(fields.integer(), 1);
  EXPECT_EQ(fields.real(), 2.5);
  EXPECT_EQ(fields.real(), 0);
  EXPECT_FALSE(CommaFields(" x, 1").integer());
  EXPECT_FALSE(CommaFields("1 2, 1").integer());
  EXPECT_EQ(fields.field(), "abc");
  EXPECT_TRUE(fields.at_end());
}

TEST(NumberIndex, FindsConsecutiveDenseAndSparseNumbers) {
  const std::vector<std::vector<std::int64_t>> lists{
      {5, 6, 7, 8},
      {9, 3, 4, 7},
      {std::int64_t{1} << 60, 3, -7, std::numeric_limits<std::int64_t>::min()},
      {1, 1, 2}};
  for (const auto& numbers : lists) {
    const NumberIndex index(numbers);
    for (std::size_t i = 0; i < numbers.size(); ++i)
      EXPECT_EQ(numbers[index.find(numbers[i])], numbers[i]);
    for (const std::int64_t other : {std::int64_t{0}, std::int64_t{100}, std::int64_t{-8}})
      EXPECT_EQ(index.find(other), NumberIndex::kNone) << other;
    EXPECT_EQ(index.repeated().size(), numbers.size() == 3 ? 1U : 0U);
  }
  EXPECT_EQ(NumberIndex().find(0), NumberIndex::kNone);
}

// python3: gzip.compress(b"hello\n" * 3, mtime=0), twice one after the other
TEST(InputText, GzipIsUnpacked) {
  const std::string packed(
      "\x1f\x8b\x08\x00\x00\x00\x00\x00\x02\x03\xcb\x48\xcd\xc9\xc9\xe7\xca\x40\x22\x01\x3a\x37"
      "\x66\x3d\x12\x00\x00\x00",
      28);
  const ScratchFolder folder;
  const std::string path = folder.write("a.gz", packed + packed);
  EXPECT_EQ(InputText(path).text(), "hello\nhello\nhello\nhello\nhello\nhello\n");
  EXPECT_EQ(unpacked_head(packed.substr(0, 24), 7), "hello\nh");
  for (std::size_t cut = 3; cut < packed.size(); ++cut)
    EXPECT_THROW(InputText(folder.write("b.gz", packed.substr(0, cut))), InputError) << cut;
}

}  // namespace
}  // namespace hiac::formats
