#include "hiac/mesh/parted/parted_index.hpp"

#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "hiac/base/error.hpp"
#include "tests/support/scratch_folder.hpp"

namespace hiac {
namespace {

using IndexJson = nlohmann::ordered_json;

IndexJson one_part(const std::string& file) {
  return {{"file", file},
          {"cells", 2},
          {"nodes", 5},
          {"low", {0, 0, 0}},
          {"high", {1, 1, 1}},
          {"hash", std::string(32, 'a')},
          {"numbers_hash", std::string(32, '9')}};
}

class PartedIndexFile : public testing::Test {
 protected:
  using Edit = std::function<void(IndexJson&)>;

  PartedIndex index_with(const Edit& edit, PartFiles files = PartFiles::beside) {
    IndexJson json{{"format", "hiac parted mesh"},
                   {"version", 1},
                   {"cells", 4},
                   {"nodes", 8},
                   {"hash", std::string(32, '0')},
                   {"parts", {one_part("a.zoo"), one_part("b.zoo")}}};
    edit(json);
    return read_parted_index(folder_.write("m.zparts", json.dump()), files);
  }
  /// The message behind the file's name; empty for none.
  std::string told_of_index(const Edit& edit) {
    try {
      static_cast<void>(index_with(edit));
    } catch (const InputError& error) {
      const std::string message = error.what(), path = folder_.file("m.zparts");
      EXPECT_TRUE(message.starts_with(path + ": ")) << message;
      return message.substr(path.size() + 2);
    }
    return "";
  }

  test::ScratchFolder folder_;
};

TEST_F(PartedIndexFile, IsReadAndWrittenAsItIs) {
  const PartedIndex index = index_with([](IndexJson&) {});
  EXPECT_EQ(index.cells, 4U);
  EXPECT_EQ(index.nodes, 8U);
  ASSERT_EQ(index.parts.size(), 2U);
  EXPECT_EQ(index.parts[1].file, "b.zoo");
  EXPECT_EQ(index.parts[1].nodes, 5U);
  EXPECT_EQ(index.parts[0].high[2], 1);
  EXPECT_EQ(index.parts[0].hash[0], 'a');
  EXPECT_EQ(index.parts[0].numbers_hash[0], '9');
  EXPECT_EQ(index.path_of(1), folder_.file("b.zoo"));
  static_cast<void>(folder_.write("n.zparts", text_of(index)));
  EXPECT_EQ(text_of(read_parted_index(folder_.file("n.zparts"))), text_of(index));
}

TEST_F(PartedIndexFile, SaysWhichMemberOfWhichPartIsWrong) {
  const std::pair<Edit, const char*> cases[] = {
      {[](IndexJson& j) { j["format"] = 3; }, "\"format\": a text expected"},
      {[](IndexJson& j) { j["parts"][1]["file"] = nullptr; }, "part 1: \"file\": a text expected"},
      {[](IndexJson& j) { j["parts"][0]["hash"] = 3; }, "part 0: \"hash\": a text expected"},
      {[](IndexJson& j) { j["parts"] = 3; }, "\"parts\": a list expected"},
      {[](IndexJson& j) { j["parts"] = IndexJson::object(); }, "\"parts\": a list expected"},
      {[](IndexJson& j) { j["parts"] = IndexJson::array(); },
       "impossible number of parts (1 to 65536 expected, 0 found)"},
      {[](IndexJson& j) { j["parts"][1]["file"] = ""; },
       "part 1: \"file\" is empty (a file's name expected)"},
      {[](IndexJson& j) { j["parts"][1]["file"] = "a\x7f"; },
       "part 1: \"file\" has control characters"},
      {[](IndexJson& j) { j["parts"][1]["file"] = "../b.zoo"; },
       "part 1: names ../b.zoo, which lies outside the index's folder (PartFiles::anywhere reads "
       "it)"},
      {[](IndexJson& j) { j["parts"][1]["file"] = "c/../b.zoo"; }, ""},
      {[](IndexJson& j) { j["parts"][1]["hash"] = std::string(31, 'a'); },
       "part 1: \"hash\": 32 hexadecimal digits expected"},
      {[](IndexJson& j) { j["parts"][1]["hash"] = std::string(33, 'a'); },
       "part 1: \"hash\": 32 hexadecimal digits expected"},
      {[](IndexJson& j) { j["hash"] = std::string(32, 'g'); },
       "\"hash\": 32 hexadecimal digits expected"},
      {[](IndexJson& j) { j["hash"] = std::string(32, 'A'); },
       "\"hash\": 32 hexadecimal digits expected"},
      {[](IndexJson& j) { j["hash"] = std::string(32, 'f'); }, ""},
      {[](IndexJson& j) { j["hash"] = std::string(32, '/'); },
       "\"hash\": 32 hexadecimal digits expected"},
      {[](IndexJson& j) { j["hash"] = std::string(32, ':'); },
       "\"hash\": 32 hexadecimal digits expected"},
      {[](IndexJson& j) {
         j["parts"][0]["low"] = {0, 0, "x"};
       },
       "part 0: \"low\": three finite numbers expected"},
      {[](IndexJson& j) {
         j["parts"][0]["high"] = {1, 1, 1, 1};
       },
       "part 0: \"high\": three numbers expected"},
      {[](IndexJson& j) {
         j["parts"][0]["low"] = {1, 1, 1};
       },
       ""},
      {[](IndexJson& j) {
         j["parts"][0]["low"] = {0, 0, 1.5};
       },
       "part 0: an impossible box (z from 1.5 to 1)"},
      {[](IndexJson& j) { j["parts"][0]["nodes"] = 0; },
       "part 0: is empty (cells and nodes expected, 2 and 0 found)"},
      {[](IndexJson& j) { j["parts"][0]["cells"] = 1.5; },
       "part 0: \"cells\": a whole number expected"},
      {[](IndexJson& j) { j.erase("nodes"); }, "\"nodes\" is missing"},
  };
  for (const auto& [edit, message] : cases) EXPECT_EQ(told_of_index(edit), message);
}

TEST_F(PartedIndexFile, HasPartsThatMakeTheWhole) {
  const auto told = [&](int cells, int nodes) {
    return told_of_index([&](IndexJson& j) {
      j["cells"] = cells;
      j["nodes"] = nodes;
    });
  };
  EXPECT_EQ(told(4, 5), "");
  EXPECT_EQ(told(4, 10), "");
  EXPECT_EQ(told(4, 4), "part 0: more nodes than the whole mesh (at most 4 expected, 5 found)");
  EXPECT_EQ(told(4, 11), "the parts have fewer nodes than the whole mesh (11 expected, 10 found)");
  EXPECT_EQ(told(3, 8), "the parts have more cells than the whole mesh (3 expected)");
  EXPECT_EQ(told(5, 8), "the parts' cells are not those of the whole mesh (5 expected, 4 found)");
  EXPECT_EQ(told_of_index([](IndexJson& j) { j["parts"][1]["file"] = "c/.././a.zoo"; }),
            "part 1: its file c/.././a.zoo is that of another part, too");
}

TEST_F(PartedIndexFile, LiesAnywhereWhereThatIsAllowed) {
  const auto outside = [](IndexJson& j) { j["parts"][1]["file"] = "../b.zoo"; };
  EXPECT_EQ(index_with(outside, PartFiles::anywhere).parts[1].file, "../b.zoo");
}

}  // namespace
}  // namespace hiac
