#include "hiac/mesh/shape_functions.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include <gtest/gtest.h>

namespace hiac {
namespace {

using Real = long double;  // the formulae are judged, not the rounding
using Vector = std::array<Real, 3>;

constexpr Real kRounding = 1e-16L;

/// EXPECT_NEAR knows double alone.
testing::AssertionResult near(Real found, Real expected, Real tolerance) {
  if (std::abs(found - expected) <= tolerance) return testing::AssertionSuccess();
  return testing::AssertionFailure() << found << " found, " << expected << " expected";
}

std::vector<CellKind> all_kinds() {
  std::vector<CellKind> kinds;
  for (std::size_t k = 0; k < kKindCount; ++k) kinds.push_back(static_cast<CellKind>(k));
  return kinds;
}

std::vector<Real> functions_at(CellKind kind, const Vector& xi) {
  std::vector<Real> values(node_count(kind));
  shape_functions<Real>(kind, xi, values);
  return values;
}

std::vector<Vector> gradients_at(CellKind kind, const Vector& xi) {
  std::vector<Vector> gradients(node_count(kind));
  shape_gradients<Real>(kind, xi, gradients);
  return gradients;
}

/// Node i in full precision: a third is none in a double.
Vector exact_node(CellKind kind, std::size_t i) {
  Vector node;
  for (std::size_t axis = 0; axis < 3; ++axis)
    node[axis] = std::round(6 * Real(reference_nodes(kind)[i][axis])) / 6;
  return node;
}

/// A point inside the reference cell: a random mean of its corners.
Vector random_point(CellKind kind, std::mt19937& random) {
  Vector point{};
  Real total = 0;
  for (std::size_t c = 0; c < corner_count(kind); ++c) {
    const Real weight = std::exponential_distribution<Real>()(random);
    for (std::size_t axis = 0; axis < 3; ++axis) point[axis] += weight * exact_node(kind, c)[axis];
    total += weight;
  }
  for (Real& coordinate : point) coordinate /= total;
  return point;
}

class ShapeFunctions : public testing::TestWithParam<CellKind> {
 protected:
  void for_random_points(const std::function<void(const Vector&)>& judge) const {
    std::mt19937 random(1998);
    for (int i = 0; i < 200; ++i) judge(random_point(GetParam(), random));
  }
};

INSTANTIATE_TEST_SUITE_P(AllKinds, ShapeFunctions, testing::ValuesIn(all_kinds()),
                         [](const auto& test) { return std::string(kind_name(test.param)); });

TEST_P(ShapeFunctions, AreOneAtTheirNodeAndZeroAtTheOthers) {
  for (std::size_t i = 0; i < node_count(GetParam()); ++i) {
    const auto values = functions_at(GetParam(), exact_node(GetParam(), i));
    for (std::size_t j = 0; j < values.size(); ++j)
      EXPECT_TRUE(near(values[j], i == j ? 1 : 0, kRounding)) << i << ' ' << j;
  }
}

TEST_P(ShapeFunctions, SumToOneAndTheirGradientsToZero) {
  for_random_points([&](const Vector& xi) {
    Real sum = 0;
    for (const Real value : functions_at(GetParam(), xi)) sum += value;
    EXPECT_TRUE(near(sum, 1, kRounding));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Real slope = 0;
      for (const Vector& gradient : gradients_at(GetParam(), xi)) slope += gradient[axis];
      EXPECT_TRUE(near(slope, 0, 10 * kRounding));
    }
  });
}

TEST_P(ShapeFunctions, GradientsAreThoseOfFiniteDifferences) {
  for_random_points([&](const Vector& xi) {
    const auto gradients = gradients_at(GetParam(), xi);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      constexpr Real kStep = 1e-5L;
      const auto at = [&](Real steps) {
        Vector moved = xi;
        moved[axis] += steps * kStep;
        return functions_at(GetParam(), moved);
      };
      const auto a = at(-2), b = at(-1), c = at(1), d = at(2);
      for (std::size_t i = 0; i < gradients.size(); ++i)
        EXPECT_TRUE(
            near(gradients[i][axis], (a[i] - 8 * b[i] + 8 * c[i] - d[i]) / (12 * kStep), 1e-11L));
    }
  });
}

