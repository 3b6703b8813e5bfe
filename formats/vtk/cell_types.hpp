#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "hiac/mesh/cell_kind.hpp"

namespace hiac::formats::vtk {

/// What becomes of a cell of a VTK type.
enum class CellFate : std::uint8_t {
  converted,    ///< it is one of the zoo's kinds
  no_volume,    ///< a point, a line, a surface
  unsupported,  ///< a volume that no kind of the zoo is
  wrong         ///< its number of nodes is not one that its type can have
};

/// How a cell of a VTK type and number of nodes is converted.
struct CellConversion {
  CellFate fate = CellFate::unsupported;
  CellKind kind{};
  /// node i of the kind is node permutation[i] of the VTK cell; empty: the same order. A cell of a
  /// linear type with as many nodes as a quadratic one has further nodes, which VTK ignores too.
  std::span<const std::uint8_t> permutation;
  /// Of an unsupported cell: the linear kind that its first nodes make, where they make one.
  std::optional<CellKind> corners;
};

/// How a cell of VTK type `type` with `nodes` nodes is converted. Node orders: see kTypes.
CellConversion conversion_of(int type, std::size_t nodes);

/// VTK's name of a cell type without its prefix: "Tetra", "QuadraticHexahedron", ...
std::string cell_type_name(int type);

}  // namespace hiac::formats::vtk
