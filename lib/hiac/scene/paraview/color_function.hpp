#pragma once

#include <array>
#include <string>
#include <vector>

#include "hiac/base/transfer_function.hpp"
#include "hiac/scene/paraview/scalar_axis.hpp"
#include "hiac/scene/paraview/state_document.hpp"

namespace hiac::paraview {

/// Largest error of a channel of display colours as piecewise-linear functions.
inline constexpr double kColorTolerance = 1e-6;

/// A colour function of ParaView (PVLookupTable) as display colours, piecewise linear along its
/// axis.
struct ColorFunction {
  ScalarAxis axis;
  std::vector<PiecewiseLinear<3>::Point> points;  ///< scalars are positions on the axis
  double bound = 0;                               ///< proven: no channel deviates more
  std::string description;                        ///< "Lab", "Diverging in 256 steps"

  /// The colour at a scalar: display values.
  [[nodiscard]] std::array<double, 3> at(double scalar) const;
};

/// Whether a discretized colour function is drawn as its table, or as the function behind it.
enum class ColorSteps : bool { taken, ignored };

/// Reads a PVLookupTable: every colour space, logarithmic scales, colours below and above the
/// range. A discretized one whose steps are taken becomes ParaView's table, before that is rounded
/// to bytes. Throws InputError for a malformed one, and for one of categories or of two scalars.
ColorFunction read_color_function(const Proxy& table, ColorSteps steps);

}  // namespace hiac::paraview
