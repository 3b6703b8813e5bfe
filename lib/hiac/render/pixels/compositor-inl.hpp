// The compositor (compositor.hpp) of vectors of segments, compiled once for every instruction set.
// Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_COMPOSITOR_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_COMPOSITOR_INL
#    undef HIAC_RENDER_COMPOSITOR_INL
#  else
#    define HIAC_RENDER_COMPOSITOR_INL
#  endif

#  include <cstddef>
#  include <cstdint>

#  include <hwy/highway.h>

#  include "hiac/render/integrate/shading-inl.hpp"
#  include "hiac/render/pixels/compositor.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The number of active segments that are out of order.
template <class D, class V = hn::Vec<D>>
HWY_INLINE std::uint64_t count_out_of_order(D d, V front, V back, V last, hn::Mask<D> active,
                                            double tolerance) {
  const V least = hn::Set(d, tolerance);
  const auto early = hn::And(active, hn::Lt(front, hn::Sub(last, least)));
  if (HWY_LIKELY(hn::AllFalse(d, early))) return 0;
  return hn::CountTrue(d, hn::And(early, hn::Gt(hn::Sub(back, front), least)));
}

// A vector of segments, of neighbouring pixels: `at` is the index of the first pixel in the tile's
// planes. `radiance` is that between `front` and `back` (ray parameters); `behind` is the
// transparency of the pixels so far. Inactive lanes must hold finite light.
template <class D, class V = hn::Vec<D>>
struct FinishedSegments {
  std::size_t at;
  V front, back;
  const Radiance<V>& radiance;
  hn::Mask<D> active;
  V behind;
};

// Composites segments behind all that their pixels hold; returns how many are out of order.
template <Rounding kRounding, class D, class V = hn::Vec<D>>
HWY_INLINE std::uint64_t composite(D d, const FinishedSegments<D>& s, double tolerance,
                                   TileBuffer& buffer) {
  double* ends = buffer.last.data() + s.at;
  const V last = hn::LoadU(d, ends);
  const std::uint64_t violations =
      count_out_of_order(d, s.front, s.back, last, s.active, tolerance);
  hn::StoreU(hn::IfThenElse(s.active, hn::Max(last, s.back), last), d, ends);
  Radiance<V> sum{hn::LoadU(d, buffer.red.data() + s.at), hn::LoadU(d, buffer.green.data() + s.at),
                  hn::LoadU(d, buffer.blue.data() + s.at), s.behind};
  add_behind<kRounding>(s.radiance, s.active, sum);
  hn::StoreU(sum.red, d, buffer.red.data() + s.at);
  hn::StoreU(sum.green, d, buffer.green.data() + s.at);
  hn::StoreU(sum.blue, d, buffer.blue.data() + s.at);
  hn::StoreU(sum.transparency, d, buffer.transparency.data() + s.at);
  return violations;
}

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
