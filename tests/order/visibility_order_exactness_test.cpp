// Orders against the truth about every pair of cells: no pair is out of order, and cells are in one
// group exactly when they are in one cycle.

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "tests/order/exact_relation.hpp"
#include "tests/order/hard_meshes.hpp"
#include "tests/support/sorting.hpp"

namespace hiac::test {
namespace {

constexpr std::array kShapes{CellShape::tetrahedron, CellShape::pyramid, CellShape::prism,
                             CellShape::wedge, CellShape::brick};

// The order of the cells that are left when some are struck off; those that are, numbered anew.
VisibilityOrder struck(const VisibilityOrder& order, const std::vector<CellId>& off) {
  std::vector<CellId> number(order.cells.size(), 1);
  for (const CellId cell : off) number[cell] = 0;
  std::vector<bool> stays;
  for (const CellId cell : order.cells) stays.push_back(number[cell] != 0);
  std::exclusive_scan(number.begin(), number.end(), number.begin(), CellId{0});
  std::vector<CellId> cells;
  std::vector<CellGroup> groups;
  const auto ranks = group_ranks(order);
  for (std::uint32_t at = 0, last = 0; at < stays.size(); ++at) {
    if (!stays[at]) continue;
    const std::uint32_t rank = ranks[order.cells[at]];
    const auto place = static_cast<std::uint32_t>(cells.size());
    cells.push_back(number[order.cells[at]]);
    if (place == 0 || rank != last) groups.push_back({place, 0});
    last = rank;
    ++groups.back().count;
  }
  std::erase_if(groups, [](const CellGroup& group) { return group.count < 2; });
  return {std::move(cells), std::move(groups), order.algorithm};
}

Arrows struck(Arrows arrows, const std::vector<CellId>& off) {
  const auto below = [&](CellId cell) {
    return static_cast<CellId>(std::ranges::lower_bound(off, cell) - off.begin());
  };
  for (auto& [front, behind] : arrows) front -= below(front), behind -= below(behind);
  return arrows;
}

// Returns the number of pairs of cells that some ray meets. No ray has a piece in cells without
// volume: where they come does not count.
std::size_t expect_exact(const ZooMesh& mesh, const View& view) {
  const ExactRelation truth = exact_relation(mesh, view);
  EXPECT_TRUE(truth.overlapping.empty());
  EXPECT_TRUE(is_order_of(struck(truth.arrows, truth.flat), mesh.cell_count() - truth.flat.size(),
                          struck(sorted(mesh, view).order, truth.flat)));
  return truth.arrows.size();
}

void expect_exact_from_everywhere(const ZooMesh& mesh, std::uint64_t seed) {
  ASSERT_GT(mesh.cell_count(), 0U);
  std::size_t pairs = 0;
  for (const auto& [name, view] : special_views(mesh, seed)) {
    SCOPED_TRACE(name);
    pairs += expect_exact(mesh, view);
  }
  EXPECT_GT(pairs, mesh.cell_count());
}

std::string name_of(CellShape shape) { return std::string(topology_of(shape).name); }

// A hash of a place: the same everywhere.
std::uint64_t mixed(std::uint64_t seed, int i, int j, int k) {
  std::mt19937_64 random(seed * 1000003U + static_cast<std::uint64_t>(i * 961 + j * 31 + k));
  return random();
}

TEST(VisibilityOrderExactness, RandomDelaunay) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(seed);
    const ZooMesh mesh = random_delaunay(5, seed);
    expect_exact_from_everywhere(mesh, seed);
    expect_exact_from_everywhere(
        keep_cells(mesh, [&](const Position&,
                             CellId cell) { return mixed(seed, int(cell), 0, 0) % 3 != 0; }),
        seed);
  }
}

TEST(VisibilityOrderExactness, ConvexMeshesOfEveryShape) {
  for (const CellShape shape : kShapes) {
    SCOPED_TRACE(name_of(shape));
    const ZooMesh mesh = blocks(2, [&](int, int, int) { return Block{shape}; });
    EXPECT_TRUE(sorted(mesh, along("", {0, 0, 1}).view).statistics.convex);
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      SCOPED_TRACE(seed);
      expect_exact_from_everywhere(distorted(mesh, seed), seed);
    }
  }
}

