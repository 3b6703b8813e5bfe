#include "hiac/render/integrate/cell_integrals.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hiac/render/integrate/cell_integrals.cpp"
#include <hwy/foreach_target.h>
// must come after foreach_target.h
#include <hwy/highway.h>

#include "hiac/render/integrate/polynomial_walk-inl.hpp"
#include "hiac/render/integrate/segment_fields-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Integrates segments with the fields that SegmentFields finds.
template <bool kEmission>
class IntegratingSink {
 public:
  using D = hn::CappedTag<double, 8>;
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;

  IntegratingSink(const Frame& frame, const CellPolynomials& cell, IntervalRange color,
                  IntervalRange extinction)
      : walk_(frame.optics, walk_field(cell.fields[cell.field_count - 1], color),
              walk_field(cell.fields[0], extinction)) {}

  HWY_INLINE void begin(std::size_t first, const CellSegments& s) {
    const D d;
    length_ = hn::LoadU(d, s.length.data() + first);
    allowed_ = hn::LoadU(d, s.allowed.data() + first);
    sum_ = {hn::Zero(d), hn::Zero(d), hn::Zero(d), hn::Set(d, 1.0)};
  }

  HWY_NOINLINE void add(double begin, double end, FieldPolynomials<V>& fields, M& active) {
    const D d;
    const V part = hn::Set(d, end - begin);
    const M undone = walk_.add(d, fields[0], fields[1], hn::Mul(length_, part),
                               hn::Mul(allowed_, part), active, sum_);
    active = hn::AndNot(undone, active);
  }

  HWY_INLINE void store(std::size_t first, M done, CellSegments& s) const {
    const D d;
    hn::StoreU(sum_.red, d, s.red.data() + first);
    hn::StoreU(sum_.green, d, s.green.data() + first);
    hn::StoreU(sum_.blue, d, s.blue.data() + first);
    hn::StoreU(sum_.transparency, d, s.transparency.data() + first);
    const auto is_done = lanes_of(d, done);
    for (std::size_t k = 0; k < hn::Lanes(d); ++k) s.done[first + k] = is_done[k] ? 1 : 0;
  }

 private:
  static WalkField walk_field(const CellPolynomials::Field& field, IntervalRange intervals) {
    return {intervals, field.base,
            std::max(std::abs(field.least - field.base), std::abs(field.most - field.base))};
  }

  PolynomialWalk<kEmission> walk_;
  // of the current segments
  V length_, allowed_;
  Radiance<V> sum_;
};

template <bool kEmission>
HWY_NOINLINE void integrate_all(const Frame& frame, const CellPolynomials& cell,
                                IntervalRange color, IntervalRange extinction,
                                CellSegments& segments) {
  IntegratingSink<kEmission> sink(frame, cell, color, extinction);
  SegmentFields<IntegratingSink<kEmission>> fields(frame, cell, sink);
  const std::size_t lanes = hn::Lanes(hn::CappedTag<double, 8>());
  for (std::size_t first = 0; first < segments.count; first += lanes)
    sink.store(first, fields.expand(first, segments), segments);
}

void integrate_segments_here(const Frame& frame, const CellPolynomials& cell, IntervalRange color,
                             IntervalRange extinction, CellSegments& segments) {
  const auto integrate = frame.optics.emission ? integrate_all<true> : integrate_all<false>;
  integrate(frame, cell, color, extinction, segments);
}

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hiac {

HWY_EXPORT(integrate_segments_here);

void integrate_cell_segments(const Frame& frame, const CellPolynomials& cell, IntervalRange color,
                             IntervalRange extinction, CellSegments& segments) {
  if (segments.count == 0) return;
  segments.pad();
  HWY_DYNAMIC_DISPATCH(integrate_segments_here)(frame, cell, color, extinction, segments);
}

}  // namespace hiac
#endif
