// Cells that are kept or replaced, with the points that are made for them: fields, blocks, numbers
// and polyhedra follow.
#include "formats/common/mesh/mesh_rewrite.hpp"

#include <array>
#include <cmath>

#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// A triangle's three nodes, a polyhedron, a cell of two nodes, another polyhedron, a cell of two.
ForeignMesh five_cells() {
  ForeignMesh mesh;
  for (int point = 0; point < 6; ++point)
    for (const int c : {0, 1, 2}) mesh.xyz.push_back(10.0 * point + c);
  mesh.first_node = 3;
  mesh.types = {{"three", 3, kNoVolume}, {"two", 2, kNoVolume}, {"poly", 0, kUnsupported}};
  mesh.cell_types = {0, 2, 1, 2, 1};
  mesh.cell_nodes = {3, 4, 5, 6, 7, 8, 3};
  mesh.polyhedra = {{1, 3}, {4, 8}, {3, 3, 4, 5, 3, 6, 7, 8}};
  mesh.cell_numbers = {50, 51, 52, 53, 54};
  mesh.blocks = {{"front", {{0, 2}}}, {"back", {{2, 3}, {3, 5}}}};
  mesh.fields.push_back(field_of("node", FieldLocation::node, 2,
                                 {0, 100, 1, 101, 2, 102, 3, 103, 4, 104, -0.0, 105}));
  mesh.fields.push_back(field_of("cell", FieldLocation::cell, 1, {20, 21, 22, 23, 24}));
  mesh.fields.push_back(field_of("corner", FieldLocation::corner, 1, {0, 1, 2, 3, -0.0, 5, 6}));
  mesh.fields.push_back(field_of("short", FieldLocation::cell, 1, {7, 8}));
  return mesh;
}

TEST(MeshRewrite, WhatIsKeptStaysAsItIs) {
  ForeignMesh mesh = five_cells();
  MeshRewrite rewrite(mesh, "f");
  EXPECT_THAT(rewrite.nodes_of(0), ElementsAre(3, 4, 5));
  EXPECT_THAT(rewrite.nodes_of(1), IsEmpty());
  EXPECT_THAT(rewrite.nodes_of(4), ElementsAre(8, 3));
  for (std::size_t cell = 0; cell < 5; ++cell) rewrite.keep();
  EXPECT_EQ(rewrite.made_points(), 0U);
  rewrite.finish();
  const ForeignMesh before = five_cells();
  EXPECT_EQ(mesh.xyz, before.xyz);
  EXPECT_THAT(mesh.node_numbers, IsEmpty());
  EXPECT_EQ(mesh.cell_types, before.cell_types);
  EXPECT_EQ(mesh.cell_nodes, before.cell_nodes);
  EXPECT_EQ(mesh.cell_numbers, before.cell_numbers);
  EXPECT_EQ(mesh.polyhedra.cells, before.polyhedra.cells);
  EXPECT_EQ(mesh.polyhedra.ends, before.polyhedra.ends);
  EXPECT_EQ(mesh.polyhedra.faces, before.polyhedra.faces);
  for (std::size_t f = 0; f < mesh.fields.size(); ++f)
    EXPECT_EQ(mesh.fields[f].values(), before.fields[f].values());
  EXPECT_TRUE(std::signbit(mesh.fields[2].values()[4]));
}

