#include "hiac/frame/surfaces/skin_sides.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/frame/surfaces/boundary_faces.hpp"
#include "tests/render/truth/general_meshes.hpp"

namespace hiac {
namespace {

// A tetrahedron's faces, as its corners' numbers, are 0 1 3, 1 2 3, 2 0 3 and 0 2 1.
TEST(SkinSides, AreTheEdgesOfTheFacesOnTheSkin) {
  const ZooMesh mesh = test::make_mesh(
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}},
      {{CellKind::tetrahedron4, {0, 1, 2, 3}}, {CellKind::tetrahedron4, {4, 2, 1, 3}}});
  const std::vector<std::uint8_t> faces{0b0101, 0b1000};
  const std::vector<SkinSide> sides = skin_sides(mesh, faces);
  struct Expected {
    NodeId low, high;
    CellId cell;
    int face;
    bool ascending;
  };
  const std::vector<Expected> expected{
      {0, 1, 0, 0, true},  {0, 2, 0, 2, false}, {0, 3, 0, 0, false},
      {0, 3, 0, 2, true},  {1, 2, 1, 3, true},  {1, 3, 0, 0, true},
      {1, 4, 1, 3, false}, {2, 3, 0, 2, false}, {2, 4, 1, 3, true}};
  ASSERT_EQ(sides.size(), expected.size());
  for (std::size_t k = 0; k < sides.size(); ++k) {
    EXPECT_EQ(sides[k].edge[0], expected[k].low) << k;
    EXPECT_EQ(sides[k].edge[1], expected[k].high) << k;
    EXPECT_EQ(sides[k].cell, expected[k].cell) << k;
    EXPECT_EQ(int{sides[k].face}, expected[k].face) << k;
    EXPECT_EQ(sides[k].ascending, expected[k].ascending) << k;
  }
  EXPECT_EQ(sides_at(sides, {0, 3}).data(), &sides[2]);
  EXPECT_EQ(sides_at(sides, {0, 3}).size(), 2U);
  EXPECT_EQ(sides_at(sides, {2, 4}).size(), 1U);
  EXPECT_TRUE(sides_at(sides, {3, 4}).empty());
  EXPECT_TRUE(sides_at(sides, {3, 0}).empty());
}

// On a closed surface every edge has two sides, passed in opposite directions.
TEST(SkinSides, OfAClosedSkinMeetInPairs) {
  const ZooMesh mesh = test::mixed_columns(2);
  const std::vector<SkinSide> sides = skin_sides(mesh, boundary_faces(mesh));
  EXPECT_GT(sides.size(), 100U);
  for (std::size_t k = 0; k < sides.size(); k += 2) {
    ASSERT_EQ(sides_at(sides, sides[k].edge).size(), 2U);
    EXPECT_EQ(sides[k].edge, sides[k + 1].edge);
    EXPECT_NE(sides[k].ascending, sides[k + 1].ascending);
  }
}

}  // namespace
}  // namespace hiac
