#include "hiac/render/integrate/isosurface_shading.hpp"

#include <algorithm>
#include <array>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hiac/render/integrate/isosurface_shading.cpp"
#include <hwy/foreach_target.h>
// must come after foreach_target.h
#include <hwy/highway.h>

#include "hiac/render/integrate/isosurface_shading-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A vector of points at once; lanes beyond the last point hold it again.
template <class D>
void shade_in_vectors(D d, const SurfaceLook& surface, std::span<const FrameLight> lights,
                      std::span<ShadedPoint> points) {
  using V = hn::Vec<decltype(d)>;
  constexpr std::size_t kMost = hn::MaxLanes(d);
  const std::size_t lanes = hn::Lanes(d);
  HWY_ALIGN std::array<std::array<double, kMost>, 3> normals, rays, colors;
  HWY_ALIGN std::array<std::array<double, kMost>, 4> seen;
  for (std::size_t first = 0; first < points.size(); first += lanes) {
    const auto some = points.subspan(first, std::min(lanes, points.size() - first));
    for (std::size_t k = 0; k < lanes; ++k) {
      const ShadedPoint& point = some[std::min(k, some.size() - 1)];
      for (std::size_t c = 0; c < 3; ++c) {
        normals[c][k] = point.normal[c];
        rays[c][k] = point.ray[c];
        colors[c][k] = point.color[c];
      }
    }
    const auto load = [&](const auto& v, std::size_t c) { return hn::Load(d, v[c].data()); };
    const V normal[3] = {load(normals, 0), load(normals, 1), load(normals, 2)};
    const V ray[3] = {load(rays, 0), load(rays, 1), load(rays, 2)};
    const V color[3] = {load(colors, 0), load(colors, 1), load(colors, 2)};
    const SurfaceShade<V> shaded = shade(d, surface, lights, color, normal, ray);
    for (std::size_t c = 0; c < 3; ++c) hn::Store(shaded.rgb[c], d, seen[c].data());
    hn::Store(shaded.transparency, d, seen[3].data());
    for (std::size_t k = 0; k < some.size(); ++k)
      some[k].shade = {{seen[0][k], seen[1][k], seen[2][k]}, seen[3][k]};
  }
}

void shade_all(const SurfaceLook& surface, std::span<const FrameLight> lights,
               std::span<ShadedPoint> points) {
  shade_in_vectors(hn::ScalableTag<double>(), surface, lights, points);
}

// No lanes are filled for nothing.
void shade_one(const SurfaceLook& surface, std::span<const FrameLight> lights, ShadedPoint& point) {
  shade_in_vectors(hn::CappedTag<double, 1>(), surface, lights, {&point, 1});
}

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hiac {

HWY_EXPORT(shade_all);
HWY_EXPORT(shade_one);

void shade_points(const SurfaceLook& surface, std::span<const FrameLight> lights,
                  std::span<ShadedPoint> points) {
  HWY_DYNAMIC_DISPATCH(shade_all)(surface, lights, points);
}

IsosurfaceShade shade_isosurface(const SurfaceLook& surface, std::span<const FrameLight> lights,
                                 const std::array<double, 3>& normal,
                                 const std::array<double, 3>& ray) {
  ShadedPoint point{normal, ray, surface.color, {}};
  HWY_DYNAMIC_DISPATCH(shade_one)(surface, lights, point);
  return point.shade;
}

}  // namespace hiac
#endif
