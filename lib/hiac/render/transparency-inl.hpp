// exp(-a) for optical depths, compiled once for every instruction set.
// Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_TRANSPARENCY_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_TRANSPARENCY_INL
#    undef HIAC_RENDER_TRANSPARENCY_INL
#  else
#    define HIAC_RENDER_TRANSPARENCY_INL
#  endif

#  include <hwy/contrib/math/math-inl.h>
#  include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Optical depths below this are thin.
inline constexpr double kThin = 0.1;

// exp(-a). Mostly a is small; what is left out of the series is at most kThin^9 / 9! = 3e-15.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V transparency(D d, V a, bool thin) {
  if (HWY_UNLIKELY(!thin)) return hn::Exp(d, hn::Neg(a));
  V sum = hn::Set(d, 1.0 / 40320);
  for (const double c : {-1.0 / 5040, 1.0 / 720, -1.0 / 120, 1.0 / 24, -1.0 / 6, 0.5, -1.0, 1.0})
    sum = hn::MulAdd(sum, a, hn::Set(d, c));
  return sum;
}

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
