// Structured blocks, their bricks and extents, and what else readers of many formats share: vectors
// by the names of their components, and the last of several definitions.
#include "formats/common/mesh/structured.hpp"

#include "formats/common/mesh/block_choice.hpp"
#include "formats/common/mesh/last_definitions.hpp"
#include "formats/common/mesh/vector_names.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::string extents_complaint(const std::vector<std::int64_t>& extents, std::size_t limit) {
  try {
    structured_block(extents, limit, "f");
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(Structured, BlocksHaveTheExtentsOfTheFile) {
  const auto points = [](const std::vector<std::int64_t>& extents) {
    return structured_block(extents, 1000, "f").points;
  };
  EXPECT_THAT(points({2, 3, 4}), ElementsAre(2, 3, 4));
  EXPECT_THAT(points({2, 3}), ElementsAre(2, 3, 1));
  EXPECT_THAT(points({7}), ElementsAre(7, 1, 1));
  EXPECT_THAT(points({2, 3, 4, -9}), ElementsAre(2, 3, 4));
  EXPECT_EQ(structured_block(std::vector<std::int64_t>{2, 3, 4}, 24, "f").point_count(), 24U);
  for (const std::vector<std::int64_t>& wrong :
       {std::vector<std::int64_t>{0, 3, 4}, {2, 0, 4}, {2, 3, 0}})
    EXPECT_EQ(extents_complaint(wrong, 1000),
              "f: a structured block has 0 points along an axis (1 or more expected)");
  EXPECT_EQ(extents_complaint({2, -3}, 1000),
            "f: a structured block has -3 points along an axis (1 or more expected)");
}

TEST(Structured, BlocksAreNotLargerThanTheFile) {
  EXPECT_EQ(extents_complaint({2, 3, 4}, 24), "none");
  EXPECT_EQ(extents_complaint({2, 3, 4}, 23),
            "f: a structured block of 2 x 3 x 4 points is more than the file can hold");
  EXPECT_EQ(extents_complaint({25}, 24),
            "f: a structured block of 25 x 1 x 1 points is more than the file can hold");
  EXPECT_EQ(extents_complaint({5, 5}, 24),
            "f: a structured block of 5 x 5 x 1 points is more than the file can hold");
  // whose product is 0 in 64 bits
  const std::int64_t large = std::int64_t{1} << 32;
  EXPECT_NE(extents_complaint({large, large}, ~std::size_t{0}), "none");
  EXPECT_NE(extents_complaint({large, large, 1}, ~std::size_t{0} - 1), "none");
}

TEST(Structured, SurfacesAndLinesHaveNoCells) {
  EXPECT_EQ((StructuredBlock{{2, 3, 5}}.cell_count()), 8U);
  for (const auto& points : std::vector<std::array<std::size_t, 3>>{
           {1, 3, 5}, {2, 1, 5}, {2, 3, 1}, {0, 3, 5}, {2, 0, 5}, {2, 3, 0}, {0, 0, 0}}) {
    const StructuredBlock block{points};
    EXPECT_EQ(block.cell_count(), 0U);
    ForeignMesh mesh;
    EXPECT_THAT(add_bricks(mesh, block, 0, {}, "flat"), IsEmpty());
    EXPECT_EQ(mesh.cell_count(), 0U);
    EXPECT_THAT(mesh.blocks, IsEmpty());
  }
}

// With the points at i, j, k every brick is a unit cube, in the zoo's order of its corners.
TEST(Structured, BricksStandBetweenTheirPoints) {
  const StructuredBlock block{{3, 4, 5}};
  ForeignMesh mesh;
  mesh.first_node = 100;
  mesh.cell_types.push_back(mesh.type_place("other", 0, kNoVolume));
  EXPECT_THAT(add_bricks(mesh, block, 7, {}, "b"), IsEmpty());
  ASSERT_EQ(mesh.cell_count(), 1U + 24);
  ASSERT_EQ(mesh.cell_nodes.size(), 8U * 24);
  ASSERT_EQ(mesh.blocks.size(), 1U);
  EXPECT_EQ(mesh.blocks[0].name, "b");
  EXPECT_EQ(mesh.blocks[0].cells[0].begin, 1U);
  EXPECT_EQ(mesh.blocks[0].cells[0].end, 25U);
  EXPECT_EQ(mesh.types[mesh.cell_types[24]].conversion.kind, CellKind::brick8);
  const auto reference = reference_nodes(CellKind::brick8);
  std::size_t entry = 0;
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 2; ++i)
        for (std::size_t n = 0; n < 8; ++n) {
          const auto point = static_cast<int>(mesh.cell_nodes[entry++] - 107);
          EXPECT_EQ(point % 3, i + reference[n][0]);
          EXPECT_EQ(point / 3 % 4, j + reference[n][1]);
          EXPECT_EQ(point / 12, k + reference[n][2]);
        }
}

