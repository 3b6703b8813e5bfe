#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace hiac {

/// The five shapes of the zoo (Williams, Max, Stein 1998, Appendix A).
enum class CellShape : std::uint8_t {
  tetrahedron,
  pyramid,
  prism,  ///< VTK's "wedge"
  wedge,  ///< the paper's anvil: a brick with one edge collapsed, 7 conventional nodes
  brick
};
inline constexpr std::size_t kShapeCount = 5;

/// Order of the interpolant along an edge.
enum class CellOrder : std::uint8_t { linear = 1, quadratic = 2, cubic = 3 };

/// The fifteen kinds: shape and order. The value is what the zoo container stores:
/// 3 * shape + order - 1.
enum class CellKind : std::uint8_t {
  tetrahedron4,
  tetrahedron10,
  tetrahedron20,
  pyramid5,
  pyramid13,
  pyramid21,
  prism6,
  prism15,
  prism24,
  wedge7,
  wedge18,
  wedge29,
  brick8,
  brick20,
  brick32
};
inline constexpr std::size_t kKindCount = 15;

constexpr CellShape shape_of(CellKind kind) {
  return static_cast<CellShape>(static_cast<unsigned>(kind) / 3);
}
constexpr CellOrder order_of(CellKind kind) {
  return static_cast<CellOrder>(static_cast<unsigned>(kind) % 3 + 1);
}
constexpr CellKind kind_of(CellShape shape, CellOrder order) {
  return static_cast<CellKind>(3 * static_cast<unsigned>(shape) + static_cast<unsigned>(order) - 1);
}

/// One face of a shape: its conventional nodes, counter-clockwise seen from outside the cell.
struct ShapeFace {
  std::uint8_t corner_count;  ///< 3 or 4
  std::array<std::uint8_t, 4> corners;
};

/// One edge of a shape: the two conventional nodes that it joins.
using ShapeEdge = std::array<std::uint8_t, 2>;

/// Topology of a shape; conventional nodes in VTK's order (the wedge's: see below).
///
///     tetrahedron   0 1 2 the base, 3 the apex
///     pyramid       0 1 2 3 the base, 4 the apex
///     prism         0 1 2 one triangle, 3 4 5 the other
///     brick         0 1 2 3 the bottom, 4 5 6 7 the top
///     wedge         the brick whose edge 6-7 is collapsed into node 6
struct ShapeTopology {
  std::string_view name;
  std::size_t corner_count;
  std::span<const ShapeEdge> edges;
  std::span<const ShapeFace> faces;
};

/// The topology of a shape. A table; throws nothing.
const ShapeTopology& topology_of(CellShape shape);
inline const ShapeTopology& topology_of(CellKind kind) { return topology_of(shape_of(kind)); }

/// Number of nodes: the corners, then (order - 1) on every edge in the edges' order, each edge
/// from its first corner to its second, then the face centres (cubic tetrahedron alone).
std::size_t node_count(CellKind kind);
inline std::size_t corner_count(CellKind kind) { return topology_of(kind).corner_count; }
inline std::size_t face_count(CellKind kind) { return topology_of(kind).faces.size(); }

/// "tetrahedron4", "brick20", ...
std::string_view kind_name(CellKind kind);
std::optional<CellKind> kind_from_name(std::string_view name);

/// The VTK cell type that has exactly this kind's nodes in this order, or none: the wedge (VTK has
/// no such cell) and the cubic serendipity kinds; the cubic tetrahedron is a Lagrange tetrahedron.
std::optional<int> vtk_cell_type(CellKind kind);

}  // namespace hiac
