#include "hiac/render/bernstein_tables.hpp"

#include <cmath>
#include <vector>

#include "hiac/optics/gauss_legendre.hpp"

namespace hiac {
namespace {

// The Bernstein polynomials of a degree at x, by their recurrence.
std::array<double, kMaxFieldDegree + 2> bernstein_values(std::size_t degree, double x) {
  std::array<double, kMaxFieldDegree + 2> b{1};
  for (std::size_t n = 1; n <= degree; ++n) {
    b[n] = x * b[n - 1];
    for (std::size_t i = n - 1; i > 0; --i) b[i] = (1 - x) * b[i] + x * b[i - 1];
    b[0] *= 1 - x;
  }
  return b;
}

BernsteinRule make_rule(std::size_t degree, std::size_t nodes) {
  const GaussRule gauss = gauss_legendre(nodes);
  const auto n = static_cast<double>(degree);
  BernsteinRule rule;
  for (std::size_t k = 0; k < nodes; ++k) {
    const double x = 0.5 + 0.5 * gauss.nodes[k];
    rule.weight[k] = 0.5 * gauss.weights[k];
    const auto value = bernstein_values(degree, x), higher = bernstein_values(degree + 1, x);
    double integral = 0;  // the i-th polynomial's: all higher ones after i, over degree + 1
    for (std::size_t i = degree + 1; i-- > 0;) {
      integral += higher[i + 1] / (n + 1);
      rule.value[k][i] = value[i];
      rule.integral[k][i] = integral;
    }
    if (degree == 0) continue;
    const auto lower = bernstein_values(degree - 1, x);
    for (std::size_t i = 0; i <= degree; ++i)
      rule.derivative[k][i] = n * ((i > 0 ? lower[i - 1] : 0) - (i < degree ? lower[i] : 0));
  }
  return rule;
}

BernsteinBases make_bases(std::size_t degree) {
  BernsteinBases bases;
  for (std::size_t from = 0; from <= degree; ++from) {
    BernsteinPolynomial f;
    f.degree = degree;
    f.c[from] = 1;
    const ChebyshevPolynomial chebyshev = chebyshev_from_bernstein(f);
    const BernsteinPolynomial bernstein =
        bernstein_from_chebyshev(std::span(f.c).first(degree + 1));
    for (std::size_t to = 0; to <= degree; ++to) {
      bases.to_chebyshev[to][from] = chebyshev.c[to];
      bases.from_chebyshev[to][from] = bernstein.c[to];
    }
  }
  return bases;
}

EllipseTable make_ellipses() {
  EllipseTable table;
  std::size_t e = 0;
  for (const double rho : {2.0, 4.0, 8.0, 16.0, 64.0, 256.0}) {
    table.log_factor[e] = std::log(32.0 / 15 / (1 - 1 / (rho * rho)));
    table.rate[e] = 0.5 / std::log(rho);
    double up = 1, down = 1;
    for (std::size_t k = 0; k < table.value[e].size(); ++k) {
      table.value[e][k] = 0.5 * (up + down);
      // dT_k / dx = k U_(k-1)
      table.derivative[e][k] = 2 * static_cast<double>(k) * (up - down) / (rho - 1 / rho);
      up *= rho;
      down /= rho;
    }
    ++e;
  }
  return table;
}

}  // namespace

const BernsteinRule& bernstein_rule(std::size_t degree, std::size_t nodes) {
  static const std::vector<BernsteinRule> kRules = [] {
    std::vector<BernsteinRule> rules;
    for (std::size_t n = 0; n <= kMaxFieldDegree; ++n)
      for (std::size_t m = 1; m <= kMostLaneNodes; ++m) rules.push_back(make_rule(n, m));
    return rules;
  }();
  return kRules[degree * kMostLaneNodes + nodes - 1];
}

const BernsteinBases& bernstein_bases(std::size_t degree) {
  static const std::vector<BernsteinBases> kBases = [] {
    std::vector<BernsteinBases> bases;
    for (std::size_t n = 0; n <= kMaxFieldDegree; ++n) bases.push_back(make_bases(n));
    return bases;
  }();
  return kBases[degree];
}

const EllipseTable& ellipse_table() {
  static const EllipseTable kTable = make_ellipses();
  return kTable;
}

}  // namespace hiac
