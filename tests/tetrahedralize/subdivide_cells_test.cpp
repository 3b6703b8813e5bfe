#include "hiac/tetrahedralize/subdivide_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/geometry/predicates.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "hiac/tetrahedralize/cell_cut.hpp"
#include "tests/support/meshes.hpp"
#include "tests/tetrahedralize/elevated_mesh.hpp"

namespace hiac {
namespace {

using test::Cut;
using test::Position;

constexpr std::array kCuts{Cut::bricks, Cut::tetrahedra, Cut::prisms, Cut::pyramids};

// The structured mesh of the unit cube with its nodes numbered at random.
ZooMesh shuffled(Cut cut, std::size_t n, std::uint64_t seed) {
  const ZooMesh mesh = test::structured(n, cut);
  std::vector<NodeId> number(mesh.node_count());
  std::iota(number.begin(), number.end(), 0);
  std::mt19937_64 random(seed);
  std::shuffle(number.begin(), number.end(), random);
  std::vector<Position> positions(mesh.node_count());
  const std::vector<Position> before = test::positions_of(mesh);
  for (std::size_t i = 0; i < number.size(); ++i) positions[number[i]] = before[i];
  std::vector<test::Cell> cells = test::cells_of(mesh);
  for (test::Cell& cell : cells)
    for (NodeId& node : cell.nodes) node = number[node];
  return test::make_mesh(positions, cells);
}

double volume_of(const ZooMesh& mesh, CellId cell) {
  const auto nodes = mesh.cell_nodes(cell);
  std::array<Position, 3> e;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t c = 0; c < 3; ++c)
      e[k][c] = mesh.position(nodes[k + 1])[c] - mesh.position(nodes[0])[c];
  return (e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
          e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
          e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
         6;
}

// Tetrahedra that fill the unit cube, face to face.
void expect_fills_the_cube(const ZooMesh& mesh) {
  validate(mesh, "subdivided");
  double volume = 0;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    EXPECT_EQ(shape_of(mesh.kinds[cell]), CellShape::tetrahedron);
    EXPECT_GT(volume_of(mesh, cell), 1e-7);
    volume += volume_of(mesh, cell);
  }
  EXPECT_NEAR(volume, 1, 1e-12);
  const FaceAdjacency adjacency = build_face_adjacency(mesh);
  EXPECT_EQ(adjacency.overshared, 0U);
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
    for (std::size_t f = 0; f < 4; ++f) {
      if (adjacency.neighbors[4 * cell + f] != kNoCell) continue;
      const auto& corners = topology_of(CellShape::tetrahedron).faces[f].corners;
      bool on_side = false;
      for (std::size_t c = 0; c < 3; ++c)
        for (const double side : {0.0, 1.0}) {
          const auto at = [&](std::size_t k) {
            return std::abs(mesh.position(mesh.cell_nodes(cell)[corners[k]])[c] - side) < 1e-12;
          };
          on_side = on_side || (at(0) && at(1) && at(2));
        }
      EXPECT_TRUE(on_side) << "cell " << cell << " has a face without neighbour inside the cube";
    }
}

TEST(SubdivideCells, TetrahedraFillTheCellsFaceToFace) {
  for (const Cut cut : kCuts)
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      const ZooMesh mesh = shuffled(cut, 3, seed);
      const SubdividedMesh parts = subdivide_cells(mesh, {});
      expect_fills_the_cube(parts.mesh);
      EXPECT_EQ(parts.new_nodes, 0U);
      EXPECT_EQ(parts.dropped_nodes, 0U);
    }
}

// The mesh with its inner nodes pushed about.
ZooMesh pushed_inside(std::size_t n, double amplitude, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> push(-amplitude, amplitude);
  std::vector<Position> positions = test::positions_of(shuffled(Cut::bricks, n, seed));
  for (Position& p : positions)
    if (std::ranges::all_of(p, [](double x) { return x > 1e-9 && x < 1 - 1e-9; }))
      for (double& x : p) x += push(random);
  return test::make_mesh(positions, test::cells_of(shuffled(Cut::bricks, n, seed)));
}