// A cavity, a tunnel, and cells taken out anywhere: parts fall apart, and touch in edges and
// corners alone.
TEST(VisibilityOrderExactness, MeshesOfEveryShapeWithParts) {
  for (const CellShape shape : kShapes) {
    SCOPED_TRACE(name_of(shape));
    const auto where = [&](const std::function<bool(int, int, int)>& there) {
      return blocks(3, [&](int i, int j, int k) {
        return there(i, j, k) ? std::optional(Block{shape}) : std::nullopt;
      });
    };
    const bool fine = shape == CellShape::tetrahedron || shape == CellShape::pyramid;
    expect_exact_from_everywhere(
        distorted(where([](int i, int j, int k) { return i != 1 || j != 1 || k != 1; }), 1), 1);
    expect_exact_from_everywhere(
        distorted(where([](int i, int j, int) { return i != 1 || j != 1; }), 2), 2);
    for (std::uint64_t seed = 3; seed <= (fine ? 4 : 7); ++seed) {
      SCOPED_TRACE(seed);
      const ZooMesh mesh =
          where([&](int i, int j, int k) { return mixed(seed, i, j, k) % 2 == 0; });
      expect_exact_from_everywhere(distorted(mesh, seed), seed);
    }
  }
}

// Cubes cut in any of the five ways beside one another, some of them halved: faces do not match,
// and nodes hang on edges and faces.
TEST(VisibilityOrderExactness, MixedMeshesWithHangingNodes) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE(seed);
    const ZooMesh mesh = blocks(2, [&](int i, int j, int k) -> std::optional<Block> {
      const std::uint64_t number = mixed(seed, i, j, k);
      if (number % 7 == 0) return std::nullopt;
      return Block{kShapes[number / 7 % 5], number / 35 % 5 == 0};
    });
    expect_exact_from_everywhere(distorted(mesh, seed), seed);
  }
}

// One brick beside eight small ones.
TEST(VisibilityOrderExactness, OneCellBesideManyOfEveryShape) {
  for (const CellShape large : kShapes)
    for (const CellShape small : kShapes) {
      SCOPED_TRACE(name_of(large) + ", " + name_of(small));
      const ZooMesh mesh = blocks(2, [&](int i, int j, int k) -> std::optional<Block> {
        if (j != 0 || k != 0) return std::nullopt;
        return i == 0 ? Block{large} : Block{small, true};
      });
      expect_exact_from_everywhere(distorted(mesh, 5), 7);
    }
}

// Two bodies that touch on a plane, or are nearer than anything but the last bit of coordinates can
// tell: their faces do not match.
TEST(VisibilityOrderExactness, SlidingInterfacesAndGapsOfAnUlp) {
  const double ulp = std::nextafter(1.0, 2.0) - 1;
  for (const CellShape shape : kShapes)
    for (const double gap : {0.0, ulp, 1e-9}) {
      SCOPED_TRACE(name_of(shape));
      SCOPED_TRACE(gap);
      const ZooMesh body = blocks(
          2, [&](int, int, int k) { return k == 0 ? std::optional(Block{shape}) : std::nullopt; });
      const ZooMesh left = moved(body, [](const Position& p) {
        return Position{p[0] / 8, p[1] / 8, p[2] / 8};
      });
      const ZooMesh right = moved(body, [gap](const Position& p) {
        return Position{1 + gap + p[0] / 16, p[1] / 8 + 0.1875, p[2] / 8 - 0.0625};
      });
      const ZooMesh mesh = side_by_side(left, right);
      expect_exact_from_everywhere(mesh, 3);
      expect_exact(mesh, from_eye("in the plane", {1, 3, 0.25}).view);
      expect_exact(mesh, from_eye("in the gap", {1 + ulp, 0.5, 0.25}).view);
    }
}

