// Pictures with a skin against brute force: every face against every ray.

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/frame/renderable.hpp"
#include "hiac/render/engine.hpp"
#include "tests/render/truth/general_meshes.hpp"
#include "tests/render/truth/skin_truth.hpp"
#include "tests/support/instrumented.hpp"

namespace hiac {
namespace {

using test::Cut;

// A uniform medium, a coloured skin that is seen through, a headlight and a light from the side.
Scene skin_scene(Projection projection, std::uint32_t width, std::uint32_t height) {
  Scene scene = test::cube_scene(projection, width, height);
  test::make_uniform(scene);
  Skin& skin = scene.skin.emplace();
  skin.color = {0.3, 0.8, 0.6};
  skin.opacity = 0.4;
  scene.lights = {Light{}, Light{{{-1, 2, 0.5}}, {0.7, 0.6, 0.5}}};
  return scene;
}

void color_by(Scene& scene, const std::string& field) {
  scene.skin->color_by =
      ColorTransfer{field, {{0.1, {0.1, 0.2, 0.9}}, {0.5, {0.2, 0.9, 0.3}}, {0.8, {0.9, 0, 0.1}}}};
}

struct Comparison {
  double largest = 0;       // error of a channel
  std::size_t unknown = 0;  // pixels that the truth does not know
  std::size_t covered = 0;
};

Comparison compare(const ZooMesh& mesh, const Scene& scene, const VisibilityOrder& order) {
  check_renderable(mesh, scene);
  const Image image = render(mesh, order, scene, false).image;
  const test::SkinTruth truth(mesh, scene);
  Comparison result;
  for (std::uint32_t y = 0; y < scene.image.height; ++y)
    for (std::uint32_t x = 0; x < scene.image.width; ++x) {
      const auto expected = truth.pixel(x, y);
      if (std::isnan(expected[0])) {
        ++result.unknown;
        continue;
      }
      if (expected[3] > 0) ++result.covered;
      for (std::size_t c = 0; c < 4; ++c)
        result.largest = std::max(result.largest,
                                  static_cast<double>(std::abs(image.at(x, y, c) - expected[c])));
    }
  return result;
}

void expect_truth(const ZooMesh& mesh, const Scene& scene, double tolerance,
                  const std::string& what) {
  const Comparison found = compare(mesh, scene, test::sorted(mesh, scene));
  EXPECT_LE(found.largest, tolerance) << what;
  EXPECT_GT(found.covered, scene.image.width * scene.image.height / 8) << what;
  EXPECT_LE(found.unknown, scene.image.width * scene.image.height / 50) << what;
}

// Four tenths of the cells of a mesh are left out: hollows, and skin behind skin.
ZooMesh with_hollows(const ZooMesh& mesh) {
  return test::keep_cells(mesh,
                          [](const test::Position&, CellId cell) { return cell * 7 % 10 < 6; });
}

std::vector<std::pair<std::string, ZooMesh>> planar_meshes() {
  const auto tapered = [](const ZooMesh& mesh) { return test::moved(mesh, test::tapered); };
  return {{"tetrahedra", test::random_delaunay(40, 3)},
          {"tetrahedra with hollows", with_hollows(test::random_delaunay(40, 4))},
          {"bricks", tapered(test::structured(2, Cut::bricks))},
          {"bricks with hollows", with_hollows(test::structured(3, Cut::bricks))},
          {"prisms", tapered(test::structured(2, Cut::prisms))},
          {"pyramids", tapered(test::structured(1, Cut::pyramids))},
          {"wedges", tapered(test::two_wedges())},
          {"all kinds", tapered(test::mixed_columns(1))}};
}

TEST(Skin, PlanarFacesAgreeWithBruteForce) {
  for (auto [name, mesh] : planar_meshes()) {
    test::add_random_field(mesh, "f", FieldLocation::node, 5);
    test::add_random_field(mesh, "corner", FieldLocation::corner, 6);
    test::add_random_field(mesh, "cell", FieldLocation::cell, 7);
    for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
      Scene scene = skin_scene(projection, 13, 11);
      expect_truth(mesh, scene, 1e-12, name);
      for (const char* field : {"f", "corner", "cell"}) {
        color_by(scene, field);
        expect_truth(mesh, scene, 1e-12, name + " by " + field);
      }
    }
  }
}

TEST(Skin, CurvedFacesAgreeWithBruteForce) {
  for (const CellKind kind : test::tried(test::all_kinds())) {
    ZooMesh mesh = test::curved_mesh(kind);
    test::add_random_field(mesh, "f", FieldLocation::node, 8);
    for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
      Scene scene = skin_scene(projection, 10, 9);
      expect_truth(mesh, scene, 1e-9, std::string(kind_name(kind)));
      color_by(scene, "f");
      expect_truth(mesh, scene, 1e-9, std::string(kind_name(kind)) + " by a field");
    }
  }
}

