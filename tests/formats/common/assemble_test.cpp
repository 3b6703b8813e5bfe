// The assembly on meshes made by hand: left-out nodes, sparse numbers, fields in all three places,
// steps and blocks.
#include "formats/common/mesh/assemble.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "formats/common/cells/solid_orders.hpp"
#include "formats/common/cells/sorted_tetrahedra.hpp"
#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Two tetrahedra of ten nodes, the second without the middle of its edge 0-1 (nodes 30, 10), on
/// points with sparse numbers; point 99 is not used.
ForeignMesh two_tetrahedra() {
  ForeignMesh mesh;
  const auto add = [&](std::int64_t number, double x, double y, double z) {
    mesh.node_numbers.push_back(number);
    for (const double v : {x, y, z}) mesh.xyz.push_back(v);
  };
  add(99, 9, 9, 9);
  add(10, 0, 0, 0);
  add(20, 1, 0, 0);
  add(30, 0, 1, 0);
  add(40, 0, 0, 1);
  add(51, 0.5, 0, 0);
  add(52, 0.5, 0.5, 0);
  add(53, 0, 0.5, 0);
  add(54, 0, 0, 0.5);
  add(55, 0.5, 0, 0.5);
  add(56, 0, 0.5, 0.5);
  add(60, -1, 0, 0);
  add(61, -0.5, 0.5, 0);
  add(62, -0.5, 0, 0);
  add(63, -0.5, 0, 0.5);
  mesh.types.push_back({"tet10", 10, solid_conversion(CellKind::tetrahedron10)});
  mesh.types.push_back({"tri3", 3, kNoVolume});
  mesh.cell_types = {0, 1, 0};
  mesh.cell_nodes = {10, 20, 30, 40, 51, 52, 53, 54,           55, 56, 10, 20,
                     30, 30, 60, 10, 40, 61, 62, kLeftOutNode, 56, 63, 54};
  mesh.blocks = {{"left", {{2, 3}}}, {"right", {{0, 2}}}};
  return mesh;
}

/// f(x, y, z) = x + 2 y + 3 z at the points, times `factor`.
std::vector<double> linear_field(const ForeignMesh& mesh, double factor) {
  std::vector<double> values;
  for (std::size_t p = 0; p < mesh.point_count(); ++p)
    values.push_back(factor *
                     (mesh.xyz[3 * p] + 2 * mesh.xyz[3 * p + 1] + 3 * mesh.xyz[3 * p + 2]));
  return values;
}

TEST(Assemble, LeftOutNodesGoToTheMiddleWithTheMeanOfTheFields) {
  ForeignMesh foreign = two_tetrahedra();
  foreign.fields.push_back(field_of("f", FieldLocation::node, 1, linear_field(foreign, 1)));
  std::vector<double> corner;
  for (std::size_t e = 0; e < foreign.cell_nodes.size(); ++e)
    corner.push_back(static_cast<double>(e));
  foreign.fields.push_back(field_of("c", FieldLocation::corner, 1, std::move(corner)));
  foreign.fields.push_back(field_of("k", FieldLocation::cell, 1, {5, 6, 7}));
  const Reading reading = assemble(std::move(foreign), {}, "m");
  const ZooMesh& mesh = reading.mesh;
  ASSERT_EQ(mesh.cell_count(), 2U);
  EXPECT_EQ(mesh.node_count(), 15U);
  EXPECT_THAT(reading.notes, testing::Contains(HasSubstr("1 mid-edge nodes that cells leave out")));
  EXPECT_THAT(reading.notes, testing::Contains(HasSubstr("1 tri3")));
  EXPECT_THAT(reading.notes, testing::Contains(HasSubstr("dropped 1 points")));
  const NodeId made = mesh.cell_nodes(1)[6];
  EXPECT_THAT(mesh.position(made), ElementsAre(0, 0.5, 0));
  for (NodeId n = 0; n < mesh.node_count(); ++n) {
    const auto x = mesh.position(n);
    EXPECT_DOUBLE_EQ(mesh.fields[0].values[n], x[0] + 2 * x[1] + 3 * x[2]);
  }
  // entries 13 to 22 are the second tetrahedron's; its node 6 lies between its nodes 2 and 0
  EXPECT_EQ(mesh.fields[1].values[10], 13);
  EXPECT_EQ(mesh.fields[1].values[16], 14);
  EXPECT_THAT(mesh.fields[2].values.view(), ElementsAre(5, 7));
}

