#include "hiac/element/world_polynomial.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/geometry/vector.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "tests/render/truth/general_meshes.hpp"

namespace hiac {
namespace {

using test::Position;

using Random = std::mt19937_64;

double between(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

std::vector<CellKind> all_kinds() {
  std::vector<CellKind> kinds;
  for (std::size_t k = 0; k < kKindCount; ++k) kinds.push_back(static_cast<CellKind>(k));
  return kinds;
}

std::vector<CellKind> kinds_of_least_interpolants() {
  std::vector<CellKind> kinds = all_kinds();
  std::erase_if(kinds, WorldPolynomial::is_of_paper);
  return kinds;
}

// The reference cell with corners moved at random by up to `by`, and nodes on edges by up to `bent`
// besides.
ZooMesh distorted_cell(CellKind kind, double by, double bent, Random& random) {
  std::vector<Position> corners;
  for (const auto& p : reference_nodes(kind_of(shape_of(kind), CellOrder::linear))) {
    corners.push_back(p);
    for (double& x : corners.back()) x += between(random, -by, by);
  }
  return test::moved(test::one_cell(kind, corners), [&](const Position& p) {
    if (std::ranges::find(corners, p) != corners.end()) return p;
    Position q = p;
    for (double& x : q) x += between(random, -bent, bent);
    return q;
  });
}

std::vector<double> random_values(std::size_t count, Random& random) {
  std::vector<double> values(count);
  for (double& value : values) value = between(random, -1, 1);
  return values;
}

// All monomials of a degree or less, weighted at random.
class RandomPolynomial {
 public:
  RandomPolynomial(std::size_t degree, Random& random)
      : terms_(monomials(degree)), weights_(random_values(terms_.size(), random)) {}

  double operator()(const Position& p) const {
    double sum = 0;
    for (std::size_t i = 0; i < terms_.size(); ++i)
      sum += weights_[i] * std::pow(p[0], terms_[i][0]) * std::pow(p[1], terms_[i][1]) *
             std::pow(p[2], terms_[i][2]);
    return sum;
  }

 private:
  std::span<const Exponents> terms_;
  std::vector<double> weights_;
};

std::vector<double> values_at_nodes(const ZooMesh& mesh, const test::ScalarFunction& field) {
  std::vector<double> values;
  for (const Position& p : test::positions_of(mesh)) values.push_back(field(p));
  return values;
}

// A point of the cell, by its isoparametric map.
Position point_inside(const ZooMesh& mesh, Random& random) {
  const CellKind kind = mesh.kinds[0];
  Position xi{between(random, 0, 1), between(random, 0, 1), between(random, 0, 1)};
  switch (shape_of(kind)) {
    case CellShape::tetrahedron:
      xi = {xi[0] * (1 - xi[1]) * (1 - xi[2]), xi[1] * (1 - xi[2]), xi[2]};
      break;
    case CellShape::pyramid:
      xi = {xi[0] * (1 - xi[2]), xi[1] * (1 - xi[2]), xi[2]};
      break;
    case CellShape::prism:
      xi[0] *= 1 - xi[1];
      break;
    case CellShape::wedge:
      xi[0] *= 2 - xi[1] - xi[2];
      break;
    case CellShape::brick:
      break;
  }
  std::array<double, kMaxNodesPerCell> shape;
  shape_functions<double>(kind, xi, shape);
  const auto nodes = test::positions_of(mesh);
  Position p{};
  for (std::size_t k = 0; k < nodes.size(); ++k)
    for (std::size_t a = 0; a < 3; ++a) p[a] += shape[k] * nodes[k][a];
  return p;
}

double value_at(const WorldPolynomial& f, const ZooMesh& mesh, const Position& p) {
  return f.at(minus(p, mesh.position(0)));
}

TEST(WorldPolynomial, TakesTheValuesOfNodes) {
  Random random(1);
  for (const CellKind kind : all_kinds())
    for (const double bent : {0.0, 0.03})
      for (int repeat = 0; repeat < 20; ++repeat) {
        const ZooMesh mesh = distorted_cell(kind, 0.15, bent, random);
        const auto values = random_values(mesh.node_count(), random);
        const auto f = WorldPolynomial::through(mesh, 0, values);
        ASSERT_TRUE(f) << kind_name(kind);
        const auto nodes = test::positions_of(mesh);
        for (std::size_t k = 0; k < nodes.size(); ++k)
          EXPECT_NEAR(value_at(*f, mesh, nodes[k]), values[k], 1e-11) << kind_name(kind);
      }
}

TEST(WorldPolynomial, HasAllPolynomialsOfItsCompleteDegree) {
  Random random(2);
  for (const CellKind kind : all_kinds()) {
    const std::size_t degree = WorldPolynomial::complete_degree(kind);
    EXPECT_EQ(degree + (kind == CellKind::pyramid21 || kind == CellKind::prism24 ? 1 : 0),
              static_cast<std::size_t>(order_of(kind)));
    for (const double bent : {0.0, 0.03})
      for (int repeat = 0; repeat < 20; ++repeat) {
        const ZooMesh mesh = distorted_cell(kind, 0.2, bent, random);
        const RandomPolynomial field(degree, random);
        const auto f = WorldPolynomial::through(mesh, 0, values_at_nodes(mesh, field));
        ASSERT_TRUE(f) << kind_name(kind);
        for (int sample = 0; sample < 10; ++sample) {
          const Position p = point_inside(mesh, random);
          EXPECT_NEAR(value_at(*f, mesh, p), field(p), 2e-12) << kind_name(kind);
        }
      }
  }
}

// Proportional to the distance from a plane through three corners.
class Plane {
 public:
  Plane(const std::vector<Position>& nodes, std::array<std::size_t, 3> corners)
      : through_(nodes[corners[0]]),
        normal_(cross(minus(nodes[corners[1]], through_), minus(nodes[corners[2]], through_))) {}

  double operator()(const Position& p) const { return dot(normal_, minus(p, through_)); }

 private:
  Position through_, normal_;
};

// The cubic polynomials that vanish at all nodes: of prisms the product of the planes of three
// quadrilaterals, of pyramids the base's plane times those of two opposite triangles.
std::vector<test::ScalarFunction> vanishing_cubics(const ZooMesh& mesh) {
  const auto nodes = test::positions_of(mesh);
  const auto product = [&](std::array<std::size_t, 3> a, std::array<std::size_t, 3> b,
                           std::array<std::size_t, 3> c) {
    return [p = Plane(nodes, a), q = Plane(nodes, b), r = Plane(nodes, c)](const Position& x) {
      return p(x) * q(x) * r(x);
    };
  };
  if (mesh.kinds[0] == CellKind::prism24) return {product({0, 3, 4}, {1, 4, 5}, {2, 5, 3})};
  return {product({0, 1, 2}, {0, 1, 4}, {2, 3, 4}), product({0, 1, 2}, {1, 2, 4}, {3, 0, 4})};
}

// With planar faces, be they parallelograms or not: what is missing of a cubic polynomial is one
// that no interpolation sees.
TEST(WorldPolynomial, HasCubicPolynomialsButForThoseThatVanishAtAllNodes) {
  Random random(3);
  for (const CellKind kind : {CellKind::prism24, CellKind::pyramid21})
    for (const auto map : {test::sheared, test::tapered}) {
      const auto corners = reference_nodes(kind_of(shape_of(kind), CellOrder::linear));
      std::vector<Position> places;
      std::ranges::transform(corners, std::back_inserter(places), map);
      const ZooMesh mesh = test::one_cell(kind, places);
      const auto hidden = vanishing_cubics(mesh);
      for (const auto& cubic : hidden)
        for (const Position& node : test::positions_of(mesh)) EXPECT_NEAR(cubic(node), 0, 1e-15);
      const RandomPolynomial field(3, random);
      const auto f = WorldPolynomial::through(mesh, 0, values_at_nodes(mesh, field));
      ASSERT_TRUE(f);
      const auto missing = [&](const Position& p) { return field(p) - value_at(*f, mesh, p); };
      // the weights of the hidden ones, from one point or two
      std::array<Position, 3> at;
      for (Position& p : at) p = point_inside(mesh, random);
      double first = missing(at[0]) / hidden[0](at[0]), second = 0;
      if (hidden.size() == 2) {
        const double a = hidden[0](at[0]), b = hidden[1](at[0]), c = hidden[0](at[1]),
                     d = hidden[1](at[1]);
        first = (missing(at[0]) * d - missing(at[1]) * b) / (a * d - b * c);
        second = (a * missing(at[1]) - c * missing(at[0])) / (a * d - b * c);
      }
      EXPECT_GT(std::abs(missing(at[2])), 1e-6);
      for (int sample = 0; sample < 20; ++sample) {
        const Position p = point_inside(mesh, random);
        const double by_hidden =
            first * hidden[0](p) + (hidden.size() == 2 ? second * hidden[1](p) : 0);
        EXPECT_NEAR(missing(p), by_hidden, 1e-10) << kind_name(kind);
      }
    }
}

// The least interpolant is carried by affine maps: turning, shifting, shearing and flattening.
TEST(WorldPolynomial, GoesWithTheCellWhereItIsTheLeastInterpolant) {
  Random random(4);
  const double c = std::cos(0.7), s = std::sin(0.7);
  const std::array<Position (*)(const Position&), 2> maps{
      test::sheared, [](const Position& p) {
        return Position{p[0], 3 * p[1], 1e-4 * p[2]};
      }};
  const auto turned = [&](const Position& p) {
    return Position{c * p[0] - s * p[2] + 100, p[1] - 50, s * p[0] + c * p[2]};
  };
  for (const CellKind kind : kinds_of_least_interpolants())
    for (const double by : {0.0, 0.01, 0.2}) {
      const ZooMesh mesh = distorted_cell(kind, by, 0.1 * by, random);
      const auto values = random_values(mesh.node_count(), random);
      const auto f = WorldPolynomial::through(mesh, 0, values);
      ASSERT_TRUE(f) << kind_name(kind);
      const auto expect_same = [&](const auto& map) {
        const ZooMesh other = test::moved(mesh, map);
        const auto g = WorldPolynomial::through(other, 0, values);
        ASSERT_TRUE(g) << kind_name(kind);
        for (int sample = 0; sample < 10; ++sample) {
          const Position p = point_inside(mesh, random);
          EXPECT_NEAR(value_at(*g, other, map(p)), value_at(*f, mesh, p), 2e-10) << kind_name(kind);
        }
      };
      expect_same(turned);
      for (const auto map : maps) expect_same(map);
    }
}

// Corners a little off the places from which nodes do not see some forms: by as little as rounding,
// and by a part of the cell.
TEST(WorldPolynomial, StaysOfTheSizeOfTheValuesWhereItIsTheLeastInterpolant) {
  Random random(5);
  for (const CellKind kind : kinds_of_least_interpolants())
    for (const double by : {0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 1e-2, 0.2})
      for (int repeat = 0; repeat < 10; ++repeat) {
        const ZooMesh mesh = distorted_cell(kind, by, 0, random);
        const auto f = WorldPolynomial::through(mesh, 0, random_values(mesh.node_count(), random));
        ASSERT_TRUE(f) << kind_name(kind);
        for (int sample = 0; sample < 10; ++sample)
          EXPECT_LE(std::abs(value_at(*f, mesh, point_inside(mesh, random))), by < 0.1 ? 8 : 40)
              << kind_name(kind) << " by " << by;
      }
}

// Bounds are sharpest of linear fields, which are extreme at corners.
TEST(WorldPolynomial, KeepsToItsBoundsInTheCell) {
  Random random(6);
  for (const CellKind kind : all_kinds())
    for (int repeat = 0; repeat < 20; ++repeat) {
      const ZooMesh mesh = distorted_cell(kind, 0.15, 0.03, random);
      for (const auto& values : {random_values(mesh.node_count(), random),
                                 values_at_nodes(mesh, [](const Position& p) { return p[0]; })}) {
        const auto f = WorldPolynomial::through(mesh, 0, values);
        ASSERT_TRUE(f) << kind_name(kind);
        for (const double value : values) {
          EXPECT_GE(value, f->least() - 1e-12) << kind_name(kind);
          EXPECT_LE(value, f->most() + 1e-12) << kind_name(kind);
        }
        for (int sample = 0; sample < 50; ++sample) {
          const double value = value_at(*f, mesh, point_inside(mesh, random));
          EXPECT_GE(value, f->least()) << kind_name(kind);
          EXPECT_LE(value, f->most()) << kind_name(kind);
        }
      }
    }
}

TEST(WorldPolynomial, GradientIsItsDerivative) {
  Random random(7);
  constexpr double kStep = 1e-5;
  for (const CellKind kind : all_kinds()) {
    const ZooMesh mesh = test::moved(distorted_cell(kind, 0.1, 0.02, random), test::sheared);
    const auto f = WorldPolynomial::through(mesh, 0, random_values(mesh.node_count(), random));
    ASSERT_TRUE(f) << kind_name(kind);
    const Position at = minus(point_inside(mesh, random), mesh.position(0));
    const auto gradient = f->gradient(at);
    for (std::size_t c = 0; c < 3; ++c) {
      Position high = at, low = at;
      high[c] += kStep;
      low[c] -= kStep;
      EXPECT_NEAR(gradient[c], (f->at(high) - f->at(low)) / (2 * kStep), 1e-5) << kind_name(kind);
    }
  }
}

}  // namespace
}  // namespace hiac
