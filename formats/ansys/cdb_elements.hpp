#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats::ansys {

/// The most nodes that a command may give an element; elements have 20.
inline constexpr std::size_t kMostNodes = 64;

/// The number of nodes of an element of the library type, with all mid-edge nodes; 0 when it is not
/// a known solid. `mesh200_shape` is key option 1 of MESH200.
std::size_t library_nodes(std::int64_t routine, std::int64_t mesh200_shape);

/// How elements of a library type (the 186 of SOLID186) are read; `nodes` is the number of nodes of
/// an element in the file. Node orders: the Ansys element reference, which for bricks and
/// tetrahedra agrees with VTK.
ForeignType element_type(std::int64_t routine, std::size_t nodes, std::int64_t mesh200_shape);

/// Makes the mid-edge nodes of a 20-node brick with repeated corners consistent: a collapsed edge
/// takes its corner as its mid-edge node (the one that Ansys writes there is meaningless), and
/// where two edges coincide and one lacks its mid-edge node, both take the existing one. `nodes`
/// may hold kLeftOutNode.
void settle_collapsed_edges(std::span<std::int64_t> nodes);

}  // namespace hiac::formats::ansys
