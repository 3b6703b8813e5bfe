// Linear pieces in vector registers, for files that Highway compiles once per instruction set
// (include after hwy/foreach_target.h). Scalar counterpart and definitions: linear_piece.hpp;
// method: linear_piece_series.hpp. The accuracy stated there holds here too. A lane's result
// depends on that lane's b and a alone, whatever the other lanes hold.
#if defined(HIAC_OPTICS_LINEAR_PIECE_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_OPTICS_LINEAR_PIECE_INL_HPP
#    undef HIAC_OPTICS_LINEAR_PIECE_INL_HPP
#  else
#    define HIAC_OPTICS_LINEAR_PIECE_INL_HPP
#  endif

#  include <cstddef>

#  include "hiac/optics/linear_piece.hpp"
#  include "hiac/optics/linear_piece_series.hpp"
#  include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace hiac {
namespace HWY_NAMESPACE {

/// LinearPieceWeights of a vector of pieces.
template <class V>
struct PieceWeights {
  V transparency;
  V front;
  V back;
};

namespace linear_piece_detail {

namespace hn = hwy::HWY_NAMESPACE;
namespace series = ::hiac::linear_piece_series;

/// The coefficients of rho, the same in all lanes.
struct OwnTerms {
  template <class Kind, std::size_t j, std::size_t k, class D>
  HWY_INLINE hn::Vec<D> rho(D d) const {
    return hn::Load(d, Kind::lanes.rho[j][k].data());
  }
};

/// The coefficients of rho, without those that a shorter series neglects in the lanes of a mask.
/// There the result is that of the shorter series to the last bit: Horner's sums begin with zeros,
/// and adding to zero is exact. Both series have the same number of terms of S.
template <class Shorter, class M>
struct TermsByLane {
  M shorter;

