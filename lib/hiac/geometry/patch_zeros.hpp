#pragma once

#include <array>
#include <cstddef>

#include "hiac/geometry/bezier_patch.hpp"

namespace hiac {

/// A parameter point of a patch where two of its coordinates vanish: where a ray meets it, when
/// these are how far the patch is from the ray, sideways and upwards.
struct PatchZero {
  double u, v;
  int sign;        ///< that of d(a, b) / d(u, v); of a double zero either
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

/// The zeros of (a, b) in a patch's domain. Their signs add up to `winding`, the number of times
/// that the image of the domain's boundary winds around 0, as the caller has decided it.
///
/// Degree 1: one coordinate's elimination leaves a quadratic equation. Else: the domain is divided
/// until Bernstein coefficients tell of every part that there is no zero in it, or that the map is
/// one to one there (Newton's iteration then finds the zero, if there is one), down to parts of
/// 2^-26 (2^-12 where there are very many such, along curves of zeros), in which of pairs of zeros
/// nothing is known. (The exclusion and uniqueness tests of
/// Bernstein-subdivision solvers; B. Mourrain, J. P. Pavone, "Subdivision methods for solving
/// polynomial equations", 2009.) Where the patch is seen so nearly edge-on that rounding hides a
/// zero's parameters, a point on the ray to within rounding will do.
///
/// What is near the border counts as inside as it is when the ray is moved right by a quarter of
/// `rounding`, and down by much less; the caller's `winding` should be found likewise. Where what
/// is found still does not add up to `winding`, rounding has mistaken a zero near the border: that
/// nearest to it is taken in or left out. One that is taken in lies on the border where that is
/// nearest to the ray (nearest_on_border): all patches around an edge then lie there.
///
/// `one_way`: the map is known to turn one way everywhere, so that there are as many zeros as
/// |winding| and one of them needs no search. `guess`: a place to look at first; where a search
/// is not needed the last bits depend on it.
///
/// `depth` decides where zeros are not single points: where the ray runs along an edge to within
/// `rounding`, the edge's less deep corner is taken; where the patch is seen edge-on, and where no
/// zero is found, the least deep of the places on its border nearest to the ray.
///
/// Whatever (a, b) is, numbers that are not finite included, it returns as many as |winding| at
/// least, all of them in the domain.
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
