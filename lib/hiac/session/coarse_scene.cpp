#include "hiac/session/coarse_scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hiac {
namespace {

// One side of a picture.
struct CoarseSide {
  std::uint32_t count;   // of the coarse picture
  std::int64_t first;    // the place of its pixel 0
  std::uint64_t inside;  // how many of its pixels lie in the whole picture
};

// Both pictures have one centre, and with sides that are both even or both odd, and an odd step,
// centres of coarse pixels are centres of pixels.
CoarseSide coarse_side(std::uint32_t side, std::uint32_t step) {
  std::uint32_t count = (side + step - 1) / step;
  if (count % 2 != side % 2) ++count;
  const auto wide = static_cast<std::int64_t>(step);
  const std::int64_t first =
      (static_cast<std::int64_t>(side) - 1 - wide * (static_cast<std::int64_t>(count) - 1)) / 2;
  const std::int64_t before = first < 0 ? (-first + wide - 1) / wide : 0;
  return {count, first, count - 2 * static_cast<std::uint64_t>(before)};
}

}  // namespace

CoarseScene coarse_scene(const Scene& scene, std::uint32_t step) {
  CoarseScene coarse{scene, step, 0, 0,
                     static_cast<std::uint64_t>(scene.image.width) * scene.image.height};
  if (step == 1) return coarse;
  const CoarseSide across = coarse_side(scene.image.width, step);
  const CoarseSide down = coarse_side(scene.image.height, step);
  coarse.scene.image = {across.count, down.count};
  coarse.left = across.first;
  coarse.top = down.first;
  coarse.pixels = across.inside * down.inside;
  const double growth =
      static_cast<double>(down.count) * step / static_cast<double>(scene.image.height);
  Camera& camera = coarse.scene.camera;
  camera.height *= growth;
  constexpr double kHalfDegree = std::numbers::pi / 360;
  camera.fov = std::atan(std::tan(camera.fov * kHalfDegree) * growth) / kHalfDegree;
  if (coarse.scene.edges) coarse.scene.edges->width /= step;
  return coarse;
}

}  // namespace hiac
