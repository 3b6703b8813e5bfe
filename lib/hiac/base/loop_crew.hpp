#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "hiac/base/parallel.hpp"

namespace hiac {

/// Several processes that do the same with the same data, and share the work of loops: each takes
/// care of a part of the indices. All call the functions in the same order, each by one thread.
class LoopCrew {
 public:
  LoopCrew() = default;
  LoopCrew(const LoopCrew&) = delete;
  LoopCrew& operator=(const LoopCrew&) = delete;
  virtual ~LoopCrew() = default;

  /// This process's part of the indices below `count`. The parts of all, one after the other,
  /// are these indices.
  [[nodiscard]] virtual IndexRange own_part(std::size_t count) const = 0;
  /// What each process has made of its part, one after the other.
  [[nodiscard]] virtual std::vector<std::vector<std::byte>> of_all(
      std::span<const std::byte> own) const = 0;
};

/// LoopCrew::own_part; all of the indices where there is no crew.
inline IndexRange own_part(const LoopCrew* crew, std::size_t count) {
  return crew == nullptr ? IndexRange{0, count} : crew->own_part(count);
}

/// The items of all parts, from those of this process's part.
template <typename Item>
std::vector<Item> of_all_parts(const LoopCrew* crew, std::vector<Item> own) {
  static_assert(std::is_trivially_copyable_v<Item>);
  if (crew == nullptr) return own;
  const auto parts = crew->of_all(std::as_bytes(std::span<const Item>(own)));
  std::size_t bytes = 0;
  for (const auto& part : parts) bytes += part.size();
  std::vector<Item> all(bytes / sizeof(Item));
  std::size_t at = 0;
  for (const auto& part : parts) {
    if (!part.empty()) std::memcpy(all.data() + at, part.data(), part.size());
    at += part.size() / sizeof(Item);
  }
  return all;
}

}  // namespace hiac
