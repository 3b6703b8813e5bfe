#include "hiac/session/frames.hpp"

#include <numeric>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/camera_path.hpp"

namespace hiac {

std::vector<std::uint32_t> frames_of(const Scene& scene, const std::optional<std::uint32_t>& one) {
  const std::uint32_t count = frame_count(scene);
  if (one && !scene.path)
    throw UsageError(fmt::format(
        "frame {}: the specification has no camera path (keyframes [[camera]], or a [turntable])",
        *one));
  if (one && *one >= count)
    throw UsageError(
        fmt::format("frame {0}: there is no such frame (expected 0 to {1}, found "
                    "{0})",
                    *one, count - 1));
  if (one) return {*one};
  std::vector<std::uint32_t> all(count);
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

}  // namespace hiac
