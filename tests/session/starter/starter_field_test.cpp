#include "hiac/session/starter/starter_field.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "tests/support/meshes.hpp"

namespace hiac::starter {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A thousand cells, so that ranks of percents are simple numbers.
ZooMesh thousand_cells() { return test::structured(10, test::Cut::bricks); }

using ValueOf = std::function<double(std::size_t)>;

ZooMesh& with_field(ZooMesh& mesh, const std::string& name, const ValueOf& value,
                    std::uint32_t components = 1) {
  std::vector<double> values(mesh.cell_count() * components);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = value(i);
  mesh.fields.push_back({name, "", FieldLocation::cell, components, std::move(values)});
  return mesh;
}

Choice choice_among(const std::vector<ValueOf>& fields) {
  ZooMesh mesh = thousand_cells();
  for (std::size_t k = 0; k < fields.size(); ++k)
    with_field(mesh, std::string(1, static_cast<char>('a' + k)), fields[k]);
  return choose_field(mesh, "", "m");
}

std::string chosen(const std::vector<ValueOf>& fields) { return choice_among(fields).field.name; }

/// Values that are no whole numbers, of so many levels, each as often as any other.
ValueOf levels(std::size_t count) {
  return [count](std::size_t i) { return 0.5 + static_cast<double>(i % count); };
}

TEST(StarterField, OutermostPercentsAreLeftOutWhereTheyAreMoreThanTwoThirdsOfTheRange) {
  // 0, 1/999, ... 998/999 and one larger: the ranks 9.99 and 989.01 have 0.01 and 0.99
  const auto ramp = [](double last) {
    return [last](std::size_t i) { return i == 999 ? last : static_cast<double>(i) / 999; };
  };
  const Choice whole = choice_among({ramp(2.93)});
  EXPECT_EQ(whole.low, 0);
  EXPECT_EQ(whole.high, 2.93);
  EXPECT_THAT(whole.notes, ElementsAre("shows 'a' from 0 to 2.93"));
  const Choice inner = choice_among({ramp(2.95)});
  EXPECT_NEAR(inner.low, 0.01, 1e-12);
  EXPECT_NEAR(inner.high, 0.99, 1e-12);
  EXPECT_THAT(inner.notes, ElementsAre("shows 'a' from 0.01 to 0.99: 98 percent of its values, "
                                       "which go from 0 to 2.95"));
  const auto outlier_below = [](std::size_t i) { return i == 7 ? -9 : 1 + std::sin(i) / 2; };
  EXPECT_THAT(choice_among({outlier_below}).notes[0], HasSubstr("which go from -9 to "));
  // one value apart from all others: nothing is left of the range within
  const Choice spike = choice_among({[](std::size_t i) { return i == 3 ? 1.5 : 0.5; }});
  EXPECT_EQ(spike.low, 0.5);
  EXPECT_EQ(spike.high, 1.5);
}

TEST(StarterField, TheEntropyOf64BinsDecides) {
  const ValueOf half = [](std::size_t i) { return i % 2 == 0 ? 0.5 : 1.5; };
  const ValueOf quarter = [](std::size_t i) { return i % 4 == 0 ? 0.5 : 1.5; };
  EXPECT_EQ(chosen({half, quarter}), "a");
  EXPECT_EQ(chosen({quarter, half}), "b");
  EXPECT_EQ(chosen({half, levels(3)}), "b");
  EXPECT_EQ(chosen({levels(8), levels(4)}), "a");
  EXPECT_EQ(chosen({levels(25), levels(40)}), "b");
  EXPECT_EQ(chosen({levels(50), levels(40)}), "a");
  // more levels than bins fill them no more evenly: 200 levels on 64 bins are three or four a bin
  EXPECT_EQ(chosen({levels(64), levels(200)}), "a");
  // far from zero as near it
  const auto far = [](double by) {
    return [by](std::size_t i) { return by + static_cast<double>(i % 40); };
  };
  EXPECT_EQ(chosen({half, far(1000.5)}), "b");
  EXPECT_EQ(chosen({half, far(-2000.5)}), "b");
  // the first of equals
  EXPECT_EQ(chosen({half, [&](std::size_t i) { return 9 - half(i); }}), "a");
  // values beyond the range count in its outer bins
  const auto outliers = [](std::size_t i) {
    return i < 5 ? 1e4 : i < 10 ? -1e4 : static_cast<double>(i % 2) + 0.5;
  };
  EXPECT_EQ(chosen({outliers, levels(3)}), "b");
  EXPECT_EQ(chosen({outliers, quarter}), "a");
}

TEST(StarterField, WholeNumbersComeLastAndNumberingsNotAtAll) {
  const ValueOf half = [](std::size_t i) { return i % 2 == 0 ? 0.5 : 1.5; };
  const ValueOf whole = [](std::size_t i) { return static_cast<double>(i % 50); };
  EXPECT_EQ(chosen({whole, half}), "b");
  EXPECT_EQ(chosen({half, whole}), "a");
  EXPECT_EQ(chosen({whole, [](std::size_t i) { return static_cast<double>(i % 3); }}), "a");
  const auto numbering = [](std::size_t i) { return 1007 - static_cast<double>(i); };
  const Choice none = choice_among({numbering});
  EXPECT_EQ(none.field.name, "position:z");
  EXPECT_TRUE(none.is_height);
  EXPECT_THAT(none.notes,
              ElementsAre("shows 'position:z' from 0 to 1, the height: none of 1 fields has finite "
                          "values that differ and are no numbering"));
  // with a gap, or with one number twice, they are values like others
  const auto gap = [&](std::size_t i) { return i == 0 ? 2000 : numbering(i); };
  const auto twice = [&](std::size_t i) { return i == 5 ? numbering(6) : numbering(i); };
  // steps of a half are no numbering
  const auto halves = [](std::size_t i) { return static_cast<double>(i) / 2; };
  for (const ValueOf& field : std::vector<ValueOf>{gap, twice, halves})
    EXPECT_EQ(chosen({field}), "a");
}

TEST(StarterField, FieldsThatAreNotFiniteOrConstantAreNotChosen) {
  const auto constant = [](std::size_t) { return 0.5; };
  const auto broken = [](std::size_t i) { return i == 9 ? std::nan("") : std::sqrt(i); };
  const auto infinite = [](std::size_t i) {
    return i == 9 ? std::numeric_limits<double>::infinity() : std::sqrt(i);
  };
  const Choice height = choice_among({constant, broken, infinite});
  EXPECT_TRUE(height.is_height);
  EXPECT_THAT(height.notes[0], HasSubstr("none of 3 fields has finite values"));
  const Choice fourth = choice_among({constant, broken, infinite, levels(2)});
  EXPECT_EQ(fourth.field.name, "d");
  EXPECT_FALSE(fourth.is_height);
  EXPECT_THAT(fourth.notes, ElementsAre("shows 'd' from 0.5 to 1.5, the one of 4 fields that says "
                                        "most"));
  const ZooMesh bare = thousand_cells();
  EXPECT_THAT(choose_field(bare, "", "m").notes,
              ElementsAre("shows 'position:z' from 0 to 1, the height: the mesh has no field"));
}

TEST(StarterField, NumbersTooLargeToShowAreLeftOut) {
  const auto huge = [](std::size_t i) {
    return i == 0 ? 1e101 : i == 1 ? -1e101 : i == 2 ? 1e100 : 0.5e100 * (1 + std::sin(i));
  };
  const Choice choice = choice_among({huge});
  EXPECT_EQ(choice.high, 1e100);
  EXPECT_GE(choice.low, 0);
}

TEST(StarterField, WhatIsAskedForIsShownAsItIs) {
  ZooMesh mesh = thousand_cells();
  with_field(mesh, "constant", [](std::size_t) { return 7; });
  with_field(
      mesh, "v", [](std::size_t i) { return std::sin(i); }, 3);
  with_field(
      mesh, "stress", [](std::size_t i) { return std::cos(i); }, 6);
  with_field(mesh, "none", [](std::size_t) { return std::nan(""); });
  const auto asked = [&](const std::string& name) { return choose_field(mesh, name, "m"); };
  EXPECT_EQ(asked("v").field.name, "v:magnitude");
  EXPECT_EQ(asked("v:y").field.name, "v:y");
  EXPECT_EQ(asked("stress").field.name, "stress:von_mises");
  EXPECT_EQ(asked("stress").field.components, 1U);
  EXPECT_EQ(asked("constant").low, 7);
  EXPECT_EQ(asked("constant").high, 7);
  EXPECT_THAT(asked("constant").notes, ElementsAre("shows 'constant' from 7 to 7"));
  EXPECT_FALSE(asked("position:z").is_height);
  EXPECT_THROW(asked("w"), UsageError);
  try {
    asked("none");
    ADD_FAILURE() << "not refused";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "m: field 'none': has no finite values");
  }
}

