// Which nodes of pieces are one, by numbers or places and within which rounding; the fields that
// pieces lack, their inventories and the marks of their cells.
#include "formats/common/pieces/common_nodes.hpp"

#include <cmath>

#include <fmt/format.h>

#include "formats/common/pieces/complete_fields.hpp"
#include "formats/common/pieces/merge_pieces.hpp"
#include "formats/common/pieces/piece_field.hpp"
#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Nodes along x, and a field of theirs.
ZooMesh nodes_at(const std::vector<double>& places, std::vector<double> values) {
  ZooMesh mesh;
  std::vector<double> xyz;
  for (const double x : places) xyz.insert(xyz.end(), {x, 0, 0});
  mesh.xyz = std::move(xyz);
  mesh.fields.push_back({"f", "", FieldLocation::node, 1, std::move(values)});
  return mesh;
}

ZooMesh numbered(ZooMesh mesh, const std::string& name, std::vector<double> numbers) {
  mesh.fields.push_back({name, "", FieldLocation::node, 1, std::move(numbers)});
  return mesh;
}

const std::vector<std::size_t> kTwoOfThree{0, 3, 6};

TEST(CommonNodes, AreFoundByPlacesAndValues) {
  const auto first = [](const std::vector<double>& values, const std::vector<double>& places,
                        const std::vector<std::size_t>& offsets) {
    return common_nodes(nodes_at(places, values), offsets, "").first;
  };
  const std::vector<double> places{0, 1, 2, 2, 0, 3};
  EXPECT_THAT(first({5, 6, 7, 7, 5, 9}, places, kTwoOfThree), ElementsAre(0, 1, 2, 2, 0, 5));
  // an other value, if only in its last bit, keeps a node; NaN is one with NaN, 0 is not with -0
  EXPECT_THAT(first({5, 6, 7, std::nextafter(7.0, 8.0), 5, 9}, places, kTwoOfThree),
              ElementsAre(0, 1, 2, 3, 0, 5));
  EXPECT_THAT(first({5, 6, NAN, NAN, 5, 9}, places, kTwoOfThree), ElementsAre(0, 1, 2, 2, 0, 5));
  EXPECT_THAT(first({0, 6, 7, 7, -0.0, 9}, places, kTwoOfThree), ElementsAre(0, 1, 2, 2, 4, 5));
  // two nodes of one piece in a place are the sides of a crack
  EXPECT_THAT(first({5, 5, 5, 5, 5, 5}, {0, 0, 2, 0, 2, 3}, kTwoOfThree),
              ElementsAre(0, 1, 2, 3, 2, 5));
  EXPECT_THAT(first({5, 5, 5, 5, 5, 5}, {0, 1, 2, 0, 0, 2}, kTwoOfThree),
              ElementsAre(0, 1, 2, 3, 4, 2));
  // three pieces
  EXPECT_THAT(first({5, 5, 5, 5, 5, 5}, {0, 1, 1, 0, 0, 1}, {0, 2, 4, 6}),
              ElementsAre(0, 1, 1, 0, 0, 1));
  EXPECT_EQ(common_nodes(nodes_at(places, {5, 6, 7, 7, 5, 9}), kTwoOfThree, "").by,
            "their equal coordinates and values");
}

TEST(CommonNodes, AreFoundByNumbersOfKnownNames) {
  const std::vector<double> numbers{8, 1, 9, 9, 8, 2};
  for (const char* name : {"mine", "GlobalNodeId", "GlobalNodeIds", "GlobalPointIds"}) {
    const ZooMesh mesh = numbered(nodes_at({0, 1, 2, 2, 0, 3}, {5, 6, 7, 7, 5, 9}), name, numbers);
    const CommonNodes common = common_nodes(mesh, kTwoOfThree, "mine");
    EXPECT_THAT(common.first, ElementsAre(0, 1, 2, 2, 0, 5));
    EXPECT_EQ(common.by, fmt::format("their '{}'", name));
    EXPECT_THAT(common.notes, IsEmpty());
  }
  // no numbers of nodes: of cells, of two components, of another name
  ZooMesh mesh = numbered(nodes_at({0, 1, 2, 2, 0, 3}, {5, 6, 7, 7, 5, 9}), "other", numbers);
  mesh.fields.push_back({"GlobalNodeId", "", FieldLocation::cell, 1, std::vector<double>{1}});
  mesh.fields.push_back(
      {"GlobalPointIds", "", FieldLocation::node, 2, std::vector<double>(12, 1.0)});
  EXPECT_EQ(common_nodes(mesh, kTwoOfThree, "").by, "their equal coordinates and values");
  // the name that is asked for goes first
  mesh = numbered(std::move(mesh), "GlobalNodeIds", numbers);
  EXPECT_EQ(common_nodes(mesh, kTwoOfThree, "other").by, "their 'other'");
}

