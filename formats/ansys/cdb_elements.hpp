#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats::ansys {

/// How many nodes an element of the library type has, all mid-edge nodes given; 0 where it is no
/// solid that is known. `mesh200_shape` is key option 1 of MESH200.
std::size_t library_nodes(std::int64_t routine, std::int64_t mesh200_shape);

/// How elements of a library type (the 186 of SOLID186) are read; `nodes` is how many an element
/// has in the file. Node orders: the Ansys element reference, which for bricks and tetrahedra are
/// VTK's.
ForeignType element_type(std::int64_t routine, std::size_t nodes, std::int64_t mesh200_shape);

/// Makes the mid-edge nodes of a 20-node brick with repeated corners follow them: what Ansys writes
/// at edges that are one point means nothing, and of edges that are one the nodes that are there
/// count. `nodes` may hold kLeftOutNode.
void settle_collapsed_edges(std::span<std::int64_t> nodes);

}  // namespace hiac::formats::ansys
