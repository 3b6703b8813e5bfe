#include "hiac/geometry/box.hpp"

#include <gtest/gtest.h>

namespace hiac {
namespace {

// A tetrahedron, and two nodes of no cell.
ZooMesh tetrahedron_and_nodes() {
  ZooMesh mesh;
  mesh.kinds = std::vector{CellKind::tetrahedron4};
  mesh.elems = std::vector<std::uint64_t>{0, 4};
  mesh.nodes = std::vector<NodeId>{1, 2, 3, 4};
  mesh.xyz = std::vector<double>{-9, 8, 7,    // of no cell
                                 1,  2, 3,    //
                                 4,  2, 3,    //
                                 1,  6, 3,    //
                                 1,  2, 15,   //
                                 5,  5, 99};  // of no cell
  return mesh;
}

TEST(Box, AroundCellsLeavesOutOtherNodes) {
  const Box box = box_of_cells(tetrahedron_and_nodes());
  EXPECT_EQ(box.low, (Vector{1, 2, 3}));
  EXPECT_EQ(box.high, (Vector{4, 6, 15}));
  EXPECT_EQ(box.diagonal(), 13);  // 3, 4 and 12
}

TEST(Box, AroundNodesTakesAll) {
  const Box box = box_of_nodes(tetrahedron_and_nodes());
  EXPECT_EQ(box.low, (Vector{-9, 2, 3}));
  EXPECT_EQ(box.high, (Vector{5, 8, 99}));
}

TEST(Box, OfNothingIsEmptyAndMeetsNothing) {
  const Box nothing = box_of_nodes({});
  EXPECT_GT(nothing.low[0], nothing.high[0]);
  EXPECT_EQ(nothing.diagonal(), 0);
  EXPECT_FALSE(nothing.meets({{-1, -1, -1}, {1, 1, 1}}));
  EXPECT_FALSE(nothing.meets(Box::empty()));
}

TEST(Box, OfOnePointHasNoDiagonal) {
  const Box point{{1e300, -1e300, 2}, {1e300, -1e300, 2}};
  EXPECT_EQ(point.diagonal(), 0);
}

// The length is that of a scaled box: squares of its sides would overflow.
TEST(Box, DiagonalOfLargeBoxesDoesNotOverflow) {
  EXPECT_DOUBLE_EQ((Box{{0, 0, 0}, {3e200, 4e200, 12e200}}.diagonal()), 13e200);
}

TEST(Box, IsClosed) {
  const Box box{{0, 0, 0}, {1, 1, 1}};
  EXPECT_TRUE(box.meets({{1, 1, 1}, {2, 2, 2}}));
  EXPECT_TRUE(box.meets({{-1, -1, -1}, {0, 0, 0}}));
  for (std::size_t c = 0; c < 3; ++c) {
    Box beside{{0, 0, 0}, {1, 1, 1}};
    beside.low[c] = 1.0000000000000002;
    beside.high[c] = 2;
    EXPECT_FALSE(box.meets(beside)) << c;
    EXPECT_FALSE(beside.meets(box)) << c;
  }
}

}  // namespace
}  // namespace hiac
