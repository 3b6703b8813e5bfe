#include "hiac/geometry/patch_facing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "hiac/geometry/bernstein_domain.hpp"

namespace hiac {
namespace {

using Factor = BernsteinDomain::Factor;

struct Determinant {
  double value, size;  // size: the sum of the absolute values of its products
};

Determinant determinant(const std::array<PatchValue, 3>& p) {
  const auto term = [&](std::size_t a) {
    const PatchValue &q = p[(a + 1) % 3], &r = p[(a + 2) % 3];
    return Determinant{
        p[a].value * (q.by_u * r.by_v - q.by_v * r.by_u),
        std::abs(p[a].value) * (std::abs(q.by_u * r.by_v) + std::abs(q.by_v * r.by_u))};
  };
  const Determinant x = term(0), y = term(1), z = term(2);
  return {x.value + y.value + z.value, x.size + y.size + z.size};
}

// The domain that gives the determinant's Bernstein coefficients: of degree 3 n - 1 in u and in v
// on a quadrilateral, of total degree 3 n - 2 on a triangle.
const BernsteinDomain& domain_of(const PatchShape& shape) {
  static const std::array<BernsteinDomain, 5> kDomains{
      BernsteinDomain(std::array{Factor{1, 1}, Factor{1, 1}}),
      BernsteinDomain(std::array{Factor{1, 5}, Factor{1, 5}}),
      BernsteinDomain(std::array{Factor{1, 8}, Factor{1, 8}}),
      BernsteinDomain(std::array{Factor{2, 4}}), BernsteinDomain(std::array{Factor{2, 7}})};
  return kDomains[shape.triangle ? shape.degree + 1U : shape.degree - 1U];
}

}  // namespace

int patch_facing(const PatchShape& shape, const std::array<PatchNet<double>, 3>& nets) {
  const BernsteinDomain& domain = domain_of(shape);
  std::array<double, 81> values;
  double size = 0;
  for (std::size_t k = 0; k < domain.size(); ++k) {
    const auto& [u, v, unused] = domain.points()[k];
    const BernsteinValues bu(shape.degree, u), bv(shape.degree, v);
    std::array<PatchValue, 3> p;
    for (std::size_t c = 0; c < 3; ++c) p[c] = evaluate_patch(shape.degree, nets[c], bu, bv);
    const Determinant here = determinant(p);
    values[k] = here.value;
    size = std::max(size, here.size);
  }
  const auto coefficients = std::span(values).first(domain.size());
  domain.to_coefficients(coefficients);
  const double rounding = 64 * std::numeric_limits<double>::epsilon() * domain.condition() * size;
  const auto [least, most] = std::ranges::minmax(coefficients);
  if (least > rounding) return 1;
  return most < -rounding ? -1 : 0;
}

}  // namespace hiac
