#include "formats/ansys/cdb_elements.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "formats/common/cells/solid_orders.hpp"

namespace hiac::formats::ansys {
namespace {

// Types by number of nodes: the Ansys element reference and its legacy types.
constexpr std::array<int, 18> kBricks8{5,  30, 45, 46, 62,  64,  65,  69,  70,
                                       73, 80, 96, 97, 107, 164, 185, 190, 278};
constexpr std::array<int, 15> kBricks20{89,  90,  95,  117, 122, 147, 186, 191,
                                        215, 216, 220, 226, 231, 236, 279};
constexpr std::array<int, 12> kTetrahedra10{87,  92,  98,  119, 123, 148,
                                            168, 187, 217, 221, 227, 232};
constexpr std::array<int, 3> kMoreTetrahedra10{237, 240, 291};
constexpr std::array<int, 3> kMoreBricks20{239, 225, 238};
constexpr std::array<int, 2> kTetrahedra4{72, 285};

/// Planes, shells, surfaces and contacts with eight or more nodes.
constexpr std::array<int, 30> kFlat8{53,  77,  78,  82,  83,  91,  93,  99,  113, 121,
                                     132, 146, 150, 152, 154, 156, 157, 170, 172, 174,
                                     183, 188, 189, 200, 213, 223, 230, 233, 281, 290};

template <std::size_t N>
bool has(const std::array<int, N>& types, std::int64_t routine) {
  return std::find(types.begin(), types.end(), routine) != types.end();
}

CellConversion conversion_of(std::size_t own, std::size_t nodes) {
  if (own == 20 && nodes == 20) return solid_conversion(CellKind::brick20);
  if ((own == 20 || own == 8) && nodes == 8) return solid_conversion(CellKind::brick8);
  if (own == 10 && nodes == 10) return solid_conversion(CellKind::tetrahedron10);
  if ((own == 10 || own == 4) && nodes == 4) return solid_conversion(CellKind::tetrahedron4);
  return {};
}

}  // namespace

std::size_t library_nodes(std::int64_t routine, std::int64_t mesh200_shape) {
  if (routine == 200) {
    constexpr std::array<std::size_t, 12> kNodes{0, 0, 0, 0, 0, 0, 0, 0, 4, 10, 8, 20};
    return mesh200_shape >= 0 && mesh200_shape < 12
               ? kNodes[static_cast<std::size_t>(mesh200_shape)]
               : 0;
  }
  if (has(kBricks8, routine)) return 8;
  if (has(kBricks20, routine) || has(kMoreBricks20, routine)) return 20;
  if (has(kTetrahedra10, routine) || has(kMoreTetrahedra10, routine)) return 10;
  return has(kTetrahedra4, routine) ? 4 : 0;
}

ForeignType element_type(std::int64_t routine, std::size_t nodes, std::int64_t mesh200_shape) {
  const std::size_t own = library_nodes(routine, mesh200_shape);
  ForeignType type{fmt::format("type{}", routine), nodes, kNoVolume};
  if (own > 0) type.conversion = conversion_of(own, nodes);
  // an unknown element with this many nodes may well be a solid
  else if (nodes >= 8 && !has(kFlat8, routine))
    type.conversion = {};
  return type;
}

void settle_collapsed_edges(std::span<std::int64_t> nodes) {
  constexpr std::size_t kCorners = 8;
  const auto edges = topology_of(CellShape::brick).edges;
  bool any = false;
  for (std::size_t i = 1; i < kCorners; ++i)
    for (std::size_t j = 0; j < i; ++j) any |= nodes[i] == nodes[j];
  if (!any) return;
  const auto ends = [&](std::size_t e) {
    return std::minmax(nodes[edges[e][0]], nodes[edges[e][1]]);
  };
  for (std::size_t e = 0; e < edges.size(); ++e) {
    std::int64_t& middle = nodes[kCorners + e];
    const auto [a, b] = ends(e);
    if (a == b) middle = a;
    for (std::size_t other = 0; other < e && a != b; ++other) {
      const auto [c, d] = ends(other);
      std::int64_t& twin = nodes[kCorners + other];
      if (a != c || b != d || twin == middle) continue;
      if (twin == kLeftOutNode)
        twin = middle;
      else if (middle == kLeftOutNode)
        middle = twin;
    }
  }
}

}  // namespace hiac::formats::ansys
