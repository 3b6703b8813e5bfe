#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "hiac/mesh/cell_kind.hpp"

namespace hiac::formats::silo {

/// A type of zones: its kind of cells and Silo's node order.
struct ZoneType {
  CellKind kind;
  const char* name;
  std::span<const std::uint8_t>
      order;  ///< the zoo's nodes in Silo's list; empty when it is the same
  std::span<const std::uint8_t> turned;  ///< the same for zones that are inside out
};

/// The type with that number (DB_ZONETYPE_...), or by its number of nodes when the number is 0, as
/// in older files.
std::optional<ZoneType> zone_type(int type, int size);

/// Whether most of the zones with these nodes, one zone after another, are inside out. Judged by
/// the sign of the triple product at the first corner: base 0 1 2 (of a prism: outwards) and a
/// corner above it. `xyz`: the coordinates of all nodes.
bool are_inside_out(const ZoneType& type, std::span<const std::int64_t> nodes,
                    std::span<const double> xyz);

}  // namespace hiac::formats::silo
