// The least interpolant against what it is the limit of: the sum of c_k exp(e^2 <x_k, x>) that
// takes the values at the points x_k, as e tends to 0 (R. Schaback, "Multivariate interpolation by
// polynomials and radial basis functions", Constructive Approximation 21, 2005; of Gaussians, which
// differ by factors that tend to 1). With e = 2^-60, in 2048 bits, it knows nothing of ranks,
// degrees and tolerances.

#include "hiac/element/least_interpolant.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gmpxx.h>
#include <gtest/gtest.h>

#include "hiac/element/world_polynomial.hpp"
#include "hiac/geometry/vector.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "tests/render/truth/general_meshes.hpp"

namespace hiac {
namespace {

using test::Position;

constexpr mp_bitcnt_t kBits = 2048;
using Number = mpf_class;
using Matrix = std::vector<std::vector<Number>>;

Number number(double x) { return {x, kBits}; }

// Gaussian elimination with partial pivoting.
std::vector<Number> solution(Matrix a, std::vector<Number> b) {
  const std::size_t n = b.size();
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k; i < n; ++i)
      if (abs(a[i][k]) > abs(a[pivot][k])) pivot = i;
    std::swap(a[k], a[pivot]);
    std::swap(b[k], b[pivot]);
    for (std::size_t i = k + 1; i < n; ++i) {
      const Number by = a[i][k] / a[k][k];
      for (std::size_t j = k; j < n; ++j) a[i][j] -= by * a[k][j];
      b[i] -= by * b[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) b[k] -= a[k][j] * b[j];
    b[k] /= a[k][k];
  }
  return b;
}

class FlatLimit {
 public:
  FlatLimit(const std::vector<Position>& points, const std::vector<double>& values) {
    const std::size_t n = points.size();
    const Number count = number(static_cast<double>(n));
    for (std::size_t a = 0; a < 3; ++a) {
      mean_[a] = number(0);
      for (const Position& p : points) mean_[a] += number(p[a]) / count;
    }
    for (const Position& p : points) centred_.push_back(centred(p));
    covariance_.assign(3, std::vector<Number>(3, number(0)));
    for (const auto& p : centred_)
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b) covariance_[a][b] += p[a] * p[b] / count;
    Matrix kernels(n, std::vector<Number>(n, number(0)));
    std::vector<Number> right;
    for (std::size_t k = 0; k < n; ++k) {
      duals_.push_back(solution(covariance_, centred_[k]));
      right.push_back(number(values[k]));
    }
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < n; ++k) kernels[i][k] = kernel(centred_[i], k);
    weights_ = solution(kernels, right);
  }

  [[nodiscard]] double at(const Position& point) const {
    const std::vector<Number> x = centred(point);
    Number sum = number(0);
    for (std::size_t k = 0; k < weights_.size(); ++k) sum += weights_[k] * kernel(x, k);
    return sum.get_d();
  }

 private:
  [[nodiscard]] std::vector<Number> centred(const Position& p) const {
    return {number(p[0]) - mean_[0], number(p[1]) - mean_[1], number(p[2]) - mean_[2]};
  }

  // The exponential of e^2 times the product in the metric that makes the covariance 1.
  [[nodiscard]] Number kernel(const std::vector<Number>& x, std::size_t k) const {
    Number product = number(0);
    for (std::size_t a = 0; a < 3; ++a) product += x[a] * duals_[k][a];
    product *= number(0x1p-120);
    Number sum = number(0), term = number(1);
    for (int m = 1; m <= 10; ++m) {
      sum += term;
      term *= product / number(m);
    }
    return sum;
  }

  std::array<Number, 3> mean_;
  Matrix covariance_;
  std::vector<std::vector<Number>> centred_, duals_;
  std::vector<Number> weights_;
};

// Integers that six divides: nodes on edges are exact, and faces are planar where corners say so.
using Corners = std::vector<Position>;

class RandomMap {
 public:
  explicit RandomMap(std::mt19937_64& random) {
    std::uniform_int_distribution<int> entry(-9, 9);
    do {
      for (auto& row : rows_)
        for (double& x : row) x = entry(random);
    } while (std::abs(determinant()) < 200);
  }

  Position operator()(const Position& p) const {
    Position q;
    for (std::size_t a = 0; a < 3; ++a)
      q[a] = rows_[a][0] * p[0] + rows_[a][1] * p[1] + rows_[a][2] * p[2] + 6;
    return q;
  }

 private:
  [[nodiscard]] double determinant() const {
    const auto& [a, b, c] = rows_;
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
  }

  std::array<Position, 3> rows_{};
};

Corners reference_corners(CellKind kind) {
  Corners corners;
  for (const auto& p : reference_nodes(kind_of(shape_of(kind), CellOrder::linear)))
    corners.push_back({6 * p[0], 6 * p[1], 6 * p[2]});
  return corners;
}

double polynomial_at(const LeastInterpolant& f, const Position& x) {
  Position y{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t a = 0; a < 3; ++a) y[i] += f.rows[i][a] * (x[a] - f.mean[a]);
  double sum = 0;
  const auto terms = monomials(f.degree);
  for (std::size_t i = 0; i < terms.size(); ++i)
    sum += f.c[i] * std::pow(y[0], terms[i][0]) * std::pow(y[1], terms[i][1]) *
           std::pow(y[2], terms[i][2]);
  return sum;
}

