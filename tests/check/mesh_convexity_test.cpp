#include "hiac/check/mesh_convexity.hpp"

#include <random>

#include <gmock/gmock.h>

#include "hiac/check/conformity.hpp"
#include "hiac/geometry/predicates.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "tests/check/findings.hpp"
#include "tests/order/hard_meshes.hpp"

namespace hiac::test {
namespace {

using testing::HasSubstr;

MeshConvexity judged(const ZooMesh& mesh, bool interfaces = false) {
  return judge_convexity(mesh, build_face_adjacency(mesh), interfaces);
}

/// By brute force: whether every node lies on the inner side of every boundary face of a mesh of
/// tetrahedra, or in its plane.
bool convex_by_nodes(const ZooMesh& mesh) {
  const FaceAdjacency adjacency = build_face_adjacency(mesh);
  std::size_t slot = 0;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    const auto nodes = mesh.cell_nodes(cell);
    for (const ShapeFace& face : topology_of(mesh.kinds[cell]).faces) {
      if (adjacency.neighbors[slot++] != kNoCell) continue;
      const auto at = [&](std::size_t k) { return mesh.position(nodes[face.corners[k]]); };
      int inner = 0;
      for (const NodeId node : nodes)
        if (const int side = orientation(at(0), at(1), at(2), mesh.position(node)); side != 0)
          inner = side;
      for (const NodeId node : mesh.nodes)
        if (orientation(at(0), at(1), at(2), mesh.position(node)) == -inner) return false;
    }
  }
  return true;
}

TEST(MeshConvexity, AgreesWithEveryNodeAgainstEveryFace) {
  std::mt19937 random(7);
  std::size_t convex = 0, not_convex = 0;
  for (int round = 0; round < 200; ++round) {
    // a few cells less make dents, holes, gaps, or only a smaller body
    const ZooMesh whole = random_delaunay(4 + random() % 8, random());
    const std::size_t dropped = random() % 3;
    const ZooMesh mesh = keep_cells(whole, [&](const Position&, CellId cell) {
      return dropped == 0 || cell % (2 + dropped) != 0;
    });
    const MeshConvexity found = judged(mesh);
    const bool truth = convex_by_nodes(mesh);
    if (found.verdict == Convexity::convex) {
      EXPECT_TRUE(truth);
    }
    if (found.verdict == Convexity::not_convex) {
      EXPECT_FALSE(truth);
    }
    convex += found.verdict == Convexity::convex ? 1 : 0;
    not_convex += found.verdict == Convexity::not_convex ? 1 : 0;
  }
  EXPECT_GT(convex, 40U);
  EXPECT_GT(not_convex, 40U);
}

TEST(MeshConvexity, NamesTheEdgesThatBendInwards) {
  // three of the four quarters of a block: an L
  const ZooMesh l = keep_cells(structured(2, Cut::bricks),
                               [](const Position& p, CellId) { return p[0] < 0.5 || p[1] < 0.5; });
  const MeshConvexity found = judged(l);
  EXPECT_EQ(found.verdict, Convexity::not_convex);
  EXPECT_EQ(found.surfaces, 1U);
  ASSERT_EQ(found.edges.size(), 2U);
  for (const ReentrantEdge& edge : found.edges)
    for (const NodeId node : {edge.low, edge.high}) {
      EXPECT_EQ(l.position(node)[0], 0.5);
      EXPECT_EQ(l.position(node)[1], 0.5);
    }
}

TEST(MeshConvexity, GapsAndCavitiesAreSurfacesOfTheirOwn) {
  const ZooMesh apart = side_by_side(structured(1, Cut::bricks),
                                     moved(structured(1, Cut::bricks), [](const Position& p) {
                                       return Position{p[0] + 2, p[1], p[2]};
                                     }));
  EXPECT_EQ(judged(apart).verdict, Convexity::not_convex);
  EXPECT_EQ(judged(apart).surfaces, 2U);
  EXPECT_TRUE(judged(apart).edges.empty());
  const ZooMesh hollow = keep_cells(structured(3, Cut::bricks), [](const Position& p, CellId) {
    return std::abs(p[0] - 0.5) + std::abs(p[1] - 0.5) + std::abs(p[2] - 0.5) > 0.1;
  });
  EXPECT_EQ(judged(hollow).surfaces, 2U);
  EXPECT_EQ(judged(hollow).verdict, Convexity::not_convex);
  EXPECT_EQ(judged(structured(3, Cut::bricks)).verdict, Convexity::convex);
}

TEST(MeshConvexity, SaysWhatIsNotKnown) {
  const ZooMesh torn = side_by_side(structured(1, Cut::bricks),
                                    moved(structured(1, Cut::bricks), [](const Position& p) {
                                      return Position{p[0] + 1, p[1], p[2]};
                                    }));
  EXPECT_EQ(judged(torn, true).verdict, Convexity::unknown);
  EXPECT_THAT(std::string(judged(torn, true).reason), HasSubstr("not shared"));
  const ZooMesh bent = moved(structured(1, Cut::bricks), [](const Position& p) {
    return Position{p[0], p[1], p[2] + 0.1 * p[0] * p[1]};
  });
  EXPECT_EQ(judged(bent).verdict, Convexity::unknown);
  EXPECT_THAT(std::string(judged(bent).reason), HasSubstr("not planar"));
}

TEST(MeshConvexity, SaysWhy) {
  const auto reason = [](const ZooMesh& mesh) { return std::string(judged(mesh).reason); };
  EXPECT_EQ(reason(structured(2, Cut::bricks)), "");
  EXPECT_EQ(reason(make_mesh({}, {})), "there is no boundary");
  // two cells at one edge, where four boundary faces meet
  EXPECT_EQ(reason(make_mesh(
                {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}},
                {{CellKind::tetrahedron4, {0, 2, 3, 1}}, {CellKind::tetrahedron4, {0, 4, 5, 1}}})),
            "edges have more or fewer than two boundary faces");
  EXPECT_EQ(reason(moved(structured(1, Cut::bricks),
                         [](const Position& p) {
                           return Position{p[0], p[1], p[2] + 0.1 * p[0] * p[1]};
                         })),
            "boundary faces are not planar, or cells have no volume");
  EXPECT_EQ(reason(wound(5, 2)), "the boundary overlaps itself, or winds around more than once");
  // the middles of edges out of line, and an inner angle that then is not told
  std::vector<Position> places{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {1, -0.25, 0}, {1, 1, 0},
                               {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {0.5, -1, -1}};
  const ZooMesh bent = make_mesh(places, {{CellKind::tetrahedron10, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}},
                                          {CellKind::tetrahedron4, {0, 2, 1, 10}}});
  EXPECT_EQ(reason(bent), "the boundary has curved faces");
  EXPECT_EQ(judged(bent).verdict, Convexity::unknown);
  EXPECT_TRUE(judged(bent).edges.empty());
}

// The apex of a cell may be the mesh's first node.
TEST(Interfaces, ACellWithNodeZeroBehindItsFaceIsOnOthers) {
  for (const bool first : {true, false}) {
    const std::vector<Position> places{{0, 0, -1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0},
                                       {0, 0, 0},  {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    std::vector<Cell> cells{{CellKind::tetrahedron4, {1, 3, 2, 0}},
                            {CellKind::tetrahedron4, {4, 5, 6, 7}}};
    if (!first) std::swap(cells[0], cells[1]);
    const ZooMesh mesh = make_mesh(places, cells);
    const auto findings =
        judge_conformity(mesh, build_face_adjacency(mesh), judge_cells(mesh, 0), 0);
    EXPECT_EQ(count_of(findings, Defect::torn_interface), 2U);
  }
}

}  // namespace
}  // namespace hiac::test
