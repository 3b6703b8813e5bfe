#include "formats/common/io/written_digits.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>

namespace hiac::formats {
namespace {

/// The decimal digits of the shortest number that gives the value.
int digits_of(double value) {
  std::array<char, 32> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), std::abs(value),
                                          std::chars_format::scientific);
  if (error != std::errc()) return kMostDigits + 1;
  char* const exponent = std::find(text.data(), end, 'e');
  return static_cast<int>(
      std::count_if(text.data(), exponent, [](char c) { return c >= '0' && c <= '9'; }));
}

/// Whether the value is a small multiple of a power of two: its significand has 24 bits or fewer.
bool is_exact(double value) {
  constexpr int kFreeBits = 29;
  constexpr std::uint64_t kSignificand = (std::uint64_t{1} << 52U) - 1;
  return std::countr_zero(std::bit_cast<std::uint64_t>(value) & kSignificand) >= kFreeBits;
}

}  // namespace

double unit_of_last_digit(std::span<const double> values) {
  double largest = 0;
  int digits = 0;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    largest = std::max(largest, std::abs(value));
    if (is_exact(value)) continue;
    digits = std::max(digits, digits_of(value));
    if (digits > kMostDigits) return 0;
  }
  if (digits < kFewestDigits) return 0;
  return std::pow(10.0, std::floor(std::log10(largest)) - digits + 1);
}

}  // namespace hiac::formats
