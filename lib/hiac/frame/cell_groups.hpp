#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hiac/order/visibility_order.hpp"

namespace hiac {

/// Positions in VisibilityOrder::cells that are drawn together: those of one group, whose order is
/// found pixel by pixel, or some in no group, which are in order.
struct CellRun {
  bool is_group;
  std::span<const std::uint32_t> ranks;
};

/// The run that ascending positions begin with; of cells in no group `most` at most. There must be
/// a position.
CellRun first_run(const VisibilityOrder& order, std::span<const std::uint32_t> ranks,
                  std::size_t most);

}  // namespace hiac
