#pragma once

#include <vector>

#include "hiac/optics/bernstein.hpp"

namespace hiac {

/// A part of [0, 1] where f may take a value s.
struct RootEnclosure {
  double low;
  double high;
  double deviation;  ///< |f - s| is at most this in [low, high]
};

/// Appends enclosures of all t in [0, 1] with f(t) = s: outside them f(t) - s has a certain sign,
/// rounding errors included. A simple root's enclosure is a few units of rounding divided by the
/// slope wide; around a multiple root, or where f comes closer to s than can be resolved, it is as
/// wide as the doubt. A constant f has no roots (it is compared with s exactly).
void append_roots(const BernsteinPolynomial& f, double s, std::vector<RootEnclosure>& roots);

}  // namespace hiac
