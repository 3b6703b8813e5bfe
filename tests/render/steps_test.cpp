#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "hiac/frame/renderable.hpp"
#include "tests/render/truth/general_meshes.hpp"
#include "tests/support/reference.hpp"

namespace hiac {
namespace {

using test::Cut;

// A field that has the step's scalar everywhere, on nodes or on cells, takes the value above the
// step: transfer functions are continuous from the right.
TEST(Steps, AreContinuousFromTheRight) {
  for (const ZooMesh& cells :
       {test::structured(2, Cut::tetrahedra), test::structured(2, Cut::bricks),
        test::of_order(test::structured(1, Cut::tetrahedra), CellOrder::quadratic),
        test::of_order(test::structured(1, Cut::tetrahedra), CellOrder::cubic),
        test::moved(test::mixed_columns(1), test::tapered)})
    for (const FieldLocation location : {FieldLocation::node, FieldLocation::cell})
      for (const Glow glow : {Glow::chromaticity, Glow::emission}) {
        ZooMesh mesh = cells;
        const std::size_t count =
            location == FieldLocation::node ? mesh.node_count() : mesh.cell_count();
        mesh.fields = {{"f", "", location, 1, std::vector<double>(count, 0.5)}};
        Scene stepped = test::cube_scene(Projection::perspective, 12, 10);
        stepped.volume.glow = glow;
        stepped.volume.color->points = {
            {0, {0, 0, 1}}, {0.5, {0, 0, 1}}, {0.5, {0.7, 0.5, 0}}, {1, {0.7, 0.5, 0}}};
        stepped.volume.extinction->points = {{0, {0.1}}, {0.5, {0.1}}, {0.5, {3}}, {1, {3}}};
        Scene constant = stepped;
        constant.volume.color->points = {{0, {0.7, 0.5, 0}}};
        constant.volume.extinction->points = {{0, {3}}};
        const Image found = test::draw(mesh, stepped).image;
        const Image expected = test::draw(mesh, constant).image;
        double brightest = 0;
        for (std::size_t i = 0; i < found.values().size(); ++i) {
          ASSERT_NEAR(found.values()[i], expected.values()[i], 1e-12);
          brightest = std::max(brightest, found.values()[i]);
        }
        EXPECT_GT(brightest, 0.5);
      }
}

// Rays end where nothing behind can change the pixel by more than the tolerance; a bright
// background is behind, too.
TEST(EndedRays, LeaveBrightBackgroundsExact) {
  for (const Cut cut : {Cut::tetrahedra, Cut::bricks}) {
    ZooMesh mesh = test::structured(6, cut);
    test::add_node_field(mesh, "f", [](const test::Position& p) { return p[0]; });
    Scene scene = test::cube_scene(Projection::orthographic, 20, 20);
    scene.volume.extinction->points = {{0, {15}}, {1, {40}}};
    scene.background.color = {1e6, 0, 0};
    scene.render.tolerance = 1e-9;
    const VisibilityOrder order = test::sorted(mesh, scene);
    const Image found = render(mesh, order, scene, true).image;
    scene.render.tolerance = 1e-18;
    const Image exact = render(mesh, order, scene, true).image;
    for (std::size_t i = 0; i < found.values().size(); ++i)
      ASSERT_NEAR(found.values()[i], exact.values()[i], 1e-9 + 1e-15 * exact.values()[i]);
  }
}

}  // namespace
}  // namespace hiac