using Monomial = std::array<int, 3>;

Real monomial(const Vector& xi, const Monomial& exponents) {
  Real value = 1;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (int i = 0; i < exponents[axis]; ++i) value *= xi[axis];
  return value;
}

/// What the header promises.
int complete_degree(CellKind kind) {
  if (shape_of(kind) == CellShape::tetrahedron || kind == CellKind::brick32)
    return static_cast<int>(order_of(kind));
  if (shape_of(kind) == CellShape::wedge) return 1;
  return std::min(2, static_cast<int>(order_of(kind)));
}

TEST_P(ShapeFunctions, ReproducePolynomialsToThePromisedDegree) {
  const int degree = complete_degree(GetParam());
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; i + j <= degree; ++j)
      for (int k = 0; i + j + k <= degree; ++k)
        for_random_points([&](const Vector& xi) {
          const auto values = functions_at(GetParam(), xi);
          Real sum = 0;
          for (std::size_t n = 0; n < values.size(); ++n)
            sum += values[n] * monomial(exact_node(GetParam(), n), {i, j, k});
          EXPECT_TRUE(near(sum, monomial(xi, {i, j, k}), 10 * kRounding)) << i << j << k;
        });
}

// -- Faces ---------------------------------------------------------------------------------------

using Plane = std::array<Real, 2>;

/// Textbook functions of the serendipity quadrilateral on [-1,1]^2 for a node at (a, b): 4, 8 and
/// 12 nodes (Zienkiewicz and Taylor, vol. 1, (8.19) to (8.22)).
Real serendipity(CellOrder order, const Plane& node, const Plane& at) {
  const auto [a, b] = node;
  const auto [r, s] = at;
  const bool corner = std::abs(a) == 1 && std::abs(b) == 1;
  if (order == CellOrder::linear) return (1 + a * r) * (1 + b * s) / 4;
  if (order == CellOrder::quadratic) {
    if (corner) return (1 + a * r) * (1 + b * s) * (a * r + b * s - 1) / 4;
    return a == 0 ? (1 - r * r) * (1 + b * s) / 2 : (1 + a * r) * (1 - s * s) / 2;
  }
  if (corner) return (1 + a * r) * (1 + b * s) * (9 * (r * r + s * s) - 10) / 32;
  return std::abs(b) == 1 ? 9 * (1 + b * s) * (1 - r * r) * (1 + 9 * a * r) / 32
                          : 9 * (1 + a * r) * (1 - s * s) * (1 + 9 * b * s) / 32;
}

/// Lagrange's functions of the triangle for the node with barycentric coordinates `node`.
Real lagrange_triangle(int order, const Vector& node, const Vector& at) {
  Real value = 1;
  for (std::size_t c = 0; c < 3; ++c)
    for (int i = 0; i < std::lround(order * node[c]); ++i)
      value *= (order * at[c] - i) / (order * node[c] - i);
  return value;
}

/// The same without a centre node: what it would have carried goes to the others.
Real triangle(CellKind kind, const Vector& node, const Vector& at) {
  const int order = static_cast<int>(order_of(kind));
  const Real own = lagrange_triangle(order, node, at);
  if (order < 3 || kind == CellKind::tetrahedron20) return own;
  const bool corner = *std::ranges::max_element(node) > 0.9L;
  return own +
         lagrange_triangle(3, {1 / 3.0L, 1 / 3.0L, 1 / 3.0L}, at) * (corner ? -1 / 6.0L : 0.25L);
}

/// The face's parameters of every node of a face: (r, s) in [-1,1]^2 or barycentric.
struct FaceNode {
  std::size_t node;
  Vector parameters;
};

