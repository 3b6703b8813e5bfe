// How fast a width changes along rays, in every lane, compiled once for every instruction set.
// Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_TAPER_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_TAPER_INL
#    undef HIAC_RENDER_TAPER_INL
#  else
#    define HIAC_RENDER_TAPER_INL
#  endif

#  include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A width that is linear along a part of a ray, at both ends; not negative.
template <class V>
struct EndWidths {
  V front, back;
};

// The taper of a part of a ray: along it, z from -1 to 1, the width is proportional to 1 + h z;
// r = h / (1 + sqrt(1 - h^2)).
template <class D, class V = hn::Vec<D>>
struct Taper {
  V r, h;
  V inverse_gap;  // 1 / (1 - |h|)
  V g;            // (1 + r^2) / (1 - r^2)

  // With the widths a and b: h = (b - a) / (a + b), r = (b - a) / (a + b + 2 sqrt(a b)),
  // 1 - |h| = 2 min(a, b) / (a + b), g = (a + b) / (2 sqrt(a b)). Inactive lanes get no taper, and
  // a width of 0 is replaced by a tiny one.
  Taper(D d, const EndWidths<V>& widths, hn::Mask<D> active) {
    const V one = hn::Set(d, 1.0), tiny = hn::Set(d, 1e-60);
    const V a = hn::IfThenElse(active, hn::Max(widths.front, tiny), one);
    const V b = hn::IfThenElse(active, hn::Max(widths.back, tiny), one);
    const V sum = hn::Add(a, b), between = hn::Sqrt(hn::Mul(a, b)), least = hn::Min(a, b);
    const V wide = hn::Add(sum, hn::Add(between, between)), narrow = hn::Mul(between, least);
    // one division for all
    const V inverse = hn::Div(one, hn::Mul(hn::Mul(sum, wide), narrow));
    const V over_ends = hn::Mul(inverse, narrow), change = hn::Sub(b, a);
    r = hn::Mul(hn::Mul(over_ends, sum), change);
    h = hn::Mul(hn::Mul(over_ends, wide), change);
    const V half = hn::Mul(hn::Mul(hn::Mul(inverse, wide), hn::Mul(sum, sum)), hn::Set(d, 0.5));
    inverse_gap = hn::Mul(half, between);
    g = hn::Mul(half, least);
  }
};

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
