#include "tests/support/linear_piece_vectors.hpp"

#include <stdexcept>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/support/linear_piece_vectors.cpp"
#include "hwy/foreach_target.h"  // compiles this file once per instruction set
#include "hwy/highway.h"
// after foreach_target.h
#include "hiac/optics/linear_piece-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

template <class Glow>
void batch(std::span<const double> b, std::span<const double> a, const LinearPieceOutput& out) {
  const hn::ScalableTag<double> d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + lanes <= b.size(); i += lanes) {
    const auto w = linear_piece_detail::evaluate<Glow>(d, hn::LoadU(d, b.data() + i),
                                                       hn::LoadU(d, a.data() + i));
    hn::StoreU(w.transparency, d, out.transparency.data() + i);
    hn::StoreU(w.front, d, out.front.data() + i);
    hn::StoreU(w.back, d, out.back.data() + i);
  }
  // the remaining pieces run one by one through the same vector code: lanes are independent
  const hn::CappedTag<double, 1> one;
  for (; i < b.size(); ++i) {
    const auto w = linear_piece_detail::evaluate<Glow>(one, hn::Set(one, b[i]), hn::Set(one, a[i]));
    out.transparency[i] = hn::GetLane(w.transparency);
    out.front[i] = hn::GetLane(w.front);
    out.back[i] = hn::GetLane(w.back);
  }
}

void weights_batch(std::span<const double> b, std::span<const double> a,
                   const LinearPieceOutput& out) {
  batch<linear_piece_detail::Chromaticity>(b, a, out);
}

void emission_batch(std::span<const double> b, std::span<const double> a,
                    const LinearPieceOutput& out) {
  batch<linear_piece_detail::Emission>(b, a, out);
}

void mean_color_batch(std::span<const double> b, std::span<const double> a,
                      const LinearPieceOutput& out) {
  batch<linear_piece_detail::MeanChromaticity>(b, a, out);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace hiac
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hiac {
namespace {

HWY_EXPORT(weights_batch);
HWY_EXPORT(emission_batch);
HWY_EXPORT(mean_color_batch);

void check_lengths(std::span<const double> b, std::span<const double> a,
                   const LinearPieceOutput& out) {
  for (const std::size_t size :
       {a.size(), out.transparency.size(), out.front.size(), out.back.size()})
    if (size != b.size())
      throw std::invalid_argument("the spans of a batch of linear pieces must be equally long");
}

}  // namespace

void linear_piece_weights(std::span<const double> b, std::span<const double> a,
                          const LinearPieceOutput& out) {
  check_lengths(b, a, out);
  HWY_DYNAMIC_DISPATCH(weights_batch)(b, a, out);
}

void linear_piece_emission(std::span<const double> b, std::span<const double> a,
                           const LinearPieceOutput& out) {
  check_lengths(b, a, out);
  HWY_DYNAMIC_DISPATCH(emission_batch)(b, a, out);
}

void linear_piece_mean_color(std::span<const double> b, std::span<const double> a,
                             const LinearPieceOutput& out) {
  check_lengths(b, a, out);
  HWY_DYNAMIC_DISPATCH(mean_color_batch)(b, a, out);
}

}  // namespace hiac
#endif  // HWY_ONCE
