#include "hiac/render/cell_scalars.hpp"

namespace hiac {

double doubtful_part(const BernsteinPolynomial& f, double value, double error,
                     std::vector<RootEnclosure>& roots) {
  roots.clear();
  append_roots(f, value - error, roots);
  append_roots(f, value + error, roots);
  std::ranges::sort(roots, {}, &RootEnclosure::low);
  roots.push_back({1, 1, 0});
  double from = 0, sum = 0;
  for (const RootEnclosure& root : roots) {
    // between roots it is within or not all along
    if (root.low > from && std::abs(evaluate(f, 0.5 * (from + root.low)) - value) <= 2 * error)
      sum += root.low - from;
    if (root.high > from) sum += root.high - std::max(from, root.low);
    from = std::max(from, root.high);
  }
  return sum;
}

}  // namespace hiac
