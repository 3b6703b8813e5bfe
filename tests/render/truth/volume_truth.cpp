#include "tests/render/truth/volume_truth.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace hiac::test {
namespace {

using Real = VolumeTruth::Real;

// A Gauss-Legendre rule on [0, 1].
template <std::size_t N>
struct Rule {
  std::array<Real, N> x, w;

  Rule() {
    for (std::size_t k = 0; k < N; ++k) {
      Real z = std::cos(std::numbers::pi_v<Real> * (static_cast<Real>(k) + 0.75L) / (N + 0.5L));
      Real slope = 0;
      for (int step = 0; step < 12; ++step) {
        Real before = 1, p = z;
        for (std::size_t n = 2; n <= N; ++n) {
          const Real next =
              ((2 * static_cast<Real>(n) - 1) * z * p - (static_cast<Real>(n) - 1) * before) /
              static_cast<Real>(n);
          before = p;
          p = next;
        }
        slope = N * (z * p - before) / (z * z - 1);
        z -= p / slope;
      }
      x[k] = (1 - z) / 2;
      w[k] = 1 / ((1 - z * z) * slope * slope);
    }
  }
};

// Linear in the scalar: value + slope s.
struct LinearFunction {
  Real value, slope;
};

template <std::size_t N>
LinearFunction on_piece(const PiecewiseLinear<N>& function, std::size_t channel, Real scalar) {
  const auto& p = function.piece(function.interval_of(static_cast<double>(scalar)));
  const Real slope = p.slope[channel];
  return {p.value[channel] - slope * p.anchor, slope};
}

ChebyshevSeries applied(const LinearFunction& f, const ChebyshevSeries& scalar) {
  ChebyshevSeries result = scalar;
  for (std::size_t k = 0; k <= scalar.degree; ++k) result.c[k] *= f.slope;
  result.c[0] += f.value;
  return result;
}

// Panels of at most unit depth over a piece of optical depth `most` at most; fewer points do where
// it is thin. `add(rule, u0, u1)`: light of one of them, from u0 to u1 in [0, 1]; false: no more.
template <std::size_t kThin, std::size_t kThick, typename Add>
void for_panels(Real most, const Add& add) {
  static const Rule<kThin> thin;
  static const Rule<kThick> thick;
  if (most < 0.02L) {
    add(thin, Real(0), Real(1));
    return;
  }
  const int panels = 1 + static_cast<int>(std::min<Real>(most, 2000));
  for (int k = 0; k < panels; ++k)
    if (!add(thick, static_cast<Real>(k) / panels, static_cast<Real>(k + 1) / panels)) return;
}

// What a function is at the two ends of a piece.
struct Ends {
  Real front, back;
  [[nodiscard]] Real at(Real u) const { return front + u * (back - front); }
};

// Light of a piece on which everything is linear, and its optical depth.
Real add_linear(const std::array<Ends, 3>& color, const Ends& tau, Real length, bool emission,
                Real transparency, std::array<Real, 3>& rgb) {
  const auto depth = [&](Real u) {
    return length * u * (tau.front + u * (tau.back - tau.front) / 2);
  };
  Real all = 0, sloped = 0;  // weights of 1 and u
  for_panels<6, 12>(
      length * std::max(tau.front, tau.back), [&](const auto& rule, Real u0, Real u1) {
        if (transparency * std::exp(-depth(u0)) < VolumeTruth::kOpaque) return false;
        for (std::size_t k = 0; k < rule.x.size(); ++k) {
          const Real u = u0 + (u1 - u0) * rule.x[k];
          const Real weight =
              (u1 - u0) * rule.w[k] * std::exp(-depth(u)) * (emission ? Real(1) : tau.at(u));
          all += weight;
          sloped += weight * u;
        }
        return true;
      });
  for (std::size_t c = 0; c < 3; ++c)
    rgb[c] +=
        transparency * length * (color[c].front * all + (color[c].back - color[c].front) * sloped);
  return depth(1);
}

}  // namespace

VolumeTruth::VolumeTruth(const Volume& volume) : volume_(volume) {
  if (volume.color) color_ = volume.color->function();
  if (volume.extinction) extinction_ = volume.extinction->function();
}

void VolumeTruth::add_linear_piece(const PieceFields& fields, Real from, Real to, Real length,
                                   Light& light) const {
  const auto ends = [&](const ChebyshevSeries& scalar, const auto& function, std::size_t c) {
    const Ends s{scalar.c[0] + from * scalar.c[1], scalar.c[0] + to * scalar.c[1]};
    const LinearFunction f = on_piece(function, c, s.at(0.5L));
    return Ends{f.value + f.slope * s.front, f.value + f.slope * s.back};
  };
  Ends tau{0, 0};
  if (volume_.extinction) tau = ends(*fields.extinction, extinction_, 0);
  std::array<Ends, 3> color{};
  if (volume_.color)
    for (std::size_t c = 0; c < 3; ++c) color[c] = ends(*fields.color, color_, c);
  light.transparency *= std::exp(-add_linear(color, tau, length, volume_.glow == Glow::emission,
                                             light.transparency, light.rgb));
}

void VolumeTruth::add_piece(const PieceFields& fields, Real from, Real to, Real length,
                            Light& light) const {
  const Real half = length / 2;
  const auto part = [&](const ChebyshevSeries& whole) {
    if (whole.degree == 0) return whole;
    std::array<Real, ChebyshevSeries::kMostDegree + 1> values;
    for (std::size_t j = 0; j <= whole.degree; ++j)
      values[j] =
          whole.at((from + to) / 2 + (to - from) / 2 * ChebyshevSeries::place(whole.degree, j));
    return ChebyshevSeries::through(whole.degree, values.data());
  };
  const bool emission = volume_.glow == Glow::emission;
  ChebyshevSeries tau;
  if (volume_.extinction) {
    const ChebyshevSeries scalar = part(*fields.extinction);
    tau = applied(on_piece(extinction_, 0, scalar.at(0)), scalar);
  }
  std::array<ChebyshevSeries, 3> color;
  if (volume_.color) {
    const ChebyshevSeries scalar = part(*fields.color);
    for (std::size_t c = 0; c < 3; ++c)
      color[c] = applied(on_piece(color_, c, scalar.at(0)), scalar);
  }
  const ChebyshevSeries depth = tau.integral();
  Real largest = 0;
  for (std::size_t k = 0; k <= tau.degree; ++k) largest += std::abs(tau.c[k]);
  for_panels<16, 24>(2 * half * largest, [&](const auto& rule, Real u0, Real u1) {
    const Real before = light.transparency;
    if (before * std::exp(-half * depth.at(2 * u0 - 1)) < kOpaque) return false;
    for (std::size_t k = 0; k < rule.x.size(); ++k) {
      const Real x = 2 * (u0 + (u1 - u0) * rule.x[k]) - 1;
      const Real weight = 2 * (u1 - u0) * half * rule.w[k] * before *
                          std::exp(-half * depth.at(x)) * (emission ? Real(1) : tau.at(x));
      for (std::size_t c = 0; c < 3; ++c) light.rgb[c] += weight * color[c].at(x);
    }
    return true;
  });
  light.transparency *= std::exp(-half * depth.at(1));
}

}  // namespace hiac::test
