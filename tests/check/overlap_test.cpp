#include "hiac/check/overlap.hpp"

#include <random>
#include <set>

#include <gtest/gtest.h>

#include "hiac/check/conformity.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "tests/check/findings.hpp"
#include "tests/check/rational_overlap.hpp"
#include "tests/order/hard_meshes.hpp"
#include "tests/support/instrumented.hpp"

namespace hiac::test {
namespace {

using Pairs = std::set<std::pair<CellId, CellId>>;

OverlapReport overlaps(const ZooMesh& mesh, double planarity = 0) {
  const FaceAdjacency adjacency = build_face_adjacency(mesh);
  const CellShapes shapes = judge_cells(mesh, planarity);
  const auto fit = judge_conformity(mesh, adjacency, shapes, planarity);
  return find_overlaps(mesh, adjacency, shapes, count_of(fit, Defect::folded_face) > 0, planarity);
}

Pairs pairs_of(const OverlapReport& report, Defect defect) {
  Pairs pairs;
  for (const Offender& o : offenders_of(report.findings, defect))
    pairs.emplace(static_cast<CellId>(o.id), static_cast<CellId>(o.other));
  return pairs;
}

Pairs for_an_order(const ZooMesh& mesh, double planarity = 0) {
  Pairs pairs;
  for (const auto& [a, b] :
       overlapping_cells(order_basis(mesh, build_face_adjacency(mesh)), planarity))
    pairs.emplace(a, b);
  return pairs;
}

Pairs by_brute_force(const ZooMesh& mesh) {
  Pairs pairs;
  for (CellId a = 0; a < mesh.cell_count(); ++a)
    for (CellId b = a + 1; b < mesh.cell_count(); ++b)
      if (interiors_meet(mesh, a, b)) pairs.emplace(a, b);
  return pairs;
}

ZooMesh both(const ZooMesh& a, const ZooMesh& b, const Position& by) {
  return side_by_side(a, moved(b, [&](const Position& p) {
                        return Position{p[0] + by[0], p[1] + by[1], p[2] + by[2]};
                      }));
}

TEST(Overlap, ConformingMeshesHaveNoneAndAskAtTheBoundaryAlone) {
  for (const Cut cut : {Cut::bricks, Cut::tetrahedra, Cut::prisms, Cut::pyramids})
    for (const bool turn : {false, true}) {
      const ZooMesh mesh = structured(4, cut);
      const auto report = overlaps(turn ? moved(mesh, turned) : mesh, turn ? 1e-10 : 0);
      EXPECT_TRUE(report.findings.empty());
      EXPECT_TRUE(report.by_boundary);
    }
  EXPECT_TRUE(overlaps(random_delaunay(100, 2)).findings.empty());
  EXPECT_TRUE(overlaps(torn(structured(4, Cut::bricks), 0.5)).by_boundary);
  EXPECT_TRUE(overlaps(pinwheel()).findings.empty());
}

// Meshes that reach into one another, one inside another without touching its boundary, the same
// twice, and tangles made by moving nodes.
TEST(Overlap, PairsAsInRationalNumbers) {
  const ZooMesh small = structured(1, Cut::tetrahedra), bricks = structured(2, Cut::bricks);
  const auto tenth = [](const Position& p) {
    return Position{p[0] / 16 + 0.3125, p[1] / 16 + 0.3125, p[2] / 16 + 0.3125};
  };
  std::mt19937 random(9);
  std::uniform_int_distribution<int> step(-3, 3);
  std::vector<ZooMesh> meshes{both(small, small, {0.75, 0.25, 0}),
                              both(bricks, small, {0.5, 0.5, 0.5}), both(small, small, {0, 0, 0}),
                              both(structured(1, Cut::bricks), moved(small, tenth), {0, 0, 0}),
                              both(small, small, {1, 0.5, 0})};
  for (int i = 0; i < 4; ++i)
    meshes.push_back(moved(small, [&](const Position& p) {
      return Position{p[0] + step(random) / 8.0, p[1] + step(random) / 8.0,
                      p[2] + step(random) / 8.0};
    }));
  for (const ZooMesh& mesh : meshes) {
    const auto found = pairs_of(overlaps(mesh), Defect::overlap);
    Pairs expected;
    for (const auto& pair : by_brute_force(mesh)) expected.insert(pair);
    EXPECT_EQ(found, expected);
    EXPECT_EQ(for_an_order(mesh), expected);
  }
}

TEST(Overlap, ByOneUlp) {
  const ZooMesh cube = structured(1, Cut::bricks);
  for (const auto& motion : exact_motions()) {
    EXPECT_TRUE(overlaps(moved(both(cube, cube, {1, 0.25, 0.5}), motion)).findings.empty());
    const auto deeper = moved(both(cube, cube, {below(1), 0.25, 0.5}), motion);
    EXPECT_EQ(pairs_of(overlaps(deeper), Defect::overlap), (Pairs{{0, 1}}));
    EXPECT_EQ(pairs_of(overlaps(deeper, 1e-10), Defect::grazing_overlap), (Pairs{{0, 1}}));
    EXPECT_TRUE(pairs_of(overlaps(deeper, 1e-10), Defect::overlap).empty());
    EXPECT_EQ(for_an_order(deeper), (Pairs{{0, 1}}));
    EXPECT_TRUE(for_an_order(deeper, 1e-10).empty());
  }
}

// Bricks with faces that are not planar: a column whose layers are twisted, alone and with a copy.
TEST(Overlap, BricksThatAreNotPlanar) {
  const auto twisted = [](const Position& p) {
    const double angle = 0.4 * p[2], x = p[0] - 0.5, y = p[1] - 0.5;
    return Position{std::cos(angle) * x - std::sin(angle) * y,
                    std::sin(angle) * x + std::cos(angle) * y, p[2]};
  };
  const ZooMesh column = moved(structured(4, Cut::bricks), twisted);
  const auto alone = overlaps(column, 1e-10);
  EXPECT_TRUE(alone.findings.empty()) << alone.findings[0].offenders.size();
  const auto twice = overlaps(both(column, column, {0.125, 0, 0}), 1e-10);
  EXPECT_GE(pairs_of(twice, Defect::overlap).size(), 48U);
  const auto distant = overlaps(both(column, column, {1.5, 0, 0}), 1e-10);
  EXPECT_TRUE(distant.findings.empty());
  // two saddles, one just in the other's hollow: their hulls overlap, they may not
  const auto saddle = [](const Position& p) {
    return Position{p[0], p[1], p[2] + 0.4 * (p[0] - 0.5) * (p[1] - 0.5)};
  };
  const ZooMesh cell = moved(structured(1, Cut::bricks), saddle);
  EXPECT_EQ(pairs_of(overlaps(both(cell, cell, {0, 0, 1.01}), 1e-10), Defect::possible_overlap),
            (Pairs{{0, 1}}));
  EXPECT_EQ(pairs_of(overlaps(both(cell, cell, {0, 0, 0.7}), 1e-10), Defect::overlap),
            (Pairs{{0, 1}}));
}

// What curved_reach stands on: the map of a curved kind is that of its corners and, for each node
// between them, its displacement times its shape function, whose sums are bounded.
TEST(Overlap, CurvedReachBoundsTheDisplacement) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  for (std::size_t k = 0; k < kKindCount; ++k) {
    const auto kind = static_cast<CellKind>(k);
    if (order_of(kind) == CellOrder::linear) continue;
    const auto linear = kind_of(shape_of(kind), CellOrder::linear);
    const std::size_t corners = corner_count(kind), count = node_count(kind);
    const auto at = reference_nodes(kind);
    double largest = 0;
    for (int i = 0; i < 400; ++i) {
      // a mean of corners: a point of the reference cell, the first ones in its middle
      std::array<double, 3> x{};
      std::array<double, 8> weights{};
      double sum = 0;
      for (std::size_t c = 0; c < corners; ++c)
        sum += weights[c] = i == 0 ? 1 : -std::log(unit(random));
      for (std::size_t c = 0; c < corners; ++c)
        for (std::size_t d = 0; d < 3; ++d) x[d] += weights[c] / sum * at[c][d];
      std::array<double, kMaxNodesPerCell> n{}, l{};
      shape_functions<double>(kind, x, n);
      shape_functions<double>(linear, x, l);
      double between = 0;
      for (std::size_t b = corners; b < count; ++b) between += std::abs(n[b]);
      largest = std::max(largest, between);
      // the values at the corners, carried to the nodes between them, give the linear function
      for (std::size_t c = 0; c < corners; ++c) {
        double carried = n[c];
        for (std::size_t b = corners; b < count; ++b) {
          std::array<double, kMaxNodesPerCell> there{};
          shape_functions<double>(linear, at[b], there);
          carried += n[b] * there[c];
        }
        ASSERT_NEAR(carried, l[c], 1e-12) << kind_name(kind);
      }
    }
    // a cell with one node displaced by 1 tells the bound that is used
    std::vector<Position> places;
    Cell cell{kind, {}};
    for (const auto& p : at) {
      cell.nodes.push_back(static_cast<NodeId>(places.size()));
      places.push_back(p);
    }
    places.back()[0] += 1;
    const double bound = curved_reach(make_mesh(places, {cell}), 0)[0];
    EXPECT_LE(largest, bound * (1 + 1e-12)) << kind_name(kind);
    EXPECT_LT(bound, 2 * largest) << kind_name(kind);
  }
}

Overlap verdict(const ZooMesh& a, const ZooMesh& b, const Position& by) {
  const auto report = overlaps(both(a, b, by));
  const auto says = [&](Defect defect) { return !pairs_of(report, defect).empty(); };
  EXPECT_FALSE(says(Defect::grazing_overlap));
  return says(Defect::overlap)            ? Overlap::certain
         : says(Defect::possible_overlap) ? Overlap::possible
                                          : Overlap::none;
}

ZooMesh one_cell(CellKind kind, const std::function<Position(std::size_t, const Position&)>& at) {
  std::vector<Position> places;
  Cell cell{kind, {}};
  for (const auto& p : reference_nodes(kind)) {
    cell.nodes.push_back(static_cast<NodeId>(places.size()));
    places.push_back(at(places.size(), p));
  }
  return make_mesh(places, {cell});
}

// A cube whose upper edges' middles are raised by h: its top reaches 1 + 2 h in the middle, where
// these four shape functions are 1/2 each, and its curved_reach is 3 h.
ZooMesh bulging_cube(double h, double bottom = 0) {
  return one_cell(CellKind::brick20, [&](std::size_t n, const Position& p) {
    return Position{p[0], p[1], p[2] + (n < 8 || p[2] == 0.5 ? 0 : p[2] == 1 ? h : -bottom)};
  });
}

TEST(Overlap, CurvedCubesOverOneAnother) {
  const double h = 1.0 / 64;
  const ZooMesh cube = structured(1, Cut::bricks), bulging = bulging_cube(h);
  const ZooMesh downwards = bulging_cube(0, h);
  std::array<double, kMaxNodesPerCell> shape{};
  shape_functions<double>(CellKind::brick20, {0.5, 0.5, 1}, shape);
  double top = 0;
  for (NodeId n = 0; n < 20; ++n) top += shape[n] * bulging.position(n)[2];
  ASSERT_NEAR(top, 1 + 2 * h, 1e-15);
  // a gap between the corners' hulls, which the bulge of one or both cells fills
  EXPECT_EQ(verdict(bulging, cube, {0, 0, 1 + 1.5 * h}), Overlap::certain);
  EXPECT_EQ(verdict(cube, downwards, {0, 0, 1 + 1.5 * h}), Overlap::certain);
  EXPECT_EQ(verdict(bulging, downwards, {0, 0, 1 + 3.5 * h}), Overlap::certain);
  // ... or leaves a gap, which the bound of the bulge does not prove
  EXPECT_EQ(verdict(bulging, cube, {0, 0, 1 + 2.5 * h}), Overlap::possible);
  EXPECT_EQ(verdict(bulging, downwards, {0, 0, 1 + 4.5 * h}), Overlap::possible);
  EXPECT_EQ(verdict(bulging, cube, {0, 0, 1 + 3.5 * h}), Overlap::none);
  EXPECT_EQ(verdict(cube, downwards, {0, 0, 1 + 3.5 * h}), Overlap::none);
  EXPECT_EQ(verdict(bulging, downwards, {0, 0, 1 + 6.5 * h}), Overlap::none);
  // the hulls overlap, by more or less than the bulges could take away
  EXPECT_EQ(verdict(bulging, cube, {0, 0, 1 - 8 * h}), Overlap::certain);
  EXPECT_EQ(verdict(bulging, cube, {0, 0, 1 - 2 * h}), Overlap::certain);
  EXPECT_EQ(verdict(bulging, downwards, {0, 0, 1 - 16 * h}), Overlap::certain);
  EXPECT_EQ(verdict(bulging, downwards, {0, 0, 1 - 5 * h}), Overlap::certain);
}

// A bent cell of each kind whose top reaches a little into the bottom of another one, or not quite.
// Sanitized, cubic cells take minutes; they go through the same code as quadratic ones.
bool is_slow(CellKind kind) { return kInstrumented && order_of(kind) == CellOrder::cubic; }

TEST(Overlap, CurvedCellsOfAllKindsThatOverlapALittle) {
  for (std::size_t k = 0; k < kKindCount; ++k) {
    const auto kind = static_cast<CellKind>(k);
    if (order_of(kind) == CellOrder::linear || is_slow(kind)) continue;
    const auto bent = [](const Position& p) {
      return Position{p[0] + p[1] * p[1] / 16, p[1] + p[2] * p[2] / 16, p[2] + p[0] * p[0] / 16};
    };
    const ZooMesh cell = one_cell(kind, [&](std::size_t, const Position& p) { return bent(p); });
    // its Jacobian is not proven positive at the apex, and so nothing of its inside
    const bool proven = judge_cells(cell, 0).turns[0] == Turn::right;
    EXPECT_EQ(proven, kind != CellKind::pyramid21);
    const auto reaching = [&](double by) {
      const ZooMesh below = one_cell(kind, [&](std::size_t, const Position& p) {
        return bent({p[0], p[1], p[2] - 1 + by});
      });
      return verdict(cell, below, {0, 0, 0});
    };
    EXPECT_EQ(reaching(0.1), proven ? Overlap::certain : Overlap::possible) << kind_name(kind);
    EXPECT_NE(reaching(-0.05), Overlap::certain) << kind_name(kind);
  }
}

// Every kind of curved cell, its nodes between the corners displaced at random, and a box. Points
// of the cell are sampled: one in the box is an overlap, which may not be denied.
TEST(Overlap, CurvedCellsAndABoxAsSamplesTell) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> unit(0, 1);
  const ZooMesh cube = structured(1, Cut::bricks);
  std::array<std::size_t, 3> told{};
  for (std::size_t k = 0; k < kKindCount; ++k) {
    const auto kind = static_cast<CellKind>(k);
    if (order_of(kind) == CellOrder::linear) continue;
    if (kInstrumented && kind > CellKind::tetrahedron20) break;
    const ZooMesh cell = one_cell(kind, [&](std::size_t n, const Position& p) {
      const double d = n < corner_count(kind) ? 0 : 0.03;
      return Position{p[0] + d * (unit(random) - 0.5), p[1] + d * (unit(random) - 0.5),
                      p[2] + d * (unit(random) - 0.5)};
    });
    const auto reference = reference_nodes(kind);
    const auto sample = [&] {
      std::array<double, 3> xi{};
      double sum = 0;
      for (std::size_t c = 0; c < corner_count(kind); ++c) {
        // near edges and faces as well
        const double weight = std::pow(-std::log(unit(random)), 2);
        sum += weight;
        for (std::size_t d = 0; d < 3; ++d) xi[d] += weight * reference[c][d];
      }
      for (double& x : xi) x /= sum;
      std::array<double, kMaxNodesPerCell> shape{};
      shape_functions<double>(kind, xi, shape);
      Position x{};
      for (NodeId n = 0; n < node_count(kind); ++n)
        for (std::size_t d = 0; d < 3; ++d) x[d] += shape[n] * cell.position(n)[d];
      return x;
    };
    std::vector<Position> samples;
    for (int i = 0; i < 1500; ++i) samples.push_back(sample());
    for (int i = 0; i < 40; ++i) {
      const Position low{3 * unit(random) - 1.5, 3 * unit(random) - 1.5, 3 * unit(random) - 1.5};
      const auto inside = [&](const Position& x) {
        return x[0] > low[0] && x[0] < low[0] + 1 && x[1] > low[1] && x[1] < low[1] + 1 &&
               x[2] > low[2] && x[2] < low[2] + 1;
      };
      const bool found = std::ranges::any_of(samples, inside);
      const Overlap said = verdict(cell, cube, low);
      ++told[static_cast<std::size_t>(said)];
      if (said == Overlap::none) {
        EXPECT_FALSE(found) << kind_name(kind) << i;
      }
      if (said == Overlap::certain) {
        bool met = found;  // a small overlap takes more samples
        for (int more = 0; more < 1'000'000 && !met; ++more) met = inside(sample());
        EXPECT_TRUE(met) << kind_name(kind) << i;
      }
    }
  }
  EXPECT_GT(told[static_cast<std::size_t>(Overlap::none)], kInstrumented ? 5U : 50U);
  EXPECT_GT(told[static_cast<std::size_t>(Overlap::certain)], kInstrumented ? 5U : 50U);
  EXPECT_LT(told[static_cast<std::size_t>(Overlap::possible)], 100U);
}

}  // namespace
}  // namespace hiac::test