// At random values, in random points of the corners' hull.
void expect_limit(CellKind kind, const Corners& corners, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const std::vector<Position> nodes = test::positions_of(test::one_cell(kind, corners));
  std::vector<double> values(nodes.size());
  for (double& value : values) value = unit(random);
  const auto found = least_interpolant(nodes, values, WorldPolynomial::complete_degree(kind));
  ASSERT_TRUE(found) << kind_name(kind);
  const FlatLimit expected(nodes, values);
  for (int sample = 0; sample < 5; ++sample) {
    Position p{};
    double sum = 0;
    for (const Position& corner : corners) {
      const double weight = -std::log(unit(random));
      for (std::size_t a = 0; a < 3; ++a) p[a] += weight * corner[a];
      sum += weight;
    }
    for (double& x : p) x /= sum;
    EXPECT_NEAR(polynomial_at(*found, p), expected.at(p), 1e-11) << kind_name(kind);
  }
}

TEST(LeastInterpolant, IsTheLimitOfExponentialsOnAffineCells) {
  std::mt19937_64 random(1);
  for (std::size_t k = 0; k < kKindCount; ++k)
    for (int repeat = 0; repeat < 2; ++repeat) {
      const auto kind = static_cast<CellKind>(k);
      Corners corners = reference_corners(kind);
      std::ranges::transform(corners, corners.begin(), RandomMap(random));
      expect_limit(kind, corners, random);
    }
}

// Of kinds whose nodes see the same forms wherever the corners are.
TEST(LeastInterpolant, IsTheLimitOfExponentialsOnDistortedCells) {
  std::mt19937_64 random(2);
  std::uniform_int_distribution<int> sixth(-3, 3);
  for (const CellKind kind : {CellKind::pyramid5, CellKind::pyramid13, CellKind::prism6,
                              CellKind::prism15, CellKind::wedge7})
    for (int repeat = 0; repeat < 4; ++repeat) {
      Corners corners = reference_corners(kind);
      for (Position& corner : corners)
        for (double& x : corner) x = 6 * (2 * x + sixth(random));
      expect_limit(kind, corners, random);
    }
}

// Whose faces are planar and not parallelograms: at their nodes some cubic polynomials vanish.
TEST(LeastInterpolant, IsTheLimitOfExponentialsOnFrusta) {
  std::mt19937_64 random(3);
  for (const CellKind kind : {CellKind::prism24, CellKind::pyramid21}) {
    Corners corners = reference_corners(kind);
    if (kind == CellKind::prism24)
      for (std::size_t k = 3; k < 6; ++k)
        for (const std::size_t a : {0, 1}) corners[k][a] *= 0.5;
    else
      corners[2][0] = corners[2][1] = 9;
    for (Position& corner : corners)
      for (double& x : corner) x *= 6;
    std::ranges::transform(corners, corners.begin(), RandomMap(random));
    expect_limit(kind, corners, random);
  }
}

// Ten points, all but one on a sphere: that quadric they see by the distance of the one. Asked to
// be complete to degree 2 the function has all quadratic polynomials, else it stays of the values'
// size.
TEST(LeastInterpolant, SeesFormsOfCompleteDegreesHoweverLittle) {
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  constexpr double kOff = 1e-3;
  std::vector<Position> points(10);
  std::vector<double> squares, signs;
  for (std::size_t k = 0; k < points.size(); ++k) {
    for (double& x : points[k]) x = normal(random);
    points[k] = unit(points[k]);
    for (double& x : points[k]) x *= k == 0 ? 1 + kOff : 1;
    squares.push_back(points[k][0] * points[k][1] - points[k][2] * points[k][2]);
    signs.push_back(k % 2 == 0 ? 1 : -1);
  }
  const Position inside{0.2, 0.1, -0.3};
  const double expected = inside[0] * inside[1] - inside[2] * inside[2];
  const auto complete = least_interpolant(points, squares, 2);
  ASSERT_TRUE(complete);
  EXPECT_EQ(complete->degree, 2U);
  EXPECT_NEAR(polynomial_at(*complete, inside), expected, 1e-11);
  EXPECT_GT(std::abs(polynomial_at(*least_interpolant(points, signs, 2), inside)), 0.1 / kOff);
  const auto stable = least_interpolant(points, squares, 1);
  ASSERT_TRUE(stable);
  EXPECT_EQ(stable->degree, 3U);
  EXPECT_GT(std::abs(polynomial_at(*stable, inside) - expected), 0.01);
  EXPECT_LT(std::abs(polynomial_at(*least_interpolant(points, signs, 1), inside)), 10);
}

TEST(LeastInterpolant, AsksForPointsThatAreApartAndNotInAPlane) {
  std::vector<Position> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}};
  const std::vector<double> values{1, 2, 3, 4, 5};
  EXPECT_TRUE(least_interpolant(points, values, 1));
  for (const double height : {0.0, 1e-11}) {
    points[4][2] = height;
    EXPECT_FALSE(least_interpolant(points, values, 1));
  }
  points[4] = points[2];
  EXPECT_FALSE(least_interpolant(points, values, 1));
  points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 1}, {0, 0, 1}};
  EXPECT_FALSE(least_interpolant(points, values, 1));
  points.assign(5, {1, 1, 1});
  EXPECT_FALSE(least_interpolant(points, values, 1));
}

}  // namespace
}  // namespace hiac
