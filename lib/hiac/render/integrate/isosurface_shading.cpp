#include "hiac/render/integrate/isosurface_shading.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hiac/render/integrate/isosurface_shading.cpp"
#include <hwy/foreach_target.h>
// must come after foreach_target.h
#include <hwy/highway.h>

#include "hiac/render/integrate/isosurface_shading-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

IsosurfaceShade shade_one(const SurfaceLook& surface, std::span<const FrameLight> lights,
                          const std::array<double, 3>& normal, const std::array<double, 3>& ray) {
  const hn::CappedTag<double, 1> d;
  using V = hn::Vec<decltype(d)>;
  const V n[3] = {hn::Set(d, normal[0]), hn::Set(d, normal[1]), hn::Set(d, normal[2])};
  const V r[3] = {hn::Set(d, ray[0]), hn::Set(d, ray[1]), hn::Set(d, ray[2])};
  const SurfaceShade<V> shaded = shade(d, surface, lights, n, r);
  return {{hn::GetLane(shaded.rgb[0]), hn::GetLane(shaded.rgb[1]), hn::GetLane(shaded.rgb[2])},
          hn::GetLane(shaded.transparency)};
}

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hiac {

HWY_EXPORT(shade_one);

IsosurfaceShade shade_isosurface(const SurfaceLook& surface, std::span<const FrameLight> lights,
                                 const std::array<double, 3>& normal,
                                 const std::array<double, 3>& ray) {
  return HWY_DYNAMIC_DISPATCH(shade_one)(surface, lights, normal, ray);
}

}  // namespace hiac
#endif
