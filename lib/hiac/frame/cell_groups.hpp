#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hiac/order/visibility_order.hpp"

namespace hiac {

/// Positions in VisibilityOrder::cells that are drawn together: either the cells of one group,
/// whose order is found pixel by pixel, or cells in no group, which are in order.
struct CellRun {
  bool is_group;
  std::span<const std::uint32_t> ranks;
};

/// The first run of ascending positions; a run of cells in no group has at most `most` cells. There
/// must be at least one position.
CellRun first_run(const VisibilityOrder& order, std::span<const std::uint32_t> ranks,
                  std::size_t most);

}  // namespace hiac
