#include "hiac/check/regularity.hpp"

#include <algorithm>
#include <array>
#include <random>

#include <gtest/gtest.h>

#include "hiac/check/lifted_orientation.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "tests/check/findings.hpp"
#include "tests/order/hard_meshes.hpp"

namespace hiac::test {
namespace {

Certificate certificate_of(const ZooMesh& mesh) {
  return certify_acyclic(order_basis(mesh, build_face_adjacency(mesh)), judge_cells(mesh, 0));
}
Acyclicity of(const ZooMesh& mesh) { return certificate_of(mesh).acyclicity; }

TEST(Regularity, DelaunayMeshesAre) {
  EXPECT_EQ(of(random_delaunay(80, 5)), Acyclicity::delaunay);
  EXPECT_EQ(of(inverted(random_delaunay(80, 5), [](CellId) { return true; })),
            Acyclicity::delaunay);
  EXPECT_EQ(of(structured(3, Cut::bricks)), Acyclicity::delaunay);
}

// Six tetrahedra of a cube lie on one sphere: they are Delaunay, and other heights tell them apart;
// also many, and where the grid's planes are not evenly spaced.
TEST(Regularity, TetrahedraOfALatticeAreDelaunayAndRegular) {
  for (const std::size_t n : {1U, 3U, 12U})
    for (const bool even : {true, false}) {
      const ZooMesh grid = moved(structured(n, Cut::tetrahedra), [&](const Position& p) {
        return even ? p : Position{p[0] * (1 + p[0]), p[1], 5 * p[2] * (0.25 + p[2])};
      });
      EXPECT_EQ(certificate_of(grid).delaunay, Delaunay::weak) << n;
      EXPECT_EQ(of(grid), Acyclicity::regular) << n;
    }
}

// A slanting grid is Delaunay with respect to another metric.
TEST(Regularity, SlantingLatticesAreRegularButNotDelaunay) {
  const ZooMesh grid = moved(structured(4, Cut::tetrahedra), [](const Position& p) {
    return Position{p[0] + 2 * p[2], p[1] - p[0], p[2]};
  });
  EXPECT_EQ(certificate_of(grid).delaunay, Delaunay::none);
  EXPECT_EQ(of(grid), Acyclicity::regular);
}

// By every node against every sphere, exactly.
TEST(Regularity, DelaunayAsAllNodesTell) {
  std::mt19937 random(4);
  std::array<int, 4> told{};
  for (int round = 0; round < 60; ++round) {
    // corners of a lattice, so that many are on one sphere; some flattened, so that it fits no more
    const ZooMesh block = structured(1 + random() % 2, Cut::tetrahedra);
    const double slant = round % 3 == 0 ? 0.25 * static_cast<double>(random() % 5) : 0;
    const ZooMesh mesh =
        round % 3 == 1 ? random_delaunay(20, random()) : moved(block, [&](const Position& p) {
          return Position{p[0] + slant * p[1], p[1], p[2]};
        });
    bool empty = true, on_sphere = false;
    for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
      const auto own = mesh.cell_nodes(cell);
      const auto at = [&](std::size_t k) { return mesh.position(own[k]); };
      const int turn = orientation(at(0), at(1), at(2), at(3));
      for (NodeId node = 0; node < mesh.node_count(); ++node) {
        if (std::ranges::find(own, node) != own.end()) continue;
        const int side = turn * outside_sphere(at(0), at(1), at(2), at(3), mesh.position(node));
        empty = empty && side >= 0;
        on_sphere = on_sphere || side == 0;
      }
    }
    const Delaunay found = certificate_of(mesh).delaunay;
    EXPECT_EQ(found, !empty ? Delaunay::none : on_sphere ? Delaunay::weak : Delaunay::strict);
    ++told[static_cast<std::size_t>(found)];
  }
  EXPECT_EQ(told[0], 0);
  for (const Delaunay d : {Delaunay::none, Delaunay::weak, Delaunay::strict})
    EXPECT_GT(told[static_cast<std::size_t>(d)], 5);
}

// Every cell is convex and meets its neighbours as a Delaunay cell does, but they overlap.
TEST(Regularity, WhatWindsAroundTwiceIsUnknown) {
  for (const auto& [sectors, turns] : {std::pair(5, 2), std::pair(8, 2)}) {
    EXPECT_EQ(of(wound(sectors, turns)), Acyclicity::unknown);
    EXPECT_EQ(certificate_of(wound(sectors, turns)).delaunay, Delaunay::unknown);
  }
}

// Four and five around an edge, a node moved off the sphere that it lies on by an ulp.
TEST(Regularity, TwoTetrahedraByOneUlp) {
  const auto mesh = [](double z) {
    return make_mesh(
        {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, z}},
        {{CellKind::tetrahedron4, {0, 2, 1, 3}}, {CellKind::tetrahedron4, {0, 1, 2, 4}}});
  };
  EXPECT_EQ(of(mesh(below(-1))), Acyclicity::delaunay);
  EXPECT_EQ(of(mesh(-1)), Acyclicity::regular);
  EXPECT_EQ(of(mesh(above(-1))), Acyclicity::regular);
  EXPECT_EQ(certificate_of(mesh(below(-1))).delaunay, Delaunay::strict);
  EXPECT_EQ(certificate_of(mesh(-1)).delaunay, Delaunay::weak);
  EXPECT_EQ(certificate_of(mesh(above(-1))).delaunay, Delaunay::none);
}

