#include "hiac/render/bounds/bounded_scene.hpp"

#include "hiac/base/error.hpp"

namespace hiac {

void require_bounded_scene(const Scene& scene) {
  if (scene.render.integration != Integration::exact)
    throw UsageError(
        "channel 'error': no bound is claimed of integrations other than \"exact\" "
        "(`render.integration`)");
  if (scene.render.interpolation != Interpolation::isoparametric)
    throw UsageError(
        "channel 'error': no bound is claimed of interpolations other than \"isoparametric\" "
        "(`render.interpolation`)");
  if (scene.render.splat_below > 0)
    throw UsageError("channel 'error': no bound is claimed of splats (`render.splat_below`)");
  if (scene.skin) throw UsageError("channel 'error': no bound is claimed of the skin (`skin`)");
}

}  // namespace hiac
