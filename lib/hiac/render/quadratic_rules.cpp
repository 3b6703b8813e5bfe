#include "hiac/render/quadratic_rules.hpp"

#include <algorithm>
#include <cmath>

#include "hiac/optics/gauss_legendre.hpp"

namespace hiac {
namespace {

std::array<QuadraticRule, kMostQuadraticNodes> make_rules() {
  std::array<QuadraticRule, kMostQuadraticNodes> rules{};
  for (std::size_t n = 1; n <= kMostQuadraticNodes; ++n) {
    const GaussRule gauss = gauss_legendre(n);
    QuadraticRule& rule = rules[n - 1];
    rule.count = n;
    for (std::size_t k = 0; k < n; ++k) {
      rule.x[k] = 0.5 + 0.5 * gauss.nodes[k];
      rule.w[k] = 0.5 * gauss.weights[k];
    }
  }
  return rules;
}

constexpr std::size_t kEllipses = 8;

// By ellipse: rho; (rho^k + rho^-k) / 2; log(rho), 1 / (2 log(rho)); log(32/15 / (1 - rho^-2)).
struct Ellipses {
  std::array<double, kEllipses> grow1, grow2, grow3, log_rho, inverse, log_factor;

  Ellipses() {
    double rho = 2;
    for (std::size_t k = 0; k < kEllipses; ++k, rho *= 2) {
      const auto grow = [rho](double power) {
        return (std::pow(rho, power) + std::pow(rho, -power)) / 2;
      };
      grow1[k] = grow(1);
      grow2[k] = grow(2);
      grow3[k] = grow(3);
      log_rho[k] = std::log(rho);
      inverse[k] = 1 / (2 * log_rho[k]);
      log_factor[k] = std::log(32.0 / 15 / (1 - 1 / (rho * rho)));
    }
  }
};

}  // namespace

const QuadraticRule& quadratic_rule(std::size_t nodes) {
  static const std::array<QuadraticRule, kMostQuadraticNodes> rules = make_rules();
  return rules[nodes - 1];
}

std::size_t quadratic_nodes(std::size_t degree, double wanted, double c1, double c2, double c3) {
  static const Ellipses e;
  if (!std::isfinite(wanted)) return 0;
  // log(wanted), rounded up
  int exponent = 0;
  std::frexp(wanted, &exponent);
  const double log_wanted = std::log(2.0) * exponent;
  double fewest = kMostQuadraticNodes + 1.0;
  for (std::size_t k = 0; k < kEllipses; ++k) {
    const double grown = c1 * e.grow1[k] + c2 * e.grow2[k] + c3 * e.grow3[k];
    const double needed =
        (log_wanted + e.log_factor[k] + grown + static_cast<double>(degree) * e.log_rho[k]) *
        e.inverse[k];
    fewest = std::min(fewest, needed);
  }
  if (!(fewest <= static_cast<double>(kMostQuadraticNodes))) return 0;
  return static_cast<std::size_t>(std::max(1.0, std::ceil(fewest)));
}

}  // namespace hiac
