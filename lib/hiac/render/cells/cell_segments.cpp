#include "hiac/render/cells/cell_segments.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hiac/render/cells/cell_segments.cpp"
#include <hwy/foreach_target.h>
// must come after foreach_target.h
#include <hwy/highway.h>

#include "hiac/render/pixels/compositor-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, 8>;
using V = hn::Vec<D>;

// One run. Stores whole vectors, of which the next ones overwrite what does not count.
HWY_INLINE void collect_run(const Frame& frame, const CrossingRuns::Run& run,
                            const CrossingRuns& runs, std::size_t at, const TileBuffer& buffer,
                            double allowed, bool by_visibility, CellSegments& s) {
  const D d;
  const V near = hn::Set(d, frame.projector.near()), far = hn::Set(d, frame.projector.far());
  const V least = hn::Set(d, frame.least_transparency), one = hn::Set(d, 1.0);
  const V centre = hn::Set(d, run.y + 0.5), unit = hn::Set(d, allowed);
  for (std::size_t i = 0; i < run.count; i += hn::Lanes(d)) {
    const V front = hn::Max(hn::LoadU(d, runs.front.data() + run.first + i), near);
    const V back = hn::Min(hn::LoadU(d, runs.back.data() + run.first + i), far);
    const V seen = hn::LoadU(d, buffer.transparency.data() + at + i);
    const V depth = hn::Sub(back, front);
    const std::size_t pixels = std::min(run.count - i, hn::Lanes(d));
    const auto kept =
        hn::And(hn::FirstN(d, pixels), hn::And(hn::Gt(seen, least), hn::Lt(front, back)));
    const std::size_t k = s.count;
    const auto keep = [&](V value, std::vector<double>& plane)
                          HWY_ATTR { hn::CompressBlendedStore(value, kept, d, plane.data() + k); };
    const std::size_t more = hn::CountTrue(d, kept);
    if (more == 0) continue;
    const V x = hn::Iota(d, run.x + 0.5 + static_cast<double>(i));
    const V length = hn::Mul(depth, hn::LoadU(d, buffer.ray_scale.data() + at + i));
    const V error = hn::Div(hn::Mul(unit, depth), by_visibility ? seen : one);
    if (more == pixels) {
      const auto store = [&](V value, std::vector<double>& plane)
                             HWY_ATTR { hn::StoreU(value, d, plane.data() + k); };
      store(x, s.x), store(centre, s.y), store(front, s.front), store(back, s.back);
      store(length, s.length), store(error, s.allowed);
      for (std::size_t j = 0; j < more; ++j) s.at[k + j] = static_cast<std::uint32_t>(at + i + j);
    } else {
      keep(x, s.x), keep(centre, s.y), keep(front, s.front), keep(back, s.back);
      keep(length, s.length), keep(error, s.allowed);
      for (std::size_t j = k; j < k + more; ++j)
        s.at[j] = static_cast<std::uint32_t>(at + static_cast<std::size_t>(s.x[j]) -
                                             static_cast<std::size_t>(run.x));
    }
    s.count += more;
  }
}

void collect_runs_here(const Frame& frame, const CrossingRuns& runs, const TileRect& tile,
                       const TileBuffer& buffer, double allowed, bool by_visibility,
                       CellSegments& segments) {
  for (const CrossingRuns::Run& run : runs.runs) {
    const std::size_t at = static_cast<std::size_t>(run.y - tile.y0) * kTileStride +
                           static_cast<std::size_t>(run.x - tile.x0);
    collect_run(frame, run, runs, at, buffer, allowed, by_visibility, segments);
  }
}

