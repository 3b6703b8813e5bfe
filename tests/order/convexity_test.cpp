#include "hiac/order/faces/convexity.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "hiac/mesh/face_adjacency.hpp"
#include "tests/order/order_meshes.hpp"

namespace hiac::test {
namespace {

constexpr std::array kCuts{Cut::bricks, Cut::tetrahedra, Cut::prisms, Cut::pyramids};

bool is_convex(const ZooMesh& mesh) { return boundary_is_convex(mesh, build_face_adjacency(mesh)); }

ZooMesh without(const ZooMesh& mesh, const std::function<bool(const Position&)>& gone) {
  return keep_cells(mesh, [&](const Position& centroid, CellId) { return !gone(centroid); });
}

ZooMesh shifted(const ZooMesh& mesh, const Position& by) {
  return moved(mesh, [&by](const Position& p) -> Position {
    return {p[0] + by[0], p[1] + by[1], p[2] + by[2]};
  });
}

TEST(Convexity, CubesAreConvexHoweverTheyAreCut) {
  for (const Cut cut : kCuts)
    for (const std::size_t n : {1U, 2U, 3U, 4U}) {
      EXPECT_TRUE(is_convex(structured(n, cut)));
      EXPECT_TRUE(
          is_convex(inverted(structured(n, cut), [](CellId cell) { return cell % 3 == 1; })));
    }
  EXPECT_TRUE(is_convex(random_delaunay(200, 1)));
  EXPECT_TRUE(is_convex(flat_between()));
  EXPECT_TRUE(is_convex(pinwheel()));
}

TEST(Convexity, ABodyWithSlantedSidesIsConvex) {
  const auto slanted = [](const Position& p) -> Position {
    return {p[0] * (1 + p[2] / 4), p[1] * (1 + p[2] / 4), p[2]};  // a frustum, sides planar
  };
  for (const Cut cut : {Cut::bricks, Cut::tetrahedra, Cut::prisms})
    EXPECT_TRUE(is_convex(moved(structured(4, cut), slanted)));
}

// Stars of five and seven points and a square twice, each convex along all edges.
TEST(Convexity, WhatWindsAroundTwiceIsNot) {
  for (const int sectors : {3, 4, 5, 8}) EXPECT_TRUE(is_convex(wound(sectors, 1))) << sectors;
  for (const auto& [sectors, turns] : {std::pair(5, 2), std::pair(8, 2), std::pair(7, 3)}) {
    const ZooMesh mesh = wound(sectors, turns);
    EXPECT_FALSE(is_convex(mesh)) << sectors;
    // whichever face comes first
    std::vector<Cell> cells = cells_of(mesh);
    for (int k = 1; k < sectors; ++k) {
      std::ranges::rotate(cells, cells.begin() + 1);
      EXPECT_FALSE(is_convex(make_mesh(positions_of(mesh), cells))) << sectors;
    }
  }
}

TEST(Convexity, NotchesCavitiesAndTunnelsAreNot) {
  const auto notch = [](const Position& p) { return p[2] > 0.7 && p[0] > 0.3 && p[0] < 0.7; };
  const auto corner = [](const Position& p) { return p[0] > 0.7 && p[1] > 0.7 && p[2] > 0.7; };
  const auto cavity = [](const Position& p) {
    return std::ranges::all_of(p, [](double x) { return x > 0.3 && x < 0.7; });
  };
  const auto tunnel = [](const Position& p) { return std::hypot(p[0] - 0.5, p[1] - 0.5) < 0.3; };
  for (const Cut cut : kCuts) {
    EXPECT_FALSE(is_convex(without(structured(4, cut), notch)));
    EXPECT_FALSE(is_convex(without(structured(4, cut), corner)));
    EXPECT_FALSE(is_convex(without(structured(4, cut), cavity)));
    EXPECT_FALSE(is_convex(without(structured(4, cut), tunnel)));
  }
}

// A dent of one ulp in a side is a dent.
TEST(Convexity, TheSmallestDent) {
  const double dent = std::nextafter(1.0, 0.0);
  EXPECT_FALSE(
      is_convex(moved(structured(2, Cut::tetrahedra), [dent](const Position& p) -> Position {
        const bool middle = p[0] == 0.5 && p[1] == 0.5 && p[2] == 1;
        return {p[0], p[1], middle ? dent : p[2]};
      })));
}

TEST(Convexity, SeveralBodiesAreNot) {
  const ZooMesh cube = structured(2, Cut::bricks);
  EXPECT_FALSE(is_convex(side_by_side(cube, shifted(cube, {3, 0, 0}))));
  // side by side without common nodes, the whole would be a convex body
  EXPECT_FALSE(is_convex(side_by_side(cube, shifted(cube, {1, 0, 0}))));
}

// Two bricks with an edge or a corner in common, and nothing more.
TEST(Convexity, BodiesThatMeetInAnEdgeOrACornerAreNot) {
  const auto pair = [](bool same_height) {
    return without(structured(2, Cut::bricks), [same_height](const Position& p) {
      const bool low = p[0] < 0.5 && p[1] < 0.5 && p[2] < 0.5;
      const bool high = p[0] > 0.5 && p[1] > 0.5 && (p[2] < 0.5) == same_height;
      return !low && !high;
    });
  };
  EXPECT_FALSE(is_convex(pair(true)));
  EXPECT_FALSE(is_convex(pair(false)));
}

TEST(Convexity, CracksAreNot) {
  for (const Cut cut : kCuts)
    for (const double front : {-1.0, 0.25, 0.75})
      EXPECT_FALSE(is_convex(torn(structured(4, cut), front)));
}

TEST(Convexity, NothingIsCertainOfACellWithoutVolumeOnTheBoundary) {
  EXPECT_FALSE(is_convex(make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}},
                                   {{CellKind::tetrahedron4, {0, 1, 2, 3}}})));
}

TEST(Convexity, WarpedSidesAreNot) {
  const auto warped = [](const Position& p) -> Position {
    return {p[0] + 0.1 * p[1] * p[2], p[1], p[2]};
  };
  EXPECT_FALSE(is_convex(moved(structured(2, Cut::bricks), warped)));
}

}  // namespace
}  // namespace hiac::test