// How many tetrahedra of bricks that are cut from their corners of the least number are turned
// inside out.
std::size_t turned_from_least_corners(const ZooMesh& mesh) {
  std::size_t turned = 0;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    const auto nodes = mesh.cell_nodes(cell);
    const CellCut cut = cut_cell(mesh.kinds[cell], nodes.first(8));
    for (const auto& [a, b, c, d] : cut.all())
      turned += orientation(mesh.position(nodes[a]), mesh.position(nodes[b]),
                            mesh.position(nodes[c]), mesh.position(nodes[d])) < 0
                    ? 1
                    : 0;
  }
  return turned;
}

TEST(SubdivideCells, CellsWithFacesThatAreNotPlanarAreFilled) {
  std::size_t turned = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const ZooMesh mesh = pushed_inside(4, 0.08, seed);
    turned += turned_from_least_corners(mesh);
    const SubdividedMesh parts = subdivide_cells(mesh, {});
    expect_fills_the_cube(parts.mesh);
    EXPECT_EQ(parts.dropped_tetrahedra, 0U);
  }
  EXPECT_GT(turned, 2U);
}

// A stack of layers much thinner than they are warped, whose corners come in random order by x:
// opposite faces have to be cut alike.
TEST(SubdivideCells, ThinWarpedLayersAreCutWithoutTurningTetrahedraInsideOut) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> push(-1e-6, 1e-6);
  for (int trial = 0; trial < 20; ++trial) {
    constexpr std::size_t kLayers = 12, kSide = 2;
    std::vector<NodeId> number((kLayers + 1) * (kSide + 1) * (kSide + 1));
    std::iota(number.begin(), number.end(), 0);
    std::ranges::shuffle(number, random);
    const auto node = [&](std::size_t i, std::size_t j, std::size_t k) {
      return number[(k * (kSide + 1) + j) * (kSide + 1) + i];
    };
    std::vector<Position> positions(number.size());
    std::vector<test::Cell> cells;
    for (std::size_t k = 0; k <= kLayers; ++k)
      for (std::size_t j = 0; j <= kSide; ++j)
        for (std::size_t i = 0; i <= kSide; ++i) {
          const auto x = static_cast<double>(i), y = static_cast<double>(j);
          positions[node(i, j, k)] = {x + push(random), y,
                                      0.2 * x * y + 1e-3 * static_cast<double>(k)};
          if (i == kSide || j == kSide || k == kLayers) continue;
          cells.push_back({CellKind::brick8,
                           {node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k),
                            node(i, j + 1, k), node(i, j, k + 1), node(i + 1, j, k + 1),
                            node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1)}});
        }
    const SubdividedMesh parts = subdivide_cells(test::make_mesh(positions, cells), {});
    for (CellId cell = 0; cell < parts.mesh.cell_count(); ++cell)
      ASSERT_GT(volume_of(parts.mesh, cell), 0) << trial;
    // faces without neighbour are the triangles of the boundary's quadrilaterals
    const FaceAdjacency adjacency = build_face_adjacency(parts.mesh);
    EXPECT_EQ(std::ranges::count(adjacency.neighbors, kNoCell),
              2 * (2 * kSide * kSide + 4 * kSide * kLayers));
  }
}

// Two bricks with a warped face between them of which each has nodes of its own.
TEST(SubdivideCells, FacesWithNodesOfTheirOwnAtTheSamePlacesAreCutAlike) {
  std::mt19937_64 random(4);
  std::vector<NodeId> number(16);
  std::iota(number.begin(), number.end(), 0);
  for (int trial = 0; trial < 30; ++trial) {
    std::ranges::shuffle(number, random);
    std::vector<Position> positions(16);
    std::vector<test::Cell> cells{{CellKind::brick8, {}}, {CellKind::brick8, {}}};
    for (std::size_t b = 0; b < 2; ++b)
      for (std::size_t n = 0; n < 8; ++n) {
        const double x = n % 4 == 1 || n % 4 == 2 ? 1 : 0, y = n % 4 >= 2 ? 1 : 0;
        const std::size_t layer = b + n / 4;
        const double z = static_cast<double>(layer) + (layer == 1 && n % 4 == 2 ? 0.3 : 0);
        positions[number[8 * b + n]] = {x, y, z};
        cells[b].nodes.push_back(number[8 * b + n]);
      }
    const SubdividedMesh parts = subdivide_cells(test::make_mesh(positions, cells), {});
    double volume = 0;
    for (CellId cell = 0; cell < parts.mesh.cell_count(); ++cell)
      volume += volume_of(parts.mesh, cell);
    EXPECT_NEAR(volume, 2, 1e-14);
  }
}

