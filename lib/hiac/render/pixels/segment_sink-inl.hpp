// The destination of a kernel's segments, compiled once for every instruction set. Include from a
// file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_SEGMENT_SINK_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_SEGMENT_SINK_INL
#    undef HIAC_RENDER_SEGMENT_SINK_INL
#  else
#    define HIAC_RENDER_SEGMENT_SINK_INL
#  endif

#  include <cstddef>

#  include <hwy/highway.h>

#  include "hiac/render/pixels/compositor-inl.hpp"
#  include "hiac/render/pixels/open_runs-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The segments of a vector, one by one.
class SegmentLanes {
 public:
  template <class D, class V>
  HWY_INLINE void store(D d, V front, V back, const Radiance<V>& light, hn::Mask<D> active) {
    const V all[kCount] = {front,
                           back,
                           light.red,
                           light.green,
                           light.blue,
                           light.transparency,
                           hn::IfThenElseZero(active, hn::Set(d, 1.0))};
    for (std::size_t q = 0; q < kCount; ++q) hn::Store(all[q], d, lane_[q]);
  }

  [[nodiscard]] bool is_active(std::size_t k) const { return lane_[kActive][k] != 0; }
  [[nodiscard]] double front(std::size_t k) const { return lane_[kFront][k]; }
  [[nodiscard]] double back(std::size_t k) const { return lane_[kBack][k]; }
  [[nodiscard]] PlainRadiance light(std::size_t k) const {
    return {{lane_[kRed][k], lane_[kGreen][k], lane_[kBlue][k]}, lane_[kZeta][k]};
  }

 private:
  enum : std::size_t { kFront, kBack, kRed, kGreen, kBlue, kZeta, kActive, kCount };
  HWY_ALIGN double lane_[kCount][8];
};

// Composites segments over a tile's pixels, adds them to its runs, or appends them to the list of a
// group whose order is not yet known.
class SegmentSink {
 public:
  explicit SegmentSink(const TileTarget& to)
      : buffer_(to.buffer),
        group_(to.group),
        runs_(to.runs),
        counts_(to.counts),
        witness_tolerance_(to.frame.witness_tolerance) {}

  template <class D>
  HWY_INLINE void add(D d, const FinishedSegments<D>& s) {
    if (HWY_UNLIKELY(group_ != nullptr))
      collect(d, s);
    else if (HWY_UNLIKELY(runs_ != nullptr))
      counts_.violations += add_to_runs(d, s, witness_tolerance_, *runs_, buffer_);
    else
      counts_.violations += composite<Rounding::once>(d, s, witness_tolerance_, buffer_);
  }

 private:
  template <class D>
  HWY_INLINE void collect(D d, const FinishedSegments<D>& s) {
    SegmentLanes lanes;
    lanes.store(d, s.front, s.back, s.radiance, s.active);
    append(s.at, hn::Lanes(d), lanes);
  }

  HWY_NOINLINE void append(std::size_t at, std::size_t count, const SegmentLanes& lanes) {
    for (std::size_t k = 0; k < count; ++k)
      if (lanes.is_active(k))
        group_->segments.push_back({at + k, lanes.front(k), lanes.back(k), lanes.light(k)});
  }

  TileBuffer& buffer_;
  SegmentList* group_;
  OpenRuns* runs_;
  TileCounts& counts_;
  double witness_tolerance_;
};

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
