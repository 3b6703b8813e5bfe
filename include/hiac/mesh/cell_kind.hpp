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

/// The topology of a shape; conventional nodes are in VTK's order (for the wedge, see below).
///
///     tetrahedron   0 1 2 the base, 3 the apex
///     pyramid       0 1 2 3 the base, 4 the apex
///     prism         0 1 2 one triangle, 3 4 5 the other
///     brick         0 1 2 3 the bottom, 4 5 6 7 the top
///     wedge         the brick whose edge 6-7 is collapsed into node 6
///
/// A cell is positively oriented when its faces, as listed here, turn counter-clockwise seen from
/// outside. For the tetrahedron, the pyramid and the brick that is the right-hand rule: the normal
/// of 0 1 2 points into the cell. **The prism is the other way round**: the normal of 0 1 2 points
/// out of it, away from 3 4 5. VTK documents its wedge, lists its faces and stores it in files in
/// this way, although VTK's own parametric coordinates of that cell are then left-handed.
///
/// Edges and faces are listed in VTK's order.
struct ShapeTopology {
  std::string_view name;
  std::size_t corner_count;
  std::span<const ShapeEdge> edges;
  std::span<const ShapeFace> faces;
};

/// The tables behind topology_of.
namespace shape_tables {

inline constexpr std::array<ShapeEdge, 6> kTetrahedronEdges{
    {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
inline constexpr std::array<ShapeFace, 4> kTetrahedronFaces{
    {{3, {0, 1, 3}}, {3, {1, 2, 3}}, {3, {2, 0, 3}}, {3, {0, 2, 1}}}};

inline constexpr std::array<ShapeEdge, 8> kPyramidEdges{
    {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}}};
inline constexpr std::array<ShapeFace, 5> kPyramidFaces{
    {{4, {0, 3, 2, 1}}, {3, {0, 1, 4}}, {3, {1, 2, 4}}, {3, {2, 3, 4}}, {3, {3, 0, 4}}}};

inline constexpr std::array<ShapeEdge, 9> kPrismEdges{
    {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}};
inline constexpr std::array<ShapeFace, 5> kPrismFaces{
    {{3, {0, 1, 2}}, {3, {3, 5, 4}}, {4, {0, 3, 4, 1}}, {4, {1, 4, 5, 2}}, {4, {2, 5, 3, 0}}}};

inline constexpr std::array<ShapeEdge, 11> kWedgeEdges{
    {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 6}}};
inline constexpr std::array<ShapeFace, 6> kWedgeFaces{{{4, {0, 4, 6, 3}},
                                                       {4, {1, 2, 6, 5}},
                                                       {4, {0, 1, 5, 4}},
                                                       {3, {3, 6, 2}},
                                                       {4, {0, 3, 2, 1}},
                                                       {3, {4, 5, 6}}}};

inline constexpr std::array<ShapeEdge, 12> kBrickEdges{{{0, 1},
                                                        {1, 2},
                                                        {2, 3},
                                                        {3, 0},
                                                        {4, 5},
                                                        {5, 6},
                                                        {6, 7},
                                                        {7, 4},
                                                        {0, 4},
                                                        {1, 5},
                                                        {2, 6},
                                                        {3, 7}}};
inline constexpr std::array<ShapeFace, 6> kBrickFaces{{{4, {0, 4, 7, 3}},
                                                       {4, {1, 2, 6, 5}},
                                                       {4, {0, 1, 5, 4}},
                                                       {4, {3, 7, 6, 2}},
                                                       {4, {0, 3, 2, 1}},
                                                       {4, {4, 5, 6, 7}}}};

inline constexpr std::array<ShapeTopology, kShapeCount> kTopologies{
    {{"tetrahedron", 4, kTetrahedronEdges, kTetrahedronFaces},
     {"pyramid", 5, kPyramidEdges, kPyramidFaces},
     {"prism", 6, kPrismEdges, kPrismFaces},
     {"wedge", 7, kWedgeEdges, kWedgeFaces},
     {"brick", 8, kBrickEdges, kBrickFaces}}};

}  // namespace shape_tables

/// The topology of a shape, from a table; does not throw.
constexpr const ShapeTopology& topology_of(CellShape shape) {
  return shape_tables::kTopologies[static_cast<std::size_t>(shape)];
}
constexpr const ShapeTopology& topology_of(CellKind kind) { return topology_of(shape_of(kind)); }

constexpr std::size_t corner_count(CellKind kind) { return topology_of(kind).corner_count; }
constexpr std::size_t edge_count(CellKind kind) { return topology_of(kind).edges.size(); }
constexpr std::size_t face_count(CellKind kind) { return topology_of(kind).faces.size(); }

/// Number of nodes: the corners, then (order - 1) on every edge in the edges' order, each edge
/// from its first corner to its second, then the face centres (cubic tetrahedron only) in the
/// faces' order.
constexpr std::size_t node_count(CellKind kind) {
  const std::size_t per_edge = static_cast<std::size_t>(order_of(kind)) - 1;
  const std::size_t on_faces = kind == CellKind::tetrahedron20 ? face_count(kind) : 0;
  return corner_count(kind) + per_edge * edge_count(kind) + on_faces;
}

/// Returns whether `value` is the number of a kind. Check this for every byte from outside.
constexpr bool is_kind(std::uint8_t value) { return value < kKindCount; }

/// "tetrahedron4", "brick20", ...
std::string_view kind_name(CellKind kind);
std::optional<CellKind> kind_from_name(std::string_view name);

/// Returns the VTK cell type with exactly this kind's nodes in this order. The wedge and the cubic
/// serendipity kinds have none; the cubic tetrahedron is a Lagrange tetrahedron.
std::optional<int> vtk_cell_type(CellKind kind);

}  // namespace hiac
