#include "hiac/render/bounds/bounded_scene.hpp"

#include "hiac/base/error.hpp"

namespace hiac {

std::optional<std::string> reason_unbounded(const Scene& scene) {
  if (scene.render.integration != Integration::exact)
    return "no bound is claimed of integrations other than \"exact\" (`render.integration`)";
  if (scene.render.interpolation != Interpolation::isoparametric)
    return "no bound is claimed of interpolations other than \"isoparametric\" "
           "(`render.interpolation`)";
  if (scene.render.splat_below > 0) return "no bound is claimed of splats (`render.splat_below`)";
  return std::nullopt;
}

void require_bounded_scene(const Scene& scene) {
  if (const auto reason = reason_unbounded(scene)) throw UsageError("channel 'error': " + *reason);
}

}  // namespace hiac
