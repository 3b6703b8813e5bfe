#pragma once

#include <algorithm>
#include <cstddef>
#include <mutex>
#include <utility>
#include <vector>

#include "hiac/base/parallel.hpp"

namespace hiac {

/// Calls find(index, list) for every index below `count`, in parallel; find appends Items to the
/// list. Returns all Items in the order of the indices, for any number of threads.
template <typename Item, typename Find>
std::vector<Item> collect(std::size_t count, std::size_t grain, const Find& find) {
  using Part = std::pair<std::size_t, std::vector<Item>>;
  std::vector<Part> parts;
  std::mutex joining;
  parallel_for(count, grain, [&](IndexRange range) {
    std::vector<Item> found;
    for (std::size_t i = range.begin; i < range.end; ++i) find(i, found);
    const std::scoped_lock lock(joining);
    parts.emplace_back(range.begin, std::move(found));
  });
  std::ranges::sort(parts, {}, &Part::first);
  std::size_t total = 0;
  for (const Part& part : parts) total += part.second.size();
  std::vector<Item> all;
  all.reserve(total);
  for (const Part& part : parts) all.insert(all.end(), part.second.begin(), part.second.end());
  return all;
}

}  // namespace hiac
