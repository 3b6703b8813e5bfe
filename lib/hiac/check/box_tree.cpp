#include "hiac/check/box_tree.hpp"

#include <array>
#include <bit>
#include <numeric>
#include <utility>

#include "hiac/base/parallel.hpp"

namespace hiac {

BoxTree::BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  if (boxes_.empty()) return;
  std::iota(order_.begin(), order_.end(), 0U);
  // one half is rounded up: a level holds runs of at most ceil(n / 2^level) boxes
  std::size_t nodes = 1;
  for (std::size_t run = boxes_.size(); run > kLeaf; run = (run + 1) / 2) nodes = 2 * nodes + 1;
  around_.resize(nodes, Box::empty());
  build({0, static_cast<std::uint32_t>(boxes_.size()), 0});
}

void BoxTree::build(const Node& node) {
  constexpr std::uint32_t kParallel = 1 << 14;
  Box& around = around_[node.number];
  Box centres = Box::empty();
  for (std::uint32_t i = node.begin; i < node.end; ++i) {
    const Box& box = boxes_[order_[i]];
    around.include(box);
    std::array<double, 3> centre;
    for (std::size_t c = 0; c < 3; ++c) centre[c] = 0.5 * box.low[c] + 0.5 * box.high[c];
    centres.include(std::span<const double, 3>(centre));
  }
  if (node.is_leaf()) return;
  std::size_t axis = 0;
  for (std::size_t c = 1; c < 3; ++c)
    if (centres.high[c] - centres.low[c] > centres.high[axis] - centres.low[axis]) axis = c;
  const auto key = [&](std::uint32_t i) {
    return std::pair(0.5 * boxes_[i].low[axis] + 0.5 * boxes_[i].high[axis], i);
  };
  std::nth_element(order_.begin() + node.begin, order_.begin() + node.middle(),
                   order_.begin() + node.end,
                   [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  const std::array halves{node.left(), node.right()};
  if (node.end - node.begin < kParallel) {
    for (const Node& half : halves) build(half);
    return;
  }
  parallel_for(2, 1, [&](IndexRange range) {
    for (std::size_t h = range.begin; h < range.end; ++h) build(halves[h]);
  });
}

}  // namespace hiac
