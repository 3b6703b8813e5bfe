#include "hiac/check/hull_overlap.hpp"

#include <random>

#include <gtest/gtest.h>

#include "tests/check/findings.hpp"
#include "tests/check/rational_overlap.hpp"

namespace hiac::test {
namespace {

using Bodies = std::vector<std::pair<std::vector<Position>, CellKind>>;

// Bodies that share no node.
ZooMesh apart(const Bodies& bodies) {
  std::vector<Position> places;
  std::vector<Cell> cells;
  for (const auto& [corners, kind] : bodies) {
    Cell cell{kind, {}};
    for (const Position& corner : corners) {
      cell.nodes.push_back(static_cast<NodeId>(places.size()));
      places.push_back(corner);
    }
    cells.push_back(std::move(cell));
  }
  return make_mesh(places, cells);
}

bool separated(const ZooMesh& mesh) {
  return are_separated(hull_of_cell(mesh, 0), hull_of_cell(mesh, 1));
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}

  int whole(int most) { return std::uniform_int_distribution<int>(0, most)(engine_); }

  // With volume; of few places, so that corners, edges and faces often touch.
  std::pair<std::vector<Position>, CellKind> body(int most) {
    for (;;) {
      const Position a = place(most), u = place(most), v = place(most), w = place(most);
      const double det = u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) +
                         u[2] * (v[0] * w[1] - v[1] * w[0]);
      if (det == 0) continue;
      const auto at = [&](double i, double j, double k) {
        Position p;
        for (std::size_t c = 0; c < 3; ++c) p[c] = a[c] + i * u[c] + j * v[c] + k * w[c];
        return p;
      };
      switch (whole(3)) {
        case 0:
          return {{at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0), at(0, 0, 1), at(1, 0, 1),
                   at(1, 1, 1), at(0, 1, 1)},
                  CellKind::brick8};
        case 1:
          return {{at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0), at(0, 0, 1)},
                  CellKind::pyramid5};
        case 2:
          return {{at(0, 0, 0), at(1, 0, 0), at(0, 1, 0), at(0, 0, 1), at(1, 0, 1), at(0, 1, 1)},
                  CellKind::prism6};
        default:
          return {{at(0, 0, 0), at(1, 0, 0), at(0, 1, 0), at(0, 0, 1)}, CellKind::tetrahedron4};
      }
    }
  }

 private:
  Position place(int most) {
    return {double(whole(2 * most) - most), double(whole(2 * most) - most),
            double(whole(2 * most) - most)};
  }
  std::mt19937 engine_;
};

TEST(HullOverlap, AsInRationalNumbers) {
  Random random(11);
  int meeting = 0;
  constexpr int kPairs = 200;
  for (int i = 0; i < kPairs; ++i) {
    const ZooMesh mesh = apart({random.body(1 + i % 2), random.body(1)});
    const bool meet = interiors_meet(mesh, 0, 1);
    meeting += meet ? 1 : 0;
    ASSERT_EQ(separated(mesh), !meet) << i;
    const Hull p = hull_of_cell(mesh, 0), q = hull_of_cell(mesh, 1);
    EXPECT_EQ(overlap_depth(p, q) > 1e-12, meet) << i;
  }
  EXPECT_GT(meeting, kPairs / 20);
}

// Points that are said to be common are; and of bodies that overlap well one is found.
TEST(HullOverlap, CommonPointsAreCommon) {
  Random random(5);
  int found = 0, meeting = 0;
  for (int i = 0; i < 120; ++i) {
    const ZooMesh mesh = apart({random.body(1), random.body(2)});
    const Hull p = hull_of_cell(mesh, 0), q = hull_of_cell(mesh, 1);
    const bool meet = interiors_meet(mesh, 0, 1);
    bool any = false;
    for (const int turn_p : {1, -1})
      for (const int turn_q : {1, -1}) any = any || common_point(p, turn_p, 0, q, turn_q, 0);
    EXPECT_LE(any, meet) << i;
    found += any ? 1 : 0;
    meeting += meet ? 1 : 0;
  }
  EXPECT_GE(found * 10, meeting * 9);
}

// Corner against face, edge against edge, face against face: touching, and an ulp deeper.
TEST(HullOverlap, ContactsByOneUlp) {
  const std::vector<Position> cube{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                   {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  const auto corner_on_face = [&](double z) {
    return apart(
        {{cube, CellKind::brick8},
         {{{0.4, 0.4, z}, {0.9, 0.3, 2}, {0.1, 0.2, 2}, {0.5, 0.8, 2}}, CellKind::tetrahedron4}});
  };
  const auto edge_on_edge = [&](double z) {
    return apart(
        {{cube, CellKind::brick8},
         {{{1.5, 0.5, z}, {0.5, 0.5, 1.5}, {2, 0.3, 2}, {2, 0.7, 2}}, CellKind::tetrahedron4}});
  };
  const auto face_on_face = [&](double z) {
    return apart(
        {{cube, CellKind::brick8},
         {{{0.2, 0.2, z}, {0.9, 0.3, z}, {0.5, 0.8, z}, {0.5, 0.5, 2}}, CellKind::tetrahedron4}});
  };
  for (const auto& motion : exact_motions()) {
    EXPECT_TRUE(separated(moved(corner_on_face(1), motion)));
    EXPECT_FALSE(separated(moved(corner_on_face(below(1)), motion)));
    EXPECT_TRUE(separated(moved(edge_on_edge(0.5), motion)));
    EXPECT_FALSE(separated(moved(edge_on_edge(below(0.5)), motion)));
    EXPECT_TRUE(separated(moved(face_on_face(1), motion)));
    EXPECT_FALSE(separated(moved(face_on_face(below(1)), motion)));
  }
}

}  // namespace
}  // namespace hiac::test
