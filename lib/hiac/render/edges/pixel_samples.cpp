#include "hiac/render/edges/pixel_samples.hpp"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hiac/render/edges/pixel_samples.cpp"
#include <hwy/foreach_target.h>
// must come after foreach_target.h
#include <hwy/highway.h>

// Compiled once for every instruction set; declared once.
#ifndef HIAC_RENDER_EDGES_PIXEL_SAMPLES
#  define HIAC_RENDER_EDGES_PIXEL_SAMPLES
namespace hiac {

// Samples of the rows of a pixel: in row k from low + step * k on to high + step * k.
struct SampleBand {
  double low = 0, high = PixelSamples::kRows, step = 0;
};

// What a strip covers: what is in both bands, along and aside, from one row (a real number) on to
// another.
struct SampledStrip {
  SampleBand along, aside;
  double first = 0, last = PixelSamples::kRows - 1;
};

}  // namespace hiac
#endif

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Reals = hn::ScalableTag<double>;
using Words = hn::RebindToUnsigned<Reals>;
using Real = hn::Vec<Reals>;
using Word = hn::Vec<Words>;

// A whole number from 0 to 64 as an integer: of 2^52 plus it, the last bits.
HWY_INLINE Word whole(Real value) {
  const Reals d;
  const Words bits;
  return hn::And(hn::BitCast(bits, hn::Add(value, hn::Set(d, 0x1p52))), hn::Set(bits, 0x7f));
}

void cover(const SampledStrip& strip, PixelSamples& samples) {
  const Reals d;
  const Words bits;
  const Real zero = hn::Zero(d), one = hn::Set(d, 1.0), end = hn::Set(d, 64.0);
  const Word all = hn::Set(bits, ~std::uint64_t{0}), last = hn::Set(bits, 63);
  const auto at = [&](double from, double step, Real row) {
    return hn::Add(hn::Set(d, from), hn::Mul(hn::Set(d, step), row));
  };
  const auto& [along, aside, first_row, last_row] = strip;
  for (std::size_t k = 0; k < PixelSamples::kRows; k += hn::Lanes(d)) {
    const Real row = hn::Iota(d, static_cast<double>(k));
    const Real low = hn::Max(at(along.low, along.step, row), at(aside.low, aside.step, row));
    const Real high = hn::Min(at(along.high, along.step, row), at(aside.high, aside.step, row));
    // from the first sample that is not below `low` on, up to the last that is not above `high`
    const Real from = hn::Ceil(hn::Min(hn::Max(low, zero), end));
    const Real beyond =
        hn::Floor(hn::Add(hn::Min(hn::Max(high, hn::Neg(one)), hn::Sub(end, one)), one));
    const auto covered = hn::And(hn::Lt(from, beyond), hn::And(hn::Ge(row, hn::Set(d, first_row)),
                                                               hn::Le(row, hn::Set(d, last_row))));
    // where none is covered the shifts may be too far, and do not count
    const Word upper = hn::Shl(all, hn::Min(whole(from), last));
    const Word lower = hn::Shr(all, hn::Min(hn::Sub(hn::Set(bits, 64), whole(beyond)), last));
    hn::StoreU(hn::IfThenElseZero(hn::RebindMask(bits, covered), hn::And(upper, lower)), bits,
               samples.rows.data() + k);
  }
}

// The number of bits of row(k), a vector of rows from row k on.
template <class Row>
HWY_INLINE int count_bits(const Row& row) {
  const Words bits;
  Word sum = hn::Zero(bits);
  for (std::size_t k = 0; k < PixelSamples::kRows; k += hn::Lanes(bits))
    sum = hn::Add(sum, hn::PopulationCount(row(k)));
  return static_cast<int>(hn::GetLane(hn::SumOfLanes(bits, sum)));
}

int count_of(const PixelSamples& samples) {
  return count_bits([&](std::size_t k) { return hn::LoadU(Words(), samples.rows.data() + k); });
}

int count_of_both(const PixelSamples& a, const PixelSamples& b) {
  return count_bits([&](std::size_t k) {
    return hn::And(hn::LoadU(Words(), a.rows.data() + k), hn::LoadU(Words(), b.rows.data() + k));
  });
}

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hiac {
namespace {

HWY_EXPORT(cover);
HWY_EXPORT(count_of);
HWY_EXPORT(count_of_both);

// Where low <= value <= high, of a value that is `value` at the first sample and grows by so much
// from sample to sample of a row, and from row to row. What holds for whole rows limits these.
SampleBand solve(double value, double by_sample, double by_row, double low, double high,
                 SampledStrip& rows) {
  constexpr double kFlat = 1e-12;  // less than samples tell apart
  if (std::abs(by_sample) < kFlat) {
    const double a = (low - value) / by_row, b = (high - value) / by_row;
    rows.first = std::max(rows.first, std::min(a, b));
    rows.last = std::min(rows.last, std::max(a, b));
    return {};
  }
  const double a = (low - value) / by_sample, b = (high - value) / by_sample;
  return {std::min(a, b), std::max(a, b), -by_row / by_sample};
}

}  // namespace

void PixelSamples::operator|=(const PixelSamples& other) {
  for (std::size_t k = 0; k < kRows; ++k) rows[k] |= other.rows[k];
}

PixelSamples strip_samples(const Strip& strip, double x, double y) {
  constexpr double kSamples = PixelSamples::kRows;
  PixelSamples samples;
  const double dx = strip.x1 - strip.x0, dy = strip.y1 - strip.y0;
  const double length = std::sqrt(dx * dx + dy * dy);
  if (!(length > 0)) return samples;
  const double ux = dx / length, uy = dy / length, half = strip.width / 2;
  // the first sample, relative to the strip's beginning
  const double first_x = x - 0.5 + 0.5 / kSamples - strip.x0;
  const double first_y = y - 0.5 + 0.5 / kSamples - strip.y0;
  SampledStrip sampled;
  sampled.along =
      solve(ux * first_x + uy * first_y, ux / kSamples, uy / kSamples, 0, length, sampled);
  sampled.aside =
      solve(ux * first_y - uy * first_x, -uy / kSamples, ux / kSamples, -half, half, sampled);
  if (sampled.first <= sampled.last) HWY_DYNAMIC_DISPATCH(cover)(sampled, samples);
  return samples;
}

int count(const PixelSamples& samples) { return HWY_DYNAMIC_DISPATCH(count_of)(samples); }

int count_common(const PixelSamples& a, const PixelSamples& b) {
  return HWY_DYNAMIC_DISPATCH(count_of_both)(a, b);
}

}  // namespace hiac
#endif
