// Based on: P. L. Williams, N. L. Max, C. M. Stein, "A High Accuracy Volume Renderer for
// Unstructured Data", IEEE TVCG 4(1), 1998, equation (8) and appendix B.
//
// Pieces of optical depth up to 4 use the series of linear_piece_series.hpp. Thicker ones have
// zeta < 0.02, and the closed forms do not cancel: with q = |a - b|, r = sqrt(2 q), x_b = b / r and
// x_a = a / r, an integral over [0, 1] is the one over [0, inf) minus zeta times the one that
// starts at the back.
#include "hiac/optics/linear_piece.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hiac/optics/linear_piece_series.hpp"
#include "hiac/optics/special_functions.hpp"

namespace hiac {

namespace linear_piece_series {

template <int kSigmaNumerator, int kSigmaDenominator>
constinit const typename Series<kSigmaNumerator, kSigmaDenominator>::Lanes
    Series<kSigmaNumerator, kSigmaDenominator>::lanes = [] {
      Lanes repeated{};
      for (std::size_t j = 0; j < delta_terms(); ++j)
        for (std::size_t k = 0; k < rho_terms(0); ++k) repeated.rho[j][k].fill(kRho[j][k]);
      for (std::size_t k = 0; k < sinhc_terms(); ++k) repeated.sinhc[k].fill(kSinhc[k]);
      return repeated;
    }();

template struct Series<1, 32>;
template struct Series<1, 16>;
template struct Series<1, 2>;
template struct Series<2, 1>;

}  // namespace linear_piece_series

namespace {

namespace series = linear_piece_series;

constexpr double kSqrtPi = 1 / std::numbers::inv_sqrtpi;
// The sum of two densities of this size is finite, and nothing is visible through them.
constexpr double kThickest = 1e150;

/// Values of the series at one (b, a), named as in linear_piece_series.hpp.
struct SeriesValues {
  double h;
  double s;
  double sinh_sigma;
  double bend;  ///< sigma^2 kappa - delta rho
  double rho;
};

template <class Kind>
SeriesValues sum_series(double b, double a) {
  const double sigma = 0.25 * (a + b);
  const double delta = 0.25 * (a - b);
  const double sigma2 = sigma * sigma;
  double rho = 0;
  double kappa = 0;
  for (std::size_t j = Kind::delta_terms(); j-- > 0;) {
    kappa = 0;  // after the loop: the part of rho without delta
    for (std::size_t k = Kind::kRhoTerms[j]; k-- > 0;) kappa = kappa * sigma2 + Kind::kRho[j][k];
    rho = rho * delta + kappa;
  }
  double s = 0;
  for (std::size_t k = Kind::sinhc_terms(); k-- > 0;) s = s * sigma2 + Kind::kSinhc[k];
  const double sinh_sigma = sigma * s;
  const double cosh_sigma = s + sigma2 * kappa;
  return {1 / (cosh_sigma + sinh_sigma), s, sinh_sigma, sigma2 * kappa - delta * rho, rho};
}

/// For pieces that are not thick: sigma = (a + b) / 4.
SeriesValues series_values(double sigma, double b, double a) {
  if (sigma <= series::ThinSeries::kSigma) return sum_series<series::ThinSeries>(b, a);
  if (sigma <= series::ModerateSeries::kSigma) return sum_series<series::ModerateSeries>(b, a);
  return sum_series<series::MediumSeries>(b, a);
}

/// Returns exp(-(a + b) / 2), corrected for the rounding error of the sum.
double thick_transparency(double b, double a) {
  const double sum = a + b;
  const double part = sum - a;
  const double error = (a - (sum - part)) + (b - part);
  return std::exp(-0.5 * sum) * (1 - 0.5 * error);
}

double thick_psi(double b, double a, double zeta) {
  if (a == b) return (1 - zeta) / a;
  const double q = std::abs(a - b);
  const double r = std::sqrt(2 * q);
  if (a > b) return kSqrtPi / r * (erfcx(b / r) - zeta * erfcx(a / r));
  return 2 / r * (dawson(b / r) - zeta * dawson(a / r));
}

double thick_psi1(double b, double a, double zeta) {
  if (a == b) return (1 - zeta * (1 + a)) / a / a;
  const double q = std::abs(a - b);
  const double r = std::sqrt(2 * q);
  const double x_b = b / r;
  const double x_a = a / r;
  if (a > b) return kSqrtPi / q * (ierfcx(x_b) - zeta * (ierfcx(x_a) + 0.5 * r * erfcx(x_a)));
  return (zeta * (dawson_derivative(x_a) - r * dawson(x_a)) - dawson_derivative(x_b)) / q;
}

LinearPieceWeights weights_of(const SeriesValues& v) {
  return {v.h * v.h, v.h * (v.sinh_sigma + v.bend), v.h * (v.sinh_sigma - v.bend)};
}

LinearPieceWeights emission_of(const SeriesValues& v, double b, double a) {
  const double half_h = 0.5 * v.h;
  return {v.h * v.h, half_h * (v.s + 0.5 * a * v.rho), half_h * (v.s - 0.5 * b * v.rho)};
}

}  // namespace

LinearPieceWeights linear_piece_weights(double b, double a) {
  const double sigma = 0.25 * (a + b);
  if (sigma <= series::MediumSeries::kSigma) return weights_of(series_values(sigma, b, a));
  b = std::min(b, kThickest);
  a = std::min(a, kThickest);
  const double zeta = thick_transparency(b, a);
  const double psi = thick_psi(b, a, zeta);
  return {zeta, 1 - psi, psi - zeta};
}

LinearPieceWeights linear_piece_emission(double b, double a) {
  const double sigma = 0.25 * (a + b);
  if (sigma <= series::MediumSeries::kSigma) return emission_of(series_values(sigma, b, a), b, a);
  b = std::min(b, kThickest);
  a = std::min(a, kThickest);
  const double zeta = thick_transparency(b, a);
  const double psi1 = thick_psi1(b, a, zeta);
  return {zeta, thick_psi(b, a, zeta) - psi1, psi1};
}

}  // namespace hiac
