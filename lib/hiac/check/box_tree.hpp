#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hiac/geometry/box.hpp"

namespace hiac {

/// Finds the boxes that meet a given one with a balanced tree, divided at the median of the centres
/// along the widest axis and built in parallel. About 32 bytes per box besides the boxes.
class BoxTree {
 public:
  explicit BoxTree(std::vector<Box> boxes);

  /// Calls visit(i) for every box i that meets `box`, in an order that depends only on the boxes.
  template <typename Visit>
  void for_each_meeting(const Box& box, const Visit& visit) const {
    if (!boxes_.empty()) descend({0, static_cast<std::uint32_t>(boxes_.size()), 0}, box, visit);
  }

  [[nodiscard]] const Box& box(std::uint32_t i) const { return boxes_[i]; }

 private:
  /// A node holds the run [begin, end) of `order_`; its halves are nodes 2 n + 1 and 2 n + 2.
  struct Node {
    std::uint32_t begin, end, number;

    [[nodiscard]] bool is_leaf() const { return end - begin <= kLeaf; }
    [[nodiscard]] std::uint32_t middle() const { return begin + (end - begin) / 2; }
    [[nodiscard]] Node left() const { return {begin, middle(), 2 * number + 1}; }
    [[nodiscard]] Node right() const { return {middle(), end, 2 * number + 2}; }
  };
  static constexpr std::uint32_t kLeaf = 6;

  void build(const Node& node);

  template <typename Visit>
  void descend(const Node& node, const Box& box, const Visit& visit) const {
    if (!around_[node.number].meets(box)) return;
    if (node.is_leaf()) {
      for (std::uint32_t i = node.begin; i < node.end; ++i)
        if (boxes_[order_[i]].meets(box)) visit(order_[i]);
      return;
    }
    descend(node.left(), box, visit);
    descend(node.right(), box, visit);
  }

  std::vector<Box> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Box> around_;  // the bounding box of every node
};

}  // namespace hiac