TEST(StarterField, ARangeThatIsGivenIsNoted) {
  Choice choice = choice_among({levels(4)});
  show_range(choice, {-2, 9.5});
  EXPECT_EQ(choice.low, -2);
  EXPECT_EQ(choice.high, 9.5);
  EXPECT_THAT(choice.notes, ElementsAre("shows 'a' from -2 to 9.5, the range of all steps"));
}

// The truth is the range of one mesh that has the values of all steps.
TEST(StarterField, TheRangeOfASeriesIsThatOfAllItsValues) {
  for (const double last : {2.0, 40.0}) {
    SeriesRange series("a");
    ZooMesh all = test::structured(20, test::Cut::bricks);
    std::vector<double> values;
    for (std::size_t step = 0; step < 8; ++step) {
      ZooMesh mesh = thousand_cells();
      with_field(mesh, "a", [&](std::size_t i) {
        return step == 5 && i < 3 ? last : std::sin(static_cast<double>(1000 * step + i));
      });
      const auto added = mesh.fields[0].values.view();
      values.insert(values.end(), added.begin(), added.end());
      series.add(mesh);
    }
    with_field(all, "a", [&](std::size_t i) { return values[i]; });
    const Choice truth = choose_field(all, "a", "m");
    EXPECT_EQ(series.range(), (std::array<double, 2>{truth.low, truth.high}));
    EXPECT_EQ(truth.high == last, last < 3);
  }
}

}  // namespace
}  // namespace hiac::starter
