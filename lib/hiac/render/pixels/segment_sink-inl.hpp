// Where the segments of a kernel go, compiled once for every instruction set.
// Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_SEGMENT_SINK_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_SEGMENT_SINK_INL
#    undef HIAC_RENDER_SEGMENT_SINK_INL
#  else
#    define HIAC_RENDER_SEGMENT_SINK_INL
#  endif

#  include <cstddef>
#  include <cstdint>

#  include <hwy/highway.h>

#  include "hiac/frame/frame.hpp"
#  include "hiac/render/integrate/shading-inl.hpp"
#  include "hiac/render/pixels/compositor-inl.hpp"
#  include "hiac/render/pixels/tile.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A vector of segments, of neighbouring pixels: `at` is the first's index into the tile's planes.
// What lies between `front` and `back` (ray parameters) is `radiance`; `behind` is the
// transparency of the pixels so far.
template <class D, class V = hn::Vec<D>>
struct FinishedSegments {
  std::size_t at;
  V front, back;
  const Radiance<V>& radiance;
  hn::Mask<D> active;
  V behind;
};

// Segments are composited over a tile's pixels, or join the list of a group whose order is yet to
// be found.
class SegmentSink {
 public:
  SegmentSink(const Frame& frame, TileBuffer& buffer, SegmentList* group, TileCounts& counts)
      : buffer_(buffer),
        group_(group),
        counts_(counts),
        witness_tolerance_(frame.witness_tolerance) {}

  template <class D>
  HWY_INLINE void add(D d, const FinishedSegments<D>& s) {
    if (group_ != nullptr)
      collect(d, s);
    else
      composite(d, s);
  }

 private:
  template <class D, class V = hn::Vec<D>>
  HWY_INLINE void composite(D d, const FinishedSegments<D>& s) {
    double* ends = buffer_.last.data() + s.at;
    const V last = hn::LoadU(d, ends);
    counts_.violations +=
        count_out_of_order(d, s.front, s.back, last, s.active, witness_tolerance_);
    hn::StoreU(hn::IfThenElse(s.active, hn::Max(last, s.back), last), d, ends);
    // lanes that are not active have segments of no length: their light is finite
    Radiance<V> sum{hn::LoadU(d, buffer_.red.data() + s.at),
                    hn::LoadU(d, buffer_.green.data() + s.at),
                    hn::LoadU(d, buffer_.blue.data() + s.at), s.behind};
    add_behind(s.radiance, s.active, sum);
    hn::StoreU(sum.red, d, buffer_.red.data() + s.at);
    hn::StoreU(sum.green, d, buffer_.green.data() + s.at);
    hn::StoreU(sum.blue, d, buffer_.blue.data() + s.at);
    hn::StoreU(sum.transparency, d, buffer_.transparency.data() + s.at);
  }

  template <class D, class V = hn::Vec<D>>
  HWY_INLINE void collect(D d, const FinishedSegments<D>& s) {
    const V all[kCount] = {s.front,
                           s.back,
                           s.radiance.red,
                           s.radiance.green,
                           s.radiance.blue,
                           s.radiance.transparency,
                           hn::IfThenElseZero(s.active, hn::Set(d, 1.0))};
    HWY_ALIGN double lane[kCount][8];
    for (std::size_t q = 0; q < kCount; ++q) hn::Store(all[q], d, lane[q]);
    append(s.at, hn::Lanes(d), lane);
  }

  enum : std::size_t { kFront, kBack, kRed, kGreen, kBlue, kZeta, kActive, kCount };

  HWY_NOINLINE void append(std::size_t at, std::size_t lanes, const double (&lane)[kCount][8]) {
    for (std::size_t k = 0; k < lanes; ++k)
      if (lane[kActive][k] != 0)
        group_->append(static_cast<std::uint32_t>(at + k), lane[kFront][k], lane[kBack][k],
                       lane[kRed][k], lane[kGreen][k], lane[kBlue][k], lane[kZeta][k]);
  }

  TileBuffer& buffer_;
  SegmentList* group_;
  TileCounts& counts_;
  double witness_tolerance_;
};

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
