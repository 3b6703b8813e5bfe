#include "hiac/render/world_polynomial.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "hiac/geometry/vector.hpp"
#include "hiac/mesh/interpolant_range.hpp"

namespace hiac {
namespace {

using Exponents = std::array<std::uint8_t, 3>;

constexpr double kLeastPivot = 1e-10;

constexpr std::array<Exponents, 20> kComplete{
    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2},
     {1, 1, 0}, {1, 0, 1}, {0, 1, 1}, {3, 0, 0}, {0, 3, 0}, {0, 0, 3}, {2, 1, 0},
     {2, 0, 1}, {1, 2, 0}, {1, 0, 2}, {0, 2, 1}, {0, 1, 2}, {1, 1, 1}}};
constexpr std::array<Exponents, 6> kPrism{
    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}};
constexpr std::array<Exponents, 8> kBrick{
    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}}};
constexpr std::array<Exponents, 20> kQuadraticBrick{
    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2},
     {1, 1, 0}, {1, 0, 1}, {0, 1, 1}, {2, 1, 0}, {2, 0, 1}, {1, 2, 0}, {1, 0, 2},
     {0, 2, 1}, {0, 1, 2}, {1, 1, 1}, {2, 1, 1}, {1, 2, 1}, {1, 1, 2}}};

// Empty where the paper has none.
std::span<const Exponents> terms_of(CellKind kind) {
  switch (kind) {
    case CellKind::tetrahedron4:
    case CellKind::tetrahedron10:
    case CellKind::tetrahedron20:
      return std::span(kComplete).first(node_count(kind));
    case CellKind::prism6:
      return kPrism;
    case CellKind::brick8:
      return kBrick;
    case CellKind::brick20:
      return kQuadraticBrick;
    default:
      return {};
  }
}

double power(double x, unsigned n) {
  double product = 1;
  for (unsigned k = 0; k < n; ++k) product *= x;
  return product;
}

double monomial(const Exponents& e, const Vector& p) {
  return power(p[0], e[0]) * power(p[1], e[1]) * power(p[2], e[2]);
}

// Gaussian elimination with full pivoting; the right side becomes the solution. False where a pivot
// vanishes.
class Equations {
 public:
  static constexpr std::size_t kMost = WorldPolynomial::kMostTerms;
  std::array<std::array<double, kMost>, kMost> matrix{};
  std::array<double, kMost> right{};

  bool solve(std::size_t n) {
    std::array<std::size_t, kMost> column;
    for (std::size_t k = 0; k < n; ++k) column[k] = k;
    for (std::size_t k = 0; k < n; ++k) {
      std::size_t row = k, at = k;
      for (std::size_t i = k; i < n; ++i)
        for (std::size_t j = k; j < n; ++j)
          if (std::abs(matrix[i][j]) > std::abs(matrix[row][at])) {
            row = i;
            at = j;
          }
      if (!(std::abs(matrix[row][at]) > kLeastPivot)) return false;
      std::swap(matrix[k], matrix[row]);
      std::swap(right[k], right[row]);
      std::swap(column[k], column[at]);
      for (std::size_t i = 0; i < n; ++i) std::swap(matrix[i][k], matrix[i][at]);
      for (std::size_t i = k + 1; i < n; ++i) {
        const double by = matrix[i][k] / matrix[k][k];
        for (std::size_t j = k; j < n; ++j) matrix[i][j] -= by * matrix[k][j];
        right[i] -= by * right[k];
      }
    }
    std::array<double, kMost> solution{};
    for (std::size_t k = n; k-- > 0;) {
      double sum = right[k];
      for (std::size_t j = k + 1; j < n; ++j) sum -= matrix[k][j] * solution[column[j]];
      solution[column[k]] = sum / matrix[k][k];
    }
    right = solution;
    return true;
  }
};

}  // namespace

bool WorldPolynomial::exists(CellKind kind) { return !terms_of(kind).empty(); }

std::optional<WorldPolynomial> WorldPolynomial::through(const ZooMesh& mesh, CellId cell,
                                                        std::span<const double> values) {
  WorldPolynomial result;
  const CellKind kind = result.kind_ = mesh.kinds[cell];
  const auto terms = terms_of(kind);
  const auto nodes = mesh.cell_nodes(cell);
  const std::size_t n = terms.size();
  std::array<Vector, kMostTerms> at;
  for (std::size_t k = 0; k < n; ++k)
    at[k] = minus(mesh.position(nodes[k]), mesh.position(nodes[0]));
  for (std::size_t c = 0; c < 3; ++c) {
    std::array<double, kMostTerms> coordinate;
    for (std::size_t k = 0; k < n; ++k) coordinate[k] = at[k][c];
    const InterpolantRange range = interpolant_range(kind, coordinate);
    result.middle_[c] = 0.5 * (range.least + range.most);
    result.half_[c] = 0.5 * (range.most - range.least);
    if (!(result.half_[c] > 0)) return std::nullopt;
    for (std::size_t k = 0; k < n; ++k) at[k][c] = (at[k][c] - result.middle_[c]) / result.half_[c];
  }
  Equations equations;
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t i = 0; i < n; ++i) equations.matrix[k][i] = monomial(terms[i], at[k]);
    equations.right[k] = values[k] - values[0];
  }
  if (!equations.solve(n)) return std::nullopt;
  result.c_ = equations.right;
  for (std::size_t i = 1; i < n; ++i) result.reach_ += std::abs(result.c_[i]);
  result.c_[0] += values[0];
  return result;
}

double WorldPolynomial::at(const Point& point) const {
  Vector p;
  for (std::size_t c = 0; c < 3; ++c) p[c] = (point[c] - middle_[c]) / half_[c];
  const auto terms = terms_of(kind_);
  double sum = 0;
  for (std::size_t i = 0; i < terms.size(); ++i) sum += c_[i] * monomial(terms[i], p);
  return sum;
}

WorldPolynomial::Point WorldPolynomial::gradient(const Point& point) const {
  Vector p;
  for (std::size_t c = 0; c < 3; ++c) p[c] = (point[c] - middle_[c]) / half_[c];
  const auto terms = terms_of(kind_);
  Point sum{};
  for (std::size_t i = 1; i < terms.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      Exponents e = terms[i];
      if (e[c] == 0) continue;
      const double factor = e[c]--;
      sum[c] += c_[i] * factor * monomial(e, p) / half_[c];
    }
  return sum;
}

}  // namespace hiac
