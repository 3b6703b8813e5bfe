// Pictures made many segments at a time against those made one at a time with a proven bound of
// their error, which brute force confirms (higher_orders_test.cpp, error_bound_test.cpp).

#include "hiac/render/cell_integrals.hpp"

#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/render/renderable.hpp"
#include "tests/render/general_meshes.hpp"
#include "tests/support/instrumented.hpp"

namespace hiac {
namespace {

using test::cube_scene;
using test::Cut;

struct NamedMesh {
  const char *cells, *map;
  ZooMesh mesh;
};

test::Position moved_inside(const test::Position& p) { return test::warped(p, 0.06); }

// Affine cells, cells that are not, and cells with bent faces or edges.
std::vector<NamedMesh> meshes_of(CellOrder order) {
  std::vector<NamedMesh> meshes;
  const std::size_t n = test::tried(8) / 4;
  for (const auto& [name, mesh] : {std::pair{"tetrahedra", test::structured(n, Cut::tetrahedra)},
                                   {"pyramids", test::structured(n, Cut::pyramids)},
                                   {"prisms", test::structured(n, Cut::prisms)},
                                   {"wedges", test::two_wedges()},
                                   {"bricks", test::structured(n, Cut::bricks)}}) {
    meshes.push_back({name, "sheared", test::of_order(test::moved(mesh, test::sheared), order)});
    meshes.push_back({name, "tapered", test::of_order(test::moved(mesh, test::tapered), order)});
    ZooMesh bent = order == CellOrder::linear
                       ? test::moved(mesh, moved_inside)
                       : test::moved(test::of_order(mesh, order), test::bent);
    meshes.push_back({name, "bent", std::move(bent)});
  }
  return meshes;
}

// How much more than claimed a picture without the channel "error" is off one that has it.
double unclaimed(const ZooMesh& mesh, const Scene& scene) {
  check_renderable(mesh, scene);
  const VisibilityOrder order = test::sorted(mesh, scene);
  const std::array channels{Channel::error};
  const RenderResult one = render(mesh, order, scene, false, nullptr, channels);
  const RenderResult many = render(mesh, order, scene, false);
  EXPECT_EQ(one.statistics.segments, many.statistics.segments);
  EXPECT_EQ(many.statistics.violations, 0U);
  double most = -1;
  for (std::uint32_t y = 0; y < scene.image.height; ++y)
    for (std::uint32_t x = 0; x < scene.image.width; ++x)
      for (std::size_t c = 0; c < 4; ++c)
        most = std::max(
            most, std::abs(one.image.at(x, y, c) - many.image.at(x, y, c)) - one.image.at(x, y, 4));
  return most;
}

class CellIntegrals : public testing::TestWithParam<CellOrder> {};

TEST_P(CellIntegrals, PicturesAreThoseOfSingleSegments) {
  unsigned trial = 0;
  for (auto& [cells, map, mesh] : meshes_of(GetParam())) {
    test::add_random_field(mesh, "f", FieldLocation::node, 16);
    test::add_random_field(mesh, "g", FieldLocation::node, 17);
    for (const double tolerance : {1e-9, 1e-13}) {
      ++trial;
      Scene scene =
          cube_scene(trial % 2 == 0 ? Projection::perspective : Projection::orthographic, 14, 12);
      scene.render.tolerance = tolerance;
      if (trial / 2 % 2 == 0) scene.volume.glow = Glow::emission;
      if (trial % 3 == 0) scene.volume.color->field = mesh.fields[1].name;
      // a step, and more opacity than a pixel can use
      if (trial % 5 == 0)
        scene.volume.extinction->points = {{0, {1}}, {0.4, {2}}, {0.4, {9}}, {1, {40}}};
      EXPECT_LE(unclaimed(mesh, scene), tolerance / 64)
          << map << " " << cells << ", tolerance " << tolerance;
    }
  }
}

// In a thick volume pieces are halved until a rule has nodes enough.
TEST_P(CellIntegrals, ThickVolumesAreThoseOfSingleSegments) {
  ZooMesh mesh =
      test::of_order(test::moved(test::structured(1, Cut::bricks), test::tapered), GetParam());
  test::add_random_field(mesh, "f", FieldLocation::node, 18);
  for (const Glow glow : {Glow::chromaticity, Glow::emission}) {
    Scene scene = cube_scene(Projection::perspective, 12, 10);
    scene.volume.glow = glow;
    scene.volume.extinction->points = {{0, {100}}, {0.3, {2000}}, {0.7, {300}}};
    EXPECT_LE(unclaimed(mesh, scene), 1e-13);
  }
}

INSTANTIATE_TEST_SUITE_P(Orders, CellIntegrals,
                         testing::Values(CellOrder::linear, CellOrder::quadratic, CellOrder::cubic),
                         [](const auto& instance) {
                           return "Order" + std::to_string(static_cast<int>(instance.param));
                         });

}  // namespace
}  // namespace hiac
