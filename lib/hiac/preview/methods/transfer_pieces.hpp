#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "hiac/frame/frame.hpp"

namespace hiac::preview {

/// A channel of a transfer function at a value, by the linear piece of an interval.
template <std::size_t N>
double channel(const TransferTable<N>& table, std::size_t c, std::size_t interval, double value) {
  return table.value[c][interval] + table.slope[c][interval] * (value - table.anchor[interval]);
}

/// Intervals that all of a cell's values are in, where least <= most.
struct IntervalRange {
  std::uint16_t least, most;
};

/// The intervals that hold all of a tetrahedron's values, whose entries in the mesh begin at
/// `entry`.
inline IntervalRange common_intervals(const FrameField& field, CellId cell, std::uint64_t entry,
                                      const std::array<NodeId, 4>& nodes) {
  IntervalRange range{0, 0xFFFF};
  for (std::size_t k = 0; k < 4; ++k) {
    const ScalarIntervals in = field.intervals[field.index(cell, entry + k, nodes[k])];
    range.least = std::max(range.least, in.low);
    range.most = std::min(range.most, in.high);
  }
  return range;
}

}  // namespace hiac::preview
