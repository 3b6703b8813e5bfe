#include "tests/render/truth/error_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hiac/frame/renderable.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/render/engine.hpp"
#include "hiac/scene/view_of.hpp"
#include "tests/render/truth/scene_truth.hpp"

namespace hiac::test {

double PixelError::ratio() const {
  if (error == 0 && claimed >= 0) return 0;
  return claimed > 0 ? error / claimed : std::numeric_limits<double>::infinity();
}

void ErrorComparison::add(const ErrorComparison& other) {
  pixels += other.pixels;
  at_default += other.at_default;
  claims.insert(claims.end(), other.claims.begin(), other.claims.end());
  largest_error = std::max(largest_error, other.largest_error);
  if (other.worst.ratio() > worst.ratio()) worst = other.worst;
  if (other.largest_claim.claimed > largest_claim.claimed) largest_claim = other.largest_claim;
  for (const PixelError& failure : other.failures)
    if (failures.size() < 20) failures.push_back(failure);
}

ErrorComparison compare_error_channel(SceneCells cells, std::uint64_t seed, std::uint32_t side) {
  const RandomScene random = random_scene(cells, seed, side);
  const auto& [mesh, scene] = random;
  check_renderable(mesh, scene);
  const VisibilityOrder order =
      exact_order(mesh, build_face_adjacency(mesh), view_of(scene.camera), scene.render.planarity)
          .order;
  const std::array channels{Channel::error, Channel::cells};
  const Image image = render(mesh, order, scene, true, nullptr, channels).image;
  const SceneTruth truth(mesh, scene);
  ErrorComparison result;
  for (std::uint32_t y = 0; y < scene.image.height; ++y)
    for (std::uint32_t x = 0; x < scene.image.width; ++x) {
      const auto expected = truth.pixel(x, y);
      const auto pixel = image.pixel(x, y);
      const bool empty = pixel[5] == 0 && expected[3] == 1;
      if (!empty) ++result.pixels;
      PixelError worst{seed, x, y, 0, 0, pixel[4]};
      for (std::size_t c = 0; c < 4; ++c) {
        const long double value =
            c < 3 ? expected[c] + expected[3] * scene.background.color[c] : 1 - expected[3];
        const auto error = static_cast<double>(std::abs(value - pixel[c]));
        if (error > worst.error || !(error == error)) {
          worst.error = error;
          worst.channel = c;
        }
      }
      result.largest_error = std::max(result.largest_error, worst.error);
      if (worst.ratio() > result.worst.ratio()) result.worst = worst;
      if (!(worst.ratio() <= 1) && result.failures.size() < 20) result.failures.push_back(worst);
      if (empty || scene.render.tolerance != Scene{}.render.tolerance) continue;
      ++result.at_default;
      result.claims.push_back(pixel[4]);
      if (worst.claimed > result.largest_claim.claimed) result.largest_claim = worst;
    }
  return result;
}

}  // namespace hiac::test
