#include "hiac/order/faces/cell_side.hpp"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/mesh/shape_functions.hpp"
#include "hiac/order/faces/eye_side.hpp"
#include "tests/geometry/rational_orientation.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

using test::Position;

ZooMesh cell_at(CellKind kind, const std::vector<Position>& positions) {
  test::Cell cell{kind, {}};
  for (NodeId node = 0; node < positions.size(); ++node) cell.nodes.push_back(node);
  return test::make_mesh(positions, {cell});
}

std::vector<Position> reference_positions(CellKind kind) {
  const auto nodes = reference_nodes(kind);
  return {nodes.begin(), nodes.end()};
}

constexpr std::array kSideKinds{CellKind::tetrahedron4, CellKind::pyramid5, CellKind::prism6,
                                CellKind::wedge7, CellKind::brick8};

TEST(CellSide, OfAllFacesIsNegativeUnlessTheCellIsMirrored) {
  for (const CellKind kind : kSideKinds) {
    auto positions = reference_positions(kind);
    EXPECT_EQ(side_of_all_faces(cell_at(kind, positions), 0), -1) << kind_name(kind);
    for (Position& p : positions) p[0] = -p[0];
    EXPECT_EQ(side_of_all_faces(cell_at(kind, positions), 0), 1) << kind_name(kind);
    for (Position& p : positions) p[0] = 0;
    EXPECT_EQ(side_of_all_faces(cell_at(kind, positions), 0), 0) << kind_name(kind);
  }
}

// One corner pushed through the cell, each in turn: corners of both orientations. A tetrahedron is
// mirrored by that, and so is a pyramid whose apex is pushed through its base.
TEST(CellSide, OfAllFacesIsNoneWhereCornersTurnBothWays) {
  for (const CellKind kind : kSideKinds) {
    const auto positions = reference_positions(kind);
    Position middle{};
    for (const Position& p : positions)
      for (std::size_t c = 0; c < 3; ++c) middle[c] += p[c] / static_cast<double>(positions.size());
    for (std::size_t k = 0; k < positions.size(); ++k) {
      auto pushed = positions;
      for (std::size_t c = 0; c < 3; ++c) pushed[k][c] += 3 * (middle[c] - pushed[k][c]);
      const bool mirrored =
          kind == CellKind::tetrahedron4 || (kind == CellKind::pyramid5 && k == 4);
      EXPECT_EQ(side_of_all_faces(cell_at(kind, pushed), 0), mirrored ? 1 : 0)
          << kind_name(kind) << ' ' << k;
    }
  }
}

// Corner 6 of a wedge has four neighbours, any three of which that follow one another count.
TEST(CellSide, OfAllFacesOfWedgesLooksAtAllTurnsOfTheFourEdges) {
  constexpr std::array<std::array<std::size_t, 4>, 10> kTurns{{{0, 1, 3, 4},
                                                               {1, 2, 0, 5},
                                                               {2, 3, 1, 6},
                                                               {3, 0, 2, 6},
                                                               {4, 0, 6, 5},
                                                               {5, 1, 4, 6},
                                                               {6, 4, 3, 2},
                                                               {6, 3, 2, 5},
                                                               {6, 2, 5, 4},
                                                               {6, 5, 4, 3}}};
  const auto reference = reference_positions(CellKind::wedge7);
  const auto turn = [&](const std::vector<Position>& p, std::size_t k) {
    const auto& [a, b, c, d] = kTurns[k];
    return test::rational_orientation(p[a], p[b], p[c], p[d]);
  };
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-0.4, 0.4);
  std::size_t by_corner_6_alone = 0;
  for (int trial = 0; trial < 400; ++trial) {
    auto positions = reference;
    for (Position& p : positions)
      for (double& x : p) x += number(random);
    bool others = true, all = true;
    for (std::size_t k = 0; k < kTurns.size(); ++k) {
      const bool right = turn(positions, k) == turn(reference, k);
      all = all && right;
      others = others && (right || k > 6);
    }
    if (others) {
      EXPECT_EQ(side_of_all_faces(cell_at(CellKind::wedge7, positions), 0), all ? -1 : 0) << trial;
    }
    by_corner_6_alone += others && !all ? 1U : 0U;
  }
  EXPECT_GT(by_corner_6_alone, 2U);
}

// Columns (1/8, 0, 0), (0, 4, 0) and (1/8, 1/8, h): a determinant of h / 2 by lengths of 1/8, 4 and
// about the root of 2 by 8.
TEST(CellSide, OfCurvedCellsIsThatOfTheJacobianInTheMiddle) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-0.03, 0.03);
  for (std::size_t k = 0; k < kKindCount; ++k) {
    const auto kind = static_cast<CellKind>(k);
    const double least = 1e-6 * std::sqrt(2) / 8;
    for (const double height :
         {1.0, -1.0, 1.1 * least, -1.1 * least, 0.9 * least, -0.9 * least, 0.0}) {
      auto positions = reference_positions(kind);
      for (Position& p : positions) {
        if (std::abs(height) == 1)
          for (double& x : p) x += number(random) / static_cast<double>(order_of(kind));
        p = {0.125 * (p[0] + p[2]), 4 * (p[1] + p[2] / 32), height * p[2]};
      }
      const int expected = std::abs(height) > least ? (height > 0 ? -1 : 1) : 0;
      EXPECT_EQ(side_by_jacobian(cell_at(kind, positions), 0), expected)
          << kind_name(kind) << ' ' << height;
    }
  }
}

