#include "hiac/scene/scene.hpp"

#include <cmath>

#include <fmt/format.h>
#include <xxhash.h>

namespace hiac {

std::array<double, 3> view_direction(const Camera& camera) {
  return {camera.look_at[0] - camera.eye[0], camera.look_at[1] - camera.eye[1],
          camera.look_at[2] - camera.eye[2]};
}

std::string view_hash(const Scene& scene) {
  const Camera& camera = scene.camera;
  // Five numbers, the projection first; adding 0 turns both zeros into the same one.
  std::array<double, 5> decisive{};
  decisive[0] = static_cast<double>(camera.projection);
  if (camera.projection == Projection::perspective) {
    for (std::size_t i = 0; i < 3; ++i) decisive[i + 1] = camera.eye[i] + 0.0;
  } else {
    const std::array<double, 3> direction = view_direction(camera);
    double largest = 0;
    for (const double d : direction) largest = std::fmax(largest, std::fabs(d));
    for (std::size_t i = 0; i < 3; ++i) decisive[i + 1] = direction[i] / largest + 0.0;
  }
  decisive[4] = scene.render.planarity + 0.0;
  const XXH128_hash_t hash = XXH3_128bits(decisive.data(), sizeof decisive);
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace hiac
