#include "tools/common/progress_bar.hpp"

#include <gtest/gtest.h>

namespace hiac::tools {
namespace {

TEST(ProgressBar, TellsStagesTilesAndFrames) {
  EXPECT_EQ(progress_text({{}, {"adjacency", 0, 0, 7.4}}), "adjacency, 7 s");
  EXPECT_EQ(progress_text({{}, {"tiles", 200, 0, 2}}), "tiles 0 %, 2 s");
  EXPECT_EQ(progress_text({{}, {"tiles", 200, 91, 91}}), "tiles 45 %, about 1 min 49 s left");
  EXPECT_EQ(progress_text({{"frames", 36, 12, 600}, {"tiles", 200, 91, 9}}),
            "frame 13 of 36, tiles 45 %, about 20 min 0 s left");
  EXPECT_EQ(progress_text({{"frames", 36, 0, 5}, {"order", 0, 0, 5}}), "frame 1 of 36, order, 5 s");
  EXPECT_EQ(progress_text({{"frames", 36, 36, 5}, {"write", 0, 0, 1}}),
            "frame 36 of 36, write, about 0 s left");
}

TEST(ProgressBar, DrawsWhatIsKnownInOneLine) {
  const Shown half{{}, {"tiles", 200, 100, 4}};
  EXPECT_EQ(progress_line("hiac-render", half, 200),
            "hiac-render: [##########..........] tiles 50 %, about 4 s left");
  EXPECT_EQ(progress_line("hiac-render", half, 20), "hiac-render: [######");
  EXPECT_EQ(progress_line("hiac-sort", {{}, {"read", 0, 0, 3}}, 200), "hiac-sort: read, 3 s");
  EXPECT_EQ(progress_line("x", {{"frames", 4, 4, 9}, {"write", 0, 0, 0}}, 30),
            "x: [####################] fram");
}

}  // namespace
}  // namespace hiac::tools
