// The light of segments of many rays, compiled once for every instruction set.
// Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_SEGMENT_SHADER_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_SEGMENT_SHADER_INL
#    undef HIAC_RENDER_SEGMENT_SHADER_INL
#  else
#    define HIAC_RENDER_SEGMENT_SHADER_INL
#  endif

#  include <algorithm>
#  include <array>
#  include <cstddef>
#  include <cstdint>
#  include <limits>
#  include <utility>
#  include <vector>

#  include <hwy/highway.h>

#  include "hiac/frame/interval_range.hpp"
#  include "hiac/render/integrate/shading-inl.hpp"
#  include "hiac/render/walk/ray_bundle-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The entries of a transfer table for the interval of every ray.
template <std::size_t N>
struct RayTable {
  HWY_ALIGN RayNumbers anchor{};
  HWY_ALIGN std::array<RayNumbers, N> value{}, slope{};

  HWY_INLINE void take(std::size_t ray, const TransferTable<N>& table, std::size_t interval) {
    anchor[ray] = table.anchor[interval];
    for (std::size_t c = 0; c < N; ++c) {
      value[c][ray] = table.value[c][interval];
      slope[c][ray] = table.slope[c][interval];
    }
  }
};

// Reads the entries of consecutive rays.
struct RaysFrom {
  std::size_t first;

  template <class D>
  HWY_INLINE hn::Vec<D> operator()(D d, const RayNumbers& column) const {
    return hn::Load(d, column.data() + first);
  }
};

// Adds the segments of a bundle to its rays, cut at the breakpoints of the transfer functions. A
// segment begins with the field with which the one before it ends: each ray keeps the entries of
// the interval of its last piece, which are those of most segments.
template <class Rule>
class SegmentShader {
 public:
  SegmentShader(const OpticsTables& optics, RayBundle& rays) : optics_(optics), rays_(rays) {
    for (std::size_t k = 0; k < optics.extinction.intervals(); ++k)
      is_empty_.push_back(is_empty_space(optics, {k, k}, {k, k}));
    low_.fill(std::numeric_limits<double>::infinity());  // no interval yet
  }

  void shade() {
    const D d;
    for (std::size_t first = 0; first < kRays; first += hn::Lanes(d)) {
      const M followed = rays_.followed(first);
      if (!hn::AllFalse(d, followed)) shade(first, followed);
    }
  }

 private:
  using D = RayBundle::D;
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;
  static constexpr std::size_t kLanes = hn::MaxLanes(D());

  // The rays' part of OpticsTables.
  struct RayOptics {
    RayTable<3> color;
    RayTable<1> extinction;
  };

  // A segment that is cut: the field at its ends, the inverse of their difference, and which share
  // of the segment lies before the end of the piece.
  struct Whole {
    double front, back, inverse, length, passed;
    bool rises, goes_on;
  };

