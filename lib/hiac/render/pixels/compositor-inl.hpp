// out_of_order (compositor.hpp) of vectors of segments, compiled once for every instruction set.
// Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_COMPOSITOR_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_COMPOSITOR_INL
#    undef HIAC_RENDER_COMPOSITOR_INL
#  else
#    define HIAC_RENDER_COMPOSITOR_INL
#  endif

#  include <cstdint>

#  include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// How many of the active segments are out of order.
template <class D, class V = hn::Vec<D>>
HWY_INLINE std::uint64_t count_out_of_order(D d, V front, V back, V last, hn::Mask<D> active,
                                            double tolerance) {
  const V least = hn::Set(d, tolerance);
  const auto early = hn::And(active, hn::Lt(front, hn::Sub(last, least)));
  if (HWY_LIKELY(hn::AllFalse(d, early))) return 0;
  return hn::CountTrue(d, hn::And(early, hn::Gt(hn::Sub(back, front), least)));
}

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