// The segments from k on that are one vector's, or one.
template <class D1>
HWY_INLINE std::uint64_t composite_from(D1 d, const Frame& frame, const CellSegments& s,
                                        std::size_t k, TileBuffer& buffer) {
  const std::size_t at = s.at[k];
  const auto load = [&](const std::vector<double>& plane)
                        HWY_ATTR { return hn::LoadU(d, plane.data() + k); };
  const auto front = load(s.front), back = load(s.back);
  const auto last = hn::LoadU(d, buffer.last.data() + at);
  const std::uint64_t violations = count_out_of_order(
      d, front, back, last, hn::FirstN(d, hn::Lanes(d)), frame.witness_tolerance);
  hn::StoreU(hn::Max(last, back), d, buffer.last.data() + at);
  const auto seen = hn::LoadU(d, buffer.transparency.data() + at);
  // not fused, as it is not where segments are composited one by one
  const auto add = [&](const std::vector<double>& light, TileBuffer::Plane& plane) HWY_ATTR {
    double* to = plane.data() + at;
    hn::StoreU(hn::Add(hn::LoadU(d, to), hn::Mul(seen, load(light))), d, to);
  };
  add(s.red, buffer.red);
  add(s.green, buffer.green);
  add(s.blue, buffer.blue);
  hn::StoreU(hn::Mul(seen, load(s.transparency)), d, buffer.transparency.data() + at);
  return violations;
}

std::uint64_t composite_here(const Frame& frame, const CellSegments& s, std::size_t count,
                             TileBuffer& buffer) {
  const D d;
  const std::size_t lanes = hn::Lanes(d);
  // pixels of a row follow one another; between rows planes have slack
  const auto together = [&](std::size_t k) {
    return k + lanes <= count && s.at[k + lanes - 1] - s.at[k] == lanes - 1 &&
           std::all_of(s.done.data() + k, s.done.data() + k + lanes,
                       [](std::uint8_t done) { return done != 0; });
  };
  std::uint64_t violations = 0;
  for (std::size_t k = 0; k < count;) {
    if (together(k)) {
      violations += composite_from(d, frame, s, k, buffer);
      k += lanes;
      continue;
    }
    if (s.done[k] != 0)
      violations += composite_from(hn::CappedTag<double, 1>(), frame, s, k, buffer);
    ++k;
  }
  return violations;
}

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hiac {

HWY_EXPORT(collect_runs_here);
HWY_EXPORT(composite_here);

void CellSegments::start(std::size_t most, bool with_known) {
  count = 0;
  known = with_known;
  const std::size_t places = most + kPadding;
  if (done.size() < places) {
    for (std::vector<double>* plane :
         {&x, &y, &front, &back, &length, &allowed, &red, &green, &blue, &transparency})
      plane->resize(places);
    at.resize(places);
    done.resize(places);
  }
  if (known && known_u.size() < places)
    for (std::vector<double>* plane : {&known_u, &known_v, &known_w}) plane->resize(places);
}

void CellSegments::pad() {
  const auto last = static_cast<std::ptrdiff_t>(count) - 1;
  const auto repeat = [&](std::vector<double>& plane) {
    std::fill_n(plane.begin() + last + 1, kPadding, plane[count - 1]);
  };
  for (std::vector<double>* plane : {&x, &y, &front, &back, &allowed}) repeat(*plane);
  if (known)
    for (std::vector<double>* plane : {&known_u, &known_v, &known_w}) repeat(*plane);
  std::fill_n(length.begin() + last + 1, kPadding, 0.0);
}

void collect_runs(const Frame& frame, const CrossingRuns& runs, const TileRect& tile,
                  const TileBuffer& buffer, double allowed, bool by_visibility,
                  CellSegments& segments) {
  HWY_DYNAMIC_DISPATCH(collect_runs_here)
  (frame, runs, tile, buffer, allowed, by_visibility, segments);
}

std::uint64_t composite_segments(const Frame& frame, const CellSegments& segments,
                                 std::size_t count, TileBuffer& buffer) {
  return HWY_DYNAMIC_DISPATCH(composite_here)(frame, segments, count, buffer);
}

}  // namespace hiac
#endif
