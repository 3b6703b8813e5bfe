#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hiac {

/// Disjoint sets of the numbers below a count, which several threads may join at once. Every set's
/// root is its least number, whatever the order of the joins. Nearly linear: a root is linked below
/// a lesser one, and paths are halved (R. J. Anderson, H. Woll, "Wait-free parallel algorithms for
/// the union-find problem", 1991).
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count);

  /// Joins the sets of a and b.
  void join(std::uint32_t a, std::uint32_t b);

  /// The least number of a's set, while no thread joins.
  std::uint32_t root(std::uint32_t a);

  [[nodiscard]] std::size_t size() const { return parent_.size(); }

 private:
  std::vector<std::uint32_t> parent_;
};

/// The numbers of the sets, from 0 in the order of their roots, and how many there are.
struct SetNumbers {
  std::vector<std::uint32_t> of;  ///< of every element
  std::uint32_t count = 0;
};
SetNumbers number_sets(DisjointSets& sets);

}  // namespace hiac