std::vector<FaceNode> face_nodes(CellKind kind, const ShapeFace& face) {
  static constexpr Real kSquare[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  std::vector<FaceNode> nodes;
  const auto corner_parameters = [&](std::size_t i) {
    if (face.corner_count == 4) return Vector{kSquare[i][0], kSquare[i][1], 0};
    Vector barycentric{};
    barycentric[i] = 1;
    return barycentric;
  };
  const std::size_t order = static_cast<std::size_t>(order_of(kind));
  const auto edges = topology_of(kind).edges;
  for (std::size_t i = 0; i < face.corner_count; ++i) {
    nodes.push_back({face.corners[i], corner_parameters(i)});
    const std::size_t j = (i + 1) % face.corner_count;
    const auto edge = std::ranges::find_if(edges, [&](const ShapeEdge& e) {
      return std::minmax(e[0], e[1]) == std::minmax(face.corners[i], face.corners[j]);
    });
    const bool forward = (*edge)[0] == face.corners[i];
    const std::size_t first =
        corner_count(kind) + (order - 1) * static_cast<std::size_t>(edge - edges.begin());
    for (std::size_t k = 1; k < order; ++k) {
      const Real share = static_cast<Real>(forward ? k : order - k) / static_cast<Real>(order);
      Vector between;
      for (std::size_t c = 0; c < 3; ++c)
        between[c] = (1 - share) * corner_parameters(i)[c] + share * corner_parameters(j)[c];
      nodes.push_back({first + k - 1, between});
    }
  }
  return nodes;
}

Vector face_point(CellKind kind, const ShapeFace& face, const Vector& parameters) {
  Vector point{};
  for (const FaceNode& corner : face_nodes(kind_of(shape_of(kind), CellOrder::linear), face)) {
    const Real weight =
        face.corner_count == 4
            ? serendipity(CellOrder::linear, {corner.parameters[0], corner.parameters[1]},
                          {parameters[0], parameters[1]})
            : lagrange_triangle(1, corner.parameters, parameters);
    for (std::size_t axis = 0; axis < 3; ++axis)
      point[axis] += weight * exact_node(kind, corner.node)[axis];
  }
  return point;
}

// All shapes have the same functions on a face of the same form, so a field is continuous across
// it.
TEST_P(ShapeFunctions, AreTheTextbooksFunctionsOnEveryFace) {
  const CellKind kind = GetParam();
  std::mt19937 random(7);
  std::uniform_real_distribution<Real> uniform(0, 1);
  const auto faces = topology_of(kind).faces;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const bool quadrilateral = faces[f].corner_count == 4;
    auto nodes = face_nodes(kind, faces[f]);
    if (kind == CellKind::tetrahedron20) nodes.push_back({16 + f, {1 / 3.0L, 1 / 3.0L, 1 / 3.0L}});
    for (int sample = 0; sample < 50; ++sample) {
      Vector at{2 * uniform(random) - 1, 2 * uniform(random) - 1, 0};
      if (!quadrilateral) {
        const Real u = uniform(random), v = uniform(random) * (1 - u);
        at = {u, v, 1 - u - v};
      }
      const auto values = functions_at(kind, face_point(kind, faces[f], at));
      std::vector<Real> expected(values.size(), 0);
      for (const auto& [node, parameters] : nodes)
        expected[node] = quadrilateral ? serendipity(order_of(kind), {parameters[0], parameters[1]},
                                                     {at[0], at[1]})
                                       : triangle(kind, parameters, at);
      for (std::size_t i = 0; i < values.size(); ++i)
        EXPECT_TRUE(near(values[i], expected[i], 10 * kRounding)) << "face " << f << " node " << i;
    }
  }
}

// -- Single kinds --------------------------------------------------------------------------------