TEST(Structured, BricksWithAHiddenPointAreLeftOut) {
  const StructuredBlock block{{4, 2, 2}};
  for (std::size_t point = 0; point < 16; ++point) {
    std::vector<bool> hidden(16, false);
    hidden[point] = true;
    ForeignMesh mesh;
    const auto kept = add_bricks(mesh, block, 0, hidden, "");
    std::vector<std::size_t> expected;
    for (std::size_t cell = 0; cell < 3; ++cell)
      if (point % 4 != cell && point % 4 != cell + 1) expected.push_back(cell);
    EXPECT_EQ(kept, expected) << point;
    EXPECT_EQ(mesh.cell_count(), expected.size());
    EXPECT_THAT(mesh.blocks, IsEmpty());
    for (std::size_t c = 0; c < expected.size(); ++c)
      EXPECT_EQ(mesh.cell_nodes[8 * c], static_cast<std::int64_t>(expected[c]));
  }
  ForeignMesh mesh;
  EXPECT_THAT(add_bricks(mesh, block, 0, std::vector<bool>(16, false), "b"), ElementsAre(0, 1, 2));
}

TEST(VectorNames, ThreeAxesOfOneStemAreAVector) {
  const auto vectors = [](const std::vector<std::string>& names) {
    std::string text;
    for (const VectorName& vector : vectors_among(names)) {
      text += vector.name;
      for (const std::size_t part : vector.parts) text += " " + std::to_string(part);
      text += "; ";
    }
    return text;
  };
  EXPECT_EQ(vectors({"VX", "VY", "VZ"}), "V 0 1 2; ");
  EXPECT_EQ(vectors({"p", "VZ", "q", "VX", "VY", "r"}), "p 0; V 3 4 1; q 2; r 5; ");
  EXPECT_EQ(vectors({"VX", "VY", "WZ"}), "VX 0; VY 1; WZ 2; ");
  EXPECT_EQ(vectors({"X", "Y", "Z"}), "X 0; Y 1; Z 2; ");
  EXPECT_EQ(vectors({"Vx", "Vy", "Vz"}), "Vx 0; Vy 1; Vz 2; ");
  EXPECT_EQ(vectors({"AX", "BX", "AY", "BY", "AZ", "BZ"}), "A 0 2 4; B 1 3 5; ");
  EXPECT_EQ(vectors({}), "");
}

TEST(LastDefinitions, OfPointsAndCellsCount) {
  std::vector<std::int64_t> numbers{5, 3, 5, -1, 3, 5};
  std::vector<double> xyz;
  for (int i = 0; i < 18; ++i) xyz.push_back(i);
  keep_last_points(numbers, xyz);
  EXPECT_THAT(numbers, ElementsAre(-1, 3, 5));
  EXPECT_THAT(xyz, ElementsAre(9, 10, 11, 12, 13, 14, 15, 16, 17));
  const std::vector<ForeignType> types{{"three", 3, kNoVolume}, {"one", 1, kNoVolume}};
  std::vector<std::int64_t> cells{7, 8, 7, 9, 8};
  std::vector<std::uint16_t> cell_types{0, 1, 1, 0, 0};
  std::vector<std::int64_t> nodes{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  keep_last_cells(cells, cell_types, nodes, types);
  EXPECT_THAT(cells, ElementsAre(7, 9, 8));
  EXPECT_THAT(cell_types, ElementsAre(1, 0, 0));
  EXPECT_THAT(nodes, ElementsAre(5, 6, 7, 8, 9, 10, 11));
}

TEST(BlockChoice, RefusalsNameTwentyBlocks) {
  std::vector<std::string> names;
  const auto said = [&] { return std::string(no_such_block("b", names, "f").what()); };
  EXPECT_EQ(said(), "block b: f has no named blocks");
  std::string listed;
  for (int n = 1; n <= 20; ++n) {
    names.push_back("n" + std::to_string(n));
    listed += (n > 1 ? ", " : "") + names.back();
  }
  EXPECT_EQ(said(), "block b: f has no such block (one of " + listed + " expected)");
  names.emplace_back("n21");
  EXPECT_EQ(said(), "block b: f has no such block (one of " + listed + ", ... expected)");
}

}  // namespace
}  // namespace hiac::formats