TEST(Assemble, ACellWithoutAnyMiddleIsLinear) {
  ForeignMesh foreign = two_tetrahedra();
  for (std::size_t e = 17; e < 23; ++e) foreign.cell_nodes[e] = kLeftOutNode;
  const ZooMesh mesh = assemble(std::move(foreign), {}, "m").mesh;
  EXPECT_EQ(mesh.kinds[0], CellKind::tetrahedron10);
  EXPECT_EQ(mesh.kinds[1], CellKind::tetrahedron4);
}

TEST(Assemble, WrongNumbersAreNamed) {
  ForeignMesh foreign = two_tetrahedra();
  foreign.cell_nodes[15] = 77;
  const auto complaint = [](ForeignMesh mesh) {
    try {
      assemble(std::move(mesh), {}, "m");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(complaint(foreign), "m: cell tet10 3: there is no node 77");
  foreign = two_tetrahedra();
  foreign.cell_nodes[13] = kLeftOutNode;
  EXPECT_THAT(complaint(foreign), HasSubstr("corner 1 is left out"));
  foreign = two_tetrahedra();
  foreign.node_numbers[3] = 10;
  EXPECT_THAT(complaint(foreign), HasSubstr("node 10 is given twice, in two places"));
  foreign = two_tetrahedra();
  foreign.xyz[7] = std::nan("");
  EXPECT_THAT(complaint(foreign), HasSubstr("not finite"));
  foreign = two_tetrahedra();
  std::swap(foreign.cell_nodes[4], foreign.cell_nodes[5]);
  EXPECT_THAT(complaint(foreign), HasSubstr("wrong node order of tetrahedron10 cells"));
  foreign = two_tetrahedra();
  foreign.fields.push_back(field_of("f", FieldLocation::node, 1, {1, 2}));
  EXPECT_THAT(complaint(foreign),
              HasSubstr("field 'f' does not fit (15 values expected, 2 found)"));
}

TEST(Assemble, StepsAndBlocksAreChosen) {
  ForeignMesh foreign = two_tetrahedra();
  foreign.times = {1, 2.5};
  for (const std::size_t step : {0, 1}) {
    foreign.fields.push_back(
        field_of("f", FieldLocation::node, 1, linear_field(foreign, step == 0 ? 1 : 10)));
    foreign.fields.back().step = step;
  }
  foreign.fields.push_back(field_of("early", FieldLocation::cell, 1, {5, 6, 7}));
  foreign.fields.back().step = 0;
  const auto value_at_20 = [&](const ReadOptions& options) {
    return assemble(ForeignMesh(foreign), options, "m").mesh.fields[0].values[1];
  };
  EXPECT_EQ(value_at_20({}), 10);
  ReadOptions options;
  options.step = 0;
  EXPECT_EQ(value_at_20(options), 1);
  options = {};
  options.time = 2.5000001;
  EXPECT_EQ(value_at_20(options), 10);
  EXPECT_EQ(assemble(ForeignMesh(foreign), options, "m").mesh.fields.size(), 1U);
  options.time = 2;
  EXPECT_THROW(value_at_20(options), UsageError);
  const Reading last = assemble(ForeignMesh(foreign), {}, "m");
  EXPECT_THAT(last.notes, testing::Contains(HasSubstr("field 'early' is of time 1, its last")));
  options = {};
  options.block = "left";
  EXPECT_EQ(assemble(ForeignMesh(foreign), options, "m").mesh.cell_count(), 1U);
}

/// A row of `cubes` unit cubes in six tetrahedra each, all with their nodes in ascending order:
/// paths from the first corner to the last along the axes, in all orders; half of them left-handed.
ForeignMesh sorted_tetrahedra(std::int64_t cubes) {
  ForeignMesh mesh;
  for (std::int64_t i = 0; i <= cubes; ++i)
    for (const int corner : {0, 1, 2, 3})
      for (const double v : {static_cast<double>(i), corner / 2 * 1.0, corner % 2 * 1.0})
        mesh.xyz.push_back(v);
  mesh.types.push_back({"tet4", 4, solid_conversion(CellKind::tetrahedron4)});
  std::array<std::int64_t, 3> steps{1, 2, 4};
  for (std::int64_t i = 0; i < cubes; ++i) {
    std::ranges::sort(steps);
    do {
      mesh.cell_types.push_back(0);
      const std::int64_t first = 4 * i;
      for (const std::int64_t step :
           {std::int64_t{0}, steps[0], steps[0] + steps[1], std::int64_t{7}})
        mesh.cell_nodes.push_back(first + step);
    } while (std::ranges::next_permutation(steps).found);
  }
  return mesh;
}

std::size_t left_handed(const ForeignMesh& mesh) {
  std::size_t count = 0;
  for (std::size_t c = 0; c < mesh.cell_nodes.size(); c += 4) {
    const auto at = [&](std::size_t k, std::size_t axis) {
      return mesh.xyz[3 * static_cast<std::size_t>(mesh.cell_nodes[c + k]) + axis] -
             mesh.xyz[3 * static_cast<std::size_t>(mesh.cell_nodes[c]) + axis];
    };
    const double determinant = at(1, 0) * (at(2, 1) * at(3, 2) - at(2, 2) * at(3, 1)) -
                               at(1, 1) * (at(2, 0) * at(3, 2) - at(2, 2) * at(3, 0)) +
                               at(1, 2) * (at(2, 0) * at(3, 1) - at(2, 1) * at(3, 0));
    count += determinant < 0 ? 1 : 0;
  }
  return count;
}

TEST(SortedTetrahedra, AreTurnedWhereAllAreSorted) {
  ForeignMesh mesh = sorted_tetrahedra(4);
  ASSERT_EQ(left_handed(mesh), 12U);
  turn_sorted_tetrahedra(mesh);
  EXPECT_EQ(left_handed(mesh), 0U);
  EXPECT_THAT(mesh.notes, ElementsAre(HasSubstr("12 of 24 tetrahedra right-handed")));
  const ForeignMesh before = sorted_tetrahedra(4);
  for (std::size_t c = 0; c < mesh.cell_nodes.size(); c += 4)
    EXPECT_TRUE(
        std::is_permutation(&mesh.cell_nodes[c], &mesh.cell_nodes[c] + 4, &before.cell_nodes[c]));
}

TEST(SortedTetrahedra, StayWhereOneIsNotSortedOrTheyAreFew) {
  ForeignMesh mesh = sorted_tetrahedra(4);
  std::swap(mesh.cell_nodes[6], mesh.cell_nodes[7]);
  const auto nodes = mesh.cell_nodes;
  turn_sorted_tetrahedra(mesh);
  EXPECT_EQ(mesh.cell_nodes, nodes);
  ForeignMesh few = sorted_tetrahedra(3);
  turn_sorted_tetrahedra(few);
  EXPECT_EQ(left_handed(few), 9U);
  EXPECT_TRUE(few.notes.empty());
}

TEST(SortedTetrahedra, OfPointsThatAreNotThereStay) {
  ForeignMesh mesh = sorted_tetrahedra(4);
  mesh.cell_nodes[7] = 1000;
  const auto nodes = mesh.cell_nodes;
  turn_sorted_tetrahedra(mesh);
  EXPECT_EQ(mesh.cell_nodes, nodes);
}

}  // namespace
}  // namespace hiac::formats
