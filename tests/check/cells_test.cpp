#include "hiac/check/cells.hpp"

#include <random>

#include <gtest/gtest.h>

#include "hiac/geometry/predicates.hpp"
#include "hiac/mesh/corner_fan.hpp"
#include "hiac/mesh/face_nodes.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "tests/check/findings.hpp"
#include "tests/order/hard_meshes.hpp"
#include "tests/support/instrumented.hpp"

namespace hiac::test {
namespace {

// One cell of a kind: its reference cell.
ZooMesh reference_cell(CellKind kind) {
  std::vector<Position> places;
  Cell cell{kind, {}};
  for (const auto& p : reference_nodes(kind)) {
    cell.nodes.push_back(static_cast<NodeId>(places.size()));
    places.push_back(p);
  }
  return make_mesh(places, {cell});
}

std::vector<Defect> defects(const ZooMesh& mesh, double planarity = 0) {
  return defects_of(judge_cells(mesh, planarity).findings);
}

ZooMesh with_corner(const ZooMesh& mesh, NodeId node, const Position& place) {
  auto places = positions_of(mesh);
  places[node] = place;
  return make_mesh(places, cells_of(mesh));
}

constexpr std::array kLinear{CellKind::tetrahedron4, CellKind::pyramid5, CellKind::prism6,
                             CellKind::wedge7, CellKind::brick8};

TEST(Cells, ReferenceCellsAreValid) {
  for (std::size_t k = 0; k < kKindCount; ++k) {
    const auto kind = static_cast<CellKind>(k);
    EXPECT_TRUE(defects(reference_cell(kind), 1e-10).empty()) << kind_name(kind);
  }
  for (const CellKind kind : kLinear) EXPECT_TRUE(defects(reference_cell(kind)).empty());
}

TEST(Cells, CornersOfThreeEdgesArePositive) {
  constexpr std::array<std::size_t, kShapeCount> kOfThreeEdges{4, 4, 6, 6, 8};
  for (std::size_t s = 0; s < kShapeCount; ++s) {
    const ZooMesh mesh = reference_cell(kLinear[s]);
    std::size_t count = 0;
    for (NodeId corner = 0; corner < corner_count(kLinear[s]); ++corner) {
      const CornerFan& fan = corner_fan(static_cast<CellShape>(s), corner);
      if (fan.count != 3) continue;
      ++count;
      const auto at = [&](std::size_t k) { return mesh.position(fan.neighbors[k]); };
      EXPECT_GT(orientation(mesh.position(corner), at(0), at(2), at(1)), 0);
    }
    EXPECT_EQ(count, kOfThreeEdges[s]);
  }
}

// The nodes between a face's corners lie in its plane, and no others do.
TEST(Cells, NodesBetweenCornersAreOnTheirFace) {
  for (std::size_t k = 0; k < kKindCount; ++k) {
    const auto kind = static_cast<CellKind>(k);
    const auto at = reference_nodes(kind);
    for (std::size_t f = 0; f < face_count(kind); ++f) {
      const auto& corners = topology_of(kind).faces[f].corners;
      const BetweenNodes between = nodes_between(kind, f);
      for (std::size_t n = corner_count(kind); n < node_count(kind); ++n) {
        double det = 0;
        const auto d = [&](std::size_t i, std::size_t c) { return at[i][c] - at[corners[0]][c]; };
        for (std::size_t c = 0; c < 3; ++c)
          det += d(n, c) * (d(corners[1], (c + 1) % 3) * d(corners[2], (c + 2) % 3) -
                            d(corners[1], (c + 2) % 3) * d(corners[2], (c + 1) % 3));
        const auto list = std::span(between.nodes).first(between.count);
        EXPECT_EQ(std::abs(det) < 1e-12, std::ranges::find(list, n) != list.end());
      }
    }
  }
}

TEST(Cells, VolumeByOneUlp) {
  for (const auto& motion : exact_motions()) {
    const auto of = [&](double z) {
      return moved(
          make_mesh(
              {{0.1, 0.2, 0.3}, {0.9, 0.2, 0.3}, {0.4, 0.7, 0.3}, {0.3, 0.4, z}, {0.3, 0.4, 1}},
              {{CellKind::tetrahedron4, {0, 1, 2, 4}}, {CellKind::tetrahedron4, {0, 1, 2, 3}}}),
          motion);
    };
    EXPECT_TRUE(defects(of(above(0.3))).empty());
    EXPECT_EQ(defects(of(0.3)), std::vector{Defect::zero_volume});
    EXPECT_EQ(defects(of(below(0.3))), std::vector{Defect::inverted});
  }
}

TEST(Cells, AHandIsAConventionWhereAllCellsHaveIt) {
  const ZooMesh mesh = structured(3, Cut::tetrahedra);
  const auto mirrored = inverted(mesh, [](CellId) { return true; });
  EXPECT_EQ(defects(mirrored), std::vector{Defect::left_handed});
  EXPECT_EQ(judge_cells(mirrored, 0).hand, Turn::left);
  EXPECT_TRUE(judge_cells(mirrored, 0).uniform);
  const auto some = judge_cells(inverted(mesh, [](CellId c) { return c % 40 == 7; }), 0);
  EXPECT_EQ(offenders_of(some.findings, Defect::inverted),
            (std::vector<Offender>{{7}, {47}, {87}, {127}}));
  EXPECT_FALSE(some.uniform);
  const auto others = judge_cells(inverted(mesh, [](CellId c) { return c % 40 != 7; }), 0);
  EXPECT_EQ(offenders_of(others.findings, Defect::inverted),
            (std::vector<Offender>{{7}, {47}, {87}, {127}}));
}

// A corner of a brick pushed along the diagonal of its top, through the plane of its neighbours.
TEST(Cells, AReflexCornerByOneUlp) {
  const auto brick = [](double x) {
    return with_corner(reference_cell(CellKind::brick8), 6, {x, x, 1});
  };
  for (const auto& motion : exact_motions()) {
    EXPECT_EQ(defects(moved(brick(below(0.5)), motion), 0.9), std::vector{Defect::jacobian});
    EXPECT_FALSE(std::ranges::count(defects(moved(brick(0.5), motion), 0.9), Defect::jacobian));
    EXPECT_TRUE(defects(moved(brick(above(0.5)), motion), 0.9).empty());
  }
}

TEST(Cells, PlanarityByOneUlp) {
  for (const auto& motion : exact_motions())
    for (const CellKind kind : {CellKind::brick8, CellKind::prism6, CellKind::wedge7}) {
      const ZooMesh cell = reference_cell(kind);
      Position place = positions_of(cell)[1];
      place[0] += 0x1p-51;
      const auto found = judge_cells(moved(with_corner(cell, 1, place), motion), 0).findings;
      ASSERT_EQ(count_of(found, Defect::nonplanar_face), 1U);
      EXPECT_LT(found[0].largest(), 1e-15);
      EXPECT_TRUE(defects(moved(with_corner(cell, 1, place), motion), 1e-10).empty());
    }
}

// A pyramid whose base is a kite that turns inwards at a corner.
TEST(Cells, ConvexityByOneUlp) {
  const auto pyramid = [](double x) {
    return make_mesh({{0, 0, 0}, {2, 0, 0}, {x, x, 0}, {0, 2, 0}, {0.25, 0.25, 1}},
                     {{CellKind::pyramid5, {0, 1, 2, 3, 4}}});
  };
  const auto has = [&](double x, Defect defect) {
    return count_of(judge_cells(pyramid(x), 0).findings, defect) > 0;
  };
  EXPECT_TRUE(has(below(1), Defect::nonconvex_cell));
  EXPECT_FALSE(has(1, Defect::nonconvex_cell));
  EXPECT_FALSE(has(above(1), Defect::nonconvex_cell));
  EXPECT_TRUE(has(below(1), Defect::jacobian));
  EXPECT_FALSE(has(above(1), Defect::jacobian));
}

TEST(Cells, ConvexMeshesOfOthersAreFoundSo) {
  for (const Cut cut : {Cut::bricks, Cut::tetrahedra, Cut::prisms, Cut::pyramids})
    EXPECT_TRUE(defects(moved(structured(3, cut), turned), 1e-10).empty());
  for (const NodeId in_line : {0U, 1U, 2U, 3U, 4U, 5U, 7U}) {
    EXPECT_FALSE(std::ranges::count(defects(corners_in_line(in_line)), Defect::nonconvex_cell));
  }
}

// The determinant of a cell's map at a point of its reference cell.
double determinant_at(const ZooMesh& mesh, const std::array<double, 3>& xi) {
  std::array<std::array<double, 3>, kMaxNodesPerCell> gradients{};
  shape_gradients<double>(mesh.kinds[0], xi, gradients);
  std::array<std::array<double, 3>, 3> m{};
  for (std::size_t k = 0; k < mesh.cell_nodes(0).size(); ++k)
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c)
        m[r][c] += gradients[k][c] * mesh.position(mesh.nodes[k])[r];
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

// Distorted cells of every kind: what is called right has no negative sample, and a negative sample
// is never overlooked.
TEST(Cells, JacobiansAsTheirSamples) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(0, 1);
  std::array<int, 2> met{};
  int undecided = 0;
  constexpr auto kCells = static_cast<int>(tried(kInstrumented ? 60 : 140));
  for (int i = 0; i < kCells; ++i) {
    const auto kind = static_cast<CellKind>(1 + i % (kKindCount - 1));
    const double by = (order_of(kind) == CellOrder::linear ? 0.9 : 0.25) * unit(random);
    const ZooMesh mesh = moved(reference_cell(kind), [&](const Position& p) {
      return Position{p[0] + by * (unit(random) - 0.5), p[1] + by * (unit(random) - 0.5),
                      p[2] + by * (unit(random) - 0.5)};
    });
    double least = 1;
    for (int s = 0; s < 200; ++s) {
      std::array<double, 3> xi{};
      double sum = 0;
      for (std::size_t c = 0; c < corner_count(kind); ++c) {
        const double weight = std::pow(unit(random), 4);
        for (std::size_t d = 0; d < 3; ++d) xi[d] += weight * reference_nodes(kind)[c][d];
        sum += weight;
      }
      for (double& x : xi) x /= sum;
      least = std::min(least, determinant_at(mesh, xi));
    }
    const Turn turn = judge_cells(mesh, 1e-10).turns[0];
    if (least < -1e-9) {
      EXPECT_EQ(turn, Turn::mixed) << kind_name(kind) << " " << i;
    }
    if (turn == Turn::right) {
      EXPECT_GT(least, -1e-9) << kind_name(kind) << " " << i;
    }
    undecided += turn == Turn::undecided ? 1 : 0;
    ++met[turn == Turn::right ? 0 : 1];
  }
  EXPECT_LE(undecided, static_cast<int>(tried(7)));  // determinants that touch zero, or nearly
  EXPECT_GT(met[0], kCells / 8);
  EXPECT_GT(met[1], kCells / 8);
}

}  // namespace
}  // namespace hiac::test
