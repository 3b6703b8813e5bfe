#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "hiac/mesh/cell_kind.hpp"

namespace hiac::formats {

/// What becomes of a cell of a format's own type.
enum class CellFate : std::uint8_t {
  converted,    ///< it is one of the zoo's kinds
  no_volume,    ///< a point, a line, a surface
  unsupported,  ///< a volume that no kind of the zoo is
  wrong         ///< its number of nodes is not one that its type can have
};

/// How a cell of a format's own type and number of nodes is converted.
struct CellConversion {
  CellFate fate = CellFate::unsupported;
  CellKind kind{};
  /// Node i of the kind is node permutation[i] of the format's cell; empty: the same order.
  std::span<const std::uint8_t> permutation;
  /// Of an unsupported cell: the linear kind that its corners make, where they make one; its node i
  /// is node permutation[i].
  std::optional<CellKind> corners;
  /// The cell has nodes beyond those of its kind; that they are left out is worth a note.
  bool further_nodes = false;
};

}  // namespace hiac::formats