// The corners around the lowest node, or around the opposite one if their triangle is smaller than
// a sixteenth of the other's.
TEST(CellSide, PlanesOfFacesAreThoseOfTheLowestNodesCorner) {
  const ShapeFace& face = topology_of(CellKind::brick8).faces[4];  // corners 0 3 2 1
  for (std::size_t lowest = 0; lowest < 4; ++lowest)
    for (const double ratio : {0.95 / 16, 1.05 / 16, 1.0}) {
      auto positions = reference_positions(CellKind::brick8);
      // the corner of the lowest node moved towards the diagonal of its neighbours
      const std::size_t corner = face.corners[lowest];
      const double s = (1 - ratio) / 2;
      positions[corner][0] += s * (1 - 2 * positions[corner][0]);
      positions[corner][1] += s * (1 - 2 * positions[corner][1]);
      test::Cell cell{CellKind::brick8, {4, 5, 6, 7, 8, 9, 10, 11}};
      cell.nodes[corner] = 0;
      std::vector<Position> all(12);
      for (std::size_t k = 0; k < 8; ++k) all[cell.nodes[k]] = positions[k];
      const ZooMesh mesh = test::make_mesh(all, {cell});
      const std::size_t middle = ratio < 1.0 / 16 ? lowest + 2 : lowest;
      EXPECT_EQ(plane_start(mesh, 0, face), (middle + 3) % 4) << lowest << ' ' << ratio;
      const auto corners = plane_corners(mesh, 0, face);
      for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(corners[k], face.corners[(middle + 3 + k) % 4]);
      // the rest of the cell lies on the side where the other corners are
      const auto at = [&](std::size_t k) { return all[cell.nodes[k]]; };
      EXPECT_EQ(side_of_cell(mesh, 0, face),
                test::rational_orientation(at(corners[0]), at(corners[1]), at(corners[2]), at(6)));
    }
  const ShapeFace& triangle = topology_of(CellKind::prism6).faces[1];
  EXPECT_EQ(
      plane_start(cell_at(CellKind::prism6, reference_positions(CellKind::prism6)), 0, triangle),
      0U);
  EXPECT_EQ(corners_from(triangle, 0), (std::array<std::uint8_t, 4>{3, 5, 4, 4}));
}

TEST(CellSide, OfAFlatCellIsNone) {
  auto positions = reference_positions(CellKind::brick8);
  for (Position& p : positions) p[2] = 0;
  const ZooMesh mesh = cell_at(CellKind::brick8, positions);
  EXPECT_EQ(side_of_cell(mesh, 0, topology_of(CellKind::brick8).faces[4]), 0);
}

// Coordinates on a lattice, moved by their last bits, near the origin and far away, huge and tiny:
// the sides are those of rational numbers.
TEST(EyeSide, OfTetrahedraIsThatOfRationalNumbers) {
  std::mt19937_64 random(2);
  std::array<int, 3> met{};
  for (std::size_t trial = 0; trial < 1500; ++trial) {
    const double far = trial % 3 == 0 ? 1024 : 0;
    // at 1e-107, products of three are multiples of the least number, which rounding moves
    const double scale = std::array{1e-200, 1e100, 1e-107, 1.0, 1.0}[trial % 5];
    const auto number = [&] {
      return scale * (far + static_cast<double>(random() % 3) +
                      (random() % 2 == 0 ? 0x1p-42 * static_cast<double>(random() % 3) : 0));
    };
    std::array<Position, 4> corners;
    for (Position& p : corners) p = {number(), number(), number()};
    const View view{trial % 2 == 0,
                    {number(), number(), number()},
                    {number() - scale * far - scale, number() - scale * far - scale, scale}};
    std::array<const double*, 4> at;
    for (std::size_t k = 0; k < 4; ++k) at[k] = corners[k].data();
    const EyeSides found = eye_sides_of_tetrahedron(at, view);
    for (std::size_t f = 0; f < 4; ++f) {
      const auto& c = topology_of(CellKind::tetrahedron4).faces[f].corners;
      const int expected =
          view.perspective
              ? test::rational_orientation(corners[c[0]], corners[c[1]], corners[c[2]], view.eye)
              : -test::rational_orientation_towards(corners[c[0]], corners[c[1]], corners[c[2]],
                                                    view.direction);
      EXPECT_EQ((found.positive >> f & 1) - (found.negative >> f & 1), expected) << trial;
      ++met[static_cast<std::size_t>(expected + 1)];
    }
  }
  for (const int count : met) EXPECT_GT(count, 200);
}

}  // namespace
}  // namespace hiac
