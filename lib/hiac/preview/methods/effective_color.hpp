#pragma once

#include <array>
#include <cstdint>

#include "hiac/base/transfer_function.hpp"
#include "hiac/preview/methods/gaussian_tables.hpp"
#include "hiac/preview/methods/method.hpp"

namespace hiac::preview {

/// What a ray meets at one end of its way through a region.
struct RayEnd {
  double tau;                   ///< extinction per world unit
  std::array<double, 3> color;  ///< chromaticity, or emission per world unit
};

/// The colour C of a vertex of a region with which a pixel's light is alpha C (chromaticity) or
/// l (1 - exp(-D)) / D C (emission; D = l tau_avg is the optical depth): the mean of the ends' for
/// M0 and M1, the effective chromaticity for M2 and M3, that is the radiance of (8) over alpha and,
/// where alpha is tiny, its limit for l -> 0.
class EffectiveColor {
 public:
  EffectiveColor(Method method, Glow glow) : method_(method), glow_(glow) {}

  /// `reverted` is set where M2 falls back to M1: an argument is beyond the tables' range, or (with
  /// emission) the difference of two lookups has no digits left.
  [[nodiscard]] std::array<double, 3> at(double length, const RayEnd& front, const RayEnd& back,
                                         bool& reverted) const;

 private:
  struct Weights {
    double front, back;
  };
  [[nodiscard]] Weights weights(double b, double a, bool& reverted) const;
  [[nodiscard]] Weights by_tables(double b, double a, bool& reverted) const;

  Method method_;
  Glow glow_;
  GaussianTables tables_;
};

/// (1 - exp(-x)) / x for x >= 0.
double opacity_ratio(double x);

}  // namespace hiac::preview
