// Nodes that are used, numbered anew, against a search through the list of nodes.
#include "hiac/mesh/parts/used_nodes.hpp"

#include <algorithm>
#include <random>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hiac/mesh/parts/chosen_tuples.hpp"

namespace hiac {
namespace {

TEST(UsedNodes, AreNumberedInTheirOrder) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 200; ++trial) {
    const std::size_t count = 1 + random() % 12;
    std::vector<NodeId> nodes(random() % 20);
    for (NodeId& node : nodes) node = static_cast<NodeId>(random() % count);
    std::vector<NodeId> truth = nodes;
    std::ranges::sort(truth);
    truth.erase(std::ranges::unique(truth).begin(), truth.end());
    std::vector<NodeId> renumbered = nodes;
    ASSERT_EQ(renumber_used_nodes(renumbered, count), truth) << trial;
    for (std::size_t i = 0; i < nodes.size(); ++i) EXPECT_EQ(truth[renumbered[i]], nodes[i]);
  }
}

TEST(ChosenTuples, ComeInTheOrderOfTheirNumbers) {
  const std::vector<double> values{0, 1, 10, 11, 20, 21};
  const std::vector<NodeId> numbers{2, 0, 2};
  EXPECT_THAT(chosen_tuples(std::span(values), 2, numbers),
              testing::ElementsAre(20, 21, 0, 1, 20, 21));
  EXPECT_THAT(chosen_tuples(std::span(values), 1, numbers), testing::ElementsAre(10, 0, 10));
}

}  // namespace
}  // namespace hiac
