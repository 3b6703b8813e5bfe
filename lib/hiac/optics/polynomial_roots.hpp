#pragma once

#include <type_traits>
#include <vector>

#include "hiac/optics/bernstein.hpp"

namespace hiac {

/// A part of [0, 1] where f may take the value s.
template <class Real>
struct BasicRootEnclosure {
  Real low;
  Real high;
  Real deviation;  ///< |f - s| is at most this in [low, high]
};
using RootEnclosure = BasicRootEnclosure<double>;

/// Appends enclosures of all t in [0, 1] with f(t) = s: outside them f(t) - s has a certain sign,
/// rounding errors included. The width of a simple root's enclosure is a few units of rounding
/// divided by the slope; around a multiple root, or where f comes too close to s to be resolved, it
/// is as wide as the uncertainty. A constant f has no roots (it is compared with s exactly).
template <class Real>
void append_roots(const BasicBernstein<Real>& f, std::type_identity_t<Real> s,
                  std::vector<BasicRootEnclosure<Real>>& roots);

}  // namespace hiac
