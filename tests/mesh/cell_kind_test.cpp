#include "hiac/mesh/cell_kind.hpp"

#include <map>
#include <set>

#include <gtest/gtest.h>

namespace hiac {
namespace {

constexpr std::array kShapes{CellShape::tetrahedron, CellShape::pyramid, CellShape::prism,
                             CellShape::wedge, CellShape::brick};

using UndirectedEdge = std::pair<unsigned, unsigned>;
UndirectedEdge undirected(unsigned a, unsigned b) { return std::minmax(a, b); }

TEST(CellKind, NumbersAreThreeTimesShapePlusOrder) {
  for (unsigned k = 0; k < kKindCount; ++k) {
    const auto kind = static_cast<CellKind>(k);
    EXPECT_EQ(kind_of(shape_of(kind), order_of(kind)), kind);
  }
  EXPECT_EQ(shape_of(CellKind::wedge18), CellShape::wedge);
  EXPECT_EQ(order_of(CellKind::wedge18), CellOrder::quadratic);
}

TEST(CellKind, NameEndsWithTheNumberOfNodes) {
  for (unsigned k = 0; k < kKindCount; ++k) {
    const auto kind = static_cast<CellKind>(k);
    EXPECT_EQ(kind_name(kind),
              std::string(topology_of(kind).name) + std::to_string(node_count(kind)));
    EXPECT_EQ(kind_from_name(kind_name(kind)), kind);
  }
  EXPECT_EQ(kind_from_name("brick27"), std::nullopt);
}

TEST(CellKind, NodeCountsAreThePapers) {
  EXPECT_EQ(node_count(CellKind::tetrahedron20), 20u);
  EXPECT_EQ(node_count(CellKind::pyramid13), 13u);
  EXPECT_EQ(node_count(CellKind::prism24), 24u);
  EXPECT_EQ(node_count(CellKind::wedge7), 7u);
  EXPECT_EQ(node_count(CellKind::wedge29), 29u);
  EXPECT_EQ(node_count(CellKind::brick32), 32u);
}

TEST(ShapeTopology, FulfilsEulersFormula) {
  for (const CellShape shape : kShapes) {
    const ShapeTopology& t = topology_of(shape);
    EXPECT_EQ(t.corner_count + t.faces.size(), t.edges.size() + 2) << t.name;
  }
}

TEST(ShapeTopology, EveryEdgeIsInTwoFacesThatRunAlongItInOppositeDirections) {
  for (const CellShape shape : kShapes) {
    const ShapeTopology& t = topology_of(shape);
    std::set<UndirectedEdge> edges;
    for (const auto& [a, b] : t.edges) edges.insert(undirected(a, b));
    ASSERT_EQ(edges.size(), t.edges.size()) << t.name;
    std::map<std::pair<unsigned, unsigned>, int> directed;
    for (const ShapeFace& face : t.faces)
      for (unsigned i = 0; i < face.corner_count; ++i) {
        const unsigned a = face.corners[i], b = face.corners[(i + 1) % face.corner_count];
        EXPECT_TRUE(edges.contains(undirected(a, b))) << t.name << ' ' << a << ' ' << b;
        ++directed[{a, b}];
      }
    EXPECT_EQ(directed.size(), 2 * t.edges.size()) << t.name;
    for (const auto& [edge, uses] : directed) EXPECT_EQ(uses, 1) << t.name;
  }
}

TEST(ShapeTopology, WedgeIsTheBrickWithEdge67Collapsed) {
  const auto collapsed = [](unsigned corner) { return corner == 7 ? 6u : corner; };
  const ShapeTopology& brick = topology_of(CellShape::brick);
  const ShapeTopology& wedge = topology_of(CellShape::wedge);
  std::set<UndirectedEdge> expected, found;
  for (const auto& [a, b] : brick.edges)
    if (collapsed(a) != collapsed(b)) expected.insert(undirected(collapsed(a), collapsed(b)));
  for (const auto& [a, b] : wedge.edges) found.insert(undirected(a, b));
  EXPECT_EQ(found, expected);
  ASSERT_EQ(wedge.faces.size(), brick.faces.size());
  for (std::size_t f = 0; f < 6; ++f) {
    std::set<unsigned> of_brick, of_wedge;
    for (const unsigned corner : brick.faces[f].corners) of_brick.insert(collapsed(corner));
    for (unsigned i = 0; i < wedge.faces[f].corner_count; ++i)
      of_wedge.insert(wedge.faces[f].corners[i]);
    EXPECT_EQ(of_wedge, of_brick);
  }
}

// vtkCellType.h
TEST(CellKind, VtkCellTypes) {
  EXPECT_EQ(vtk_cell_type(CellKind::tetrahedron4), 10);
  EXPECT_EQ(vtk_cell_type(CellKind::tetrahedron20), 71);
  EXPECT_EQ(vtk_cell_type(CellKind::prism6), 13);
  EXPECT_EQ(vtk_cell_type(CellKind::brick20), 25);
  EXPECT_EQ(vtk_cell_type(CellKind::wedge7), std::nullopt);
  EXPECT_EQ(vtk_cell_type(CellKind::pyramid21), std::nullopt);
}

}  // namespace
}  // namespace hiac
