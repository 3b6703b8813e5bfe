#include "hiac/check/quality/disjoint_sets.hpp"

#include <numeric>
#include <utility>

namespace hiac {

DisjointSets::DisjointSets(std::size_t count) : parent_(count) {
  std::iota(parent_.begin(), parent_.end(), 0U);
}

std::uint32_t DisjointSets::root(std::uint32_t a) {
  for (;;) {
    std::uint32_t above = std::atomic_ref(parent_[a]).load(std::memory_order_relaxed);
    if (above == a) return a;
    const std::uint32_t next = std::atomic_ref(parent_[above]).load(std::memory_order_relaxed);
    // if another thread has changed it meanwhile, that is as good
    std::atomic_ref(parent_[a]).compare_exchange_weak(above, next, std::memory_order_relaxed);
    a = next;
  }
}

void DisjointSets::join(std::uint32_t a, std::uint32_t b) {
  for (;;) {
    a = root(a);
    b = root(b);
    if (a == b) return;
    if (a < b) std::swap(a, b);
    std::uint32_t expected = a;
    if (std::atomic_ref(parent_[a]).compare_exchange_strong(expected, b, std::memory_order_relaxed))
      return;
  }
}

SetNumbers number_sets(DisjointSets& sets) {
  SetNumbers numbers;
  numbers.of.resize(sets.size());
  for (std::uint32_t i = 0; i < sets.size(); ++i) {
    const std::uint32_t root = sets.root(i);
    numbers.of[i] = root == i ? numbers.count++ : numbers.of[root];
  }
  return numbers;
}

}  // namespace hiac