// A brick with two corners at one place, as structured grids have them at an axis.
TEST(SubdivideCells, FlatTetrahedraOfCollapsedBricksAreLeftOut) {
  std::vector<Position> positions = test::positions_of(test::structured(1, Cut::bricks));
  const std::vector<test::Cell> cells = test::cells_of(test::structured(1, Cut::bricks));
  positions[cells[0].nodes[1]] = positions[cells[0].nodes[0]];
  positions[cells[0].nodes[5]] = positions[cells[0].nodes[4]];
  const SubdividedMesh parts = subdivide_cells(test::make_mesh(positions, cells), {});
  EXPECT_GT(parts.dropped_tetrahedra, 0U);
  double volume = 0;
  for (CellId cell = 0; cell < parts.mesh.cell_count(); ++cell) {
    EXPECT_GT(volume_of(parts.mesh, cell), 0);
    volume += volume_of(parts.mesh, cell);
  }
  EXPECT_NEAR(volume, 0.5, 1e-15);
}

double quadratic(const Position& p) {
  return 0.3 + p[0] - 2 * p[1] * p[2] + 1.5 * p[0] * p[0] + p[1] * p[0] - 0.7 * p[2] * p[2];
}
double cubic(const Position& p) {
  return quadratic(p) + p[0] * p[0] * p[1] - 0.5 * p[2] * p[2] * p[2] + p[0] * p[1] * p[2];
}

// The largest difference of a node field's interpolant from a function, in random places.
double largest_difference(const ZooMesh& mesh, const test::ScalarFunction& truth) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit;
  double largest = 0;
  const auto values = mesh.fields[0].values.view();
  std::array<double, kMaxNodesPerCell> shape;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    Position xi{unit(random), unit(random), unit(random)};
    const double sum = xi[0] + xi[1] + xi[2] + unit(random);
    for (double& v : xi) v /= sum;
    shape_functions<double>(mesh.kinds[cell], xi, shape);
    Position p{};
    double value = 0;
    const auto nodes = mesh.cell_nodes(cell);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      value += shape[i] * values[nodes[i]];
      for (std::size_t c = 0; c < 3; ++c) p[c] += shape[i] * mesh.position(nodes[i])[c];
    }
    largest = std::max(largest, std::abs(value - truth(p)));
  }
  return largest;
}

TEST(SubdivideCells, QuadraticFieldsStayWhatTheyAreInTenNodeTetrahedra) {
  for (const Cut cut : kCuts) {
    ZooMesh mesh = test::elevated(shuffled(cut, 2, 4), CellOrder::quadratic);
    test::add_node_field(mesh, "f", quadratic);
    const SubdividedMesh parts = subdivide_cells(mesh, {});
    expect_fills_the_cube(parts.mesh);
    EXPECT_EQ(parts.mesh.kinds[0], CellKind::tetrahedron10);
    EXPECT_LE(largest_difference(parts.mesh, quadratic), 1e-13);
    EXPECT_EQ(parts.dropped_nodes, 0U);
    EXPECT_EQ(parts.new_nodes == 0, cut == Cut::tetrahedra);
  }
}

TEST(SubdivideCells, CubicFieldsStayWhatTheyAreInTwentyNodeTetrahedra) {
  for (const Cut cut : kCuts) {
    // complete to degree 3 are bricks and tetrahedra, the others to degree 2 (shape_functions.hpp)
    const bool complete = cut == Cut::bricks || cut == Cut::tetrahedra;
    const test::ScalarFunction truth = complete ? cubic : quadratic;
    ZooMesh mesh = test::elevated(shuffled(cut, 2, 5), CellOrder::cubic);
    test::add_node_field(mesh, "f", truth);
    const SubdividedMesh parts = subdivide_cells(mesh, {});
    expect_fills_the_cube(parts.mesh);
    EXPECT_EQ(parts.mesh.kinds[0], CellKind::tetrahedron20);
    EXPECT_LE(largest_difference(parts.mesh, truth), 1e-13);
  }
}

