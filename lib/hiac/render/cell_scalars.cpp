#include "hiac/render/cell_scalars.hpp"

namespace hiac {

bool all_zero(const std::vector<std::uint8_t>& zero, IntervalRange range) {
  return std::all_of(zero.begin() + static_cast<std::ptrdiff_t>(range.low),
                     zero.begin() + static_cast<std::ptrdiff_t>(range.high) + 1,
                     [](std::uint8_t z) { return z != 0; });
}

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
