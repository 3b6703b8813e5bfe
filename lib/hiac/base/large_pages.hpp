#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>
#include <vector>

namespace hiac {

/// Asks the system to back this memory with large pages (2 MiB on x86) when it is first touched. An
/// array that is read in random order then costs fewer page-table walks, and one page fault instead
/// of 512. Does nothing for memory below a few large pages, or if the system has none. Contents do
/// not change.
void advise_large_pages(void* memory, std::size_t bytes);

/// Returns `count` zeros of T, in large pages if there are enough. For arrays with an entry per
/// cell or node.
template <typename T>
std::vector<T> large_vector(std::size_t count) {
  std::vector<T> elements;
  elements.reserve(count);
  advise_large_pages(elements.data(), count * sizeof(T));
  elements.resize(count);
  return elements;
}

/// Returns uninitialized working memory in large pages: the threads that fill it touch it first.
template <typename T>
requires std::is_trivially_default_constructible_v<T> std::unique_ptr<T[]> unset_array(
    std::size_t count) {
  auto elements = std::make_unique_for_overwrite<T[]>(count);
  advise_large_pages(elements.get(), count * sizeof(T));
  return elements;
}

}  // namespace hiac
