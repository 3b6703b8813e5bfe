// Shading of isosurfaces by the formula of isosurface_shading.hpp, vectorized and compiled once for
// every instruction set. Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_ISOSURFACE_SHADING_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_ISOSURFACE_SHADING_INL
#    undef HIAC_RENDER_ISOSURFACE_SHADING_INL
#  else
#    define HIAC_RENDER_ISOSURFACE_SHADING_INL
#  endif

#  include <span>

#  include <hwy/contrib/math/math-inl.h>
#  include <hwy/highway.h>

#  include "hiac/frame/surfaces/isosurfaces.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class V>
struct SurfaceShade {
  V rgb[3];  // premultiplied
  V transparency;
};

template <class V>
HWY_INLINE V dot(const V (&a)[3], const V (&b)[3]) {
  return hn::MulAdd(a[0], b[0], hn::MulAdd(a[1], b[1], hn::Mul(a[2], b[2])));
}

// (R.V)^shininess where R.V > 0, else 0. Rounding may make the cosine larger than 1; the power is
// limited, because a huge exponent would amplify the excess.
template <class D, class V>
HWY_NOINLINE V highlight(D d, double shininess, V cosine) {
  const V smallest = hn::Set(d, 1e-300);
  const V power = hn::Min(hn::Mul(hn::Set(d, shininess), hn::Log(d, hn::Max(cosine, smallest))),
                          hn::Set(d, 0x1p-10));
  return hn::IfThenElseZero(hn::Gt(cosine, hn::Zero(d)), hn::Exp(d, power));
}

/// The shade of a surface of one look, seen in vectors of rays: of the colour `color`, in place of
/// the look's own.
template <class D, class V>
HWY_INLINE SurfaceShade<V> shade(D d, const SurfaceLook& surface,
                                 std::span<const FrameLight> lights, const V (&color)[3],
                                 const V (&normal)[3], const V (&ray)[3]) {
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0), two = hn::Set(d, 2.0);
  const V away = dot(normal, ray);
  const V facing = hn::Abs(away);  // N.V
  const V side = hn::CopySign(one, hn::Neg(away));
  SurfaceShade<V> result;
  for (std::size_t c = 0; c < 3; ++c)
    result.rgb[c] = hn::Mul(hn::Set(d, surface.ambient), color[c]);
  for (const FrameLight& light : lights) {
    V to_light = facing, towards_eye = one;  // N.L, L.V
    if (!light.headlight) {
      const V direction[3] = {hn::Set(d, light.direction[0]), hn::Set(d, light.direction[1]),
                              hn::Set(d, light.direction[2])};
      to_light = hn::Mul(side, dot(normal, direction));
      towards_eye = hn::Neg(dot(ray, direction));
    }
    const auto lit = hn::Gt(to_light, zero);
    const V diffuse = hn::Mul(hn::Set(d, surface.diffuse), to_light);
    V specular = zero;
    if (surface.specular > 0)
      specular = hn::Mul(
          hn::Set(d, surface.specular),
          highlight(d, surface.shininess, hn::MulSub(hn::Mul(two, to_light), facing, towards_eye)));
    for (std::size_t c = 0; c < 3; ++c) {
      const V reflected = hn::MulAdd(diffuse, color[c], specular);
      result.rgb[c] =
          hn::MulAdd(hn::IfThenElseZero(lit, reflected), hn::Set(d, light.color[c]), result.rgb[c]);
    }
  }
  // a surface of opacity 0 is transparent edge-on, too
  const V seen = hn::Max(facing, hn::Set(d, 1e-300));
  result.transparency = hn::Exp(d, hn::Div(hn::Set(d, surface.log_transparency), seen));
  const V opacity = hn::Sub(one, result.transparency);
  for (V& channel : result.rgb) channel = hn::Mul(channel, opacity);
  return result;
}

/// The same in the look's own colour.
template <class D, class V>
HWY_INLINE SurfaceShade<V> shade(D d, const SurfaceLook& surface,
                                 std::span<const FrameLight> lights, const V (&normal)[3],
                                 const V (&ray)[3]) {
  const V color[3] = {hn::Set(d, surface.color[0]), hn::Set(d, surface.color[1]),
                      hn::Set(d, surface.color[2])};
  return shade(d, surface, lights, color, normal, ray);
}

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
