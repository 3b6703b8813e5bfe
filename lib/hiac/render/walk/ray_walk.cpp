#include "hiac/render/walk/ray_walk.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hiac/render/walk/ray_walk.cpp"
#include <hwy/foreach_target.h>
// must come after foreach_target.h
#include <hwy/highway.h>

#include "hiac/render/walk/ray_bundle-inl.hpp"
#include "hiac/render/walk/segment_shader-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class Rule>
HWY_NOINLINE void follow_by(const RayScene& scene, const RayStarts& starts, const TileTarget& to,
                            TileEdges& edges) {
  RayBundle rays(scene, starts, to, edges);
  SegmentShader<Rule> shader(scene.frame.optics, rays);
  while (rays.advance()) {
    shader.shade();
    rays.settle();
  }
}

void follow_rays_here(const RayScene& scene, const RayStarts& starts, const TileTarget& to,
                      TileEdges& edges) {
  if (scene.frame.optics.emission)
    follow_by<ExactEmission>(scene, starts, to, edges);
  else
    follow_by<ExactChromaticity>(scene, starts, to, edges);
}

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hiac {

HWY_EXPORT(follow_rays_here);

void follow_rays(const RayScene& scene, const RayStarts& starts, const TileTarget& to,
                 TileEdges& edges) {
  HWY_DYNAMIC_DISPATCH(follow_rays_here)(scene, starts, to, edges);
}

}  // namespace hiac
#endif