// The largest coordinate is 4, the largest value 20: a hundred thousandth of these is allowed.
TEST(CommonNodes, OfOneNumberLieAtOnePlaceUpToRounding) {
  const auto found = [](double place, double value) {
    return common_nodes(
        numbered(nodes_at({0, -4, 2, 2 + place, 5e-6, 3}, {5, 6, -20, -20 + value, 5, NAN}),
                 "GlobalNodeId", {8, 1, 9, 9, 7, 2}),
        kTwoOfThree, "");
  };
  const CommonNodes same = found(0, 0);
  EXPECT_THAT(same.first, ElementsAre(0, 1, 2, 2, 4, 5));
  EXPECT_THAT(same.notes, IsEmpty());
  EXPECT_THAT(found(2e-5, 0).notes,
              ElementsAre("coordinates or values of common nodes differ by up to 5e-06 of the "
                          "largest one: those of the first piece count"));
  EXPECT_THAT(found(-1e-5, 1e-4).notes,
              ElementsAre("coordinates or values of common nodes differ by up to 5e-06 of the "
                          "largest one: those of the first piece count"));
  EXPECT_THAT(found(3.9e-5, 1.9e-4).first, ElementsAre(0, 1, 2, 2, 4, 5));
  const CommonNodes apart = found(0, 2.1e-4);
  EXPECT_THAT(apart.first, ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_THAT(apart.notes,
              ElementsAre("1 nodes of equal 'GlobalNodeId' have different values in the pieces and "
                          "stay apart"));
  const CommonNodes far = found(4.1e-5, 0);
  EXPECT_THAT(far.first, ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_THAT(far.notes, ElementsAre("'GlobalNodeId' does not number the nodes of all pieces, as "
                                     "one stands for different places: joined by places"));
  EXPECT_EQ(far.by, "their equal coordinates and values");
}

Reading piece_with(std::vector<Field> fields, std::size_t cells) {
  Reading piece;
  piece.mesh.kinds = std::vector<CellKind>(cells, CellKind::tetrahedron4);
  std::vector<std::uint64_t> elems;
  std::vector<NodeId> nodes;
  for (std::size_t cell = 0; cell <= cells; ++cell) elems.push_back(4 * cell);
  for (std::size_t cell = 0; cell < cells; ++cell) nodes.insert(nodes.end(), {0, 1, 2, 3});
  piece.mesh.elems = std::move(elems);
  piece.mesh.nodes = std::move(nodes);
  piece.mesh.xyz = std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 2, 2, 2};
  piece.mesh.fields = std::move(fields);
  return piece;
}

TEST(CompleteFields, WhatAPieceLacksIsNotKnownThere) {
  std::vector<Reading> pieces;
  pieces.push_back(
      piece_with({{"n", "K", FieldLocation::node, 2, std::vector<double>(10, 1.0)}}, 2));
  pieces.push_back(piece_with({{"c", "", FieldLocation::cell, 1, std::vector<double>{3}},
                               {"n", "", FieldLocation::corner, 1, std::vector<double>(4, 4.0)}},
                              1));
  pieces.push_back(
      piece_with({{"gone", "", FieldLocation::node, 1, std::vector<double>(5, 1.0)}}, 0));
  complete_fields(pieces, "f");
  EXPECT_THAT(pieces[2].mesh.fields, IsEmpty());
  for (const std::size_t p : {0, 1}) {
    const std::vector<Field>& fields = pieces[p].mesh.fields;
    ASSERT_EQ(fields.size(), 3U);
    EXPECT_EQ(fields[0].name, "n");
    EXPECT_EQ(fields[0].unit, "K");
    EXPECT_EQ(fields[0].components, 2U);
    EXPECT_EQ(fields[0].values.size(), 10U);
    EXPECT_EQ(fields[1].name, "c");
    EXPECT_EQ(fields[1].location, FieldLocation::cell);
    EXPECT_EQ(fields[1].values.size(), p == 0 ? 2U : 1U);
    EXPECT_EQ(fields[2].location, FieldLocation::corner);
    EXPECT_EQ(fields[2].values.size(), p == 0 ? 8U : 4U);
    for (std::size_t f = 0; f < 3; ++f)
      for (const double value : fields[f].values.view())
        EXPECT_EQ(std::isnan(value), (p == 0) != (f == 0)) << p << f;
  }
  EXPECT_THAT(pieces[0].notes, ElementsAre("field 'c' is missing in 1 files: NaN there",
                                           "field 'n' is missing in 2 files: NaN there"));
  EXPECT_THAT(pieces[1].notes, IsEmpty());
  pieces[1].mesh.fields[0].components = 1;
  try {
    complete_fields(pieces, "f");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "f: field 'n' has 2 components in one block and 1 in another");
  }
}

