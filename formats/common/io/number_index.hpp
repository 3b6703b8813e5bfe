#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace hiac::formats {

/// Finds the place of a number in a file's list of node or cell numbers, which may be sparse and in
/// any order. Consecutive numbers take no memory; numbers with few gaps take a table, others a
/// sorted list.
class NumberIndex {
 public:
  static constexpr std::size_t kNone = ~std::size_t{0};

  NumberIndex() = default;
  explicit NumberIndex(std::span<const std::int64_t> numbers);

  /// The place of the first entry with that number, or kNone.
  [[nodiscard]] std::size_t find(std::int64_t number) const {
    if (number < low_) return kNone;
    const auto offset = static_cast<std::uint64_t>(number) - static_cast<std::uint64_t>(low_);
    if (consecutive_) return offset < count_ ? offset : kNone;
    if (sorted_.empty()) return offset < table_.size() ? found(table_[offset]) : kNone;
    return find_sorted(number);
  }

  /// The places of entries that repeat the number of an earlier entry, each with the earlier place.
  [[nodiscard]] const std::vector<std::pair<std::size_t, std::size_t>>& repeated() const {
    return repeated_;
  }

 private:
  static constexpr std::uint32_t kHole = ~std::uint32_t{0};
  static std::size_t found(std::uint32_t place) { return place == kHole ? kNone : place; }
  [[nodiscard]] std::size_t find_sorted(std::int64_t number) const;
  void build_table(std::span<const std::int64_t> numbers, std::uint64_t range);
  void build_sorted(std::span<const std::int64_t> numbers);

  std::int64_t low_ = 0;
  std::size_t count_ = 0;
  bool consecutive_ = true;
  std::vector<std::uint32_t> table_;
  std::vector<std::pair<std::int64_t, std::size_t>> sorted_;
  std::vector<std::pair<std::size_t, std::size_t>> repeated_;
};

}  // namespace hiac::formats
