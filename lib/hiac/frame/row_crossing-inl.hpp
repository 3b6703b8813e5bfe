// Where rows of pixel centres cross projected edges, many at a time, compiled once for every
// instruction set. Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_FRAME_ROW_CROSSING_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_FRAME_ROW_CROSSING_INL
#    undef HIAC_FRAME_ROW_CROSSING_INL
#  else
#    define HIAC_FRAME_ROW_CROSSING_INL
#  endif

#  include <hwy/highway.h>

#  include "hiac/frame/row_crossing.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// crossing_x of row_crossing.hpp in vectors; the operations are not fused either.
template <class V>
HWY_INLINE V crossing_x(V center, V x, V y, V slope) {
  return hn::Add(x, hn::Mul(hn::Sub(center, y), slope));
}

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
