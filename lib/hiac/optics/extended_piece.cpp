#include "hiac/optics/extended_piece.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace hiac {
namespace {

using Real = long double;

// Light that passes less than this fraction of transparency is neglected.
constexpr Real kOpaque = 0x1p-90L;
constexpr Real kThickestPart = 0.25L;
// Number of terms of the power series of exp(-b v - (a - b) v^2 / 2) for a, b <= 1/4: the remainder
// is below 1e-21.
constexpr std::size_t kTerms = 28;

// Integrals over a part, v from 0 to 1, of exp(-A) and of v exp(-A), or of the same multiplied by
// the extinction tau(v) = b + (a - b) v.
struct Moments {
  Real constant = 0, linear = 0;
};

template <bool kWithExtinction>
Moments moments(Real b, Real a) {
  const Real slope = a - b;
  Moments m;
  Real before = 0, y = 1;  // coefficients of exp(-A): y' = -(b + slope v) y
  for (std::size_t k = 0; k < kTerms; ++k) {
    const auto n = static_cast<Real>(k);
    if constexpr (kWithExtinction) {
      m.constant += y * (b / (n + 1) + slope / (n + 2));
      m.linear += y * (b / (n + 2) + slope / (n + 3));
    } else {
      m.constant += y / (n + 1);
      m.linear += y / (n + 2);
    }
    const Real next = -(b * y + slope * before) / (n + 1);
    before = y;
    y = next;
  }
  return m;
}

// Returns the width of a part that starts where the extinction is `tau` and whose optical depth is
// kThickestPart if computed with the extinction of its thicker end.
Real widest_part(Real tau, Real slope) {
  const Real rising = std::max<Real>(slope, 0);
  // tau w + slope w^2 = kThickestPart
  return 2 * kThickestPart / (tau + std::sqrt(tau * tau + 4 * kThickestPart * rising));
}

template <bool kWithExtinction>
ExtendedPieceWeights weights(Real b, Real a) {
  const Real slope = a - b;
  ExtendedPieceWeights sum{std::exp(-(b + a) / 2), 0, 0};
  for (Real u0 = 0, u1 = 0; u0 < 1; u0 = u1) {
    const Real in_front = std::exp(-u0 * (b + u0 * slope / 2));
    if (in_front < kOpaque) break;
    u1 = std::min<Real>(1, u0 + widest_part(b + u0 * slope, slope));
    const Real width = u1 - u0;
    const Moments m = moments<kWithExtinction>((b + u0 * slope) * width, (b + u1 * slope) * width);
    const Real unit = kWithExtinction ? in_front : in_front * width;
    // u = u0 + width v
    const Real back = u0 * m.constant + width * m.linear;
    const Real front = (1 - u1) * m.constant + width * (m.constant - m.linear);
    sum.front += unit * front;
    sum.back += unit * back;
  }
  return sum;
}

}  // namespace

ExtendedPieceWeights extended_piece_weights(Real b, Real a) { return weights<true>(b, a); }

ExtendedPieceWeights extended_piece_emission(Real b, Real a) { return weights<false>(b, a); }

}  // namespace hiac