TEST(Skin, IsDrawnWithoutAMedium) {
  ZooMesh mesh = with_hollows(test::random_delaunay(40, 9));
  Scene scene = skin_scene(Projection::perspective, 13, 11);
  scene.volume = {};
  expect_truth(mesh, scene, 1e-12, "no medium");
  scene.skin->opacity = 1;
  expect_truth(mesh, scene, 1e-12, "opaque");
  // a medium without extinction
  test::add_random_field(mesh, "f", FieldLocation::node, 10);
  scene.volume.extinction = ExtinctionTransfer{"f", {{0, {0}}}};
  scene.volume.color = ColorTransfer{"f", {{0, {1, 1, 1}}}};
  expect_truth(mesh, scene, 1e-12, "a clear medium");
}

TEST(Skin, IsCutByTheSlabAndSeenFromWithin) {
  ZooMesh mesh = with_hollows(test::random_delaunay(60, 11));
  test::add_random_field(mesh, "f", FieldLocation::node, 12);
  Scene scene = skin_scene(Projection::perspective, 13, 11);
  scene.camera.clip = {{3.6, 4.2}};
  expect_truth(mesh, scene, 1e-12, "clipped");
  scene.camera.projection = Projection::orthographic;
  expect_truth(mesh, scene, 1e-12, "clipped, orthographic");
  scene.camera.projection = Projection::perspective;
  scene.camera.clip.reset();
  scene.camera.eye = {0.52, 0.47, 0.41};
  scene.camera.look_at = {0, 0, 0.1};
  scene.camera.fov = 80;
  expect_truth(mesh, scene, 1e-12, "from within");
}

TEST(Skin, IsTheSameInGroupsOfCells) {
  for (const auto& mesh :
       {with_hollows(test::random_delaunay(40, 13)), test::curved_mesh(CellKind::brick20)}) {
    ZooMesh with_field = mesh;
    test::add_random_field(with_field, "f", FieldLocation::node, 14);
    const Scene scene = skin_scene(Projection::perspective, 13, 11);
    VisibilityOrder order = test::sorted(with_field, scene);
    const auto last = static_cast<std::uint32_t>(order.cells.size());
    order.groups = std::vector<CellGroup>{{0, last}};
    EXPECT_LE(compare(with_field, scene, order).largest, 1e-9) << kind_name(mesh.kinds[0]);
  }
}

TEST(Skin, HasNoHoles) {
  ZooMesh mesh = test::moved(test::structured(5, Cut::tetrahedra), test::sheared);
  test::add_random_field(mesh, "f", FieldLocation::node, 15);
  Scene scene = skin_scene(Projection::perspective, 150, 120);
  scene.skin->opacity = 1;
  const VisibilityOrder order = test::sorted(mesh, scene);
  const Image with = render(mesh, order, scene, false).image;
  scene.skin.reset();
  const Image without = render(mesh, order, scene, false).image;
  for (std::uint32_t y = 0; y < 120; ++y)
    for (std::uint32_t x = 0; x < 150; ++x)
      EXPECT_EQ(with.at(x, y, 3), without.at(x, y, 3) > 0 ? 1 : 0) << x << ' ' << y;
}

TEST(Skin, OfNoOpacityChangesNothing) {
  ZooMesh mesh = with_hollows(test::random_delaunay(60, 16));
  test::add_random_field(mesh, "f", FieldLocation::node, 17);
  Scene scene = test::cube_scene(Projection::perspective, 40, 30);
  const Image without = test::draw(mesh, scene).image;
  scene.skin.emplace().opacity = 0;
  const Image with = test::draw(mesh, scene).image;
  for (std::uint32_t y = 0; y < 30; ++y)
    for (std::uint32_t x = 0; x < 40; ++x)
      for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(with.at(x, y, c), without.at(x, y, c), 1e-12);
}

TEST(Skin, IsNoCellOfAPixelAndHasADepth) {
  ZooMesh mesh = test::structured(2, Cut::bricks);
  test::add_random_field(mesh, "f", FieldLocation::node, 18);
  Scene scene = skin_scene(Projection::perspective, 20, 16);
  const std::vector<Channel> channels{Channel::depth, Channel::cells, Channel::witness};
  const VisibilityOrder order = test::sorted(mesh, scene);
  const Image with = render(mesh, order, scene, false, nullptr, channels).image;
  const Image alone = render(mesh, order, scene, false).image;
  scene.skin.reset();
  const Image without = render(mesh, order, scene, false, nullptr, channels).image;
  for (std::uint32_t y = 0; y < 16; ++y)
    for (std::uint32_t x = 0; x < 20; ++x) {
      for (std::size_t c = 0; c < 4; ++c) EXPECT_EQ(with.at(x, y, c), alone.at(x, y, c));
      // the medium begins where the skin is
      for (std::size_t c = 4; c < 7; ++c) EXPECT_EQ(with.at(x, y, c), without.at(x, y, c));
    }
}

}  // namespace
}  // namespace hiac
