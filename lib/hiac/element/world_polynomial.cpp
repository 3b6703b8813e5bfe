#include "hiac/element/world_polynomial.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "hiac/geometry/vector.hpp"
#include "hiac/mesh/interpolant_range.hpp"
#include "hiac/mesh/shape_functions.hpp"

namespace hiac {
namespace {

constexpr double kLeastRelativePivot = 1e-10;
// the number of nodes of a 20-node brick
constexpr std::size_t kMostEquations = 20;

constexpr std::array<Exponents, 6> kPrism{
    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}};
constexpr std::array<Exponents, 8> kBrick{
    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}}};
constexpr std::array<Exponents, 20> kQuadraticBrick{
    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2},
     {1, 1, 0}, {1, 0, 1}, {0, 1, 1}, {2, 1, 0}, {2, 0, 1}, {1, 2, 0}, {1, 0, 2},
     {0, 2, 1}, {0, 1, 2}, {1, 1, 1}, {2, 1, 1}, {1, 2, 1}, {1, 1, 2}}};

// The monomials that the paper lists for a kind; empty if it lists none.
std::span<const Exponents> terms_of(CellKind kind) {
  switch (kind) {
    case CellKind::tetrahedron4:
    case CellKind::tetrahedron10:
    case CellKind::tetrahedron20:
      return monomials(static_cast<std::size_t>(order_of(kind)));
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

// Powers of three coordinates.
class Powers {
 public:
  explicit Powers(const Vector& p) {
    for (std::size_t c = 0; c < 3; ++c) {
      power_[c][0] = 1;
      for (std::size_t e = 1; e < power_[c].size(); ++e) power_[c][e] = power_[c][e - 1] * p[c];
    }
  }

  double operator()(const Exponents& e) const {
    return power_[0][e[0]] * power_[1][e[1]] * power_[2][e[2]];
  }

 private:
  std::array<std::array<double, LeastInterpolant::kMostDegree + 1>, 3> power_;
};

}  // namespace

bool WorldPolynomial::is_of_paper(CellKind kind) { return !terms_of(kind).empty(); }

std::size_t WorldPolynomial::complete_degree(CellKind kind) {
  if (kind == CellKind::pyramid21 || kind == CellKind::prism24) return 2;
  return static_cast<std::size_t>(order_of(kind));
}

bool WorldPolynomial::set_paper(CellKind kind, std::span<const Vector> nodes,
                                std::span<const double> values) {
  terms_ = terms_of(kind);
  const std::size_t n = terms_.size();
  for (const Exponents& e : terms_)
    degree_ = std::max<std::size_t>(degree_, std::size_t{e[0]} + e[1] + e[2]);
  for (std::size_t c = 0; c < 3; ++c) {
    std::array<double, kMostEquations> coordinate;
    for (std::size_t k = 0; k < n; ++k) coordinate[k] = nodes[k][c];
    const ValueRange range = interpolant_range(kind, coordinate);
    const double half = 0.5 * (range.most - range.least);
    if (!(half > 0)) return false;
    origin_[c] = 0.5 * (range.least + range.most);
    to_box_[c][c] = 1 / half;
  }
  using Index = Eigen::Index;
  const auto count = static_cast<Index>(n);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostEquations, kMostEquations> matrix(
      count, count);
  for (std::size_t k = 0; k < n; ++k) {
    const Powers monomial(in_box(nodes[k]));
    for (std::size_t i = 0; i < n; ++i)
      matrix(static_cast<Index>(k), static_cast<Index>(i)) = monomial(terms_[i]);
  }
  const Eigen::FullPivLU<decltype(matrix)> lu(matrix);
  if (!(lu.matrixLU().diagonal().cwiseAbs().minCoeff() > kLeastRelativePivot)) return false;
  const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostEquations, 1> solution =
      lu.solve(Eigen::Map<const Eigen::VectorXd>(values.data(), count));
  std::ranges::copy(solution, c_.begin());
  return true;
}

bool WorldPolynomial::set_least(CellKind kind, std::span<const Vector> nodes,
                                std::span<const double> values) {
  const auto found = least_interpolant(nodes, values, complete_degree(kind));
  if (!found) return false;
  terms_ = monomials(found->degree);
  degree_ = found->degree;
  origin_ = found->mean;
  Vector reach;
  for (std::size_t c = 0; c < 3; ++c) {
    std::array<double, kMaxNodesPerCell> coordinate;
    for (std::size_t k = 0; k < nodes.size(); ++k)
      coordinate[k] = dot(found->rows[c], minus(nodes[k], origin_));
    const ValueRange range = interpolant_range(kind, coordinate);
    reach[c] = std::max(-range.least, range.most);
    for (std::size_t a = 0; a < 3; ++a) to_box_[c][a] = found->rows[c][a] / reach[c];
  }
  const Powers scale(reach);
  for (std::size_t i = 0; i < terms_.size(); ++i) c_[i] = found->c[i] * scale(terms_[i]);
  return true;
}

std::optional<WorldPolynomial> WorldPolynomial::through(const ZooMesh& mesh, CellId cell,
                                                        std::span<const double> values) {
  const CellKind kind = mesh.kinds[cell];
  const auto nodes = mesh.cell_nodes(cell);
  std::array<Vector, kMaxNodesPerCell> at;
  std::array<double, kMaxNodesPerCell> from_first;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    at[k] = minus(mesh.position(nodes[k]), mesh.position(nodes[0]));
    from_first[k] = values[k] - values[0];
  }
  const auto points = std::span(at).first(nodes.size());
  const auto differences = std::span(from_first).first(nodes.size());
  WorldPolynomial result;
  if (!(is_of_paper(kind) ? result.set_paper(kind, points, differences)
                          : result.set_least(kind, points, differences)))
    return std::nullopt;
  for (std::size_t i = 1; i < result.terms_.size(); ++i) result.reach_ += std::abs(result.c_[i]);
  result.c_[0] += values[0];
  return result;
}

WorldPolynomial::Point WorldPolynomial::in_box(const Point& point) const {
  const Vector from = minus(point, origin_);
  return {dot(to_box_[0], from), dot(to_box_[1], from), dot(to_box_[2], from)};
}

double WorldPolynomial::at(const Point& point) const {
  const Powers monomial(in_box(point));
  double sum = 0;
  for (std::size_t i = 0; i < terms_.size(); ++i) sum += c_[i] * monomial(terms_[i]);
  return sum;
}

WorldPolynomial::Point WorldPolynomial::gradient(const Point& point) const {
  const Powers monomial(in_box(point));
  Point sum{};
  for (std::size_t i = 1; i < terms_.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      Exponents e = terms_[i];
      if (e[c] == 0) continue;
      const double factor = c_[i] * e[c]--;
      const double slope = factor * monomial(e);
      for (std::size_t a = 0; a < 3; ++a) sum[a] += slope * to_box_[c][a];
    }
  return sum;
}

}  // namespace hiac
