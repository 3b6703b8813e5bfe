#include "hiac/geometry/bezier_patch.hpp"

#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/geometry/face_form.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

// Every face of every kind, as a patch, against the cell's own shape functions there. The patch
// begins at the lowest node, and nodes are numbered at random.
TEST(BezierPatch, IsTheTraceOfTheShapeFunctionsOnEveryFace) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(0, 1);
  for (std::size_t k = 0; k < 4 * kKindCount; ++k) {
    const auto kind = static_cast<CellKind>(k % kKindCount);
    const auto reference = reference_nodes(kind);
    std::vector<test::Position> positions(reference.begin(), reference.end());
    test::Cell cell{kind, {}};
    for (NodeId i = 0; i < positions.size(); ++i) cell.nodes.push_back(i);
    if (k >= kKindCount) std::ranges::shuffle(cell.nodes, random);
    for (test::Position& p : positions)
      for (double& x : p) x += 0.2 * (number(random) - 0.5);
    std::vector<test::Position> numbered(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) numbered[cell.nodes[i]] = positions[i];
    const ZooMesh mesh = test::make_mesh(numbered, {cell});
    for (std::size_t f = 0; f < face_count(kind); ++f) {
      const FaceForm form = face_form(mesh, 0, f, 1e-10);
      const auto points = control_points(mesh, 0, f, form);
      EXPECT_EQ(form.shape.degree, static_cast<int>(order_of(kind)));
      for (int i = 0; i < 10; ++i) {
        double u = number(random), v = number(random);
        if (form.shape.triangle && u + v > 1) u = 1 - u, v = 1 - v;
        // the same point of the reference cell
        std::array<double, 3> xi{};
        const auto corner = [&](std::size_t c) { return reference[form.corners[c]]; };
        for (std::size_t c = 0; c < 3; ++c)
          xi[c] = form.shape.triangle
                      ? (1 - u - v) * corner(0)[c] + u * corner(1)[c] + v * corner(2)[c]
                      : (1 - v) * ((1 - u) * corner(0)[c] + u * corner(1)[c]) +
                            v * ((1 - u) * corner(3)[c] + u * corner(2)[c]);
        std::array<double, kMaxNodesPerCell> shape;
        shape_functions<double>(kind, xi, shape);
        for (std::size_t c = 0; c < 3; ++c) {
          double expected = 0;
          for (std::size_t n = 0; n < positions.size(); ++n) expected += shape[n] * positions[n][c];
          PatchNet<double> net;
          for (std::size_t p = 0; p < net.size(); ++p) net[p] = points[p][c];
          const std::size_t degree = form.shape.degree;
          const PatchValue value =
              evaluate_patch(degree, net, BernsteinValues(degree, u), BernsteinValues(degree, v));
          EXPECT_NEAR(value.value, expected, 1e-14) << kind_name(kind) << " face " << f;
        }
      }
    }
  }
}

}  // namespace
}  // namespace hiac