// A triangle within a triangle, turned so that no heights lift all edges between them, as the faces
// of tetrahedra below a common apex.
ZooMesh without_heights() {
  return make_mesh(
      {{4, 0, 0}, {0, 4, 0}, {-4, -4, 0}, {1, 0, 0}, {0, 1, 0}, {-1, -1, 0}, {0, 0, 4}},
      {{CellKind::tetrahedron4, {0, 1, 4, 6}},
       {CellKind::tetrahedron4, {0, 4, 3, 6}},
       {CellKind::tetrahedron4, {1, 2, 5, 6}},
       {CellKind::tetrahedron4, {1, 5, 4, 6}},
       {CellKind::tetrahedron4, {2, 0, 3, 6}},
       {CellKind::tetrahedron4, {2, 3, 5, 6}},
       {CellKind::tetrahedron4, {3, 4, 5, 6}}});
}

TEST(Regularity, SaysWhyItIsUnknown) {
  const auto reason = [](const ZooMesh& mesh) { return std::string(certificate_of(mesh).reason); };
  const ZooMesh some = random_delaunay(20, 5);
  EXPECT_EQ(reason(some), "");
  EXPECT_EQ(reason(inverted(some, [](CellId c) { return c == 3; })),
            "not all cells are valid and turn alike");
  EXPECT_EQ(reason(keep_cells(structured(2, Cut::bricks),
                              [](const Position&, CellId c) { return c != 3; })),
            "rays may leave the mesh and enter it again");
  ZooMesh curved = make_mesh({{0, 0, 0},
                              {2, 0, 0},
                              {0, 2, 0},
                              {0, 0, 2},
                              {1, 0, 0},
                              {1, 1, 0},
                              {0, 1, 0},
                              {0, 0, 1},
                              {1, 0, 1},
                              {0, 1, 1}},
                             {{CellKind::tetrahedron10, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}}});
  EXPECT_EQ(reason(curved), "cells are curved");
  const ZooMesh slanting = moved(structured(2, Cut::bricks), [](const Position& p) {
    return Position{p[0] + p[2], p[1], p[2]};
  });
  EXPECT_EQ(reason(slanting), "other heights than Delaunay's are searched for tetrahedra alone");
  EXPECT_EQ(certificate_of(slanting).delaunay, Delaunay::none);
  EXPECT_EQ(reason(without_heights()), "no other heights than Delaunay's found");
  EXPECT_EQ(of(without_heights()), Acyclicity::unknown);
}

// What is not convex, or not linear, or not valid, is not asked further.
TEST(Regularity, OthersAreUnknown) {
  EXPECT_EQ(of(pinwheel()), Acyclicity::unknown);
  EXPECT_EQ(of(flat_between()), Acyclicity::unknown);
  EXPECT_EQ(of(inverted(random_delaunay(20, 5), [](CellId c) { return c == 3; })),
            Acyclicity::unknown);
}

}  // namespace
}  // namespace hiac::test
