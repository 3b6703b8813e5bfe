#include "hiac/mesh/fields/tensor_invariants.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>

namespace hiac {

std::optional<SymmetricTensor> symmetric_tensor(std::span<const double> tuple) {
  if (tuple.size() == 6) {
    SymmetricTensor t;
    std::ranges::copy(tuple, t.begin());
    return t;
  }
  if (tuple.size() != 9) return std::nullopt;
  const auto mean = [&](std::size_t i, std::size_t j) { return 0.5 * tuple[i] + 0.5 * tuple[j]; };
  return SymmetricTensor{tuple[0], tuple[4], tuple[8], mean(1, 3), mean(5, 7), mean(2, 6)};
}

std::array<double, 3> principal_values(const SymmetricTensor& t) {
  if (!std::ranges::all_of(t, [](double v) { return std::isfinite(v); })) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    return {kNone, kNone, kNone};
  }
  const auto& [xx, yy, zz, xy, yz, xz] = t;
  Eigen::Matrix3d matrix;
  matrix << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  const Eigen::Vector3d ascending =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
  return {ascending[2], ascending[1], ascending[0]};
}

double von_mises(const SymmetricTensor& t) {
  const auto& [xx, yy, zz, xy, yz, xz] = t;
  // sqrt(((xx - yy)^2 + (yy - zz)^2 + (zz - xx)^2) / 2 + 3 (xy^2 + yz^2 + xz^2))
  const double normal = std::hypot(xx - yy, yy - zz, zz - xx);
  return std::hypot(std::sqrt(0.5) * normal, std::sqrt(3.0) * std::hypot(xy, yz, xz));
}

double tresca(const SymmetricTensor& t) {
  const auto values = principal_values(t);
  return values[0] - values[2];
}

double trace(const SymmetricTensor& t) { return t[0] + t[1] + t[2]; }

SymmetricTensor deviator(const SymmetricTensor& t) {
  const auto& [xx, yy, zz, xy, yz, xz] = t;
  // differences first: a large mean stress leaves them their digits
  return {((xx - yy) + (xx - zz)) / 3,
          ((yy - xx) + (yy - zz)) / 3,
          ((zz - xx) + (zz - yy)) / 3,
          xy,
          yz,
          xz};
}

}  // namespace hiac
