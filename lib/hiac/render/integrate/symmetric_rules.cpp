#include "hiac/render/integrate/symmetric_rules.hpp"

#include <cmath>

#include "hiac/base/gauss_legendre.hpp"

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

BernsteinEllipses make_ellipses() {
  BernsteinEllipses table{};
  for (std::size_t e = 0; e < BernsteinEllipses::kCount; ++e) {
    const double log_rho = static_cast<double>(e + 1) * std::log(2.0), rho = std::exp(log_rho);
    table.reach[e] = 0.5 * (rho + 1 / rho);
    table.rate[e] = 0.5 / log_rho;
    table.log_factor[e] = std::log(32.0 / 15 / (1 - 1 / (rho * rho)));
  }
  return table;
}

}  // namespace

const SymmetricRules& symmetric_rules() {
  static const SymmetricRules kRules = make_rules();
  return kRules;
}

const BernsteinEllipses& bernstein_ellipses() {
  static const BernsteinEllipses kTable = make_ellipses();
  return kTable;
}

}  // namespace hiac