// Zienkiewicz and Taylor, vol. 1, ch. 8.
TEST(BrickFunctions, AreTheTextbooks) {
  std::mt19937 random(3);
  for (const CellKind kind : {CellKind::brick8, CellKind::brick20, CellKind::brick32})
    for (int sample = 0; sample < 100; ++sample) {
      const Vector xi = random_point(kind, random);
      const auto values = functions_at(kind, xi);
      Vector r;
      for (std::size_t axis = 0; axis < 3; ++axis) r[axis] = 2 * xi[axis] - 1;
      for (std::size_t i = 0; i < values.size(); ++i) {
        Vector a;
        Real product = 1, dot = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          a[axis] = 2 * exact_node(kind, i)[axis] - 1;
          product *= 1 + a[axis] * r[axis];
          dot += a[axis] * r[axis];
        }
        const auto inner = std::ranges::find_if(a, [](Real c) { return std::abs(c) < 0.9L; });
        Real expected = product / 8;
        if (inner != a.end()) {
          const Real along = *inner, here = r[static_cast<std::size_t>(inner - a.begin())];
          const Real others = product / (1 + along * here) * (1 - here * here);
          expected =
              kind == CellKind::brick20 ? others / 4 : others * (1 + 9 * along * here) * 9 / 64;
        } else if (kind == CellKind::brick20) {
          expected *= dot - 2;
        } else if (kind == CellKind::brick32) {
          expected *= (9 * (r[0] * r[0] + r[1] * r[1] + r[2] * r[2]) - 19) / 8;
        }
        EXPECT_TRUE(near(values[i], expected, kRounding)) << kind_name(kind) << ' ' << i;
      }
    }
}

