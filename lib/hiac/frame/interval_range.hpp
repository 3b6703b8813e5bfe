#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hiac/frame/transfer_table.hpp"

namespace hiac {

/// The range of intervals of a transfer function that contains a cell's scalars, inclusive.
struct IntervalRange {
  std::size_t low, high;
};

/// Whether all intervals of a range are marked as zero.
inline bool all_zero(const std::vector<std::uint8_t>& zero, IntervalRange range) {
  return std::all_of(zero.begin() + static_cast<std::ptrdiff_t>(range.low),
                     zero.begin() + static_cast<std::ptrdiff_t>(range.high) + 1,
                     [](std::uint8_t z) { return z != 0; });
}

/// Whether the volume neither absorbs nor emits where the scalars of colour and extinction lie in
/// these ranges. Where nothing absorbs, chromaticity has no effect.
inline bool is_empty_space(const OpticsTables& optics, IntervalRange color,
                           IntervalRange extinction) {
  return all_zero(optics.no_extinction, extinction) &&
         (!optics.emission || all_zero(optics.no_color, color));
}

}  // namespace hiac
