#pragma once

#include <cstdint>

#include "hiac/order/visibility_order.hpp"

namespace hiac {

/// The group of several cells that a position in VisibilityOrder::cells lies in; null where it lies
/// in none.
const CellGroup* group_of(const VisibilityOrder& order, std::uint32_t rank);

/// Where the first group begins that begins after a position; the largest number where none does.
std::uint32_t next_group_first(const VisibilityOrder& order, std::uint32_t rank);

}  // namespace hiac
