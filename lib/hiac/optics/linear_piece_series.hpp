#pragma once

#include <array>
#include <cstddef>

/// The power series for linear pieces that are not thick, shared by the scalar and the vector
/// evaluation.
///
/// With b, a the optical densities at the front and the back (linear_piece.hpp), let
///     sigma = (a + b) / 4,   delta = (a - b) / 4,   h = sqrt(zeta) = exp(-sigma)
/// and move the origin of u to the middle of the piece, u = 1/2 + s. Then
/// A(u) = sigma + 2 sigma s - 2 delta (1/4 - s^2), so that everything but the factor h is even or
/// odd in s, and all results follow from one function of two variables:
///
///     rho(delta, sigma^2) = 4 int_{-1/2}^{1/2} s sinh(2 sigma s) exp(2 delta (1/4 - s^2)) ds
///                           / (2 sigma)
///                         = sum_{j,k} delta^j sigma^{2k} / ((2k+1)! (2k+3)(2k+5)...(2k+2j+3)).
///
/// Let S = sinh(sigma) / sigma and kappa = rho(0, sigma^2); then cosh(sigma) = S + sigma^2 kappa
/// and, by the integration by parts b Psi + (a - b) Psi_1 = 1 - zeta,
///
///     1 - zeta     = 2 h sigma S
///     1 - Psi      = h (sigma S + sigma^2 kappa - delta rho)
///     Psi - zeta   = h (sigma S - sigma^2 kappa + delta rho)
///     Psi          = h (S + delta rho)
///     Psi - Psi_1  = h (S + a rho / 2) / 2
///     Psi_1        = h (S - b rho / 2) / 2.
///
/// No bracket cancels for thin pieces, and none loses more than a decimal digit up to sigma = 2.
namespace hiac::linear_piece_series {

/// Coefficient of delta^j sigma^{2k} in rho.
constexpr double rho_coefficient(std::size_t j, std::size_t k) {
  double denominator = 1;
  for (std::size_t i = 2; i <= 2 * k + 1; ++i) denominator *= static_cast<double>(i);
  for (std::size_t i = 0; i <= j; ++i) denominator *= static_cast<double>(2 * k + 2 * i + 3);
  return 1 / denominator;
}

/// Coefficient of sigma^{2k} in S = sinh(sigma) / sigma.
constexpr double sinhc_coefficient(std::size_t k) {
  double denominator = 1;
  for (std::size_t i = 2; i <= 2 * k + 1; ++i) denominator *= static_cast<double>(i);
  return 1 / denominator;
}

/// A term below this cannot change the last bit of rho >= 1/5 or S >= 1; all neglected terms
/// together stay below 2^-55.
inline constexpr double kNegligible = 0x1p-59;

/// The series truncated for |delta| <= sigma <= kSigma.
template <int kSigmaNumerator, int kSigmaDenominator>
struct Series {
  static constexpr double kSigma = double{kSigmaNumerator} / kSigmaDenominator;

  /// Number of powers of sigma^2 that are kept with delta^j.
  static constexpr std::size_t rho_terms(std::size_t j) {
    double power = 1;
    for (std::size_t i = 0; i < j; ++i) power *= kSigma;
    std::size_t k = 0;
    while (rho_coefficient(j, k) * power >= kNegligible) {
      power *= kSigma * kSigma;
      ++k;
    }
    return k;
  }

  /// Number of powers of delta that are kept.
  static constexpr std::size_t delta_terms() {
    std::size_t j = 0;
    while (rho_terms(j) > 0) ++j;
    return j;
  }

  /// Number of powers of sigma^2 that are kept in S.
  static constexpr std::size_t sinhc_terms() {
    double power = 1;
    std::size_t k = 0;
    while (sinhc_coefficient(k) * power >= kNegligible) {
      power *= kSigma * kSigma;
      ++k;
    }
    return k;
  }

  /// kRhoTerms[j] = rho_terms(j), for loops.
  static constexpr auto kRhoTerms = [] {
    std::array<std::size_t, delta_terms()> table{};
    for (std::size_t j = 0; j < delta_terms(); ++j) table[j] = rho_terms(j);
    return table;
  }();

  /// kRho[j][k] = rho_coefficient(j, k), zero if the term is neglected.
  static constexpr auto kRho = [] {
    std::array<std::array<double, rho_terms(0)>, delta_terms()> table{};
    for (std::size_t j = 0; j < delta_terms(); ++j)
      for (std::size_t k = 0; k < rho_terms(j); ++k) table[j][k] = rho_coefficient(j, k);
    return table;
  }();

  static constexpr auto kSinhc = [] {
    std::array<double, sinhc_terms()> table{};
    for (std::size_t k = 0; k < sinhc_terms(); ++k) table[k] = sinhc_coefficient(k);
    return table;
  }();

  /// The coefficients, each repeated for every lane of a vector, so that an instruction can use
  /// them as memory operands; a constant would first be broadcast to a register. They are defined
  /// in linear_piece.cpp, because a compiler that saw the definition beside its use would make
  /// constants of them.
  struct Lanes {
    using Coefficient = std::array<double, 8>;
    alignas(64) std::array<std::array<Coefficient, rho_terms(0)>, delta_terms()> rho;
    alignas(64) std::array<Coefficient, sinhc_terms()> sinhc;
  };
  static const Lanes lanes;
};

/// Optical depth (a + b) / 2 = 2 sigma up to 1/16: the pieces of fine meshes.
using FaintSeries = Series<1, 32>;
/// Optical depth up to 1/8.
using ThinSeries = Series<1, 16>;
/// Optical depth up to 1.
using ModerateSeries = Series<1, 2>;
/// Optical depth up to 4; beyond, a piece is thick.
using MediumSeries = Series<2, 1>;

}  // namespace hiac::linear_piece_series