TEST(AddPiece, InventoriesAreAddedUp) {
  const auto inventory = [](std::size_t count, double low, double high, std::vector<double> times) {
    Inventory piece;
    piece.points = 10 * count;
    piece.cells = {{"tet", count, "tetrahedron4"}, {"tet", 1, "unsupported"}};
    piece.fields = {{"p", "node", "double", 1, 10 * count, low, high, count}};
    piece.times = std::move(times);
    return piece;
  };
  Inventory all = inventory(2, 1, 5, {});
  add_piece(all, inventory(3, -4, 2, {0.5}));
  Inventory third = inventory(4, 2, 9, {7});
  third.cells.push_back({"hex", 6, "brick8"});
  third.fields.push_back({"p", "cell", "float", 3, 8, 0, 1, 2});
  add_piece(all, third);
  EXPECT_EQ(all.points, 90U);
  EXPECT_THAT(all.times, ElementsAre(0.5));
  ASSERT_EQ(all.cells.size(), 3U);
  EXPECT_EQ(all.cells[0].count, 9U);
  EXPECT_EQ(all.cells[1].count, 3U);
  EXPECT_EQ(all.cells[2].count, 6U);
  ASSERT_EQ(all.fields.size(), 2U);
  EXPECT_EQ(all.fields[0].tuples, 90U);
  EXPECT_EQ(all.fields[0].low, -4);
  EXPECT_EQ(all.fields[0].high, 9);
  EXPECT_EQ(all.fields[0].not_finite, 9U);
  EXPECT_EQ(all.fields[1].tuples, 8U);
}

TEST(PieceField, MarksAreTakenOutAgain) {
  ZooMesh mesh = piece_with({}, 3).mesh;
  EXPECT_EQ(take_pieces(mesh), std::nullopt);
  mark_pieces(mesh, {1, 2, 2});
  mark_piece(mesh, 7);
  ASSERT_EQ(mesh.fields.size(), 1U);
  EXPECT_EQ(mesh.fields[0].location, FieldLocation::cell);
  EXPECT_EQ(mesh.fields[0].components, 1U);
  const auto pieces = take_pieces(mesh);
  ASSERT_TRUE(pieces);
  EXPECT_THAT(*pieces, ElementsAre(7, 7, 7));
  EXPECT_THAT(mesh.fields, IsEmpty());
  mark_pieces(mesh, {4, 0, 5});
  EXPECT_THAT(*take_pieces(mesh), ElementsAre(4, 0, 5));
  EXPECT_FALSE(PieceMarking::is_on());
  {
    const PieceMarking marking;
    EXPECT_TRUE(PieceMarking::is_on());
  }
  EXPECT_FALSE(PieceMarking::is_on());
}

}  // namespace
}  // namespace hiac::formats
