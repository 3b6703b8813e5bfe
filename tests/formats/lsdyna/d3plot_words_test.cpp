// The control words of LS-DYNA's files: where data begin for each of them, and what is refused.
#include <cstring>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "formats/lsdyna/d3plot_layout.hpp"
#include "tests/formats/files.hpp"
#include "tests/formats/solver_files.hpp"

namespace hiac::formats::lsdyna {
namespace {

using testing::HasSubstr;
using Changes = std::map<std::size_t, std::int64_t>;

/// Two nodes and a solid of seven values; control words by their number from 0. Words behind the
/// first 64 may be changed, too.
std::string words_of(const Changes& changes, std::size_t count = 200) {
  std::vector<std::int64_t> words(count, 0);
  words[11] = 1;
  words[15] = 4;
  words[16] = 2;
  words[23] = 1;
  words[27] = 7;
  for (const auto& [word, value] : changes) words.at(word) = value;
  Bytes out;
  for (const std::int64_t word : words) out.whole(static_cast<std::int32_t>(word));
  return out.str();
}

Layout layout_of(const Changes& changes) {
  const std::string bytes = words_of(changes);
  Words words(bytes, 4, std::endian::native, "f");
  return read_layout(words);
}

std::string layout_complaint(const Changes& changes, std::size_t count = 200) {
  const std::string bytes = words_of(changes, count);
  Words words(bytes, 4, std::endian::native, "f");
  try {
    read_layout(words);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(D3plotWords, NodesAndASolid) {
  const Layout layout = layout_of({});
  EXPECT_EQ(layout.nodes, 2U);
  EXPECT_EQ(layout.solids, 1U);
  EXPECT_FALSE(layout.ten_nodes);
  EXPECT_EQ(layout.coordinates, 64U);
  EXPECT_EQ(layout.connectivity, 70U);
  EXPECT_EQ(layout.more_nodes, 79U);
  EXPECT_EQ(layout.first_state, 79U);
  EXPECT_EQ(layout.node_data, 1U);
  EXPECT_EQ(layout.thermal_data, 1U);
  EXPECT_EQ(layout.solid_data, 1U);
  EXPECT_EQ(layout.deletion_data, 8U);
  EXPECT_EQ(layout.state_words, 8U);
  EXPECT_EQ(layout.deletion, 0U);
}

TEST(D3plotWords, WhatStandsBeforeTheStates) {
  const std::vector<std::tuple<std::string, Changes, std::size_t>> rows{
      {"three beams", {{28, 3}}, 79 + 18},
      {"three shells", {{31, 3}}, 79 + 15},
      {"three thick shells", {{40, 3}}, 79 + 27},
      {"users' numbers", {{39, 11}}, 79 + 11},
      {"fluids", {{47, 4}}, 79 + 4},
      {"shells of eight nodes", {{55, 3}}, 79 + 15},
      {"ten nodes", {{23, -1}}, 79 + 2},
      {"further control words", {{57, 5}}, 79 + 5},
      {"materials", {{15, 5}, {51, 3}}, 79 + 2 + 3},
      {"materials that are not there", {{15, 4}, {51, 3}}, 79},
      {"three nodes", {{16, 3}}, 79 + 3},
      {"three solids", {{23, 3}}, 79 + 18}};
  for (const auto& [name, changes, first] : rows)
    EXPECT_EQ(layout_of(changes).first_state, first) << name;
  EXPECT_EQ(layout_of({{47, 4}, {57, 5}}).coordinates, 73U);
  EXPECT_EQ(layout_of({{15, 5}, {51, 3}}).coordinates, 69U);
  EXPECT_TRUE(layout_of({{23, -1}}).ten_nodes);
  EXPECT_EQ(layout_of({{23, -1}, {39, 4}}).more_nodes, 83U);
}

TEST(D3plotWords, WhatStandsInAState) {
  const std::vector<std::tuple<std::string, Changes, std::size_t>> rows{
      {"globals", {{18, 5}}, 8 + 5},
      {"a temperature", {{19, 1}}, 8 + 2},
      {"a temperature and a flux", {{19, 2}}, 8 + 8},
      {"temperatures of three layers and a flux", {{19, 3}}, 8 + 12},
      {"added mass", {{19, 11}}, 8 + 4},
      {"added mass alone", {{19, 10}}, 8 + 2},
      {"rates", {{56, 1}}, 8 + 2},
      {"residuals", {{56, 10}}, 8 + 12},
      {"both", {{56, 11}}, 8 + 14},
      {"coordinates", {{20, 1}}, 8 + 6},
      {"velocities", {{21, 1}}, 8 + 6},
      {"accelerations", {{22, 1}}, 8 + 6},
      {"thermal values of solids", {{57, 2}, {65, 4}}, 8 + 4},
      {"values of thick shells", {{40, 2}, {42, 5}}, 8 + 10},
      {"values of beams", {{28, 2}, {30, 5}}, 8 + 10},
      {"values of shells", {{31, 2}, {33, 5}}, 8 + 10},
      {"deleted nodes", {{36, -1}}, 8 + 2},
      {"deleted nodes, still", {{36, -9999}}, 8 + 2},
      {"deleted elements", {{36, -10000}, {28, 2}, {31, 3}, {40, 4}}, 8 + 1 + 2 + 3 + 4},
      {"nothing deleted", {{36, 5}}, 8}};
  for (const auto& [name, changes, words] : rows)
    EXPECT_EQ(layout_of(changes).state_words, words) << name;
  EXPECT_EQ(layout_of({{36, -9999}}).deletion, 1U);
  EXPECT_EQ(layout_of({{36, -10000}}).deletion, 2U);
  EXPECT_EQ(layout_of({{18, 5}, {19, 1}, {20, 1}}).thermal_data, 1U + 5 + 2 * 4);
  EXPECT_EQ(layout_of({{57, 2}, {65, 4}}).solid_data, 5U);
}

TEST(D3plotWords, TemperaturesThatAreRead) {
  EXPECT_FALSE(layout_of({{19, 0}}).has_temperature);
  EXPECT_TRUE(layout_of({{19, 1}}).has_temperature);
  EXPECT_TRUE(layout_of({{19, 2}}).has_temperature);
  EXPECT_FALSE(layout_of({{19, 3}}).has_temperature);
  EXPECT_TRUE(layout_of({{20, 1}}).has_coordinates);
  EXPECT_TRUE(layout_of({{21, 1}}).has_velocity);
  EXPECT_TRUE(layout_of({{22, 1}}).has_acceleration);
}

TEST(D3plotWords, ShellsOfRigidBodiesHaveNoValues) {
  // two materials, 20 being rigid, and three shells of materials 1, 2, 3
  const Changes changes{{15, 5}, {51, 2}, {66, 20}, {67, 1}, {31, 3},
                        {33, 5}, {87, 1}, {92, 2},  {97, 3}};
  EXPECT_EQ(layout_of(changes).first_state, 98U);
  EXPECT_EQ(layout_of(changes).state_words, 8U + 2 * 5);
  Changes none = changes;
  none[66] = 1;
  EXPECT_EQ(layout_of(none).state_words, 8U + 3 * 5);
  Changes two = changes;
  two[92] = 1;
  EXPECT_EQ(layout_of(two).state_words, 8U + 5);
}

/// The bytes of a real as those of an integer.
std::int64_t bits_of(float real) {
  std::int32_t bits = 0;
  std::memcpy(&bits, &real, sizeof bits);
  return bits;
}

TEST(D3plotWords, TitlesStandBetweenEndMarks) {
  const std::int64_t mark = bits_of(-999999.0F);
  EXPECT_EQ(layout_of({{79, mark}, {80, 90001}, {81, 2}, {120, mark}}).first_state, 121U);
  EXPECT_EQ(layout_of({{79, mark}, {80, 90002}, {81, 2}, {120, mark}}).first_state, 121U);
  EXPECT_EQ(layout_of({{79, mark}, {80, 90000}, {99, mark}}).first_state, 100U);
  EXPECT_EQ(layout_of({{79, mark}, {80, 90000}, {99, 90001}, {100, 1}, {120, mark}}).first_state,
            121U);
  EXPECT_EQ(layout_of({{79, mark}, {80, 90003}}).first_state, 80U);
  EXPECT_EQ(layout_complaint({{79, mark}, {80, 90001}, {81, 201}}),
            "f: at byte 328: 201 titles are more than the file holds");
}

TEST(D3plotWords, ModelsThatAreNotRead) {
  for (const int code : {-1, 2, 6, 8})
    EXPECT_EQ(
        layout_complaint({{15, code}}),
        fmt::format("f: at byte 64: a model of dimension code {} (3, 4 or 5 expected)", code));
  for (const int code : {3, 4, 5}) EXPECT_EQ(layout_complaint({{15, code}}), "none");
  EXPECT_EQ(layout_complaint({{15, 7}}), "f: at byte 64: holds rigid roads, which are not read");
  EXPECT_EQ(layout_complaint({{37, 1}}), "f: at byte 152: holds SPH particles, which are not read");
  EXPECT_EQ(layout_complaint({{54, 1}}),
            "f: at byte 220: holds airbag particles, which are not read");
  EXPECT_EQ(layout_complaint({{48, 1}}), "f: at byte 196: holds CFD data, which are not read");
  const std::string nodes = "holds solids of 20 or 27 nodes, which are not read";
  EXPECT_EQ(layout_complaint({{57, 3}, {64, 1}}), "f: at byte 260: " + nodes);
  EXPECT_EQ(layout_complaint({{57, 3}, {66, 1}}), "f: at byte 268: " + nodes);
  EXPECT_EQ(layout_complaint({{19, 4}}),
            "f: at byte 228: a thermal flag from 0 to 3 expected (4 found)");
  EXPECT_EQ(layout_complaint({{19, -1}}),
            "f: at byte 228: a thermal flag from 0 to 3 expected (-1 found)");
}

TEST(D3plotWords, CountsThatLeadBeyondTheFile) {
  EXPECT_EQ(layout_complaint({}, 79), "none");
  EXPECT_EQ(layout_complaint({}, 78), "f: at byte 224: the model takes 79 words (78 found)");
  EXPECT_EQ(layout_complaint({{16, 201}}),
            "f: at byte 68: 201 things are more than the file holds");
  EXPECT_THAT(layout_complaint({{16, 200}}), HasSubstr("the model takes 673 words (200 found)"));
  EXPECT_EQ(layout_complaint({{16, -1}}), "f: at byte 68: -1 things are more than the file holds");
  EXPECT_EQ(layout_complaint({{23, 201}}),
            "f: at byte 96: 201 solids are more than the file holds");
  EXPECT_EQ(layout_complaint({{23, -201}}),
            "f: at byte 96: 201 solids are more than the file holds");
  EXPECT_EQ(layout_complaint({{27, 100'001}}),
            "f: at byte 112: control word 28: a small count expected (100001 found)");
  EXPECT_EQ(layout_complaint({{27, 100'000}}),
            "f: at byte 112: 100000 things are more than the file holds");
  EXPECT_EQ(layout_complaint({{27, -1}}),
            "f: at byte 112: control word 28: a small count expected (-1 found)");
  EXPECT_EQ(layout_complaint({{57, 201}}),
            "f: at byte 232: 201 further control words are more than the file holds");
  EXPECT_EQ(layout_complaint({{47, 201}}),
            "f: at byte 192: 201 fluid materials are more than the file holds");
}

TEST(D3plotWords, WordsAreToldByTheirControlWords) {
  const auto kind = [](const Changes& changes) { return word_kind(words_of(changes)); };
  for (const int type : {1, 5, 11}) EXPECT_TRUE(kind({{11, type}})) << type;
  for (const int type : {0, 2, 10}) EXPECT_FALSE(kind({{11, type}})) << type;
  for (const int dimension : {2, 9}) EXPECT_TRUE(kind({{15, dimension}})) << dimension;
  for (const int dimension : {1, 10}) EXPECT_FALSE(kind({{15, dimension}})) << dimension;
  EXPECT_FALSE(kind({{16, 0}}));
  EXPECT_TRUE(kind({{27, 0}}));
  EXPECT_FALSE(kind({{27, -1}}));
  EXPECT_TRUE(word_kind(words_of({}, 64)));
  EXPECT_FALSE(word_kind(words_of({}, 64).substr(1)));
  EXPECT_EQ(kind({})->bytes, 4U);
}

TEST(D3plotWords, NumbersOfBothWidths) {
  const std::string bytes = Bytes().whole(-7).mark(0.5F).whole(9).raw("xxx").str();
  Words words(bytes, 4, std::endian::native, "f");
  EXPECT_EQ(words.size(), 3U);
  EXPECT_EQ(words.integer(0), -7);
  EXPECT_EQ(words.real(1), 0.5);
  const auto complaint = [&](const auto& read) -> std::string {
    try {
      read();
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_EQ(complaint([&] { (void)words.integer(3); }), "f: at byte 8: word 4 expected (3 found)");
  EXPECT_EQ(complaint([&] { (void)words.real(3); }), "f: at byte 8: word 4 expected (3 found)");
  const std::string wide = Bytes(true).put(std::int64_t{-7}).real(0.5).str();
  Words other(wide, 8,
              std::endian::native == std::endian::little ? std::endian::big : std::endian::little,
              "f");
  EXPECT_EQ(other.integer(0), -7);
  EXPECT_EQ(other.real(1), 0.5);
}

TEST(D3plotWords, FilesWithoutSolidsOrWithoutControlWords) {
  const ScratchFolder folder;
  const std::string path = folder.write("d3plot", words_of({{23, 0}, {28, 2}, {31, 3}}));
  EXPECT_EQ(refusal(path), path + ": holds no solids (but 3 shells, 2 beams)");
  const std::string other = folder.write("other", words_of({{11, 0}}));
  try {
    format_named("d3plot").read(other, {});
    ADD_FAILURE() << "not refused";
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(), other + ": has no control words of a d3plot file");
  }
}

}  // namespace
}  // namespace hiac::formats::lsdyna
