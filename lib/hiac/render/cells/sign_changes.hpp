#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "hiac/optics/polynomial_roots.hpp"

namespace hiac {

/// Follows the sign of an offset along [0, 1] and notes where it changes. `Real`: double or long
/// double.
template <class Real>
class SignChanges {
 public:
  /// `below`: whether the offset is negative at 0, if known.
  SignChanges(std::optional<bool> below, std::vector<Real>& places)
      : below_(below), places_(places) {}

  /// States that the sign is certain on [begin, end], and uncertain between the last certain point
  /// and `begin`. If the sign differs from the last one, a change is noted halfway between.
  void certain(bool below, Real begin, Real end) {
    if (below_ && *below_ != below) places_.push_back((reached_ + begin) / 2);
    below_ = below;
    reached_ = end;
  }

  /// Follows a polynomial on [begin, end] whose sign is that of the offset wherever its magnitude
  /// exceeds `rounding`. `roots`: scratch.
  void follow(const BasicBernstein<Real>& offset, Real begin, Real end, Real rounding,
              std::vector<BasicRootEnclosure<Real>>& roots) {
    // the ray stays far from the surface, the usual case
    const auto [least, most] = std::ranges::minmax(offset.coefficients());
    if (least > rounding || most < -rounding) return certain(least < 0, begin, end);
    roots.clear();
    append_roots(offset, 0, roots);
    std::ranges::sort(roots, {}, &BasicRootEnclosure<Real>::low);
    roots.push_back({1, 1, 0});
    const auto at = [&](Real t) { return begin + t * (end - begin); };
    Real from = 0;
    for (const BasicRootEnclosure<Real>& root : roots) {
      if (root.low > from) {
        Real largest = 0;
        for (const double u : {0.25, 0.5, 0.75}) {
          const Real value = evaluate(offset, from + u * (root.low - from));
          if (std::abs(value) > std::abs(largest)) largest = value;
        }
        if (std::abs(largest) > rounding) certain(largest < 0, at(from), at(root.low));
      }
      from = std::max(from, root.high);
    }
  }

 private:
  std::optional<bool> below_;
  Real reached_ = 0;
  std::vector<Real>& places_;
};

/// Fills `places` with the points where an offset along [0, 1], given in pieces, minus `level`
/// changes sign. Pieces have `begin`, `end` and the offset as fields[0]. `roots`: scratch.
template <class Real, class Piece>
void find_shifted_changes(const std::vector<Piece>& pieces, Real level, std::vector<Real>& places,
                          std::vector<BasicRootEnclosure<Real>>& roots) {
  places.clear();
  SignChanges<Real> changes(std::nullopt, places);
  for (const Piece& piece : pieces) {
    BasicBernstein<Real> shifted = piece.fields[0];
    for (std::size_t i = 0; i <= shifted.degree; ++i) shifted.c[i] -= level;
    changes.follow(shifted, piece.begin, piece.end, 0, roots);
  }
}

/// Whether an offset raised by `level`, and one lowered by it, each have as many sign changes as
/// `places`. Raises each entry of `moved`, which may be empty, to at least twice the distance by
/// which its place moves. `shifted`, `roots`: scratch.
template <class Real, class Piece>
bool as_many_when_shifted(const std::vector<Piece>& pieces, Real level,
                          const std::vector<Real>& places, std::vector<Real>& moved,
                          std::vector<Real>& shifted,
                          std::vector<BasicRootEnclosure<Real>>& roots) {
  bool as_many = true;
  for (const Real by : {level, -level}) {
    find_shifted_changes(pieces, by, shifted, roots);
    if (shifted.size() != places.size())
      as_many = false;
    else
      for (std::size_t i = 0; i < moved.size(); ++i)
        moved[i] = std::max(moved[i], 2 * std::abs(shifted[i] - places[i]));
  }
  return as_many;
}

}  // namespace hiac
