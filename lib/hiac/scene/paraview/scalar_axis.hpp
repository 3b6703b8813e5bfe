#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "hiac/scene/paraview/state_document.hpp"

namespace hiac::paraview {

/// The scalars of a transfer function: as they are, or on a logarithmic scale as positions in
/// [0, 1], which are even in the scalar's logarithm.
struct ScalarAxis {
  /// The first and the last scalar of a logarithmic scale, positive; none: linear.
  std::optional<std::array<double, 2>> log_range;

  /// Of a scalar within the range.
  [[nodiscard]] double position(double scalar) const {
    if (!log_range) return scalar;
    const auto& [low, high] = *log_range;
    if (scalar == low) return 0;  // exact, as the other end
    if (scalar == high) return 1;
    return (std::log(scalar) - std::log(low)) / (std::log(high) - std::log(low));
  }
};

/// The axis of a transfer function over [low, high] that says whether its scale is logarithmic. As
/// in ParaView, a range that begins at 0 or below has a linear one; throws InputError where it is
/// negative throughout.
ScalarAxis axis_of(const Proxy& function, double low, double high);

}  // namespace hiac::paraview
