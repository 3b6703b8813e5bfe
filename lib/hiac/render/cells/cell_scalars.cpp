#include "hiac/render/cells/cell_scalars.hpp"

namespace hiac {

// An error e of a field changes the optical depth of a whole ray by e times slope times length at
// most; that changes alpha by as much, and radiance by twice the largest colour (chromaticity) or
// the light of a whole ray (emission) times that. The colour's own error is weighted by at most
// 1, or the length.
void set_allowed_errors(const Frame& frame, double length, double share, CellScalars& color,
                        CellScalars& extinction) {
  const OpticsTables& optics = frame.optics;
  const double light = std::max(optics.largest_color * (optics.emission ? length : 2),
                                2 * frame.isosurfaces.largest_light);
  const double by_extinction =
      steepest_slope(optics.extinction, extinction.intervals) * length * std::max(1.0, light);
  const double by_color =
      steepest_slope(optics.color, color.intervals) * (optics.emission ? length : 1);
  extinction.nodes.allowed = share / by_extinction;
  color.nodes.allowed = share / by_color;
  if (optics.same_field)
    extinction.nodes.allowed = color.nodes.allowed = share / (by_extinction + by_color);
}

template <class Real>
Real doubtful_part(const BasicBernstein<Real>& f, std::type_identity_t<Real> value,
                   std::type_identity_t<Real> error, std::vector<BasicRootEnclosure<Real>>& roots) {
  roots.clear();
  append_roots(f, value - error, roots);
  append_roots(f, value + error, roots);
  std::ranges::sort(roots, {}, &BasicRootEnclosure<Real>::low);
  roots.push_back({1, 1, 0});
  Real from = 0, sum = 0;
  for (const BasicRootEnclosure<Real>& root : roots) {
    // between two roots the polynomial stays within the error, or stays outside it
    if (root.low > from && std::abs(evaluate(f, (from + root.low) / 2) - value) <= 2 * error)
      sum += root.low - from;
    if (root.high > from) sum += root.high - std::max(from, root.low);
    from = std::max(from, root.high);
  }
  return sum;
}

template double doubtful_part(const BernsteinPolynomial&, double, double,
                              std::vector<RootEnclosure>&);
template long double doubtful_part(const ExtendedBernstein&, long double, long double,
                                   std::vector<BasicRootEnclosure<long double>>&);

}  // namespace hiac