// The largest difference of a linear tetrahedron's field from a function in the middles of edges:
// of a quadratic one its second derivative along the edge, times an eighth of the length squared.
double largest_edge_difference(const ZooMesh& mesh, const test::ScalarFunction& truth) {
  double largest = 0;
  const auto values = mesh.fields[0].values.view();
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
    for (const auto& [a, b] : topology_of(CellShape::tetrahedron).edges) {
      const NodeId i = mesh.cell_nodes(cell)[a], j = mesh.cell_nodes(cell)[b];
      Position middle;
      for (std::size_t c = 0; c < 3; ++c)
        middle[c] = 0.5 * (mesh.position(i)[c] + mesh.position(j)[c]);
      largest = std::max(largest, std::abs(0.5 * (values[i] + values[j]) - truth(middle)));
    }
  return largest;
}

TEST(SubdivideCells, LinearizedByHalvingTheErrorFallsFourfold) {
  for (const Cut cut : kCuts)
    for (const CellOrder order : {CellOrder::quadratic, CellOrder::cubic}) {
      ZooMesh mesh = test::elevated(shuffled(cut, 2, 6), order);
      test::add_node_field(mesh, "f", quadratic);
      std::vector<double> errors;
      for (const unsigned levels : {0U, 1U, 2U, 3U}) {
        const SubdividedMesh parts = subdivide_cells(mesh, {true, levels});
        expect_fills_the_cube(parts.mesh);
        EXPECT_EQ(parts.mesh.kinds[0], CellKind::tetrahedron4);
        const auto values = parts.mesh.fields[0].values.view();
        const auto positions = test::positions_of(parts.mesh);
        for (std::size_t node = 0; node < values.size(); ++node)
          EXPECT_NEAR(values[node], quadratic(positions[node]), 1e-13);
        errors.push_back(largest_edge_difference(parts.mesh, quadratic));
      }
      // from the second level on all shapes that there will be are there
      EXPECT_LT(errors[1], errors[0]);
      EXPECT_LT(errors[2], errors[1]);
      EXPECT_NEAR(errors[2] / errors[3], 4, 1e-9);
    }
}

TEST(SubdivideCells, UsesTheNodesThatQuadraticCellsHave) {
  const ZooMesh mesh = test::elevated(shuffled(Cut::tetrahedra, 2, 7), CellOrder::quadratic);
  const SubdividedMesh halves = subdivide_cells(mesh, {true, 1});
  EXPECT_EQ(halves.new_nodes, 0U);
  EXPECT_EQ(halves.dropped_nodes, 0U);
  EXPECT_EQ(halves.mesh.cell_count(), 8 * mesh.cell_count());
  const SubdividedMesh corners = subdivide_cells(mesh, {true, 0});
  EXPECT_EQ(corners.mesh.node_count(), 27U);
  EXPECT_EQ(corners.dropped_nodes, mesh.node_count() - 27);
}

TEST(SubdivideCells, HandsOnFieldsOfEveryPlace) {
  ZooMesh mesh = shuffled(Cut::bricks, 2, 8);
  mesh.metadata = {{"source", "a test"}};
  std::vector<double> by_cell(2 * mesh.cell_count()), by_corner(mesh.nodes.size());
  std::iota(by_cell.begin(), by_cell.end(), 1);
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
    for (std::size_t k = 0; k < 8; ++k)
      by_corner[8 * cell + k] = 1000.0 * cell + mesh.position(mesh.cell_nodes(cell)[k])[0];
  mesh.fields.push_back({"pair", "m", FieldLocation::cell, 2, std::move(by_cell)});
  mesh.fields.push_back({"jump", "", FieldLocation::corner, 1, std::move(by_corner)});
  for (const Subdivision& how : {Subdivision{}, Subdivision{true, 1}}) {
    const ZooMesh parts = subdivide_cells(mesh, how).mesh;
    validate(parts, "parts");
    EXPECT_EQ(parts.metadata, mesh.metadata);
    const std::size_t each = parts.cell_count() / mesh.cell_count();
    EXPECT_EQ(each, how.linearize ? 48U : 6U);
    EXPECT_EQ(parts.fields[0].unit, "m");
    for (CellId cell = 0; cell < parts.cell_count(); ++cell) {
      const auto parent = static_cast<double>(cell / each);
      EXPECT_EQ(parts.fields[0].values[2 * cell], 2 * parent + 1);
      EXPECT_EQ(parts.fields[0].values[2 * cell + 1], 2 * parent + 2);
      for (std::size_t k = 0; k < 4; ++k)
        EXPECT_NEAR(parts.fields[1].values[4 * cell + k],
                    1000 * parent + parts.position(parts.cell_nodes(cell)[k])[0], 1e-10);
    }
  }
}

}  // namespace
}  // namespace hiac
