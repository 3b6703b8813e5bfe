#pragma once

#include <string>
#include <vector>

#include "hiac/base/transfer_function.hpp"
#include "hiac/scene/paraview/scalar_axis.hpp"
#include "hiac/scene/paraview/state_document.hpp"

namespace hiac::paraview {

/// What an opacity o over the unit distance u means as an extinction.
enum class ExtinctionLaw : bool {
  proportional,  ///< o / u: ParaView's projected tetrahedra, Bunyk's ray casting, z-sweep
  exponential    ///< -ln(1 - o) / u: where ParaView draws regular grids, or resamples to one
};

/// Largest error of extinctions as piecewise-linear functions, relative to the largest extinction.
inline constexpr double kExtinctionShare = 1e-4;

/// An opacity function of ParaView (PiecewiseFunction) as extinctions per unit of length, piecewise
/// linear along its axis.
struct OpacityFunction {
  ScalarAxis axis;
  std::vector<PiecewiseLinear<1>::Point> points;  ///< scalars are positions on the axis
  double bound = 0;                               ///< proven: extinctions deviate no more anywhere
  bool is_opaque = false;  ///< somewhere the opacity is 1, and the law's extinction infinite
};

/// The extinction of an opacity in [0, 1]; the exponential law has that of the largest
/// single-precision number below 1 in place of an infinite one: 16.6 / unit.
double extinction(double opacity, double unit, ExtinctionLaw law);

/// Reads a PiecewiseFunction: points with midpoint and sharpness, on a linear or a logarithmic
/// scale, as vtkPiecewiseFunction defines them. `unit`: the unit distance, positive. Throws
/// InputError for a malformed one.
OpacityFunction read_opacity_function(const Proxy& function, double unit, ExtinctionLaw law);

}  // namespace hiac::paraview
