#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "hiac/check/defect.hpp"
#include "tests/support/meshes.hpp"

namespace hiac::test {

/// The offenders of one defect; none where it was not found.
inline std::vector<Offender> offenders_of(const std::vector<Finding>& findings, Defect defect) {
  for (const Finding& finding : findings)
    if (finding.defect == defect) return finding.offenders;
  return {};
}
inline std::size_t count_of(const std::vector<Finding>& findings, Defect defect) {
  return offenders_of(findings, defect).size();
}
inline std::vector<Defect> defects_of(const std::vector<Finding>& findings) {
  std::vector<Defect> defects;
  for (const Finding& finding : findings) defects.push_back(finding.defect);
  std::ranges::sort(defects);
  return defects;
}

inline double above(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); }
inline double below(double x) {
  return std::nextafter(x, -std::numeric_limits<double>::infinity());
}

/// Maps that no coordinate is rounded by and that keep right hands right: the rotations of the
/// cube, each with a power of two.
inline std::vector<std::function<Position(const Position&)>> exact_motions() {
  std::vector<std::function<Position(const Position&)>> motions;
  std::array<std::size_t, 3> axes{0, 1, 2};
  int exponent = -40;
  do {
    for (unsigned signs = 0; signs < 8; ++signs) {
      const bool even = (axes[0] + 1) % 3 == axes[1];
      const bool odd_signs = ((signs & 1U) + (signs >> 1 & 1U) + (signs >> 2)) % 2 != 0;
      if (even == odd_signs) continue;  // a reflection
      const double scale = std::ldexp(1.0, exponent);
      exponent += 3;
      motions.emplace_back([axes, signs, scale](const Position& p) {
        Position q;
        for (std::size_t c = 0; c < 3; ++c)
          q[c] = ((signs >> c & 1U) != 0 ? -scale : scale) * p[axes[c]];
        return q;
      });
    }
  } while (std::ranges::next_permutation(axes).found);
  return motions;
}

}  // namespace hiac::test