TEST(MeshRewrite, NewCellsAndPointsHaveMeansOfTheOld) {
  ForeignMesh mesh = five_cells();
  MeshRewrite rewrite(mesh, "f");
  rewrite.replace();
  const std::int64_t a = rewrite.point({{1, 0.25}, {0, 0.75}}, 0);
  const std::int64_t b = rewrite.point({{5, 1.0}}, 0);
  EXPECT_EQ(a, 9);
  EXPECT_EQ(b, 10);
  EXPECT_EQ(rewrite.point({{0, 0.75}, {1, 0.25}}, 0), a);
  EXPECT_EQ(rewrite.point({{0, 0.25}, {1, 0.75}}, 7), 11);
  EXPECT_EQ(rewrite.made_points(), 3U);
  const std::vector<Weights> entries{{{2, 1.0}}, {{0, 0.5}, {1, 0.5}}};
  rewrite.add(1, std::array{a, b}, entries);
  rewrite.add(1, std::array<std::int64_t, 2>{3, 4}, {});
  rewrite.replace();  // the first polyhedron goes
  rewrite.keep();
  rewrite.keep();
  rewrite.replace();
  const std::vector<Weights> one{{{1, 1.0}}, {{0, 1.0}}, {{0, 0.5}, {1, 0.5}}};
  rewrite.add(0, std::array<std::int64_t, 3>{3, 8, a}, one);
  rewrite.finish();
  EXPECT_THAT(mesh.cell_types, ElementsAre(1, 1, 1, 2, 0));
  EXPECT_THAT(mesh.cell_nodes, ElementsAre(9, 10, 3, 4, 6, 7, 3, 8, 9));
  EXPECT_THAT(mesh.cell_numbers, ElementsAre(50, 50, 52, 53, 54));
  EXPECT_THAT(mesh.polyhedra.cells, ElementsAre(3));
  EXPECT_THAT(mesh.polyhedra.ends, ElementsAre(4));
  EXPECT_THAT(mesh.polyhedra.faces, ElementsAre(3, 6, 7, 8));
  const auto ranges = [&](std::size_t block) {
    std::vector<std::size_t> ends;
    for (const IndexRange& range : mesh.blocks[block].cells) {
      ends.push_back(range.begin);
      ends.push_back(range.end);
    }
    return ends;
  };
  EXPECT_THAT(ranges(0), ElementsAre(0, 2));
  EXPECT_THAT(ranges(1), ElementsAre(2, 3, 3, 5));
  ASSERT_EQ(mesh.xyz.size(), 27U);
  EXPECT_THAT(std::vector(mesh.xyz.begin() + 18, mesh.xyz.end()),
              ElementsAre(2.5, 3.5, 4.5, 50, 51, 52, 7.5, 8.5, 9.5));
  EXPECT_THAT(mesh.node_numbers, IsEmpty());
  const std::vector<double> node = mesh.fields[0].values();
  ASSERT_EQ(node.size(), 18U);
  EXPECT_THAT(std::vector(node.begin() + 12, node.end()),
              ElementsAre(0.25, 100.25, 0, 105, 0.75, 100.75));
  EXPECT_TRUE(std::signbit(node[14]));
  EXPECT_THAT(mesh.fields[1].values(), ElementsAre(20, 20, 22, 23, 24));
  const std::vector<double> corner = mesh.fields[2].values();
  ASSERT_EQ(corner.size(), 9U);
  EXPECT_EQ(corner[0], 2);
  EXPECT_EQ(corner[1], 0.5);
  EXPECT_TRUE(std::isnan(corner[2]) && std::isnan(corner[3]));
  EXPECT_THAT(std::vector(corner.begin() + 4, corner.end()), ElementsAre(3, 0, 6, 5, 5.5));
  // what did not fit before is for the receiver to refuse
  EXPECT_THAT(mesh.fields[3].values(), ElementsAre(7, 8));
}

// Where the file numbers its points, those that are made come behind the largest number.
TEST(MeshRewrite, MadePointsAreNumberedBehindTheOthers) {
  for (const auto& [numbers, first] :
       std::vector<std::pair<std::vector<std::int64_t>, std::int64_t>>{
           {{70, 10, 40, 20, 30, 60}, 71},
           {{-9, -8, -7, -6, -5, -4}, 9},
           {{0, 1, 2, 3, 4, 8}, 9}}) {
    ForeignMesh mesh = five_cells();
    mesh.node_numbers = numbers;
    MeshRewrite rewrite(mesh, "f");
    EXPECT_EQ(rewrite.place_of(numbers[3], 0), 3U);
    for (int cell = 0; cell < 5; ++cell) rewrite.replace();
    EXPECT_EQ(rewrite.point({{0, 0.5}, {1, 0.5}}, 0), first);
    EXPECT_EQ(rewrite.point({{0, 0.5}, {2, 0.5}}, 0), first + 1);
    rewrite.finish();
    std::vector<std::int64_t> expected = numbers;
    expected.insert(expected.end(), {first, first + 1});
    EXPECT_EQ(mesh.node_numbers, expected);
    EXPECT_EQ(mesh.cell_count(), 0U);
  }
}

TEST(MeshRewrite, PlacesOfNumbersThatThereAre) {
  ForeignMesh mesh = five_cells();
  const MeshRewrite rewrite(mesh, "f");
  EXPECT_EQ(rewrite.place_of(3, 0), 0U);
  EXPECT_EQ(rewrite.place_of(8, 0), 5U);
  const auto said = [&](std::int64_t number, std::size_t cell) {
    try {
      static_cast<void>(rewrite.place_of(number, cell));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(said(2, 2), "f: cell two 2: there is no node 2");
  EXPECT_EQ(said(9, 1), "f: cell poly 1: there is no node 9");
  EXPECT_EQ(said(kLeftOutNode, 0),
            "f: cell three 0: there is no node " + std::to_string(kLeftOutNode));
}

}  // namespace
}  // namespace hiac::formats