  HWY_INLINE void shade(std::size_t first, M followed) {
    const D d;
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, hn::And(followed, leaves_interval(first)), bits);
    const M is_empty = hn::Ne(hn::Load(d, empty_.data() + first), hn::Zero(d));
    if (HWY_LIKELY(bits[0] == 0)) {
      rays_.count(first, followed, is_empty);
      return add(first, hn::AndNot(is_empty, followed));
    }
    shade_cut(first, followed, bits[0]);
  }

  // Some segments begin or end in other intervals than the pieces before them.
  HWY_NOINLINE void shade_cut(std::size_t first, M now, unsigned leaving) {
    const D d;
    std::array<Whole, kLanes> whole{};
    unsigned cut = 0;
    for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane)
      if ((leaving >> lane & 1U) != 0 && cut_first(first + lane, whole[lane])) cut |= 1U << lane;
    const M is_empty = hn::Ne(hn::Load(d, empty_.data() + first), hn::Zero(d));
    rays_.count(first, now, is_empty);
    for (;;) {
      add(first, now);
      unsigned next = 0;
      for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane)
        if ((cut >> lane & 1U) != 0 && whole[lane].goes_on) {
          go_on(first + lane, whole[lane]);
          next |= 1U << lane;
        }
      if (next == 0) return;
      cut = next;
      now = mask_of(cut);
    }
  }

  static HWY_INLINE M mask_of(unsigned lanes) {
    const std::uint8_t bits[8] = {static_cast<std::uint8_t>(lanes)};
    return hn::LoadMaskBits(D(), bits);
  }

  // Whether segments do not lie in the intervals of the pieces before them. A breakpoint lies in
  // the interval above it, unless the field comes from below or goes there.
  HWY_INLINE M leaves_interval(std::size_t first) const {
    const D d;
    const V low = hn::Load(d, low_.data() + first);
    const V high = hn::Load(d, high_.data() + first);
    const V front = hn::Load(d, rays_.front_field.data() + first);
    const V back = hn::Load(d, rays_.back_field.data() + first);
    const V least = hn::Min(front, back), most = hn::Max(front, back);
    return hn::Not(hn::And(hn::Ge(least, low), hn::And(hn::Lt(least, high), hn::Le(most, high))));
  }

  // Makes the ray's piece its segment's first, if that is cut.
  HWY_INLINE bool cut_first(std::size_t ray, Whole& whole) {
    const double front = rays_.front_field[ray], back = rays_.back_field[ray];
    const double &low = low_[ray], &high = high_[ray];
    if (!(front >= low && front <= high)) find_interval(ray, front);
    const bool rises = back > high || (front >= high && back >= high);
    if (!rises && !(back < low)) return false;
    whole = {front, back, 1 / (back - front), rays_.length[ray], 0, rises, false};
    cut(ray, whole);
    return true;
  }

  // Makes the ray's piece end where it leaves its interval.
  HWY_INLINE void cut(std::size_t ray, Whole& whole) {
    const double begin = rays_.front_field[ray];
    const double exit = whole.rises ? high_[ray] : low_[ray];
    whole.goes_on = whole.rises ? whole.back > exit || begin >= exit : whole.back < exit;
    rays_.back_field[ray] = whole.goes_on ? exit : whole.back;
    // in this order, what is no number counts as where the piece begins
    const double at = std::max(whole.passed, (exit - whole.front) * whole.inverse);
    const double end = whole.goes_on ? std::min(at, 1.0) : 1.0;
    rays_.length[ray] = whole.length * (end - std::exchange(whole.passed, end));
  }

  HWY_INLINE void go_on(std::size_t ray, Whole& whole) {
    rays_.front_field[ray] = rays_.back_field[ray];
    enter_interval(ray, whole.rises ? interval_[ray] + 1 : interval_[ray] - 1);
    cut(ray, whole);
  }

  HWY_NOINLINE void find_interval(std::size_t ray, double field) {
    const std::vector<double>& upper = optics_.extinction.upper;
    const auto above = std::upper_bound(upper.begin(), upper.end() - 1, field);
    enter_interval(ray, static_cast<std::size_t>(above - upper.begin()));
  }

  HWY_INLINE void enter_interval(std::size_t ray, std::size_t interval) {
    interval_[ray] = interval;
    low_[ray] = optics_.extinction.lower[interval];
    high_[ray] = optics_.extinction.upper[interval];
    empty_[ray] = is_empty_[interval] ? 1 : 0;
    here_.color.take(ray, optics_.color, interval);
    here_.extinction.take(ray, optics_.extinction, interval);
  }

  // Adds the pieces of consecutive rays, those of a mask.
  HWY_INLINE void add(std::size_t first, M where) {
    const D d;
    if (hn::AllFalse(d, where)) return;
    const V front = hn::Load(d, rays_.front_field.data() + first);
    const V back = hn::Load(d, rays_.back_field.data() + first);
    const RaysFrom interval{first};
    const Radiance<V> light =
        piece_radiance<Rule>(d, here_, interval, interval, hn::Load(d, rays_.length.data() + first),
                             front, back, front, back);
    double* const planes[4] = {rays_.red.data() + first, rays_.green.data() + first,
                               rays_.blue.data() + first, rays_.transparency.data() + first};
    Radiance<V> sum{hn::Load(d, planes[0]), hn::Load(d, planes[1]), hn::Load(d, planes[2]),
                    hn::Load(d, planes[3])};
    add_behind(light, where, sum);
    hn::Store(sum.red, d, planes[0]);
    hn::Store(sum.green, d, planes[1]);
    hn::Store(sum.blue, d, planes[2]);
    hn::Store(sum.transparency, d, planes[3]);
  }

  const OpticsTables& optics_;
  RayBundle& rays_;
  std::vector<bool> is_empty_;  // of every interval: whether it is empty space
  // of every ray: the interval of its last piece, its bounds, and 1 if it is empty space
  std::array<std::size_t, kRays> interval_{};
  HWY_ALIGN RayNumbers low_{}, high_{}, empty_{};
  RayOptics here_;
};

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
