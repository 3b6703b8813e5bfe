#include "hiac/check/quality/mesh_parts.hpp"

#include <map>
#include <numeric>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "hiac/base/parallel.hpp"
#include "hiac/check/quality/disjoint_sets.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "tests/check/findings.hpp"
#include "tests/order/order_meshes.hpp"

namespace hiac::test {
namespace {

MeshParts parts_of(const ZooMesh& mesh) {
  return mesh_parts(mesh, build_face_adjacency(mesh), judge_cells(mesh, 0));
}

/// Sets by relabelling.
struct Labels {
  std::vector<std::size_t> of;

  explicit Labels(std::size_t count) : of(count) { std::iota(of.begin(), of.end(), 0U); }
  void join(std::size_t a, std::size_t b) {
    const std::size_t from = of[a], to = of[b];
    std::ranges::replace(of, from, to);
  }
};

struct Counts {
  std::uint64_t components, shells, cavities;
  std::int64_t tunnels;
};

using Edges = std::set<std::set<NodeId>>;

Edges edges_of(const ZooMesh& mesh, CellId cell) {
  Edges edges;
  const auto nodes = mesh.cell_nodes(cell);
  for (const auto& [a, b] : topology_of(mesh.kinds[cell]).edges) edges.insert({nodes[a], nodes[b]});
  return edges;
}

/// How many bodies the cells are when those with a common edge are joined; with `at`, only those
/// edges count that end there.
std::size_t bodies_of(const std::vector<Edges>& cells, const NodeId* at = nullptr) {
  Labels labels(cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (std::size_t d = 0; d < c; ++d)
      for (const auto& edge : cells[c])
        if ((at == nullptr || edge.contains(*at)) && cells[d].contains(edge)) labels.join(c, d);
  return std::set(labels.of.begin(), labels.of.end()).size();
}

/// What is left of a mesh that fills a convex region when only the cells in `kept` stay, told by
/// its homology: b2 is the number of regions of emptiness that do not reach the outside, b0 the
/// number of bodies, and b0 - b1 + b2 = nodes - edges + faces - cells. It has b0 + b2 boundary
/// surfaces, whose genera add up to b1 (Alexander's duality). Bodies that touch at a node alone are
/// apart: a node counts as often as there are bodies of the cells around it.
Counts by_homology(const ZooMesh& whole, const std::vector<bool>& kept) {
  const FaceAdjacency adjacency = build_face_adjacency(whole);
  const std::vector<std::uint64_t> offsets = face_offsets(whole);
  const std::size_t cells = whole.cell_count();
  Labels by_face(cells), empty(cells + 1);
  std::map<NodeId, std::vector<Edges>> around;
  std::vector<Edges> bodies;
  std::set<std::set<NodeId>> edges, faces;
  for (CellId c = 0; c < cells; ++c) {
    const auto own = whole.cell_nodes(c);
    const ShapeTopology& shape = topology_of(whole.kinds[c]);
    for (std::size_t f = 0; f < shape.faces.size(); ++f) {
      const CellId other = adjacency.neighbors[offsets[c] + f];
      if (other == kNoCell && !kept[c]) empty.join(c, cells);
      if (other != kNoCell && kept[other] == kept[c]) (kept[c] ? by_face : empty).join(c, other);
      std::set<NodeId> corners;
      for (std::size_t k = 0; k < shape.faces[f].corner_count; ++k)
        corners.insert(own[shape.faces[f].corners[k]]);
      if (kept[c]) faces.insert(corners);
    }
    if (!kept[c]) continue;
    bodies.push_back(edges_of(whole, c));
    edges.insert(bodies.back().begin(), bodies.back().end());
    for (const NodeId node : own) around[node].push_back(bodies.back());
  }
  std::size_t nodes = 0;
  for (const auto& [node, cells_there] : around) nodes += bodies_of(cells_there, &node);
  std::set<std::size_t> components, regions;
  for (CellId c = 0; c < cells; ++c) {
    if (kept[c]) components.insert(by_face.of[c]);
    if (!kept[c] && empty.of[c] != empty.of[cells]) regions.insert(empty.of[c]);
  }
  const std::size_t shells = bodies_of(bodies) + regions.size();
  const auto euler = static_cast<std::int64_t>(nodes + faces.size()) -
                     static_cast<std::int64_t>(edges.size() + bodies.size());
  return {components.size(), shells, regions.size(), static_cast<std::int64_t>(shells) - euler};
}

TEST(MeshParts, AsHomologyTells) {
  std::mt19937 random(11);
  const std::vector<ZooMesh> wholes{structured(4, Cut::bricks), structured(2, Cut::tetrahedra),
                                    structured(3, Cut::prisms), structured(2, Cut::pyramids),
                                    random_delaunay(25, 3)};
  std::uint64_t cavities = 0, branching = 0;
  std::int64_t tunnels = 0;
  for (int round = 0; round < 200; ++round) {
    const ZooMesh& whole = wholes[static_cast<std::size_t>(round) % wholes.size()];
    // few gaps make cavities, many make tunnels and parts
    const auto of_ten = 2 + random() % 7;
    std::vector<bool> kept(whole.cell_count());
    for (std::size_t c = 0; c < kept.size(); ++c) kept[c] = random() % 10 < of_ten;
    const ZooMesh some =
        keep_cells(whole, [&](const Position&, CellId cell) { return kept[cell]; });
    if (some.cell_count() == 0) continue;
    // of either hand
    const ZooMesh mesh = round % 2 == 0 ? some : moved(some, [](const Position& p) {
      return Position{p[0], 3 - p[1], p[2]};
    });
    const MeshParts found = parts_of(mesh);
    const Counts expected = by_homology(whole, kept);
    EXPECT_EQ(found.components, expected.components) << round;
    EXPECT_EQ(found.shells, expected.shells) << round;
    EXPECT_EQ(found.cavities, expected.cavities) << round;
    EXPECT_EQ(found.tangled_edges, 0U) << round;
    ASSERT_TRUE(found.tunnels.has_value());
    EXPECT_EQ(*found.tunnels, expected.tunnels) << round;
    cavities += found.cavities;
    tunnels += *found.tunnels;
    branching += found.branching_edges;
  }
  EXPECT_GT(cavities, 100U);
  EXPECT_GT(tunnels, 100);
  EXPECT_GT(branching, 1000U);
}

TEST(MeshParts, ARingAndAHollowBall) {
  const auto off = [](double x) { return std::abs(x - 0.5) > 0.2; };
  const ZooMesh cube = structured(3, Cut::bricks);
  const MeshParts ring =
      parts_of(keep_cells(cube, [&](const Position& p, CellId) { return off(p[0]) || off(p[1]); }));
  EXPECT_EQ(ring.components, 1U);
  EXPECT_EQ(ring.shells, 1U);
  EXPECT_EQ(ring.cavities, 0U);
  EXPECT_EQ(ring.tunnels, 1);
  const MeshParts hollow = parts_of(keep_cells(
      cube, [&](const Position& p, CellId) { return off(p[0]) || off(p[1]) || off(p[2]); }));
  EXPECT_EQ(hollow.shells, 2U);
  EXPECT_EQ(hollow.cavities, 1U);
  EXPECT_EQ(hollow.tunnels, 0);
  EXPECT_EQ(hollow.boundary_faces, 54U + 6U);
}

// A body in another one's cavity; the same body twice in a mesh, side by side; a slit of no width.
TEST(MeshParts, BodiesWithinAndBesideOneAnother) {
  const ZooMesh cube = structured(3, Cut::bricks);
  const ZooMesh hollow = keep_cells(cube, [](const Position& p, CellId) {
    return std::abs(p[0] - 0.5) + std::abs(p[1] - 0.5) + std::abs(p[2] - 0.5) > 0.1;
  });
  const auto small = moved(structured(2, Cut::tetrahedra), [](const Position& p) {
    return Position{0.45 + p[0] / 10, 0.45 + p[1] / 10, 0.45 + p[2] / 10};
  });
  const MeshParts nested = parts_of(side_by_side(hollow, small));
  EXPECT_EQ(nested.components, 2U);
  EXPECT_EQ(nested.shells, 3U);
  EXPECT_EQ(nested.cavities, 1U);
  const MeshParts twice = parts_of(side_by_side(cube, cube));
  EXPECT_EQ(twice.components, 2U);
  EXPECT_EQ(twice.cavities, 0U);
  // the middle cube of 3^3 has nodes of its own: what is around it has a cavity, which it fills
  const ZooMesh core = keep_cells(cube, [&](const Position& p, CellId) {
    return std::abs(p[0] - 0.5) + std::abs(p[1] - 0.5) + std::abs(p[2] - 0.5) < 0.1;
  });
  EXPECT_EQ(parts_of(side_by_side(hollow, core)).cavities, 1U);
}

// Bricks above and below a node of their own enclose nothing between them where both nodes are at
// one place; a cavity one ulp thick is one.
TEST(MeshParts, CavitiesOfAlmostNoVolume) {
  for (const bool open : {false, true}) {
    // leaning, so that only sums of numbers that cancel tell how much is between
    const ZooMesh block = structured(4, Cut::bricks);
    std::vector<Position> places = positions_of(block);
    std::vector<Cell> cells = cells_of(block);
    // a node in the middle of the cube gets a twin for the cells above it
    NodeId middle = 0;
    while (places[middle] != Position{0.5, 0.5, 0.5}) ++middle;
    places.push_back(places[middle]);
    const std::vector<Position> upright = places;
    for (Position& p : places) p[2] += p[0] + p[1];
    if (open) places.back()[2] = above(places.back()[2]);
    for (Cell& cell : cells) {
      double height = 0;
      for (const NodeId n : cell.nodes) height += upright[n][2] / 8;
      if (height > 0.5)
        std::ranges::replace(cell.nodes, middle, static_cast<NodeId>(places.size() - 1));
    }
    const MeshParts parts = parts_of(make_mesh(places, cells));
    EXPECT_EQ(parts.components, 1U);
    EXPECT_EQ(parts.shells, 2U);
    EXPECT_EQ(parts.cavities, open ? 1U : 0U);
  }
}

// Two prisms as bricks with two edges collapsed, those of both into the same nodes.
TEST(MeshParts, CellsWithRepeatedNodes) {
  const MeshParts parts = parts_of(make_mesh(
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {2, 0, 0}, {2, 0, 1}},
      {{CellKind::brick8, {0, 1, 2, 2, 3, 4, 5, 5}},
       {CellKind::brick8, {1, 6, 2, 2, 4, 7, 5, 5}}}));
  EXPECT_EQ(parts.components, 1U);
  EXPECT_EQ(parts.boundary_faces, 8U);
  EXPECT_EQ(parts.shells, 1U);
  EXPECT_EQ(parts.cavities, 0U);
  EXPECT_EQ(parts.tangled_edges, 0U);
  EXPECT_EQ(parts.tunnels, 0);
}

TEST(MeshParts, OverlapsAreTangled) {
  // three tetrahedra share a face
  const MeshParts three =
      parts_of(make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 2}, {0, 0, -1}},
                         {{CellKind::tetrahedron4, {0, 1, 2, 3}},
                          {CellKind::tetrahedron4, {0, 1, 2, 4}},
                          {CellKind::tetrahedron4, {0, 2, 1, 5}}}));
  EXPECT_GT(three.tangled_edges, 0U);
  EXPECT_FALSE(three.tunnels.has_value());
  EXPECT_EQ(three.components, 3U);
}

TEST(DisjointSets, FromSeveralThreadsAsFromOne) {
  constexpr std::uint32_t kCount = 20'000;
  std::mt19937 random(2);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs(kCount / 2);
  for (auto& [a, b] : pairs) {
    a = static_cast<std::uint32_t>(random() % kCount);
    b = static_cast<std::uint32_t>(random() % kCount);
  }
  std::vector<std::vector<std::uint32_t>> found;
  for (const unsigned threads : {1U, 4U}) {
    const ThreadLimit limit(threads);
    DisjointSets sets(kCount);
    parallel_for(pairs.size(), 16, [&](IndexRange range) {
      for (std::size_t i = range.begin; i < range.end; ++i)
        sets.join(pairs[i].first, pairs[i].second);
    });
    const SetNumbers numbers = number_sets(sets);
    found.push_back(numbers.of);
    EXPECT_EQ(std::ranges::max(numbers.of) + 1, numbers.count);
  }
  EXPECT_EQ(found[0], found[1]);
  for (const auto& [a, b] : pairs) EXPECT_EQ(found[0][a], found[0][b]);
}

}  // namespace
}  // namespace hiac::test
