#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

namespace hiac {

/// A number that is ordered as the value, which is not NaN, is; both zeros have the same.
inline std::uint64_t key_of(double value) {
  constexpr std::uint64_t kSign = std::uint64_t{1} << 63U;
  const auto bits = std::bit_cast<std::uint64_t>(value + 0.0);
  return (bits & kSign) != 0 ? ~bits : bits | kSign;
}

/// The value with that key.
inline double value_of(std::uint64_t key) {
  constexpr std::uint64_t kSign = std::uint64_t{1} << 63U;
  return std::bit_cast<double>((key & kSign) != 0 ? key & ~kSign : ~key);
}

/// Finds the key of a rank among many, digit by digit, the most significant first: how many keys
/// share the digits found so far says which digit the rank lies in.
class RankedKey {
 public:
  explicit RankedKey(std::uint64_t rank) : rank_(rank) {}

  static constexpr unsigned kDigitBits = 16;
  static constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;

  [[nodiscard]] bool found() const { return below_ == 64; }
  [[nodiscard]] std::uint64_t key() const { return prefix_; }

  /// Counts a key's next digit, if it shares those found so far. `counts`: of every digit.
  template <typename Counts>
  void count(std::uint64_t key, Counts& counts) const {
    const std::uint64_t digits = key >> (64 - kDigitBits - below_);
    if (digits >> kDigitBits == prefix_) ++counts[digits & (kDigits - 1)];
  }
  /// Takes the next digit, from the counts of all keys.
  template <typename Counts>
  void take(const Counts& counts) {
    std::uint64_t digit = 0;
    while (rank_ >= counts[digit]) rank_ -= counts[digit++];
    prefix_ = prefix_ << kDigitBits | digit;
    below_ += kDigitBits;
  }

 private:
  std::uint64_t rank_;  // among the keys that share the digits found
  std::uint64_t prefix_ = 0;
  unsigned below_ = 0;  // bits found
};

}  // namespace hiac
