#include "hiac/check/regularity.hpp"

#include <gtest/gtest.h>

#include "hiac/mesh/face_adjacency.hpp"
#include "tests/check/findings.hpp"
#include "tests/order/hard_meshes.hpp"

namespace hiac::test {
namespace {

Acyclicity of(const ZooMesh& mesh) {
  return certify_acyclic(order_basis(mesh, build_face_adjacency(mesh)), judge_cells(mesh, 0))
      .acyclicity;
}

TEST(Regularity, DelaunayMeshesAre) {
  EXPECT_EQ(of(random_delaunay(80, 5)), Acyclicity::delaunay);
  EXPECT_EQ(of(inverted(random_delaunay(80, 5), [](CellId) { return true; })),
            Acyclicity::delaunay);
  EXPECT_EQ(of(structured(3, Cut::bricks)), Acyclicity::delaunay);
}

// Six tetrahedra of a cube lie on one sphere: other heights tell them apart.
TEST(Regularity, TetrahedraOfALatticeAreRegular) {
  EXPECT_EQ(of(structured(1, Cut::tetrahedra)), Acyclicity::regular);
  EXPECT_EQ(of(structured(3, Cut::tetrahedra)), Acyclicity::regular);
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