// Bedrosian's quadratic pyramid as he writes it, on the base [-1,1]^2.
TEST(PyramidFunctions, AreBedrosians) {
  std::mt19937 random(4);
  for (int sample = 0; sample < 100; ++sample) {
    const Vector xi = random_point(CellKind::pyramid13, random);
    const auto values = functions_at(CellKind::pyramid13, xi);
    const Real z = xi[2], w = 1 - z;
    const Real r = 2 * xi[0] - w, s = 2 * xi[1] - w;  // -w ... w
    constexpr Real kBase[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (std::size_t i = 0; i < 4; ++i) {
      const auto [a, b] = kBase[i];
      const Real bilinear = (w + a * r) * (w + b * s) / (4 * w);
      EXPECT_TRUE(near(values[i], bilinear * (a * r + b * s - 1), kRounding)) << i;
      EXPECT_TRUE(near(values[9 + i], 4 * z * bilinear, kRounding));
    }
    EXPECT_TRUE(near(values[4], z * (2 * z - 1), kRounding));
    EXPECT_TRUE(near(values[5], (w * w - r * r) * (w - s) / (2 * w), kRounding));
    EXPECT_TRUE(near(values[6], (w * w - s * s) * (w + r) / (2 * w), kRounding));
  }
}

// vtkLagrangeTetra::GetParametricCoords of VTK 9.1 for 20 points, times three.
TEST(ReferenceNodes, CubicTetrahedronIsVtksLagrangeTetrahedron) {
  constexpr int kVtk[20][3] = {{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, 3}, {1, 0, 0},
                               {2, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0},
                               {0, 0, 1}, {0, 0, 2}, {2, 0, 1}, {1, 0, 2}, {0, 2, 1},
                               {0, 1, 2}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}, {1, 1, 0}};
  const auto nodes = reference_nodes(CellKind::tetrahedron20);
  for (std::size_t i = 0; i < 20; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_DOUBLE_EQ(3 * nodes[i][axis], kVtk[i][axis]) << i;
}

// GetParametricCoords of VTK 9.1 for its quadratic cells, times two; the wedge with x and y
// swapped.
TEST(ReferenceNodes, QuadraticCellsAreVtks) {
  const auto expect = [](CellKind kind, const std::vector<std::array<int, 3>>& vtk) {
    ASSERT_EQ(vtk.size(), node_count(kind));
    for (std::size_t i = 0; i < vtk.size(); ++i)
      for (std::size_t axis = 0; axis < 3; ++axis)
        EXPECT_EQ(2 * reference_nodes(kind)[i][axis], vtk[i][axis]) << kind_name(kind) << ' ' << i;
  };
  expect(CellKind::tetrahedron10, {{0, 0, 0},
                                   {2, 0, 0},
                                   {0, 2, 0},
                                   {0, 0, 2},
                                   {1, 0, 0},
                                   {1, 1, 0},
                                   {0, 1, 0},
                                   {0, 0, 1},
                                   {1, 0, 1},
                                   {0, 1, 1}});
  expect(CellKind::prism15, {{0, 0, 0},
                             {0, 2, 0},
                             {2, 0, 0},
                             {0, 0, 2},
                             {0, 2, 2},
                             {2, 0, 2},
                             {0, 1, 0},
                             {1, 1, 0},
                             {1, 0, 0},
                             {0, 1, 2},
                             {1, 1, 2},
                             {1, 0, 2},
                             {0, 0, 1},
                             {0, 2, 1},
                             {2, 0, 1}});
  expect(CellKind::brick20,
         {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {2, 2, 2},
          {0, 2, 2}, {1, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1, 0}, {1, 0, 2}, {2, 1, 2},
          {1, 2, 2}, {0, 1, 2}, {0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {0, 2, 1}});
}

TEST(ReferenceNodes, FacesTurnCounterClockwiseSeenFromOutsideAndArePlanar) {
  for (const CellKind kind : all_kinds())
    for (const ShapeFace& face : topology_of(kind).faces) {
      const auto corner = [&](std::size_t i) { return exact_node(kind, face.corners[i]); };
      const auto minus = [](const Vector& a, const Vector& b) {
        return Vector{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
      };
      const Vector u = minus(corner(1), corner(0)), v = minus(corner(2), corner(1));
      const Vector normal{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                          u[0] * v[1] - u[1] * v[0]};
      std::size_t in_plane = 0;
      for (std::size_t c = 0; c < corner_count(kind); ++c) {
        const Vector d = minus(exact_node(kind, c), corner(0));
        const Real height = normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2];
        EXPECT_LE(height, 0) << kind_name(kind);
        in_plane += height == 0;
      }
      EXPECT_EQ(in_plane, face.corner_count) << kind_name(kind);
    }
}

// Where a coordinate collapses: finite, and the limit along the stated direction.
TEST(ShapeGradients, AtACollapsedCornerAreTheLimitThroughTheMiddle) {
  const auto judge = [](CellKind kind, const Vector& corner, const Vector& inward) {
    const auto at = gradients_at(kind, corner);
    Vector moved;
    for (std::size_t axis = 0; axis < 3; ++axis) moved[axis] = corner[axis] + 1e-9L * inward[axis];
    const auto beside = gradients_at(kind, moved);
    for (std::size_t i = 0; i < at.size(); ++i)
      for (std::size_t axis = 0; axis < 3; ++axis)
        EXPECT_TRUE(near(at[i][axis], beside[i][axis], 1e-7L)) << kind_name(kind) << ' ' << i;
  };
  for (const CellKind kind : {CellKind::pyramid5, CellKind::pyramid13, CellKind::pyramid21})
    judge(kind, {0, 0, 1}, {0.5L, 0.5L, -1});
  for (const CellKind kind : {CellKind::wedge7, CellKind::wedge18, CellKind::wedge29})
    judge(kind, {0, 1, 1}, {1, -1, -1});
}

TEST(ShapeFunctionsInDouble, AgreeWithLongDouble) {
  std::mt19937 random(5);
  for (const CellKind kind : all_kinds())
    for (int sample = 0; sample < 50; ++sample) {
      const Vector xi = random_point(kind, random);
      const std::array<double, 3> rounded{static_cast<double>(xi[0]), static_cast<double>(xi[1]),
                                          static_cast<double>(xi[2])};
      std::vector<double> values(node_count(kind));
      std::vector<std::array<double, 3>> gradients(node_count(kind));
      shape_functions<double>(kind, rounded, values);
      shape_gradients<double>(kind, rounded, gradients);
      for (std::size_t i = 0; i < values.size(); ++i) {
        EXPECT_TRUE(near(values[i], functions_at(kind, xi)[i], 1e-14L));
        for (std::size_t axis = 0; axis < 3; ++axis)
          EXPECT_TRUE(near(gradients[i][axis], gradients_at(kind, xi)[i][axis], 1e-13L));
      }
    }
}

}  // namespace
}  // namespace hiac
