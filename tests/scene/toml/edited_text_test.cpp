#include "hiac/scene/toml/edited_text.hpp"

#include <algorithm>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <toml++/toml.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/starter_text.hpp"
#include "hiac/scene/toml/spec_override.hpp"
#include "tests/support/instrumented.hpp"

namespace hiac {
namespace {

using testing::HasSubstr;

std::string edited_or_error(const std::string& text, const std::string& key,
                            const std::string& value) {
  try {
    return with_key(text, key, value);
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(EditedText, ReplacesAValueAndNothingElse) {
  const std::string text =
      "# mine\n[camera]  # the eye\n  fov = 30.0   # degrees\neye = [ 1, # x\n 2, 3 ]\n";
  EXPECT_EQ(with_key(text, "camera.fov", "20.5"),
            "# mine\n[camera]  # the eye\n  fov = 20.5   # degrees\neye = [ 1, # x\n 2, 3 ]\n");
  EXPECT_EQ(with_key(text, "camera.eye.1", "7"),
            "# mine\n[camera]  # the eye\n  fov = 30.0   # degrees\neye = [ 1, # x\n 7, 3 ]\n");
}

TEST(EditedText, AddsKeysBehindTheirTablesLast) {
  EXPECT_EQ(with_key("[a]\n  x = 1  # one\n\n# off\n#y = 3\n[b]\n", "a.y", "2"),
            "[a]\n  x = 1  # one\n  y = 2\n\n# off\n#y = 3\n[b]\n");
  EXPECT_EQ(with_key("[a]", "a.y", "2"), "[a]\ny = 2\n");
  EXPECT_EQ(with_key("a.b.x = 1\nc = 2\n", "a.b.y", "2"), "a.b.x = 1\na.b.y = 2\nc = 2\n");
  EXPECT_EQ(with_key("a = {x = 1} # t\n", "a.y", "2"), "a = {x = 1, y = 2} # t\n");
  EXPECT_EQ(with_key("a = {}\n", "a.y.z", "2"), "a = { y = { z = 2 } }\n");
  EXPECT_EQ(with_key("# top\n[a]\n", "b", "1"), "b = 1\n# top\n[a]\n");
}

TEST(EditedText, AddsTablesBehindTheirRelatives) {
  EXPECT_EQ(with_key("[v.a]\nx = 1\n\n# about w\n[w]\n", "v.b.y", "2"),
            "[v.a]\nx = 1\n\n[v.b]\ny = 2\n\n# about w\n[w]\n");
  EXPECT_EQ(with_key("[[s]]\nx = 1\n\n[w]\n", "s.1.x", "2"),
            "[[s]]\nx = 1\n\n[[s]]\nx = 2\n\n[w]\n");
  EXPECT_EQ(with_key("[[s]]\nx = 1\n[[s]]\nx = 2\n", "s.0.t.y", "3"),
            "[[s]]\nx = 1\n\n[s.t]\ny = 3\n\n[[s]]\nx = 2\n");
  EXPECT_EQ(with_key("", "s.0.x", "2"), "[[s]]\nx = 2\n");
  EXPECT_EQ(with_table("[w]\n", "s.0", {{{"x", "1"}, {"y", "[\n  2,\n]"}}}),
            "[w]\n\n[[s]]\nx = 1\ny = [\n  2,\n]\n");
  EXPECT_THROW(with_table("[w]\n", "w", {{{"x", "1"}}}), UsageError);
}

TEST(EditedText, KeepsElementsOnTheirLines) {
  const std::string text = "p = [\n  [0, 1],  # low\n  [2, 3]  # high\n]\n";
  EXPECT_EQ(with_element(text, "p.1", "[1, 5]"),
            "p = [\n  [0, 1],  # low\n  [1, 5],\n  [2, 3]  # high\n]\n");
  EXPECT_EQ(with_element(text, "p.2", "[4, 5]"),
            "p = [\n  [0, 1],  # low\n  [2, 3],  # high\n  [4, 5],\n]\n");
  EXPECT_EQ(without_key(text, "p.0"), "p = [\n  [2, 3]  # high\n]\n");
  EXPECT_EQ(without_key(text, "p.1"), "p = [\n  [0, 1]  # low\n]\n");
  EXPECT_EQ(with_element("p = [1, 2]", "p.1", "9"), "p = [1, 9, 2]");
  EXPECT_EQ(without_key("p = [1, 2]", "p.1"), "p = [1]");
  EXPECT_EQ(without_key("p = {a = 1, b = 2}", "p.a"), "p = {b = 2}");
  EXPECT_THROW(with_element("p = 3\n", "p.0", "1"), UsageError);
  EXPECT_THROW(with_element("p = [1]\n", "p.2", "1"), UsageError);
}

TEST(EditedText, RemovesTablesWithTheirLines) {
  const std::string text = "[a]\nx = 1 # x\n\n[[s]]\nv = 1\n# off\n\n[[s]]\nv = 2\n\n# b's\n[b]\n";
  EXPECT_EQ(without_table(text, "s.0"), "[a]\nx = 1 # x\n\n# off\n\n[[s]]\nv = 2\n\n# b's\n[b]\n");
  EXPECT_EQ(without_table(text, "a"), "[[s]]\nv = 1\n# off\n\n[[s]]\nv = 2\n\n# b's\n[b]\n");
  EXPECT_EQ(without_table(text, "s"), "[a]\nx = 1 # x\n\n# off\n\n# b's\n[b]\n");
  EXPECT_EQ(without_table(text, "c"), text);
}

TEST(EditedText, RefusesWhatItCannotDo) {
  EXPECT_THAT(edited_or_error("[a]\nx = 1\n", "a", "2"), HasSubstr("key `a`: is a table"));
  EXPECT_THAT(edited_or_error("[a]\nx = 1\n", "a.x.y", "2"), HasSubstr("below a plain value"));
  EXPECT_THAT(edited_or_error("[a]\nx = [1]\n", "a.x.2", "2"), HasSubstr("no element `2`"));
  EXPECT_THAT(edited_or_error("[[a]]\nx = 1\n", "a.2.x", "2"), HasSubstr("no element `2`"));
  EXPECT_THAT(edited_or_error("[a]\n", "a..x", "2"), HasSubstr("malformed key"));
  EXPECT_THAT(edited_or_error("[a\n", "a.x", "2"), HasSubstr("view:1"));
  for (const char* value : {"1\nb = 2", "1 # off", "1, 2", "", "word", "1]\nb = [2"})
    EXPECT_THAT(edited_or_error("[a]\n", "a.x", value), HasSubstr("no value in TOML")) << value;
}

TEST(EditedText, LeavesExamplesInCommentsOff) {
  Scene scene;
  scene.image = {10, 10};
  scene.camera.look_at = {1, 0, 0};
  scene.camera.up = {0, 0, 1};
  scene.camera.fov = 30;
  scene.volume.color.emplace().field = "p";
  const std::string text = starter_text(scene, "viridis", {0, 1});
  ASSERT_THAT(text, HasSubstr("# [skin]"));
  const std::string edited = with_key(text, "skin.opacity", "0.5");
  EXPECT_THAT(edited, HasSubstr("# [skin]"));
  EXPECT_TRUE(edited.starts_with(text));
  EXPECT_EQ(parse_scene(edited, "view").scene.skin->opacity, 0.5);
}

// Random texts and edits, compared with what the parser and the overrides make of them ------------

/// Texts of random TOML; every comment has a number of its own.
class RandomText {
 public:
  explicit RandomText(unsigned seed) : random_(seed) {}

  std::size_t below(std::size_t n) { return random_() % n; }
  template <typename T>
  const T& one_of(const std::vector<T>& choices) {
    return choices[below(choices.size())];
  }

  std::string value(int depth = 0) {
    const std::size_t kind = below(depth < 2 ? 9 : 6);
    if (kind < 2) return std::to_string(below(100));
    if (kind == 2) return "-1.5e-3";
    if (kind == 3) return one_of<std::string>({"\"a # b ] , }\"", "'c:\\ [x'", "\"q\\\" = 1\""});
    if (kind == 4)
      return one_of<std::string>({"\"\"\"\n# no comment\n[no.table]\n\"\"\"", "'''x''''", "true"});
    if (kind == 5) return one_of<std::string>({"1979-05-27 07:32:00", "inf", "0x1F"});
    return kind < 8 ? list(depth) : braces(depth);
  }

  std::string text() {
    comments_ = 0;
    std::string text = keys(below(3), {"r", "s", "\"t\"", "a.u"});
    std::vector<std::string> headers{"[b]", "[b.d]", "[e . f]", "[[g]]", "[[g]]\n[g.h]", "[[g]]"};
    std::shuffle(headers.begin(), headers.end(), random_);
    headers.resize(below(headers.size() + 1));
    std::stable_partition(headers.begin(), headers.end(),
                          [](const std::string& h) { return h[1] == '['; });
    for (const std::string& header : headers)
      text += blank() + header + comment() + keys(below(4), {"x", "y.z", "y.w", "'v'", "n"});
    return text + blank();
  }

  /// The comments of the text made last.
  [[nodiscard]] std::vector<std::string> comments() const {
    std::vector<std::string> all;
    for (int i = 0; i < comments_; ++i) all.push_back(fmt::format("#c{}.", i));
    return all;
  }

 private:
  std::string comment() { return below(3) == 0 ? fmt::format(" #c{}.\n", comments_++) : "\n"; }
  std::string blank() {
    std::string text;
    while (below(3) == 0) text += below(2) == 0 ? "\n" : "  " + comment();
    return text;
  }
  std::string list(int depth) {
    const bool on_lines = below(2) == 0;
    std::string text = "[";
    const std::size_t count = below(4);
    for (std::size_t i = 0; i < count; ++i) {
      if (on_lines) text += comment() + "  ";
      text += value(depth + 1);
      if (on_lines && below(4) == 0) text += comment();
      if (i + 1 < count || below(2) == 0) text += below(2) == 0 ? "," : ", ";
    }
    return text + (on_lines ? comment() + "]" : "]");
  }
  std::string braces(int depth) {
    std::string text = "{";
    std::vector<std::string> names{"i", "j.k", "j.l", "\"m\""};
    std::shuffle(names.begin(), names.end(), random_);
    names.resize(below(4));
    for (const std::string& name : names)
      text += (text == "{" ? "" : ", ") + name + "=" + value(depth + 1);
    return text + "}";
  }
  std::string keys(std::size_t count, std::vector<std::string> names) {
    std::string text;
    std::shuffle(names.begin(), names.end(), random_);
    for (std::size_t i = 0; i < count; ++i)
      text += blank() + (below(4) == 0 ? "  " : "") + names[i] + " = " + value() + comment();
    return text;
  }

  std::mt19937 random_;
  int comments_ = 0;
};

/// A random key, of the text or near one of it.
std::string random_key(RandomText& random, const toml::table& document) {
  std::string key;
  const toml::node* node = &document;
  while (true) {
    std::string part = random.one_of<std::string>(
        {"r", "b", "d", "e", "f", "g", "h", "x", "y", "z", "i", "new", "0", "1", "2"});
    const toml::node* next = nullptr;
    if (const auto* table = node->as_table(); table != nullptr && !table->empty()) {
      if (random.below(8) > 0) {
        auto entry = table->begin();
        std::advance(entry, static_cast<std::ptrdiff_t>(random.below(table->size())));
        part = entry->first.str();
      }
      next = table->get(part);
    } else if (const auto* list = node->as_array()) {
      const std::size_t index = random.below(list->size() + 1);
      part = std::to_string(index);
      next = list->get(index);
    }
    key += (key.empty() ? "" : ".") + part;
    if (random.below(next == nullptr ? 2 : 4) == 0) return key;
    static const toml::table kNothing;
    node = next == nullptr ? &kNothing : next;
    if (key.size() > 40) return key;
  }
}

/// What an override makes of the text; nothing if it refuses.
std::optional<toml::table> overridden(const std::string& text, const std::string& option) {
  toml::table document = toml::parse(text);
  try {
    apply_override(document, option);
    return document;
  } catch (const UsageError&) {
    return std::nullopt;
  }
}

/// The parts of two texts that differ.
std::pair<std::string, std::string> difference(const std::string& a, const std::string& b) {
  const auto [i, j] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  std::string x(i, a.end()), y(j, b.end());
  while (!x.empty() && !y.empty() && x.back() == y.back()) {
    x.pop_back();
    y.pop_back();
  }
  return {x, y};
}

/// Whether removing bytes of a text gives the part.
bool is_part_of(const std::string& part, const std::string& text) {
  std::size_t at = 0;
  for (const char c : text) at += at < part.size() && part[at] == c ? 1 : 0;
  return at == part.size();
}

std::size_t kept_comments(const RandomText& random, const std::string& text) {
  std::size_t kept = 0;
  for (const std::string& comment : random.comments())
    kept += text.find(comment) != std::string::npos ? 1 : 0;
  return kept;
}

TEST(EditedText, SetsWhatTheOverrideSetsAndKeepsEveryComment) {
  RandomText random(1);
  int replaced = 0, added = 0;
  for (int round = 0; round < static_cast<int>(test::tried(40000)); ++round) {
    const std::string text = random.text();
    const toml::table before = toml::parse(text);
    const std::string key = random_key(random, before);
    const std::string value = random.one_of<std::string>({"4242", "[4242]", "{ q = 4242 }"});
    const std::optional<toml::table> truth = overridden(text, key + "=" + value);
    std::string edited;
    try {
      edited = with_key(text, key, value);
    } catch (const UsageError& error) {
      const bool has_reason = std::string(error.what()).find("table") != std::string::npos;
      ASSERT_TRUE(!truth || has_reason) << text << "\n--- " << key << "\n" << error.what();
      continue;
    }
    ASSERT_TRUE(truth) << text << "\n--- " << key << "\n" << edited;
    toml::table found;
    ASSERT_NO_THROW(found = toml::parse(edited)) << text << "\n--- " << key << "\n" << edited;
    ASSERT_EQ(found, *truth) << text << "\n--- " << key << "\n" << edited;
    if (is_part_of(text, edited)) {
      ++added;
      ASSERT_EQ(kept_comments(random, edited), random.comments().size()) << text << "\n" << edited;
    } else {
      // only the value itself
      ++replaced;
      ASSERT_LE(difference(text, edited).second.size(), value.size())
          << text << "\n--- " << key << "\n"
          << edited;
    }
  }
  EXPECT_GT(replaced, static_cast<int>(test::tried(3000)));
  EXPECT_GT(added, static_cast<int>(test::tried(3000)));
}

/// Without empty tables and lists: those that nothing but what is gone has made are gone, too.
void drop_empty(toml::table& table);

void drop_empty(toml::array& list) {
  for (toml::node& node : list) {
    if (node.is_table()) drop_empty(*node.as_table());
    if (node.is_array()) drop_empty(*node.as_array());
  }
}

void drop_empty(toml::table& table) {
  std::vector<std::string> empty;
  for (auto&& [name, node] : table) {
    toml::table* below = node.as_table();
    if (below != nullptr) drop_empty(*below);
    toml::array* list = node.as_array();
    if (list != nullptr) drop_empty(*list);
    if ((below != nullptr && below->empty()) || (list != nullptr && list->empty()))
      empty.emplace_back(name.str());
  }
  for (const std::string& name : empty) table.erase(name);
}

toml::table without_empty(toml::table table) {
  drop_empty(table);
  return table;
}

TEST(EditedText, RemovesWhatTheOverrideRemoves) {
  RandomText random(2);
  int removed = 0;
  for (int round = 0; round < static_cast<int>(test::tried(40000)); ++round) {
    const std::string text = random.text();
    const std::string key = random_key(random, toml::parse(text));
    const bool tables_too = random.below(2) == 0;
    std::string edited;
    try {
      edited = tables_too ? without_table(text, key) : without_key(text, key);
    } catch (const UsageError&) {
      continue;
    }
    if (edited == text) continue;
    const std::optional<toml::table> truth = overridden(text, key + "=");
    ASSERT_TRUE(truth) << text << "\n--- " << key << "\n" << edited;
    toml::table found;
    ASSERT_NO_THROW(found = toml::parse(edited)) << text << "\n--- " << key << "\n" << edited;
    ASSERT_EQ(without_empty(found), without_empty(*truth)) << text << "\n--- " << key << "\n"
                                                           << edited;
    ++removed;
    ASSERT_TRUE(is_part_of(edited, text)) << text << "\n--- " << key << "\n" << edited;
  }
  EXPECT_GT(removed, static_cast<int>(test::tried(5000)));
}

/// The list that a key names.
toml::array* list_at(toml::table& document, const std::string& key) {
  toml::node* node = &document;
  for (std::size_t at = 0; at <= key.size() && node != nullptr;) {
    const std::string part = key.substr(at, key.find('.', at) - at);
    at += part.size() + 1;
    node = node->is_table() ? node->as_table()->get(part) : node->as_array()->get(std::stoul(part));
  }
  return node == nullptr ? nullptr : node->as_array();
}

TEST(EditedText, InsertsElementsBetweenOthers) {
  RandomText random(3);
  int inserted = 0;
  for (int round = 0; round < static_cast<int>(test::tried(40000)); ++round) {
    const std::string text = random.text();
    toml::table truth = toml::parse(text);
    const std::string key = random_key(random, truth);
    std::string edited;
    try {
      edited = with_element(text, key, "4242");
    } catch (const UsageError&) {
      continue;
    }
    const std::size_t dot = key.rfind('.');
    toml::array* list = list_at(truth, key.substr(0, dot));
    ASSERT_NE(list, nullptr);
    list->insert(list->cbegin() + static_cast<std::ptrdiff_t>(std::stoul(key.substr(dot + 1))),
                 4242);
    ASSERT_EQ(toml::parse(edited), truth) << text << "\n--- " << key << "\n" << edited;
    ASSERT_EQ(kept_comments(random, edited), random.comments().size()) << text << "\n" << edited;
    ++inserted;
  }
  EXPECT_GT(inserted, static_cast<int>(test::tried(1000)));
}

}  // namespace
}  // namespace hiac
