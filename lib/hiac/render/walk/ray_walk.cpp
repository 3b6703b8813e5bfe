#include "hiac/render/walk/ray_walk.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hiac/render/walk/ray_walk.cpp"
#include <hwy/foreach_target.h>
// must come after foreach_target.h
#include <hwy/highway.h>

#include "hiac/render/integrate/shading-inl.hpp"
#include "hiac/render/pixels/compositor-inl.hpp"
#include "hiac/render/walk/ray_bundle-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Adds the segments of a bundle to its rays. Segments that lie in one interval of the transfer
// functions are shaded together with others in that interval, whatever their cells.
template <class Rule>
class SegmentShader {
 public:
  SegmentShader(const OpticsTables& optics, RayBundle& rays)
      : optics_(optics), rays_(rays), last_in_(optics.extinction.intervals(), kNobody) {}

  void shade() {
    crossing_count_ = 0;
    for (std::size_t ray = 0; ray < kRays; ++ray)
      if (rays_.is_followed(ray)) sort(static_cast<std::uint8_t>(ray));
    for (const std::size_t interval : intervals_) shade_within(interval);
    intervals_.clear();
    for (std::size_t first = 0; first < crossing_count_; first += hn::Lanes(D()))
      shade_across(first, std::min(crossing_count_, first + hn::Lanes(D())));
  }

 private:
  using D = hn::CappedTag<double, 8>;
  using V = hn::Vec<D>;
  static constexpr std::uint8_t kNobody = 255;
  static_assert(kRays < kNobody);

  // Finds the intervals of a ray's segment, from those of its last one on.
  HWY_INLINE void sort(std::uint8_t ray) {
    const std::vector<double>& upper = optics_.extinction.upper;
    const auto [least, most] = std::minmax(rays_.front_field[ray], rays_.back_field[ray]);
    std::size_t low = interval_[ray];
    while (low + 1 < upper.size() && upper[low] <= least) ++low;
    while (low > 0 && upper[low - 1] > least) --low;
    interval_[ray] = low;
    const bool crosses = most > upper[low];
    const bool is_empty = !crosses && is_empty_space(optics_, {low, low}, {low, low});
    rays_.count(ray, is_empty);
    if (is_empty) return;
    if (crosses) {
      crossing_[crossing_count_++] = ray;
      return;
    }
    if (last_in_[low] == kNobody) intervals_.push_back(low);
    before_[ray] = std::exchange(last_in_[low], ray);
  }

  // Some rays as a vector, one at least; lanes beyond them repeat the last with no length. Nothing
  // is set in advance, as that takes longer than all else.
  struct Pack {
    std::uint8_t ray[hn::MaxLanes(D())];
    std::size_t count;
    HWY_ALIGN double length[hn::MaxLanes(D())], front[hn::MaxLanes(D())], back[hn::MaxLanes(D())];
  };

  HWY_INLINE void put(std::uint8_t ray, std::size_t lane, Pack& pack) const {
    pack.ray[lane] = ray;
    pack.length[lane] = rays_.length[ray];
    pack.front[lane] = rays_.front_field[ray];
    pack.back[lane] = rays_.back_field[ray];
  }

  HWY_INLINE void fill(std::uint8_t last, std::size_t count, Pack& pack) const {
    pack.count = count;
    for (std::size_t lane = count; lane < hn::Lanes(D()); ++lane) {
      put(last, lane, pack);
      pack.length[lane] = 0;
    }
  }

