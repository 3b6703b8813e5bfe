// Adds vectors of segments to runs (open_runs.hpp), compiled once for every instruction set.
// Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_OPEN_RUNS_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_OPEN_RUNS_INL
#    undef HIAC_RENDER_OPEN_RUNS_INL
#  else
#    define HIAC_RENDER_OPEN_RUNS_INL
#  endif

#  include <cstddef>
#  include <cstdint>

#  include <hwy/highway.h>

#  include "hiac/render/pixels/compositor-inl.hpp"
#  include "hiac/render/pixels/open_runs.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Opens runs in the lanes of a mask, and closes those before. Returns how many segments there are
// out of order.
template <class D, class V = hn::Vec<D>>
HWY_NOINLINE std::uint64_t open_runs(D d, std::size_t at, V front, V back, hn::Mask<D> opened,
                                     double tolerance, OpenRuns& runs, TileBuffer& buffer) {
  const V before = hn::LoadU(d, runs.front.data() + at);
  const auto ended = hn::And(opened, hn::Ne(before, hn::Set(d, OpenRuns::kNone)));
  if (!hn::AllFalse(d, ended)) {
    std::uint8_t bits[8] =
        {};  // StoreMaskBits writes 8 bytes at most, and no vector has more lanes
    hn::StoreMaskBits(d, ended, bits);
    for (std::size_t k = 0; k < hn::Lanes(d); ++k)
      if ((bits[0] >> k & 1) != 0) runs.close(at + k, buffer);
  }
  const auto set = [&](V value, OpenRuns::Plane& plane) HWY_ATTR {
    double* to = plane.data() + at;
    hn::StoreU(hn::IfThenElse(opened, value, hn::LoadU(d, to)), d, to);
  };
  set(front, runs.front);
  set(hn::Zero(d), runs.red);
  set(hn::Zero(d), runs.green);
  set(hn::Zero(d), runs.blue);
  set(hn::Set(d, 1.0), runs.transparency);
  return count_out_of_order(d, front, back, hn::LoadU(d, buffer.last.data() + at), opened,
                            tolerance);
}

// Adds segments to the runs of their pixels; returns how many are out of order.
template <class D, class V = hn::Vec<D>>
HWY_INLINE std::uint64_t add_to_runs(D d, const FinishedSegments<D>& s, double tolerance,
                                     OpenRuns& runs, TileBuffer& buffer) {
  double* ends = runs.back.data() + s.at;
  const V last = hn::LoadU(d, ends);
  const auto opened = hn::AndNot(hn::Eq(s.front, last), s.active);
  std::uint64_t violations = 0;
  if (HWY_UNLIKELY(!hn::AllFalse(d, opened)))
    violations = open_runs(d, s.at, s.front, s.back, opened, tolerance, runs, buffer);
  hn::StoreU(hn::IfThenElse(s.active, s.back, last), d, ends);
  Radiance<V> sum{hn::LoadU(d, runs.red.data() + s.at), hn::LoadU(d, runs.green.data() + s.at),
                  hn::LoadU(d, runs.blue.data() + s.at),
                  hn::LoadU(d, runs.transparency.data() + s.at)};
  add_behind<Rounding::twice>(s.radiance, s.active, sum);
  hn::StoreU(sum.red, d, runs.red.data() + s.at);
  hn::StoreU(sum.green, d, runs.green.data() + s.at);
  hn::StoreU(sum.blue, d, runs.blue.data() + s.at);
  hn::StoreU(sum.transparency, d, runs.transparency.data() + s.at);
  const V all = hn::Mul(hn::LoadU(d, runs.before.data() + s.at), sum.transparency);
  hn::StoreU(hn::IfThenElse(s.active, all, s.behind), d, buffer.transparency.data() + s.at);
  return violations;
}

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
