#include "formats/common/pieces/merge_pieces.hpp"

#include <algorithm>
#include <array>

#include <gmock/gmock.h>

#include "hiac/base/error.hpp"
#include "hiac/mesh/face_adjacency.hpp"

namespace hiac::formats {
namespace {

/// A unit brick at x0 with a node field that is `scale` times x.
Reading brick_at(double x0, double scale) {
  Reading piece;
  piece.mesh.kinds = std::vector{CellKind::brick8};
  piece.mesh.elems = std::vector<std::uint64_t>{0, 8};
  piece.mesh.nodes = std::vector<NodeId>{0, 1, 2, 3, 4, 5, 6, 7};
  std::vector<double> xyz;
  std::vector<double> field;
  for (const auto& [x, y, z] : std::vector<std::array<double, 3>>{{0, 0, 0},
                                                                  {1, 0, 0},
                                                                  {1, 1, 0},
                                                                  {0, 1, 0},
                                                                  {0, 0, 1},
                                                                  {1, 0, 1},
                                                                  {1, 1, 1},
                                                                  {0, 1, 1}}) {
    xyz.insert(xyz.end(), {x0 + x, y, z});
    field.push_back(scale * (x0 + x));
  }
  piece.mesh.xyz = std::move(xyz);
  piece.mesh.fields.push_back({"f", "", FieldLocation::node, 1, std::move(field)});
  piece.mesh.fields.push_back({"c", "", FieldLocation::cell, 1, std::vector<double>{x0}});
  return piece;
}

std::vector<Reading> pieces_of(Reading a, Reading b) {
  std::vector<Reading> pieces;
  pieces.push_back(std::move(a));
  pieces.push_back(std::move(b));
  return pieces;
}

TEST(MergePieces, NeighboursShareTheirFace) {
  const Reading whole = merge_pieces(pieces_of(brick_at(0, 1), brick_at(1, 1)), "pieces");
  validate(whole.mesh, "whole");
  EXPECT_EQ(whole.mesh.cell_count(), 2U);
  EXPECT_EQ(whole.mesh.node_count(), 12U);
  const FaceAdjacency adjacency = build_face_adjacency(whole.mesh);
  EXPECT_EQ(std::count(adjacency.neighbors.begin(), adjacency.neighbors.end(), kNoCell), 10);
  for (NodeId node = 0; node < 12; ++node)
    EXPECT_EQ(whole.mesh.fields[0].values[node], whole.mesh.position(node)[0]);
  EXPECT_EQ(whole.mesh.fields[1].values[1], 1);
  ASSERT_EQ(whole.notes.size(), 1U);
  EXPECT_THAT(whole.notes[0], testing::HasSubstr("4 nodes"));
}

TEST(MergePieces, DifferentValuesKeepTheirNodes) {
  const Reading whole = merge_pieces(pieces_of(brick_at(0, 1), brick_at(1, 2)), "pieces");
  validate(whole.mesh, "whole");
  EXPECT_EQ(whole.mesh.node_count(), 16U);
}

TEST(MergePieces, PiecesMustCarryTheSameFields) {
  Reading other = brick_at(1, 1);
  other.mesh.fields.pop_back();
  EXPECT_THROW(merge_pieces(pieces_of(brick_at(0, 1), std::move(other)), "pieces"), InputError);
}

TEST(MergePieces, EmptyPiecesDoNotMatter) {
  Reading empty;
  empty.mesh.elems = std::vector<std::uint64_t>{0};
  empty.notes.push_back("nothing here");
  const Reading whole = merge_pieces(pieces_of(std::move(empty), brick_at(0, 1)), "pieces");
  EXPECT_EQ(whole.mesh.cell_count(), 1U);
  EXPECT_THAT(whole.notes, testing::ElementsAre("nothing here"));
}

/// Gives a piece numbers of its nodes.
Reading with_numbers(Reading piece, std::vector<double> numbers) {
  piece.mesh.fields.push_back({"GlobalNodeId", "", FieldLocation::node, 1, std::move(numbers)});
  return piece;
}

TEST(MergePieces, NumbersOfTheWholeMeshJoinRoundedNodes) {
  // x = 1 + 1e-9, where the other piece has 1; the values of `f` follow
  const auto pieces = [](double off, std::vector<double> numbers) {
    return pieces_of(with_numbers(brick_at(0, 1), {0, 1, 2, 3, 4, 5, 6, 7}),
                     with_numbers(brick_at(1 + off, 1), std::move(numbers)));
  };
  const Reading whole = merge_pieces(pieces(1e-9, {1, 11, 12, 2, 5, 15, 16, 6}), "pieces");
  validate(whole.mesh, "whole");
  EXPECT_EQ(whole.mesh.node_count(), 12U);
  EXPECT_THAT(whole.notes, testing::Contains(testing::HasSubstr("by their 'GlobalNodeId'")));
  EXPECT_THAT(whole.notes, testing::Contains(testing::HasSubstr("differ by up to")));
  for (NodeId node = 0; node < 8; ++node)  // the first piece's count
    EXPECT_EQ(whole.mesh.position(node)[0], node % 4 == 1 || node % 4 == 2 ? 1 : 0);
  // a crack: other numbers at the same place
  EXPECT_EQ(merge_pieces(pieces(0, {21, 11, 12, 22, 25, 15, 16, 26}), "pieces").mesh.node_count(),
            16U);
}

TEST(MergePieces, NumbersThatAreNotThoseOfTheWholeMeshAreToldAndDoNotCount) {
  const std::vector<double> own{0, 1, 2, 3, 4, 5, 6, 7};
  for (const auto& [numbers, why] : std::vector<std::pair<std::vector<double>, std::string>>{
           {own, "one stands for different places"},
           {{8, 8, 9, 10, 11, 12, 13, 14}, "a piece has one twice"},
           {{0.5, 8, 9, 10, 11, 12, 13, 14}, "not all are whole"}}) {
    const Reading whole = merge_pieces(
        pieces_of(with_numbers(brick_at(0, 1), own), with_numbers(brick_at(1, 1), numbers)),
        "pieces");
    EXPECT_THAT(whole.notes, testing::Contains(testing::HasSubstr(why)));
  }
}

TEST(MergePieces, DifferentValuesOfOneNumberStayApart) {
  const Reading whole =
      merge_pieces(pieces_of(with_numbers(brick_at(0, 1), {0, 1, 2, 3, 4, 5, 6, 7}),
                             with_numbers(brick_at(1, 2), {1, 11, 12, 2, 5, 15, 16, 6})),
                   "pieces");
  EXPECT_EQ(whole.mesh.node_count(), 16U);
  EXPECT_THAT(whole.notes, testing::Contains(testing::HasSubstr("4 nodes of equal")));
}

TEST(MergePieces, CopiesOfCellsAreLeftOut) {
  const Reading whole = merge_pieces(pieces_of(brick_at(0, 1), brick_at(0, 1)), "pieces");
  validate(whole.mesh, "whole");
  EXPECT_EQ(whole.mesh.cell_count(), 1U);
  EXPECT_EQ(whole.mesh.node_count(), 8U);
  EXPECT_THAT(whole.notes, testing::Contains(testing::HasSubstr("left out 1 cells")));
}

}  // namespace
}  // namespace hiac::formats
