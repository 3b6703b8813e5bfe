#include "formats/common/io/text_cursor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "formats/common/io/comma_fields.hpp"
#include "formats/common/io/deck_numbers.hpp"
#include "formats/common/io/input_text.hpp"
#include "formats/common/io/number_index.hpp"
#include "formats/common/io/product.hpp"
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

TEST(TextCursor, WholeNumbersOfEighteenDigits) {
  const std::string most(18, '9');
  for (const std::string& text : {most, "-" + most, "+" + most, std::string("0"), "-" + most + " x",
                                  "00" + most.substr(2) + "\n"}) {
    TextCursor cursor(text, "f");
    EXPECT_EQ(cursor.integer("x"), std::stoll(text)) << text;
  }
  for (const std::string text :
       {"1000000000000000000", "-9223372036854775808", "1-", "-", "+ 1", "1x"})
    EXPECT_THROW(TextCursor(text, "f").integer("x"), InputError) << text;
  // fields between commas have all that there are
  EXPECT_EQ(CommaFields("9223372036854775807").integer(), std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(CommaFields("-9223372036854775808").integer(),
            std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(CommaFields("9223372036854775808").integer(), std::nullopt);
  EXPECT_EQ(CommaFields(most).integer(), 999'999'999'999'999'999);
  EXPECT_EQ(to_integer("-9223372036854775808"), std::numeric_limits<std::int64_t>::min());
}

TEST(TextCursor, RealsOfAHundredDigits) {
  // as C writes numbers there is no end, with an exponent of Fortran there is
  EXPECT_EQ(to_real("1." + std::string(500, '0') + "E+2"), 100);
  const auto fortran = [](std::size_t zeros, const std::string& exponent) {
    return to_real("1." + std::string(zeros, '0') + exponent);
  };
  EXPECT_EQ(fortran(127 - 5, "D+2"), 100);
  EXPECT_EQ(fortran(128 - 5, "D+2"), std::nullopt);
  EXPECT_EQ(fortran(126 - 4, "+2"), 100);
  EXPECT_EQ(fortran(127 - 4, "+2"), std::nullopt);
  EXPECT_EQ(to_real("1q3"), 1000);
  EXPECT_EQ(to_real("1Q3"), 1000);
}

TEST(TextCursor, WordsAndLines) {
  const std::string text = " \t\v\f\r\nfirst\x0b two\r\n\x08x\x0e\n\nlast\r";
  TextCursor cursor(text, "f");
  EXPECT_EQ(cursor.word(), "first");
  EXPECT_EQ(cursor.peek_line(), "\v two");
  EXPECT_EQ(cursor.line(), "\v two");
  EXPECT_EQ(cursor.word(), "\x08x\x0e");
  EXPECT_EQ(cursor.line(), "");
  EXPECT_EQ(cursor.line(), "");
  EXPECT_EQ(cursor.left(), 5U);
  EXPECT_EQ(cursor.line(), "last");
  EXPECT_TRUE(cursor.at_end());
  EXPECT_EQ(cursor.line(), "");
  EXPECT_EQ(cursor.word(), "");
  cursor.move_to(6);
  EXPECT_EQ(cursor.offset(), 6U);
  EXPECT_EQ(cursor.bytes(5, "a name"), "first");
  EXPECT_EQ(cursor.left(), text.size() - 11);
  EXPECT_EQ(trimmed("\r\t a b\v\n"), "a b");
  EXPECT_EQ(trimmed(" \n"), "");
  EXPECT_EQ(upper("a1-Zz"), "A1-ZZ");
  EXPECT_TRUE(starts_with_upper("nOde, x", "NODE"));
  EXPECT_TRUE(starts_with_upper("node", "NODE"));
  EXPECT_FALSE(starts_with_upper("nod", "NODE"));
  EXPECT_FALSE(starts_with_upper("mode", "NODE"));
}

TEST(TextCursor, DataAndCountsFitTheFile) {
  const auto complaint = [](const auto& read) {
    TextCursor cursor("ab 12 3", "f");
    cursor.bytes(2, "a head");
    try {
      read(cursor);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(complaint([](TextCursor& c) { c.bytes(5, "a body"); }), "");
  EXPECT_EQ(complaint([](TextCursor& c) { c.bytes(6, "a body"); }),
            "f: at byte 2: the file ends within a body (6 bytes expected, 5 found)");
  EXPECT_EQ(complaint([](TextCursor& c) { EXPECT_EQ(c.count("a count", 12), 12U); }), "");
  EXPECT_EQ(complaint([](TextCursor& c) { c.count("a count", 11); }),
            "f:1: a count: impossible (0 to 11 expected, 12 found)");
  EXPECT_EQ(TextCursor("0", "f").count("a count", 0), 0U);
  EXPECT_THROW(TextCursor("-1", "f").count("a count", 5), InputError);
}

TEST(TextCursor, LongWordsAreShownShortened) {
  EXPECT_EQ(shown(""), "''");
  EXPECT_EQ(shown("a\tb\x80"), "'a?b?'");
  EXPECT_EQ(shown(std::string(40, 'x')), "'" + std::string(40, 'x') + "'");
  EXPECT_EQ(shown(std::string(41, 'x')), "'" + std::string(40, 'x') + "...'");
}

TEST(DeckNumbers, AreWholeAndNotTooLarge) {
  EXPECT_EQ(whole_number(" 12 "), 12);
  EXPECT_EQ(whole_number("-2.0"), -2);
  EXPECT_EQ(whole_number("1.2E1"), 12);
  EXPECT_EQ(whole_number("999999999"), 999'999'999);
  EXPECT_EQ(whole_number("-999999999"), -999'999'999);
  for (const char* text : {"1000000000", "-1000000000", "2.5", "x", "", "nan", "inf"})
    EXPECT_EQ(whole_number(text), std::nullopt) << text;
}

TEST(DeckNumbers, ProductsOfExtentsStayBelowTheLargest) {
  EXPECT_EQ(product(std::vector<std::uint64_t>{}), 1U);
  EXPECT_EQ(product(std::vector<std::uint64_t>{3, 5, 7}), 105U);
  EXPECT_EQ(product(std::vector<std::uint64_t>{3, 0, 7}), 0U);
  EXPECT_EQ(product(std::vector<std::uint64_t>{1ULL << 32, 1ULL << 31}), 1ULL << 63);
  EXPECT_EQ(product(std::vector<std::uint64_t>{1ULL << 32, 1ULL << 32}), ~std::uint64_t{0});
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

/// A list of numbers in any order, some of them several times, that are as dense as `range` says.
std::vector<std::int64_t> some_numbers(std::mt19937& random, std::int64_t low, std::int64_t range) {
  std::vector<std::int64_t> numbers(random() % 40);
  std::uniform_int_distribution<std::int64_t> any(low, low + range);
  for (std::int64_t& number : numbers) number = any(random);
  return numbers;
}

// The lists are consecutive, dense or sparse, so that they are kept in each of the ways.
TEST(NumberIndex, FindsTheFirstOfEachNumberAndTellsTheOthers) {
  std::mt19937 random(5);
  for (int round = 0; round < 600; ++round) {
    const std::int64_t low = std::vector<std::int64_t>{0, -20, 7'000'000'000}[random() % 3];
    const std::int64_t range = std::vector<std::int64_t>{5, 30, 200, 400, 1'000'000}[random() % 5];
    std::vector<std::int64_t> numbers = some_numbers(random, low, range);
    if (round % 5 == 0) std::ranges::sort(numbers);
    if (round % 5 == 1) {
      for (std::size_t i = 0; i < numbers.size(); ++i)
        numbers[i] = low + static_cast<std::int64_t>(i);
      if (numbers.size() > 3) numbers.back() = numbers[random() % 3];
    }
    const NumberIndex index(numbers);
    const auto first = [&](std::int64_t number) {
      const auto at = std::ranges::find(numbers, number);
      return at == numbers.end() ? NumberIndex::kNone
                                 : static_cast<std::size_t>(at - numbers.begin());
    };
    std::vector<std::pair<std::size_t, std::size_t>> repeated;
    for (std::size_t i = 0; i < numbers.size(); ++i)
      if (first(numbers[i]) != i) repeated.emplace_back(i, first(numbers[i]));
    auto found = index.repeated();
    std::ranges::sort(found);
    ASSERT_EQ(found, repeated) << round;
    for (std::int64_t number = low - 2; number < low + 250; ++number)
      ASSERT_EQ(index.find(number), first(number)) << round;
    for (const std::int64_t number : numbers)
      for (const std::int64_t near : {number - 1, number, number + 1})
        ASSERT_EQ(index.find(near), first(near)) << round;
  }
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
