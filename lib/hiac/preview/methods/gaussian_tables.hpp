#pragma once

#include <vector>

namespace hiac::preview {

/// The integrals of exp(t^2) and exp(-t^2) from 0 on, tabulated by Simpson's rule at equal steps
/// and interpolated between them (P. L. Williams, N. L. Max, "A Volume Density Optical Model",
/// 1992; the paper's M2). Cubic interpolation, from the integrals and their derivatives at both
/// ends of a step: an absolute error of 1e-12. The range is what double precision allows: equation
/// (8) multiplies a difference of lookups by exp(x^2), and with that their rounding.
class GaussianTables {
 public:
  static constexpr double kRange = 3;

  GaussianTables();
  /// Of exp(t^2), 0 <= x <= kRange.
  [[nodiscard]] double growing(double x) const { return interpolate(growing_, x); }
  /// Of exp(-t^2), 0 <= x <= kRange.
  [[nodiscard]] double falling(double x) const { return interpolate(falling_, x); }

 private:
  struct Entry {
    double integral, derivative;
  };
  [[nodiscard]] double interpolate(const std::vector<Entry>& table, double x) const;

  std::vector<Entry> growing_, falling_;
};

}  // namespace hiac::preview
