#include "hiac/render/cells/curved/patch_curvature.hpp"

#include <algorithm>
#include <cmath>

namespace hiac {

PatchCurvature::PatchCurvature(std::size_t degree, const PatchNet<double>& net) {
  const std::size_t side = degree + 1;
  const auto at = [&](std::size_t i, std::size_t j) { return net[i + side * j]; };
  const auto n = static_cast<double>(degree);
  for (std::size_t j = 0; j < side; ++j)
    for (std::size_t i = 0; i + 2 < side; ++i) {
      uu_ = std::max(uu_, std::abs(at(i + 2, j) - 2 * at(i + 1, j) + at(i, j)));
      vv_ = std::max(vv_, std::abs(at(j, i + 2) - 2 * at(j, i + 1) + at(j, i)));
    }
  for (std::size_t j = 0; j < degree; ++j)
    for (std::size_t i = 0; i < degree; ++i)
      uv_ = std::max(uv_, std::abs(at(i + 1, j + 1) - at(i + 1, j) - at(i, j + 1) + at(i, j)));
  const double beyond = std::pow(1 + 2 * kBorder, 2 * n);
  uu_ *= n * (n - 1) * beyond;
  vv_ *= n * (n - 1) * beyond;
  uv_ *= n * n * beyond;
}

double PatchCurvature::within(double u, double v) const {
  return 0.5 * (uu_ * u * u + vv_ * v * v) + uv_ * u * v;
}

}  // namespace hiac
