// The error bound of pixels in which edges are drawn: the medium in front of and behind an edge is
// as near to the truth as it claims, the edge's share of the pixel is what is drawn.
#include <array>
#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "hiac/render/engine.hpp"
#include "hiac/render/explain_pixel.hpp"
#include "tests/render/truth/general_meshes.hpp"
#include "tests/render/truth/scene_truth.hpp"
#include "tests/support/instrumented.hpp"
#include "tests/support/sorting.hpp"

namespace hiac {
namespace {

using test::Cut;

Scene edges_scene(std::uint64_t seed) {
  Scene scene =
      test::cube_scene(seed % 2 == 0 ? Projection::perspective : Projection::orthographic, 28, 21);
  if (seed % 3 == 0) scene.volume.glow = Glow::emission;
  if (seed % 4 == 1)
    for (auto& point : scene.volume.extinction->points) point.value[0] *= 20;  // rays end early
  scene.edges = Edges{EdgeChoice::feature, 30, 3, {0.2, 1, 0.4}, 0.6};
  return scene;
}

// The truth where the ray meets edges in front of all cells and behind all cells alone; none where
// it meets one between cells.
std::optional<std::array<long double, 4>> truth_with_edges(const PixelExplanation& pixel,
                                                           std::array<long double, 4> medium,
                                                           const Color& color) {
  std::array<long double, 4> result{0, 0, 0, 1};
  const auto behind = [&](const std::array<long double, 4>& next) {
    for (std::size_t c = 0; c < 3; ++c) result[c] += result[3] * next[c];
    result[3] *= next[3];
  };
  bool through = false, beyond = false;
  for (const PixelSegment& s : pixel.segments) {
    if (s.part == RayPart::inside) {
      if (beyond) return std::nullopt;
      if (!through) behind(medium);
      through = true;
      continue;
    }
    beyond = through;
    const long double a = s.opacity;
    behind({a * color[0], a * color[1], a * color[2], 1 - a});
  }
  return result;
}

TEST(EdgeErrors, AreNeverBelowTheErrorOfTheMedium) {
  std::size_t compared = 0, in_front = 0;
  double largest_share = 0;
  for (std::uint64_t seed = 1; seed <= test::tried(6); ++seed) {
    ZooMesh mesh = seed % 3 == 0   ? test::structured(2, Cut::tetrahedra)
                   : seed % 3 == 1 ? test::structured(2, Cut::bricks)
                                   : test::structured(2, Cut::prisms);
    test::add_random_field(mesh, "f", FieldLocation::node, seed);
    const Scene scene = edges_scene(seed);
    const VisibilityOrder order = test::sorted(mesh, scene);
    const std::vector<Channel> channels{Channel::error};
    const Image image = render(mesh, order, scene, false, nullptr, channels).image;
    Scene bare = scene;
    bare.edges.reset();
    const test::SceneTruth truth(mesh, bare);
    const Image without = render(mesh, order, bare, false).image;
    for (std::uint32_t y = 0; y < 21; y += test::kInstrumented ? 2 : 1)
      for (std::uint32_t x = 0; x < 28; ++x) {
        if (image.at(x, y, 3) == without.at(x, y, 3)) continue;
        const PixelExplanation pixel = explain_pixel(mesh, order, scene, x, y, false);
        ASSERT_EQ(*pixel.error, image.at(x, y, 4));
        const auto expected = truth_with_edges(pixel, truth.pixel(x, y), scene.edges->color);
        if (!expected) continue;
        ++compared;
        if (pixel.segments.front().part == RayPart::edge && pixel.segments.size() > 1) ++in_front;
        for (std::size_t c = 0; c < 4; ++c) {
          const long double wanted = c == 3 ? 1 - (*expected)[3] : (*expected)[c];
          const auto error = static_cast<double>(std::abs(wanted - image.at(x, y, c)));
          ASSERT_LE(error, image.at(x, y, 4)) << seed << ' ' << x << ' ' << y << ' ' << c;
          largest_share = std::max(largest_share, error / image.at(x, y, 4));
        }
        EXPECT_LT(image.at(x, y, 4), 1e-6);
      }
  }
  EXPECT_GT(compared, test::tried(600));
  EXPECT_GT(in_front, test::tried(250));
  EXPECT_GT(largest_share, 1e-4);
}

}  // namespace
}  // namespace hiac
