#include "hiac/check/box_tree.hpp"

#include <random>
#include <set>

#include <gtest/gtest.h>

namespace hiac {
namespace {

// Against asking every box, for sizes around those at which the tree gets another level.
TEST(BoxTree, FindsWhatABruteForceFinds) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> place(0, 40), size(0, 5);
  for (const std::size_t count : {0U, 1U, 5U, 6U, 7U, 12U, 13U, 50U, 97U, 700U}) {
    std::vector<Box> boxes(count);
    for (Box& box : boxes)
      for (std::size_t c = 0; c < 3; ++c) {
        box.low[c] = place(random);
        box.high[c] = box.low[c] + size(random);
      }
    if (count > 20) boxes[3] = boxes[4] = boxes[5];
    if (count > 20) boxes[7] = Box::empty();
    const BoxTree tree(boxes);
    for (std::size_t i = 0; i < std::min<std::size_t>(count, 60); ++i) {
      std::multiset<std::uint32_t> found, expected;
      tree.for_each_meeting(boxes[i], [&](std::uint32_t j) { found.insert(j); });
      for (std::uint32_t j = 0; j < count; ++j)
        if (boxes[j].meets(boxes[i])) expected.insert(j);
      EXPECT_EQ(found, expected) << count << " " << i;
    }
  }
}

}  // namespace
}  // namespace hiac
