#include "hiac/render/quadratic_rules.hpp"

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

}  // namespace

const QuadraticRule& quadratic_rule(std::size_t nodes) {
  static const std::array<QuadraticRule, kMostQuadraticNodes> rules = make_rules();
  return rules[nodes - 1];
}

}  // namespace hiac
