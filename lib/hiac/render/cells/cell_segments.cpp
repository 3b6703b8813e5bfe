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

// Collects one run. Stores whole vectors; each store overwrites the unused lanes of the previous
// one.
HWY_INLINE void collect_run(const TileTarget& to, const CrossingRuns::Run& run,
                            const CrossingRuns& runs, double allowed, CellSegments& s) {
  const D d;
  const Frame& frame = to.frame;
  const TileBuffer& buffer = to.buffer;
  const std::size_t at = to.tile.index(run.x, run.y);
  const V near = hn::Set(d, frame.projector.near()), far = hn::Set(d, frame.projector.far());
  const V least = hn::Set(d, frame.least_transparency), one = hn::Set(d, 1.0);
  const V centre = hn::Set(d, pixel_center(run.y)), unit = hn::Set(d, allowed);
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
    const V x = hn::Iota(d, pixel_center(run.x) + static_cast<double>(i));
    const V length = hn::Mul(depth, hn::LoadU(d, buffer.ray_scale.data() + at + i));
    const V error = hn::Div(hn::Mul(unit, depth), to.group == nullptr ? seen : one);
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

void collect_runs_here(const TileTarget& to, const CrossingRuns& runs, double allowed,
                       CellSegments& segments) {
  for (const CrossingRuns::Run& run : runs.runs) collect_run(to, run, runs, allowed, segments);
}

// Composites the segments from k on that fill one vector of the tag's width, which may be 1.
template <class D1>
HWY_INLINE std::uint64_t composite_from(D1 d, const Frame& frame, const CellSegments& s,
                                        std::size_t k, TileBuffer& buffer) {
  const std::size_t at = s.at[k];
  const auto load = [&](const std::vector<double>& plane)
                        HWY_ATTR { return hn::LoadU(d, plane.data() + k); };
  const Radiance<hn::Vec<D1>> light{load(s.red), load(s.green), load(s.blue), load(s.transparency)};
  return composite<Rounding::twice>(
      d,
      {at, load(s.front), load(s.back), light, hn::FirstN(d, hn::Lanes(d)),
       hn::LoadU(d, buffer.transparency.data() + at)},
      frame.witness_tolerance, buffer);
}

std::uint64_t composite_here(const Frame& frame, const CellSegments& s, std::size_t count,
                             TileBuffer& buffer) {
  const D d;
  const std::size_t lanes = hn::Lanes(d);
  // the pixels of a row are consecutive; between rows the planes have padding
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

void collect_runs(const TileTarget& to, const CrossingRuns& runs, double allowed,
                  CellSegments& segments) {
  HWY_DYNAMIC_DISPATCH(collect_runs_here)(to, runs, allowed, segments);
}

std::uint64_t composite_segments(const Frame& frame, const CellSegments& segments,
                                 std::size_t count, TileBuffer& buffer) {
  return HWY_DYNAMIC_DISPATCH(composite_here)(frame, segments, count, buffer);
}

}  // namespace hiac
#endif
