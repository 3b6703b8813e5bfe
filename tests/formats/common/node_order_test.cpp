#include "formats/common/cells/node_order.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

#include "hiac/base/error.hpp"
#include "hiac/mesh/shape_functions.hpp"

namespace hiac::formats {
namespace {

using Vector = std::array<double, 3>;

/// A mesh of one cell of that kind whose nodes are at `points`.
ZooMesh one_cell(CellKind kind, const std::vector<Vector>& points) {
  ZooMesh mesh;
  mesh.kinds = std::vector{kind};
  mesh.elems = std::vector<std::uint64_t>{0, points.size()};
  std::vector<NodeId> nodes;
  std::vector<double> xyz;
  for (std::size_t i = 0; i < points.size(); ++i) {
    nodes.push_back(static_cast<NodeId>(i));
    xyz.insert(xyz.end(), points[i].begin(), points[i].end());
  }
  mesh.nodes = std::move(nodes);
  mesh.xyz = std::move(xyz);
  return mesh;
}

std::vector<Vector> reference_points(CellKind kind) {
  const auto nodes = reference_nodes(kind);
  return {nodes.begin(), nodes.end()};
}

std::string refusal(CellKind kind, const std::vector<Vector>& points) {
  std::vector<std::string> notes;
  try {
    check_edge_nodes(one_cell(kind, points), "cell", notes);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(NodeOrder, StraightCellsOfEveryKindPass) {
  for (std::size_t k = 0; k < kKindCount; ++k) {
    const auto kind = static_cast<CellKind>(k);
    EXPECT_EQ(refusal(kind, reference_points(kind)), "") << kind_name(kind);
  }
}

TEST(NodeOrder, AnyTwoEdgeNodesExchangedAreFound) {
  for (const CellKind kind : {CellKind::tetrahedron10, CellKind::pyramid13, CellKind::prism15,
                              CellKind::brick20, CellKind::tetrahedron20, CellKind::brick32}) {
    const std::size_t first = corner_count(kind);
    const std::size_t end =
        first + (static_cast<std::size_t>(order_of(kind)) - 1) * edge_count(kind);
    for (std::size_t i = first; i < end; ++i)
      for (std::size_t j = first; j < i; ++j) {
        auto points = reference_points(kind);
        std::swap(points[i], points[j]);
        EXPECT_THAT(refusal(kind, points), testing::HasSubstr("wrong node order"))
            << kind_name(kind) << " " << i << " " << j;
      }
  }
}

// Exodus lists a brick's side edges before its top ones, and Abaqus a tetrahedron's as VTK does
TEST(NodeOrder, ForeignBrickOrderIsFoundAlsoInFlatCells) {
  for (const double height : {1.0, 0.1, 0.001}) {
    auto points = reference_points(CellKind::brick20);
    for (Vector& point : points) point[2] *= height;
    std::rotate(points.begin() + 12, points.begin() + 16, points.end());
    EXPECT_THAT(refusal(CellKind::brick20, points), testing::HasSubstr("wrong node order"));
  }
}

TEST(NodeOrder, CurvedEdgesAndQuarterPointsPass) {
  // a third of a circle: the middle is tan(120/4)/2 = 0.289 edge lengths off the chord
  auto points = reference_points(CellKind::tetrahedron10);
  points[4][1] -= std::tan(std::numbers::pi / 6) / 2;
  EXPECT_EQ(refusal(CellKind::tetrahedron10, points), "");
  // a crack tip at node 0: its edges' nodes at the quarter points
  points = reference_points(CellKind::brick20);
  for (const std::size_t mid : {std::size_t{8}, std::size_t{11}, std::size_t{16}})
    for (double& x : points[mid]) x = x == 0.5 ? 0.25 : x;
  EXPECT_EQ(refusal(CellKind::brick20, points), "");
}

TEST(NodeOrder, FewWildNodesAreNotedAlone) {
  const auto points = reference_points(CellKind::tetrahedron10);
  constexpr std::size_t kCells = 100;
  std::vector<double> xyz;
  std::vector<NodeId> nodes;
  std::vector<std::uint64_t> elems{0};
  for (std::size_t c = 0; c < kCells; ++c) {
    for (std::size_t n = 0; n < points.size(); ++n) {
      nodes.push_back(static_cast<NodeId>(nodes.size()));
      Vector point = points[n];
      if (c == 7 && n == 5) point[2] -= 0.9;  // strongly bent
      xyz.insert(xyz.end(), point.begin(), point.end());
    }
    elems.push_back(nodes.size());
  }
  ZooMesh mesh;
  mesh.kinds = std::vector<CellKind>(kCells, CellKind::tetrahedron10);
  mesh.elems = std::move(elems);
  mesh.nodes = std::move(nodes);
  mesh.xyz = std::move(xyz);
  std::vector<std::string> notes;
  check_edge_nodes(mesh, "mesh", notes);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_THAT(notes[0], testing::HasSubstr("1 of 100 tetrahedron10 cells"));
  EXPECT_THAT(notes[0], testing::HasSubstr("cell 7"));
}

}  // namespace
}  // namespace hiac::formats