  template <class Kind, std::size_t j, std::size_t k, class D>
  HWY_INLINE hn::Vec<D> rho(D d) const {
    static_assert(Shorter::sinhc_terms() == Kind::sinhc_terms());
    const auto c = hn::Load(d, Kind::lanes.rho[j][k].data());
    if constexpr (j < Shorter::delta_terms() && k < Shorter::rho_terms(j)) {
      return c;
    } else {
      return hn::IfThenZeroElse(shorter, c);
    }
  }
};

/// sum_{k' >= k} kRho[j][k'] sigma2^{k' - k} (Horner, unrolled).
template <class Kind, std::size_t j, std::size_t k, class D, class Terms, class V>
HWY_INLINE V rho_row(D d, const Terms& terms, V sigma2) {
  const V c = terms.template rho<Kind, j, k>(d);
  if constexpr (k + 1 == Kind::rho_terms(j)) {
    return c;
  } else {
    return hn::MulAdd(rho_row<Kind, j, k + 1>(d, terms, sigma2), sigma2, c);
  }
}

/// sum_{j' >= j} delta^{j' - j} rho_row(j').
template <class Kind, std::size_t j, class D, class Terms, class V>
HWY_INLINE V rho_from(D d, const Terms& terms, V delta, V sigma2) {
  const V row = rho_row<Kind, j, 0>(d, terms, sigma2);
  if constexpr (j + 1 == Kind::delta_terms()) {
    return row;
  } else {
    return hn::MulAdd(rho_from<Kind, j + 1>(d, terms, delta, sigma2), delta, row);
  }
}

template <class Kind, std::size_t k, class D, class V>
HWY_INLINE V sinhc_from(D d, V sigma2) {
  const V c = hn::Load(d, Kind::lanes.sinhc[k].data());
  if constexpr (k + 1 == Kind::sinhc_terms()) {
    return c;
  } else {
    return hn::MulAdd(sinhc_from<Kind, k + 1>(d, sigma2), sigma2, c);
  }
}

/// Values of the series, named as in linear_piece_series.hpp.
template <class V>
struct SeriesValues {
  V h;
  V s;
  V sinh_sigma;
  V bend;  ///< sigma^2 kappa - delta rho
  V rho;
};

template <class Kind, class D, class Terms, class V>
HWY_INLINE SeriesValues<V> series_values(D d, const Terms& terms, V b, V a) {
  const V quarter = hn::Set(d, 0.25);
  const V sigma = hn::Mul(quarter, hn::Add(a, b));
  const V delta = hn::Mul(quarter, hn::Sub(a, b));
  const V sigma2 = hn::Mul(sigma, sigma);
  const V kappa = rho_row<Kind, 0, 0>(d, terms, sigma2);
  const V rho = hn::MulAdd(rho_from<Kind, 1>(d, terms, delta, sigma2), delta, kappa);
  const V s = sinhc_from<Kind, 0>(d, sigma2);
  const V sinh_sigma = hn::Mul(sigma, s);
  const V sigma2_kappa = hn::Mul(sigma2, kappa);
  const V cosh_sigma = hn::Add(s, sigma2_kappa);
  V h;
  if constexpr (Kind::kSigma <= 0.5) {
    h = hn::Sub(cosh_sigma, sinh_sigma);  // loses less than half a digit and needs no division
  } else {
    h = hn::Div(hn::Set(d, 1.0), hn::Add(cosh_sigma, sinh_sigma));
  }
  return {h, s, sinh_sigma, hn::NegMulAdd(delta, rho, sigma2_kappa), rho};
}

/// Chromaticity glow: computes linear_piece_weights.
struct Chromaticity {
  template <class Kind, class D, class Terms, class V>
  static HWY_INLINE PieceWeights<V> evaluate(D d, const Terms& terms, V b, V a) {
    const SeriesValues<V> v = series_values<Kind>(d, terms, b, a);
    return {hn::Mul(v.h, v.h), hn::Mul(v.h, hn::Add(v.sinh_sigma, v.bend)),
            hn::Mul(v.h, hn::Sub(v.sinh_sigma, v.bend))};
  }
  static LinearPieceWeights scalar(double b, double a) {
    return ::hiac::linear_piece_weights(b, a);
  }
};

/// Emission glow: computes linear_piece_emission.
struct Emission {
  template <class Kind, class D, class Terms, class V>
  static HWY_INLINE PieceWeights<V> evaluate(D d, const Terms& terms, V b, V a) {
    const SeriesValues<V> v = series_values<Kind>(d, terms, b, a);
    const V half = hn::Set(d, 0.5);
    const V half_h = hn::Mul(half, v.h);
    const V half_rho = hn::Mul(half, v.rho);
    return {hn::Mul(v.h, v.h), hn::Mul(half_h, hn::MulAdd(a, half_rho, v.s)),
            hn::Mul(half_h, hn::NegMulAdd(b, half_rho, v.s))};
  }
  static LinearPieceWeights scalar(double b, double a) {
    return ::hiac::linear_piece_emission(b, a);
  }
};

/// Chromaticity glow with the piece's mean colour: either end weighs half the opacity.
struct MeanChromaticity {
  template <class Kind, class D, class Terms, class V>
  static HWY_INLINE PieceWeights<V> evaluate(D d, const Terms& terms, V b, V a) {
    const V sigma = hn::Mul(hn::Set(d, 0.25), hn::Add(a, b));
    const V sigma2 = hn::Mul(sigma, sigma);
    const V s = sinhc_from<Kind, 0>(d, sigma2);
    const V sinh_sigma = hn::Mul(sigma, s);
    const V cosh_sigma = hn::MulAdd(sigma2, rho_row<Kind, 0, 0>(d, terms, sigma2), s);
    V h;
    if constexpr (Kind::kSigma <= 0.5) {
      h = hn::Sub(cosh_sigma, sinh_sigma);
    } else {
      h = hn::Div(hn::Set(d, 1.0), hn::Add(cosh_sigma, sinh_sigma));
    }
    const V half = hn::Mul(h, sinh_sigma);
    return {hn::Mul(h, h), half, half};
  }
  static LinearPieceWeights scalar(double b, double a) {
    const LinearPieceWeights w = ::hiac::linear_piece_weights(b, a);
    const double half = 0.5 * (w.front + w.back);
    return {w.transparency, half, half};
  }
};

template <class V, class M>
HWY_INLINE PieceWeights<V> select(M mask, const PieceWeights<V>& yes, const PieceWeights<V>& no) {
  return {hn::IfThenElse(mask, yes.transparency, no.transparency),
          hn::IfThenElse(mask, yes.front, no.front), hn::IfThenElse(mask, yes.back, no.back)};
}

/// Overwrites the lanes that hold thick pieces with the results of the scalar function. `out`:
/// transparency, front and back, one vector after another.
template <class Glow, class D, class V>
HWY_NOINLINE void evaluate_thick_lanes(D d, V b, V a, double* HWY_RESTRICT out) {
  constexpr std::size_t kLanes = hn::MaxLanes(d);
  HWY_ALIGN double b_lanes[kLanes];
  HWY_ALIGN double a_lanes[kLanes];
  hn::Store(b, d, b_lanes);
  hn::Store(a, d, a_lanes);
  for (std::size_t i = 0; i < hn::Lanes(d); ++i) {
    if (!(0.25 * (a_lanes[i] + b_lanes[i]) > series::MediumSeries::kSigma)) continue;
    const LinearPieceWeights w = Glow::scalar(b_lanes[i], a_lanes[i]);
    out[i] = w.transparency;
    out[kLanes + i] = w.front;
    out[2 * kLanes + i] = w.back;
  }
}

/// Evaluates pieces that are faint or thin, each by its own series.
template <class Glow, class D, class M, class V>
HWY_INLINE PieceWeights<V> evaluate_faint_or_thin(D d, M faint, V b, V a) {
  return Glow::template evaluate<series::ThinSeries>(d, TermsByLane<series::FaintSeries, M>{faint},
                                                     b, a);
}

/// Evaluates lanes that need different methods; some are more than thin. The result goes through
/// memory (`out`, as above), so that the caller keeps its vectors in registers in the common case.
template <class Glow, class D, class V>
HWY_NOINLINE void evaluate_mixed(D d, V b, V a, double* HWY_RESTRICT out) {
  constexpr std::size_t kLanes = hn::MaxLanes(d);
  const V sigma = hn::Mul(hn::Set(d, 0.25), hn::Add(a, b));
  const auto faint = hn::Le(sigma, hn::Set(d, series::FaintSeries::kSigma));
  const auto thin = hn::Le(sigma, hn::Set(d, series::ThinSeries::kSigma));
  const auto moderate = hn::Le(sigma, hn::Set(d, series::ModerateSeries::kSigma));
  const auto thick = hn::Gt(sigma, hn::Set(d, series::MediumSeries::kSigma));
  PieceWeights<V> w = select(thin, evaluate_faint_or_thin<Glow>(d, faint, b, a),
                             Glow::template evaluate<series::ModerateSeries>(d, OwnTerms(), b, a));
  if (!hn::AllTrue(d, moderate))
    w = select(moderate, w, Glow::template evaluate<series::MediumSeries>(d, OwnTerms(), b, a));
  hn::Store(w.transparency, d, out);
  hn::Store(w.front, d, out + kLanes);
  hn::Store(w.back, d, out + 2 * kLanes);
  if (!hn::AllFalse(d, thick)) evaluate_thick_lanes<Glow>(d, b, a, out);
}

template <class Glow, class D, class V>
HWY_INLINE PieceWeights<V> evaluate(D d, V b, V a) {
  const V sigma = hn::Mul(hn::Set(d, 0.25), hn::Add(a, b));
  const auto faint = hn::Le(sigma, hn::Set(d, series::FaintSeries::kSigma));
  if (HWY_LIKELY(hn::AllTrue(d, faint)))
    return Glow::template evaluate<series::FaintSeries>(d, OwnTerms(), b, a);
  if (hn::AllTrue(d, hn::Le(sigma, hn::Set(d, series::ThinSeries::kSigma))))
    return evaluate_faint_or_thin<Glow>(d, faint, b, a);
  constexpr std::size_t kLanes = hn::MaxLanes(d);
  HWY_ALIGN double out[3 * kLanes];
  evaluate_mixed<Glow>(d, b, a, out);
  return {hn::Load(d, out), hn::Load(d, out + kLanes), hn::Load(d, out + 2 * kLanes)};
}

}  // namespace linear_piece_detail

/// Returns transparency, 1 - Psi and Psi - zeta of the pieces (b, a), a vector of doubles each.
template <class D, class V>
HWY_INLINE PieceWeights<V> linear_piece_weights(D d, V b, V a) {
  return linear_piece_detail::evaluate<linear_piece_detail::Chromaticity>(d, b, a);
}

/// Returns transparency, Psi - Psi_1 and Psi_1 of the pieces (b, a), a vector of doubles each.
template <class D, class V>
HWY_INLINE PieceWeights<V> linear_piece_emission(D d, V b, V a) {
  return linear_piece_detail::evaluate<linear_piece_detail::Emission>(d, b, a);
}

/// Returns transparency and (1 - zeta) / 2 twice: PieceRule::mean_color with chromaticity glow.
template <class D, class V>
HWY_INLINE PieceWeights<V> linear_piece_mean_color(D d, V b, V a) {
  return linear_piece_detail::evaluate<linear_piece_detail::MeanChromaticity>(d, b, a);
}

}  // namespace HWY_NAMESPACE
}  // namespace hiac
HWY_AFTER_NAMESPACE();

#endif  // the per-target include guard
