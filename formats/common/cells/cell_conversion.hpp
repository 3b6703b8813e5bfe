#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "hiac/mesh/cell_kind.hpp"

namespace hiac::formats {

/// The outcome of the conversion of a cell of a format's own type.
enum class CellFate : std::uint8_t {
  converted,    ///< it is one of the zoo's kinds
  no_volume,    ///< a point, a line, a surface
  unsupported,  ///< a volume cell that the zoo has no kind for
  wrong         ///< its type cannot have this number of nodes
};

/// How a cell of a format's own type and number of nodes is converted.
struct CellConversion {
  CellFate fate = CellFate::unsupported;
  CellKind kind{};
  /// Node i of the kind is node permutation[i] of the format's cell; empty: the same order.
  std::span<const std::uint8_t> permutation;
  /// For an unsupported cell: the linear kind that its corners form, if there is one; its node i is
  /// node permutation[i].
  std::optional<CellKind> corners;
  /// The cell has more nodes than its kind; a note says that the further nodes are left out.
  bool further_nodes = false;
};

/// A conversion to `kind`.
constexpr CellConversion converted_to(CellKind kind,
                                      std::span<const std::uint8_t> permutation = {}) {
  return {CellFate::converted, kind, permutation, std::nullopt, false};
}
/// A volume cell that the zoo has no kind for; its corners form `corners`.
constexpr CellConversion unsupported_with(CellKind corners,
                                          std::span<const std::uint8_t> permutation = {}) {
  return {CellFate::unsupported, {}, permutation, corners, false};
}
inline constexpr CellConversion kUnsupported{CellFate::unsupported, {}, {}, std::nullopt, false};
/// A surface, a line, a point.
inline constexpr CellConversion kNoVolume{CellFate::no_volume, {}, {}, std::nullopt, false};
inline constexpr CellConversion kWrongCount{CellFate::wrong, {}, {}, std::nullopt, false};

}  // namespace hiac::formats
