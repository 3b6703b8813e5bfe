#include "hiac/render/symmetric_rules.hpp"

#include <cmath>

#include "hiac/optics/gauss_legendre.hpp"

namespace hiac {
namespace {

SymmetricRules make_rules() {
  SymmetricRules rules;
  for (std::size_t n = 1; n <= kMostSymmetricNodes; ++n) {
    const GaussRule gauss = gauss_legendre(n);
    SymmetricRule& rule = rules[n - 1];
    rule.pairs = n / 2;
    if (n % 2 != 0) rule.middle = 0.5 * gauss.weights[n / 2];
    for (std::size_t k = 0; k < n / 2; ++k) {
      rule.z[k] = gauss.nodes[n - 1 - k];
      rule.weight[k] = 0.5 * gauss.weights[n - 1 - k];
    }
  }
  return rules;
}

QuadraticEllipses make_ellipses() {
  QuadraticEllipses table{};
  for (std::size_t e = 0; e < QuadraticEllipses::kCount; ++e) {
    const double log_rho = static_cast<double>(e + 1) * std::log(2.0), rho = std::exp(log_rho);
    const double rate = 0.5 / log_rho, a = 0.5 * (rho + 1 / rho);
    table.rate[e] = rate;
    for (std::size_t k = 0; k < table.constant.size(); ++k)
      table.constant[k][e] = rate * (std::log(32.0 / 15 / (1 - 1 / (rho * rho))) +
                                     static_cast<double>(k + 1) * log_rho);
    for (std::size_t k = 0; k < table.per_power.size(); ++k)
      table.per_power[k][e] = rate * std::pow(a, static_cast<double>(k + 1));
  }
  return table;
}

}  // namespace

const SymmetricRules& symmetric_rules() {
  static const SymmetricRules kRules = make_rules();
  return kRules;
}

const QuadraticEllipses& quadratic_ellipses() {
  static const QuadraticEllipses kTable = make_ellipses();
  return kTable;
}

}  // namespace hiac