  HWY_INLINE void composite(const Pack& pack, const Radiance<V>& light) {
    const D d;
    HWY_ALIGN double sum[4][hn::MaxLanes(D())];
    double* const planes[4] = {rays_.red.data(), rays_.green.data(), rays_.blue.data(),
                               rays_.transparency.data()};
    for (std::size_t n = 0; n < hn::Lanes(d); ++n)
      for (std::size_t c = 0; c < 4; ++c) sum[c][n] = planes[c][pack.ray[n]];
    Radiance<V> all{hn::Load(d, sum[0]), hn::Load(d, sum[1]), hn::Load(d, sum[2]),
                    hn::Load(d, sum[3])};
    add_behind(light, hn::FirstN(d, pack.count), all);
    hn::Store(all.red, d, sum[0]);
    hn::Store(all.green, d, sum[1]);
    hn::Store(all.blue, d, sum[2]);
    hn::Store(all.transparency, d, sum[3]);
    for (std::size_t n = 0; n < hn::Lanes(d); ++n) {
      if (n == pack.count) break;
      for (std::size_t c = 0; c < 4; ++c) planes[c][pack.ray[n]] = sum[c][n];
    }
  }

  HWY_NOINLINE void shade_within(std::size_t interval) {
    const D d;
    std::uint8_t ray = std::exchange(last_in_[interval], kNobody);
    while (ray != kNobody) {
      Pack pack;
      std::uint8_t last = ray;
      std::size_t count = 0;
      for (; ray != kNobody && count < hn::Lanes(d); ray = before_[ray])
        put(last = ray, count++, pack);
      fill(last, count, pack);
      const V front = hn::Load(d, pack.front), back = hn::Load(d, pack.back);
      composite(pack, uniform_radiance<Rule>(d, optics_, interval, interval,
                                             hn::Load(d, pack.length), front, back, front, back));
    }
  }

  HWY_NOINLINE void shade_across(std::size_t first, std::size_t last) {
    const D d;
    const std::vector<double>& upper = optics_.extinction.upper;
    Pack pack;
    std::size_t count = 0;
    IntervalRange range{~std::size_t{0}, 0};
    for (std::size_t n = first; n < last; ++n) {
      const std::uint8_t ray = crossing_[n];
      put(ray, count++, pack);
      const double most = std::max(rays_.front_field[ray], rays_.back_field[ray]);
      std::size_t high = interval_[ray];
      while (high + 1 < upper.size() && upper[high] < most) ++high;
      range.low = std::min(range.low, interval_[ray]);
      range.high = std::max(range.high, high);
    }
    fill(crossing_[last - 1], count, pack);
    composite(pack, sliced_radiance<Rule>(d, optics_, range, hn::Load(d, pack.length),
                                          hn::Load(d, pack.front), hn::Load(d, pack.back),
                                          hn::FirstN(d, pack.count)));
  }

  const OpticsTables& optics_;
  RayBundle& rays_;
  std::array<std::size_t, kRays> interval_{};  // of the smaller end of the ray's last segment
  std::array<std::uint8_t, kRays> crossing_;   // rays whose segments pass breakpoints
  std::size_t crossing_count_ = 0;
  // rays by interval, as lists
  std::vector<std::uint8_t> last_in_;
  std::array<std::uint8_t, kRays> before_;
  std::vector<std::size_t> intervals_;  // that have rays
};

template <class Rule>
HWY_NOINLINE void follow_by(const RayScene& scene, const RayStarts& starts, const TileTarget& to,
                            TileEdges& edges) {
  RayBundle rays(scene, starts, to, edges);
  SegmentShader<Rule> shader(scene.frame.optics, rays);
  while (rays.advance()) {
    shader.shade();
    rays.settle();
  }
}

void follow_rays_here(const RayScene& scene, const RayStarts& starts, const TileTarget& to,
                      TileEdges& edges) {
  if (scene.frame.optics.emission)
    follow_by<ExactEmission>(scene, starts, to, edges);
  else
    follow_by<ExactChromaticity>(scene, starts, to, edges);
}

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hiac {

HWY_EXPORT(follow_rays_here);

void follow_rays(const RayScene& scene, const RayStarts& starts, const TileTarget& to,
                 TileEdges& edges) {
  HWY_DYNAMIC_DISPATCH(follow_rays_here)(scene, starts, to, edges);
}

}  // namespace hiac
#endif
