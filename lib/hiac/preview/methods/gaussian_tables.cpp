#include "hiac/preview/methods/gaussian_tables.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace hiac::preview {
namespace {

constexpr std::size_t kSteps = 8192;
constexpr double kStep = GaussianTables::kRange / kSteps;

}  // namespace

GaussianTables::GaussianTables() {
  const auto tabulate = [](double sign, std::vector<Entry>& table) {
    const auto density = [&](double t) { return std::exp(sign * t * t); };
    double integral = 0;
    for (std::size_t k = 0; k <= kSteps; ++k) {
      const double t = static_cast<double>(k) * kStep;
      table.push_back({integral, density(t)});
      integral += kStep / 6 * (density(t) + 4 * density(t + kStep / 2) + density(t + kStep));
    }
  };
  tabulate(1, growing_);
  tabulate(-1, falling_);
}

double GaussianTables::interpolate(const std::vector<Entry>& table, double x) const {
  const double at = x / kStep;
  const auto k = std::min(static_cast<std::size_t>(at), kSteps - 1);
  const double u = at - static_cast<double>(k), v = 1 - u;
  const Entry &a = table[k], &b = table[k + 1];
  return v * v * (1 + 2 * u) * a.integral + u * u * (1 + 2 * v) * b.integral +
         u * v * kStep * (v * a.derivative - u * b.derivative);
}

}  // namespace hiac::preview
