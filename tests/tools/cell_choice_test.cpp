// --threshold and --block of hiac-render: the pictures of hiac-convert and hiac-render one after
// the other.

#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "tests/tools/steps/step_files.hpp"

namespace hiac::test {
namespace {

using testing::HasSubstr;

class CellChoice : public StepFiles {
 protected:
  /// Expects the same bytes of a picture of `input` with these options and of one of what
  /// hiac-convert makes of it by them.
  void expect_same(const std::string& input, const std::string& options, const std::string& view) {
    ASSERT_EQ(run("$RENDER " + input + " " + options + view + " -o direct.png"), 0) << complaint();
    log_ = complaint();
    ASSERT_EQ(run("$CONVERT -q " + input + " " + options + " -o kept.zoo"), 0) << complaint();
    ASSERT_EQ(run("$RENDER -q kept.zoo" + view + " -o after.png"), 0) << complaint();
    ASSERT_EQ(run("$RENDER -q " + input + view + " -o whole.png"), 0) << complaint();
    const std::string direct = bytes_of(file("direct.png"));
    EXPECT_FALSE(direct.empty());
    EXPECT_EQ(direct, bytes_of(file("after.png"))) << input << ' ' << options;
    EXPECT_NE(direct, bytes_of(file("whole.png"))) << input << ' ' << options;
  }

  std::string log_;
};

TEST_F(CellChoice, PicturesAreThoseOfTheConvertedMesh) {
  const std::string view = " --view view.toml", starter = " --size 40x30";
  for (const std::string& how : {view, starter}) {
    expect_same("part1.zoo", "--threshold T=1,", how);
    EXPECT_THAT(log_, HasSubstr("hiac-render: --threshold T=1,: "));
    EXPECT_THAT(log_, HasSubstr("of 48 cells are kept"));
    expect_same("part1.zoo", "--threshold position:x=0.2,0.7", how);
    expect_same("still.msh", "--threshold T=,1.5", how);
    EXPECT_THAT(log_, HasSubstr("--threshold T=,1.5: "));
    expect_same("still.msh", "--block right", how);
    expect_same("still.msh", "--block left --threshold T=-1,2.5", how);
  }
}

TEST_F(CellChoice, AStoredOrderOfAllCellsIsNotThatOfSome) {
  ASSERT_EQ(run("$SORT -q part1.zoo --view view.toml | cat >ordered.zoo"), 0) << complaint();
  ASSERT_EQ(run("$RENDER -q ordered.zoo --threshold T=1, --view view.toml -o a.png"), 0)
      << complaint();
  ASSERT_EQ(run("$RENDER -q part1.zoo --threshold T=1, --view view.toml -o b.png"), 0);
  EXPECT_EQ(bytes_of(file("a.png")), bytes_of(file("b.png")));
  ASSERT_EQ(run("$SORT -q part1.zoo --view view.toml -o all.order"), 0);
  EXPECT_EQ(run("$RENDER part1.zoo --threshold T=1, --order all.order --view view.toml -o c.png"),
            3);
}

TEST_F(CellChoice, SeriesChooseInEveryStep) {
  ASSERT_EQ(run("$CONVERT -q still.msh --steps all --threshold T=0.5, -o kept-%d.zoo"), 0);
  ASSERT_EQ(run("$RENDER -q kept-%d.zoo --view view.toml -o after%d.png"), 0) << complaint();
  ASSERT_EQ(run("$RENDER -q still.msh --steps all --threshold T=0.5, --view view.toml -o f%d.png"),
            0)
      << complaint();
  ASSERT_EQ(run("$CONVERT -q still.msh --steps all -o whole-%d.zoo"), 0);
  ASSERT_EQ(run("$RENDER -q whole-%d.zoo --threshold T=0.5, --view view.toml -o z%d.png"), 0);
  for (const std::string step : {"0", "1", "2"}) {
    const std::string truth = bytes_of(file("after" + step + ".png"));
    EXPECT_EQ(bytes_of(file("f" + step + ".png")), truth);
    EXPECT_EQ(bytes_of(file("z" + step + ".png")), truth);
  }
}

TEST_F(CellChoice, WrongUsageNamesTheOption) {
  const std::vector<std::pair<std::string, std::string>> rows{
      {"part1.zoo --block left", "--block left: part1.zoo is a zoo container, which has no blocks"},
      {"still.msh --block middle", "--block middle"},
      {"part1.zoo --threshold T", "--threshold T: FIELD=LOW,HIGH expected"},
      {"still.msh --threshold T", "--threshold T: FIELD=LOW,HIGH expected"},
      {"part1.zoo --threshold U=0,1", "--threshold U=0,1: field 'U'"}};
  for (const auto& [arguments, message] : rows) {
    EXPECT_EQ(run("$RENDER " + arguments + " --view view.toml -o a.png"), 2) << arguments;
    EXPECT_THAT(complaint(), HasSubstr(message)) << arguments;
  }
  EXPECT_EQ(run("$RENDER part1.zoo --threshold T=77,78 --view view.toml -o a.png"), 3);
  EXPECT_THAT(complaint(), HasSubstr("no cell has all of its values within these bounds"));
}

}  // namespace
}  // namespace hiac::test
