#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats::gmsh {

/// The element type with that number of the MSH format; none when there is no such type.
/// Numbers and node orders: the Gmsh reference manual, "MSH file format" and "Node ordering".
const ForeignType* element_type(std::int64_t number);

/// How a kind is written: the number of Gmsh's element type, and for each of its nodes the node of
/// the kind that it is.
struct WrittenType {
  int number;
  std::vector<std::uint8_t> nodes;
};

/// None for kinds that Gmsh has not (the wedges).
const std::optional<WrittenType>& written_type(CellKind kind);

}  // namespace hiac::formats::gmsh
