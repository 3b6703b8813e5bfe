#pragma once

#include <array>
#include <cstddef>

#include "hiac/geometry/bezier_patch.hpp"

namespace hiac {

/// A parameter point of a patch where two of its coordinates, a and b, vanish. When these are the
/// patch's distances from a ray, sideways and upwards, the ray meets the patch there.
struct PatchZero {
  double u, v;
  int sign;        ///< the sign of d(a, b) / d(u, v); arbitrary for a double zero
  double outside;  ///< distance of (u, v) from the patch's domain; negative inside
};

class PatchZeros {
 public:
  static constexpr std::size_t kMost = 12;

  [[nodiscard]] std::size_t size() const { return count_; }
  [[nodiscard]] const PatchZero& operator[](std::size_t k) const { return zeros_[k]; }
  [[nodiscard]] const PatchZero* begin() const { return zeros_.data(); }
  [[nodiscard]] const PatchZero* end() const { return zeros_.data() + count_; }
  void add(const PatchZero& zero) {
    if (count_ < kMost) zeros_[count_++] = zero;
  }
  void remove(std::size_t k) { zeros_[k] = zeros_[--count_]; }

 private:
  std::array<PatchZero, kMost> zeros_;
  std::size_t count_ = 0;
};

/// Returns the zeros of (a, b) in a patch's domain. Their signs add up to `winding`, the number of
/// times that the image of the domain's boundary winds around 0, as the caller has determined it.
///
/// Degree 1: eliminating one parameter leaves a quadratic equation. Higher degrees: the domain is
/// divided until the Bernstein coefficients prove of each part that it contains no zero, or that
/// the map is one to one on it, where Newton's iteration finds the zero if there is one. Division
/// ends at parts of size 2^-26 (2^-12 where curves of zeros make very many such parts); pairs of
/// zeros within such a part may be missed. (These are the exclusion and uniqueness tests of
/// Bernstein-subdivision solvers; B. Mourrain, J. P. Pavone, "Subdivision methods for solving
/// polynomial equations", 2009.) Where the patch is seen so nearly edge-on that rounding hides a
/// zero's parameters, any point that is on the ray to within rounding is accepted.
///
/// A zero near the border counts as inside if it is inside after the ray is moved right by a
/// quarter of `rounding` and down by much less; the caller should find `winding` with the same
/// shift. If the signs still do not add up to `winding`, rounding has misplaced a zero near the
/// border: the one nearest to the border is added or removed. An added zero is moved to the point
/// of the border that is nearest to the ray (nearest_on_border), which is the same point for all
/// patches around an edge.
///
/// `one_way`: the map is known to keep its orientation everywhere, so that there are exactly
/// |winding| zeros, and a single one needs no search. `guess`: where Newton's iteration starts;
/// without a search, the last bits of the result depend on it.
///
/// `depth` decides where zeros are not isolated. Where the ray runs along an edge to within
/// `rounding`, the less deep corner of the edge is returned; where the patch is seen edge-on, or
/// where no zero is found, the least deep of the border's points nearest to the ray.
///
/// At least |winding| zeros are returned, all of them in the domain, whatever (a, b) is, non-finite
/// numbers included.
struct PatchZeroQuestion {
  const PatchShape& shape;
  const PatchNet<double>&a, &b, &depth;
  int winding;
  bool one_way;
  double rounding = 0;
  std::array<double, 2> guess = {0.5, 0.5};
};
PatchZeros patch_zeros(const PatchZeroQuestion& question);

}  // namespace hiac