// Edges of a structured grid collapsed into a line, and cells without volume there.
TEST(VisibilityOrderExactness, CollapsedEdges) {
  for (const Collapse collapse : {Collapse::coincident, Collapse::merged}) {
    SCOPED_TRACE(collapse == Collapse::merged ? "merged" : "coincident");
    const ZooMesh fan = collapsed_fan(9, 3, 2, collapse);
    expect_exact_from_everywhere(fan, 1);
    // a second one a little above, turned: rays leave the one and enter the other
    const ZooMesh above = moved(fan, [](const Position& p) {
      return Position{p[1] + 16, -p[0] - 8, p[2] + 80.5};
    });
    expect_exact_from_everywhere(side_by_side(fan, above), 2);
    // its second layer without height
    const ZooMesh flat = moved(collapsed_fan(9, 2, 3, collapse), [](const Position& p) {
      return Position{p[0], p[1], p[2] > 40 ? p[2] - 40 : p[2]};
    });
    EXPECT_EQ(exact_relation(flat, along("", {1, 2, 3}).view).flat.size(), 18U);
    expect_exact_from_everywhere(flat, 3);
    // and its middle ring without width
    const ZooMesh thin = moved(collapsed_fan(9, 3, 2, collapse), [](const Position& p) {
      const double ring = std::round(std::hypot(p[0], p[1]) / 64), to = ring > 1 ? ring - 1 : ring;
      const double scale = ring == 0 ? 0 : to / ring;
      return Position{p[0] * scale, p[1] * scale, p[2]};
    });
    expect_exact_from_everywhere(thin, 4);
  }
}

// Whatever overlaps is named to the order: then all that does not is in order, and cells are in one
// group exactly when the relation, to which cells that overlap belong both ways, has a cycle.
std::size_t expect_exact_where_cells_overlap(const ZooMesh& mesh, const View& view) {
  const ExactRelation truth = exact_relation(mesh, view);
  OrderBasis basis = order_basis(mesh, build_face_adjacency(mesh));
  Arrows arrows = truth.arrows;
  for (const auto& [a, b] : truth.overlapping) {
    basis.overlaps.push_back({a, b});
    arrows.emplace_back(a, b);
    arrows.emplace_back(b, a);
  }
  std::ranges::sort(arrows);
  EXPECT_TRUE(is_order_of(struck(arrows, truth.flat), mesh.cell_count() - truth.flat.size(),
                          struck(exact_order(basis, view, 1e-10).order, truth.flat)));
  return truth.overlapping.size();
}

// Bodies moved through one another, by a part of a cell or by whole ones; and one within a cell.
TEST(VisibilityOrderExactness, BodiesThatOverlap) {
  for (const CellShape shape : kShapes)
    for (const Position& by : {Position{3, 1, 5}, {4, 4, 4}, {0, 0, 7}, {-1, 6.5, 2}, {2, 0, 0}}) {
      SCOPED_TRACE(name_of(shape) + " moved by " + std::to_string(by[0]));
      const ZooMesh body = blocks(2, [&](int, int, int) { return Block{shape}; });
      const ZooMesh other = moved(body, [&](const Position& p) {
        return Position{p[0] + by[0], p[1] + by[1], p[2] + by[2]};
      });
      const ZooMesh mesh = distorted(side_by_side(body, other), 1);
      std::size_t overlapping = 0;
      for (const auto& [name, view] : special_views(mesh, 2)) {
        SCOPED_TRACE(name);
        overlapping += expect_exact_where_cells_overlap(mesh, view);
      }
      EXPECT_GT(overlapping, 0U);
    }
}

// Nodes pushed until cells are turned inside out, and lie on one side of faces that they share.
TEST(VisibilityOrderExactness, TangledMeshes) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const double most = seed % 2 == 0 ? 0.125 : 0.25;
    const ZooMesh mesh = moved(random_delaunay(5, seed), [&](const Position& p) {
      Position place = p;
      for (double& x : place) x += most * (static_cast<double>(random() % 1024) / 512 - 1);
      return place;
    });
    std::size_t overlapping = 0;
    for (const auto& [name, view] : special_views(mesh, seed)) {
      SCOPED_TRACE(name);
      overlapping += expect_exact_where_cells_overlap(mesh, view);
    }
    EXPECT_GT(overlapping, 0U);
  }
}

}  // namespace
}  // namespace hiac::test
