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

/// How a kind is written: Gmsh's number of the element type, and for each node of the element the
/// kind's node.
struct WrittenType {
  int number;
  std::vector<std::uint8_t> nodes;
};

/// None for kinds that Gmsh does not have (the wedges).
const std::optional<WrittenType>& written_type(CellKind kind);

}  // namespace hiac::formats::gmsh
