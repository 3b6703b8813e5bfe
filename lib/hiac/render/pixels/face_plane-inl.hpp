// Affine functions on faces over the screen, compiled once for every instruction set.
// Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_FACE_PLANE_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_FACE_PLANE_INL
#    undef HIAC_RENDER_FACE_PLANE_INL
#  else
#    define HIAC_RENDER_FACE_PLANE_INL
#  endif

#  include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The barycentric coordinates of the points of triangular faces over the screen, one face a lane.
// With dx and dy from a face's first corner to the point,
//     lambda_s = cx dx + cy dy,   lambda_m = gx dx + gy dy - h lambda_s:
// Gaussian elimination with complete pivoting. The point that they describe is off (x, y) by
// rounding of the coordinates alone, however thin the projected face. A quantity q is then
// q0 + lambda_m qm + lambda_s qs.
template <class D, class V = hn::Vec<D>>
struct FacePlane {
  V cx, cy, gx, gy, h;
  hn::Mask<D> swapped;  // is_second_longer: m is the second edge, s the first one
};

// Whether the second of two edges has the largest coordinate: the column pivot.
template <class V>
HWY_INLINE auto is_second_longer(V x1, V y1, V x2, V y2) {
  return hn::Lt(hn::Max(hn::Abs(x1), hn::Abs(y1)), hn::Max(hn::Abs(x2), hn::Abs(y2)));
}

// `x1` to `y2`: the edges from the first corner to the second and the third.
template <class D, class V = hn::Vec<D>>
HWY_INLINE FacePlane<D> face_plane(D d, V x1, V y1, V x2, V y2) {
  const V one = hn::Set(d, 1.0), zero = hn::Zero(d);
  const auto swapped = is_second_longer(x1, y1, x2, y2);
  // edge m has the largest entry, s is the other
  const V mx = hn::IfThenElse(swapped, x2, x1), my = hn::IfThenElse(swapped, y2, y1);
  const V sx = hn::IfThenElse(swapped, x1, x2), sy = hn::IfThenElse(swapped, y1, y2);
  // row pivot: p is the coordinate of the largest entry, q the other
  const auto y_pivot = hn::Lt(hn::Abs(mx), hn::Abs(my));
  const V mp = hn::IfThenElse(y_pivot, my, mx), mq = hn::IfThenElse(y_pivot, mx, my);
  const V sp = hn::IfThenElse(y_pivot, sy, sx), sq = hn::IfThenElse(y_pivot, sx, sy);
  const V inverse_mp = hn::Div(one, mp);
  const V l = hn::Mul(mq, inverse_mp);
  const V inverse_u = hn::Div(one, hn::NegMulAdd(l, sp, sq));
  const V cp = hn::Neg(hn::Mul(l, inverse_u));
  return {hn::IfThenElse(y_pivot, inverse_u, cp),
          hn::IfThenElse(y_pivot, cp, inverse_u),
          hn::IfThenElse(y_pivot, zero, inverse_mp),
          hn::IfThenElse(y_pivot, inverse_mp, zero),
          hn::Mul(sp, inverse_mp),
          swapped};
}

// The barycentric coordinates of points of a row on one face.
template <class V>
struct FacePlace {
  V m, s;
};

// The quantities that the points of a row share on one face.
struct FaceLine {
  double base_x, cx, gx, h, cy_dy, gy_dy;
};

template <class D, class V = hn::Vec<D>>
HWY_INLINE FacePlace<V> place_on_face(D d, const FaceLine& line, V x) {
  const V dx = hn::Sub(x, hn::Set(d, line.base_x));
  const V s = hn::MulAdd(dx, hn::Set(d, line.cx), hn::Set(d, line.cy_dy));
  const V m = hn::NegMulAdd(hn::Set(d, line.h), s,
                            hn::MulAdd(dx, hn::Set(d, line.gx), hn::Set(d, line.gy_dy)));
  return {m, s};
}

// The value of a quantity at these points.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V on_face(D d, double q0, double qm, double qs, const FacePlace<V>& at) {
  return hn::MulAdd(at.s, hn::Set(d, qs), hn::MulAdd(at.m, hn::Set(d, qm), hn::Set(d, q0)));
}

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
