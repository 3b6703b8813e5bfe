#pragma once

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/mesh/shape_functions.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac::formats {

using Vector = std::array<double, 3>;

/// An element as a format documents it: its corners' reference coordinates in the format's order,
/// the edges on which its further nodes lie, in their order, and how many lie on each.
struct DocumentedElement {
  std::string name;
  CellKind kind;
  std::vector<Vector> corners;
  std::vector<std::pair<int, int>> edges;
  int on_edge = 0;
  std::vector<std::array<int, 3>> faces = {};  ///< with a node in the middle
};

inline std::vector<Vector> reference_points(const DocumentedElement& element) {
  std::vector<Vector> points = element.corners;
  for (const auto& [a, b] : element.edges)
    for (int k = 1; k <= element.on_edge; ++k) {
      const double t = double(k) / (element.on_edge + 1);
      Vector p{};
      for (std::size_t c = 0; c < 3; ++c)
        p[c] =
            (1 - t) * element.corners[std::size_t(a)][c] + t * element.corners[std::size_t(b)][c];
      points.push_back(p);
    }
  for (const auto& face : element.faces) {
    Vector p{};
    for (const int corner : face)
      for (std::size_t c = 0; c < 3; ++c) p[c] += element.corners[std::size_t(corner)][c] / 3;
    points.push_back(p);
  }
  return points;
}

/// A right-handed affine map, so that no node is where its number could be guessed.
inline Vector placed(const Vector& p) {
  return {2 + 1.5 * p[0] + 0.25 * p[1], -1 + p[1] + 0.5 * p[2], 0.5 + 0.125 * p[0] + 2 * p[2]};
}

/// A polynomial that the kind's interpolant reproduces.
inline double polynomial(CellKind kind, const Vector& x) {
  const double linear = 1 + x[0] - 2 * x[1] + 0.5 * x[2];
  if (order_of(kind) == CellOrder::linear) return linear;
  const double quadratic = linear + x[0] * x[1] - 3 * x[1] * x[2] + x[2] * x[2];
  if (kind != CellKind::tetrahedron20 && kind != CellKind::brick32) return quadratic;
  return quadratic + x[0] * x[1] * x[2] - 0.5 * x[0] * x[0] * x[0] + x[1] * x[2] * x[2];
}

inline std::vector<Vector> placed_points(const DocumentedElement& element) {
  std::vector<Vector> points;
  for (const Vector& p : reference_points(element)) points.push_back(placed(p));
  return points;
}

/// The mesh is one cell of the kind, positively oriented, whose first field interpolates to the
/// polynomial at places in it.
inline void expect_one_cell(const ZooMesh& mesh, const DocumentedElement& element) {
  SCOPED_TRACE(element.name);
  ASSERT_EQ(mesh.cell_count(), 1U);
  ASSERT_EQ(mesh.kinds[0], element.kind);
  ASSERT_GE(mesh.fields.size(), 1U);
  const auto nodes = mesh.cell_nodes(0);
  const Field& field = mesh.fields[0];
  std::vector<double> values(kMaxNodesPerCell);
  std::vector<Vector> gradients(nodes.size());
  // pulled towards an inner point: at a pyramid's apex gradients have no single value
  for (const Vector& at : reference_nodes(element.kind)) {
    Vector xi{};
    for (std::size_t c = 0; c < 3; ++c) xi[c] = 0.25 + 0.6 * (at[c] - 0.25);
    shape_functions<double>(element.kind, xi, values);
    shape_gradients<double>(element.kind, xi, gradients);
    Vector x{};
    double value = 0;
    std::array<Vector, 3> j{};
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const auto p = mesh.position(nodes[n]);
      value += values[n] * field.values[field.location == FieldLocation::node ? nodes[n] : n];
      for (std::size_t r = 0; r < 3; ++r) {
        x[r] += values[n] * p[r];
        for (std::size_t c = 0; c < 3; ++c) j[r][c] += p[r] * gradients[n][c];
      }
    }
    const double jacobian = j[0][0] * (j[1][1] * j[2][2] - j[1][2] * j[2][1]) -
                            j[0][1] * (j[1][0] * j[2][2] - j[1][2] * j[2][0]) +
                            j[0][2] * (j[1][0] * j[2][1] - j[1][1] * j[2][0]);
    EXPECT_GT(jacobian, 0);
    EXPECT_NEAR(value, polynomial(element.kind, x), 1e-12);
  }
}

inline const std::vector<Vector> kTetraCorners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
inline const std::vector<Vector> kPyramidCorners{
    {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}};
inline const std::vector<Vector> kPrismCorners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0},
                                               {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
inline const std::vector<Vector> kBrickCorners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                               {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

}  // namespace hiac::formats
