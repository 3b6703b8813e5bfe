#include "hiac/session/coarse_scene.hpp"

#include <algorithm>

#include "hiac/scene/camera_motion.hpp"

namespace hiac {
namespace {

// One side of a picture.
struct CoarseSide {
  std::uint32_t count;  // of the coarse picture
  std::int64_t first;   // the place of its pixel 0
  double shift;         // from its middle to that of the whole picture, in its pixels
};

// The squares reach beyond the picture by less than a step, shared by its two ends: the pixels in
// their middle lie inside.
CoarseSide coarse_side(std::uint32_t side, std::uint32_t step) {
  const std::int64_t whole = side, wide = step;
  const std::int64_t count = (whole + wide - 1) / wide;
  const std::int64_t first = (wide - 1) / 2 - (count * wide - whole) / 2;
  // pixel k's centre is at first + k wide + 1/2 there and at k + 1/2 here
  const double middle =
      (static_cast<double>(whole - 2 * first - 1) / static_cast<double>(wide) + 1) / 2;
  return {static_cast<std::uint32_t>(count), first, middle - static_cast<double>(count) / 2};
}

}  // namespace

CoarseScene coarse_scene(const Scene& scene, std::uint32_t step) {
  CoarseScene coarse{scene, step, 0, 0};
  if (step == 1) return coarse;
  const CoarseSide across = coarse_side(scene.image.width, step);
  const CoarseSide down = coarse_side(scene.image.height, step);
  coarse.scene.image = {across.count, down.count};
  coarse.left = across.first;
  coarse.top = down.first;
  Camera& camera = coarse.scene.camera;
  camera = widened(
      camera, static_cast<double>(down.count) * step / static_cast<double>(scene.image.height));
  camera.shift = {across.shift + camera.shift[0] / step, down.shift + camera.shift[1] / step};
  if (coarse.scene.edges) coarse.scene.edges->width /= step;
  return coarse;
}

}  // namespace hiac
