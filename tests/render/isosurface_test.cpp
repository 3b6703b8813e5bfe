#include <cmath>
#include <numeric>
#include <random>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/base/parallel.hpp"
#include "hiac/frame/renderable.hpp"
#include "hiac/render/engine.hpp"
#include "tests/render/truth/general_meshes.hpp"
#include "tests/render/truth/polyhedron_reference.hpp"
#include "tests/render/truth/scene_truth.hpp"
#include "tests/support/reference.hpp"

namespace hiac {
namespace {

using test::cube_scene;
using test::Cut;
using test::draw;
using test::Position;

Isosurface surface_of(const std::string& field, double value, Color color, double opacity) {
  Isosurface surface;
  surface.field = field;
  surface.value = value;
  surface.color = color;
  surface.opacity = opacity;
  return surface;
}

// Five surfaces, one of them opaque, one without a highlight, one with an odd one.
void add_surfaces(Scene& scene, const std::string& field) {
  scene.isosurfaces = {
      surface_of(field, 0.2, {1, 0.3, 0.2}, 0.3), surface_of(field, 0.4, {0.2, 0.9, 0.4}, 0.5),
      surface_of(field, 0.52, {0.3, 0.4, 1}, 0.2), surface_of(field, 0.65, {1, 1, 0.4}, 0.7),
      surface_of(field, 0.8, {0.8, 0.7, 0.9}, 1)};
  scene.isosurfaces[1].specular = 0;
  scene.isosurfaces[2].shininess = 3.5;
}

// A scene's true pixels, for largest_error.
auto pixels_of(const test::SceneTruth& truth) {
  return [&truth](std::uint32_t x, std::uint32_t y) {
    const auto p = truth.pixel(x, y);
    return std::array{static_cast<double>(p[0]), static_cast<double>(p[1]),
                      static_cast<double>(p[2]), static_cast<double>(1 - p[3])};
  };
}

template <typename Reference>
double largest_error(const Scene& scene, const Image& image, const Reference& reference) {
  double largest = 0;
  for (std::uint32_t y = 0; y < scene.image.height; ++y)
    for (std::uint32_t x = 0; x < scene.image.width; ++x) {
      const std::array<double, 4> expected = reference(x, y);
      for (std::size_t c = 0; c < 4; ++c)
        largest = std::max(largest, std::abs(expected[c] - image.at(x, y, c)));
    }
  return largest;
}

double error_of_tetrahedra(const ZooMesh& mesh, const Scene& scene) {
  check_renderable(mesh, scene);
  return largest_error(scene, draw(mesh, scene).image, [&](std::uint32_t x, std::uint32_t y) {
    return test::reference_pixel(mesh, scene, x, y);
  });
}

double error_of_polyhedra(const ZooMesh& mesh, const Scene& scene) {
  check_renderable(mesh, scene);
  return largest_error(scene, draw(mesh, scene).image, [&](std::uint32_t x, std::uint32_t y) {
    return test::polyhedron_reference(mesh, scene, x + 0.5, y + 0.5);
  });
}

ZooMesh delaunay_with_fields(std::size_t points, std::uint64_t seed) {
  ZooMesh mesh = test::random_delaunay(points, seed);
  test::add_node_field(mesh, "f", test::smooth_field);
  test::add_random_field(mesh, "node", FieldLocation::node, seed + 1);
  test::add_random_field(mesh, "cell", FieldLocation::cell, seed + 2);
  test::add_random_field(mesh, "corner", FieldLocation::corner, seed + 3);
  return mesh;
}

TEST(Isosurfaces, DelaunayAgreesWithBruteForce) {
  const ZooMesh mesh = delaunay_with_fields(60, 1);
  for (const Projection projection : {Projection::orthographic, Projection::perspective})
    for (const Glow glow : {Glow::chromaticity, Glow::emission})
      for (const auto& [color, extinction, iso] : {std::array{"f", "f", "f"},
                                                   {"f", "f", "node"},
                                                   {"node", "f", "corner"},
                                                   {"corner", "cell", "node"},
                                                   {"f", "corner", "cell"}}) {
        Scene scene = cube_scene(projection, 18, 15);
        scene.render.tolerance = 1e-15;
        scene.volume.glow = glow;
        scene.volume.color->field = color;
        scene.volume.extinction->field = extinction;
        add_surfaces(scene, iso);
        EXPECT_LE(error_of_tetrahedra(mesh, scene), 1e-12)
            << color << ' ' << extinction << ' ' << iso << " perspective "
            << (projection == Projection::perspective) << " emission " << (glow == Glow::emission);
      }
}

TEST(Isosurfaces, CellsOfOtherKindsAgreeWithBruteForce) {
  const auto straight = test::sheared, bent = test::tapered;
  for (const auto& [cells, map] : {std::pair{test::structured(1, Cut::bricks), straight},
                                   {test::structured(1, Cut::bricks), bent},
                                   {test::structured(1, Cut::prisms), bent},
                                   {test::structured(1, Cut::pyramids), bent},
                                   {test::two_wedges(), bent},
                                   {test::mixed_columns(1), bent}}) {
    ZooMesh mesh = test::moved(cells, map);
    test::add_random_field(mesh, "f", FieldLocation::node, 21);
    test::add_random_field(mesh, "g", FieldLocation::corner, 22);
    for (const char* field : {"f", "g"}) {
      Scene scene = cube_scene(Projection::perspective, 8, 7);
      add_surfaces(scene, field);
      EXPECT_LE(error_of_polyhedra(mesh, scene), 1e-12) << field << ' ' << mesh.cell_count();
    }
  }
}

// Colour, extinction and isosurfaces by three fields, on nodes, cells and cells' corners, in cells
// of every linear kind.
TEST(Isosurfaces, FiveWithThreeFieldsAgreeWithTheTruth) {
  for (ZooMesh mesh :
       {test::random_delaunay(40, 8), test::moved(test::structured(2, Cut::bricks), test::tapered),
        test::moved(test::structured(2, Cut::prisms), test::tapered),
        test::moved(test::structured(1, Cut::pyramids), test::tapered),
        test::moved(test::two_wedges(), test::tapered),
        test::moved(test::mixed_columns(2), test::sheared)}) {
    test::add_random_field(mesh, "node", FieldLocation::node, 31);
    test::add_random_field(mesh, "cell", FieldLocation::cell, 32);
    test::add_random_field(mesh, "corner", FieldLocation::corner, 33);
    test::add_random_field(mesh, "other", FieldLocation::node, 34);
    for (const auto& [color, extinction, iso] : {std::array{"corner", "cell", "node"},
                                                 {"node", "other", "corner"},
                                                 {"cell", "corner", "other"}}) {
      Scene scene = cube_scene(Projection::perspective, 11, 9);
      scene.volume.color->field = color;
      scene.volume.extinction->field = extinction;
      add_surfaces(scene, iso);
      check_renderable(mesh, scene);
      const test::SceneTruth truth(mesh, scene);
      EXPECT_LE(largest_error(scene, draw(mesh, scene).image, pixels_of(truth)), 1e-12)
          << color << ' ' << extinction << ' ' << iso << ' ' << mesh.cell_count();
    }
  }
}

TEST(Isosurfaces, EyeInsideAgreesWithBruteForce) {
  ZooMesh bricks = test::moved(test::mixed_columns(1), test::tapered);
  test::add_random_field(bricks, "f", FieldLocation::node, 23);
  Scene scene = cube_scene(Projection::perspective, 8, 7);
  scene.camera.eye = test::tapered({0.31, 0.42, 0.37});
  scene.camera.look_at = {0.9, 0.3, 0.5};
  scene.camera.fov = 100;
  add_surfaces(scene, "f");
  EXPECT_LE(error_of_polyhedra(bricks, scene), 1e-12);
  scene.camera.eye = {0.43, 0.52, 0.61};
  scene.image = {24, 20};
  EXPECT_LE(error_of_tetrahedra(delaunay_with_fields(60, 4), scene), 1e-12);
}

TEST(Isosurfaces, ClippingSlabAgreesWithBruteForce) {
  const ZooMesh mesh = delaunay_with_fields(60, 5);
  ZooMesh columns = test::moved(test::mixed_columns(1), test::tapered);
  test::add_random_field(columns, "f", FieldLocation::node, 24);
  for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
    Scene scene = cube_scene(projection, 20, 18);
    scene.camera.clip = {{3.4, 3.9}};
    add_surfaces(scene, "node");
    EXPECT_LE(error_of_tetrahedra(mesh, scene), 1e-12);
    scene.image = {8, 7};
    add_surfaces(scene, "f");
    EXPECT_LE(error_of_polyhedra(columns, scene), 1e-12);
  }
}

TEST(Isosurfaces, LightsOnEverySideAgreeWithBruteForce) {
  const ZooMesh mesh = delaunay_with_fields(60, 6);
  Scene scene = cube_scene(Projection::perspective, 24, 20);
  add_surfaces(scene, "f");
  scene.lights = {Light{{{0.3, -1, 0.5}}, {0.9, 0.8, 0.7}}, Light{{{-40, 10, 3}}, {0.1, 0.3, 0.5}},
                  Light{{}, {0.2, 0.2, 0.4}}};
  EXPECT_LE(error_of_tetrahedra(mesh, scene), 1e-12);
  scene.lights.clear();
  EXPECT_LE(error_of_tetrahedra(mesh, scene), 1e-12);
}

TEST(Isosurfaces, AloneAgreeWithBruteForce) {
  const ZooMesh mesh = delaunay_with_fields(60, 7);
  Scene scene = cube_scene(Projection::orthographic, 24, 20);
  add_surfaces(scene, "node");
  scene.volume.extinction.reset();
  EXPECT_LE(error_of_tetrahedra(mesh, scene), 1e-12);
  scene.volume.color.reset();
  EXPECT_LE(error_of_tetrahedra(mesh, scene), 1e-12);
  EXPECT_GT(draw(mesh, scene).statistics.covered_pixels, 100U);
}

// A field along z and one surface of it, nothing else, seen along the axis: how much light passes a
// pixel tells how often the surface was drawn there.
class PassagesAlongAxis : public testing::TestWithParam<std::tuple<Cut, Projection, double>> {
 protected:
  // Checks that every ray through the unit cube meets the surface `count` times.
  void expect_drawn(const test::ScalarFunction& field, double value, int count, std::size_t n = 4) {
    const auto [cut, projection, side] = GetParam();
    ZooMesh mesh = test::structured(n, cut);
    test::add_node_field(mesh, "f", field);
    Scene scene;
    scene.image = {16, 16};
    scene.camera.projection = projection;
    scene.camera.look_at = {0.5, 0.5, 0.5};
    scene.camera.eye = {0.5, 0.5, 0.5 + 3 * side};
    scene.camera.up = {0, 1, 0};
    scene.camera.height = 1;
    scene.camera.fov = 16;
    scene.isosurfaces = {surface_of("f", value, {1, 1, 1}, 0.5)};
    check_renderable(mesh, scene);
    const RenderResult result = draw(mesh, scene);
    for (std::uint32_t y = 0; y < 16; ++y)
      for (std::uint32_t x = 0; x < 16; ++x) {
        const auto pixel = result.image.pixel(x, y);
        // not quite face-on
        ASSERT_NEAR(std::log2(1 - pixel[3]), -count, 0.3 * count + 1e-12)
            << x << ' ' << y << ' ' << value;
      }
  }
};

TEST_P(PassagesAlongAxis, SurfacesInFacesAreDrawnOnce) {
  for (const double value : {0.25, 0.5, 0.75})
    for (const double sign : {-1.0, 1.0})
      expect_drawn([sign](const Position& p) { return sign * p[2]; }, sign * value, 1);
}

TEST_P(PassagesAlongAxis, SurfacesBetweenFacesAreDrawnOnce) {
  for (const double value : {0.1, 0.3, 0.6, 1 - 1e-9})
    expect_drawn([](const Position& p) { return p[2]; }, value, 1);
}

// Some nodes of a cell have the value, by one, two and three.
TEST_P(PassagesAlongAxis, SurfacesThroughNodesAreDrawnOnce) {
  for (const auto& [a, b] : {std::pair{0.25, 0.0}, {0.25, 0.25}, {-0.25, 0.5}, {0.0, -0.5}})
    expect_drawn([a = a, b = b](const Position& p) { return p[2] + a * p[0] + b * p[1]; },
                 0.5 + (a + b) / 2, 1);
}

// Node values that are rounded: no plane of nodes has the value to the bit.
TEST_P(PassagesAlongAxis, SurfacesInFacesUpToRoundingAreDrawnOnce) {
  expect_drawn([](const Position& p) { return 0.7 * p[2] + 0.1; }, 0.7 * 0.6 + 0.1, 1, 5);
  expect_drawn([](const Position& p) { return p[2] + 0.1 * p[0]; }, 0.65, 1, 5);
  expect_drawn([](const Position& p) { return p[2] + (p[0] - 0.5) / 10; }, 0.4 + 1.0 / 320, 1, 5);
}

TEST_P(PassagesAlongAxis, TouchedFacesAreNotDrawn) {
  for (const double sign : {-1.0, 1.0})
    expect_drawn([sign](const Position& p) { return sign * std::abs(p[2] - 0.5); }, 0, 0);
}

TEST_P(PassagesAlongAxis, CellsThatHaveTheValueAreNotBelowIt) {
  const auto valley = [](const Position& p) { return std::max(0.0, std::abs(p[2] - 0.5) - 0.25); };
  expect_drawn(valley, 0, 0);
  expect_drawn([&](const Position& p) { return -valley(p); }, 0, 2);
  expect_drawn([](const Position&) { return 0.25; }, 0.25, 0);
}

TEST_P(PassagesAlongAxis, OnTheBoundaryTheFieldBelowDraws) {
  expect_drawn([](const Position& p) { return p[2]; }, 1, 1);
  expect_drawn([](const Position& p) { return p[2]; }, 0, 0);
}

INSTANTIATE_TEST_SUITE_P(
    AllKinds, PassagesAlongAxis,
    testing::Combine(testing::Values(Cut::bricks, Cut::tetrahedra, Cut::prisms, Cut::pyramids),
                     testing::Values(Projection::orthographic, Projection::perspective),
                     testing::Values(-1.0, 1.0)));

// The value at a node is the surface's or one within three units in the last place of it; every
// third one is far from it (by no more than what extended precision tells from these units).
double near_value(double value, std::mt19937_64& random) {
  const auto steps = static_cast<int>(random() % 7) - 3;
  const double far = std::ldexp(static_cast<double>(random() >> 11), -57) - 0.03125;
  if (random() % 3 == 0) return value + far;
  double near = value;
  for (int k = 0; k < std::abs(steps); ++k)
    near = std::nextafter(near, steps > 0 ? value + 1 : value - 1);
  // where whole faces have the value, which of their cells draws the surface is a convention
  return steps == 0 ? std::nextafter(value, value + 1) : near;
}

// Most nodes have a value within three units in the last place of the surface's: it runs along
// faces, at 1e-16 of a cell's size from them. The truth is found from the differences, which are
// exact.
TEST(Isosurfaces, NodesWithinRoundingOfTheValueAgreeWithTheTruth) {
  for (const auto cut : {Cut::tetrahedra, Cut::prisms, Cut::bricks})
    for (const double value : {0.5, 1.0})
      for (const Projection projection : {Projection::orthographic, Projection::perspective})
        for (std::uint64_t seed = 1; seed <= 3; ++seed) {
          ZooMesh mesh = test::moved(test::structured(2, cut), test::sheared);
          std::mt19937_64 random(seed);
          std::vector<double> values(mesh.node_count()), offsets;
          for (double& v : values) offsets.push_back((v = near_value(value, random)) - value);
          ZooMesh shifted = mesh;
          mesh.fields = {Field{"f", "", FieldLocation::node, 1, std::move(values)}};
          shifted.fields = {Field{"f", "", FieldLocation::node, 1, std::move(offsets)}};
          Scene scene = cube_scene(projection, 30, 26);
          scene.volume = {};
          scene.isosurfaces = {surface_of("f", value, {1, 1, 1}, 0.5)};
          Scene shifted_scene = scene;
          shifted_scene.isosurfaces[0].value = 0;
          const test::SceneTruth truth(shifted, shifted_scene);
          EXPECT_LE(largest_error(scene, draw(mesh, scene).image, pixels_of(truth)), 1e-6)
              << static_cast<int>(cut) << ' ' << value << ' ' << seed << " perspective "
              << (projection == Projection::perspective);
        }
}

// A field of whole numbers from -3 to 3 without 0, and of numbers far from it at every third node,
// in units of `unit`; `far` of them.
ZooMesh in_units(const ZooMesh& cells, double unit, double far, std::uint64_t seed) {
  ZooMesh mesh = cells;
  std::mt19937_64 random(seed);
  std::vector<double> values(mesh.node_count());
  for (double& v : values) {
    const auto steps = static_cast<double>(random() % 3 + 1) * (random() % 2 == 0 ? -1 : 1);
    v = random() % 3 == 0 ? steps * far : steps * unit;
  }
  mesh.fields = {Field{"f", "", FieldLocation::node, 1, std::move(values)}};
  return mesh;
}

// An isosurface does not depend on the field's unit, be it so small that values are denormal.
TEST(Isosurfaces, OfDenormalValuesAreThoseOfOthers) {
  for (const auto cut : {Cut::tetrahedra, Cut::prisms, Cut::bricks})
    for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
      Scene scene = cube_scene(projection, 30, 26);
      scene.volume = {};
      scene.isosurfaces = {surface_of("f", 0, {1, 1, 1}, 0.5)};
      const ZooMesh cells = test::moved(test::structured(2, cut), test::sheared);
      const auto expect_truth = [&](double unit, double far, const ZooMesh& same) {
        const ZooMesh mesh = in_units(cells, unit, far, 5);
        const test::SceneTruth truth(same, scene);
        EXPECT_LE(largest_error(scene, draw(mesh, scene).image, pixels_of(truth)), 1e-9)
            << static_cast<int>(cut) << ' ' << unit << ' ' << far;
      };
      const ZooMesh ordinary = in_units(cells, 1, 1024, 5);
      for (const double unit : {1.0, 0x1p-600, 0x1p-1000, 0x1p-1074})
        expect_truth(unit, 1024 * unit, ordinary);
    }
}

// Where some nodes have values of order 1 and the others denormal ones, these are as good as the
// smallest that are not.
TEST(Isosurfaces, OfDenormalValuesBesideOthersMissNothing) {
  for (const auto cut : {Cut::tetrahedra, Cut::prisms, Cut::bricks})
    for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
      Scene scene = cube_scene(projection, 30, 26);
      scene.volume = {};
      scene.isosurfaces = {surface_of("f", 0, {1, 1, 1}, 0.5)};
      const ZooMesh cells = test::moved(test::structured(2, cut), test::sheared);
      const Image expected = draw(in_units(cells, 0x1p-150, 0.03, 6), scene).image;
      for (const double unit : {0x1p-600, 0x1p-1000, 0x1p-1074}) {
        const Image found = draw(in_units(cells, unit, 0.03, 6), scene).image;
        double largest = 0;
        for (std::size_t i = 0; i < found.values().size(); ++i)
          largest = std::max(largest, std::abs(found.values()[i] - expected.values()[i]));
        EXPECT_LE(largest, 1e-9) << static_cast<int>(cut) << ' ' << unit;
      }
    }
}

// Fields with jumps: a surface in every cell whose corners' values lie around it, none between.
TEST(Isosurfaces, NothingIsDrawnAtJumps) {
  ZooMesh mesh = test::structured(4, Cut::bricks);
  std::vector<double> cells;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
    cells.push_back(static_cast<double>(cell / 16));
  mesh.fields = {Field{"f", "", FieldLocation::cell, 1, std::move(cells)}};
  Scene scene = cube_scene(Projection::perspective, 16, 16);
  scene.volume = {};
  scene.isosurfaces = {surface_of("f", 1.5, {1, 1, 1}, 0.5)};
  const RenderResult result = draw(mesh, scene);
  for (const double value : result.image.values()) ASSERT_EQ(value, 0);
}

// Surfaces at one depth follow one another as in the scene.
TEST(Isosurfaces, CoincidentSurfacesAreInTheScenesOrder) {
  for (const Cut cut : {Cut::tetrahedra, Cut::bricks}) {
    ZooMesh mesh = test::structured(3, cut);
    test::add_node_field(mesh, "f", [](const Position& p) { return p[0] + p[2]; });
    Scene scene = cube_scene(Projection::perspective, 16, 16);
    scene.volume = {};
    scene.isosurfaces = {surface_of("f", 1.1, {1, 0, 0}, 1), surface_of("f", 1.1, {0, 1, 0}, 1)};
    for (Isosurface& surface : scene.isosurfaces) surface.specular = 0;
    const RenderResult result = draw(mesh, scene);
    std::size_t hit = 0;
    for (std::uint32_t y = 0; y < 16; ++y)
      for (std::uint32_t x = 0; x < 16; ++x) {
        ASSERT_EQ(result.image.at(x, y, 1), 0);
        hit += result.image.at(x, y, 0) > 0 ? 1 : 0;
      }
    EXPECT_GT(hit, 20U);
  }
}

// As one group, in any order, and with any number of threads, the image is the same.
TEST(Isosurfaces, GroupsAndThreadsGiveTheSameImage) {
  ZooMesh mesh = test::moved(test::mixed_columns(2), test::tapered);
  test::add_random_field(mesh, "f", FieldLocation::node, 25);
  Scene scene = cube_scene(Projection::perspective, 70, 60);
  add_surfaces(scene, "f");
  VisibilityOrder group;
  std::vector<CellId> cells(mesh.cell_count());
  std::iota(cells.rbegin(), cells.rend(), CellId{0});
  group.groups = std::vector<CellGroup>{{0, static_cast<std::uint32_t>(cells.size())}};
  group.cells = std::move(cells);
  const RenderResult sorted = draw(mesh, scene), grouped = render(mesh, group, scene, false);
  const ThreadLimit limit(1);
  const RenderResult alone = draw(mesh, scene);
  for (std::size_t i = 0; i < sorted.image.values().size(); ++i) {
    ASSERT_NEAR(sorted.image.values()[i], grouped.image.values()[i], 1e-13);
    ASSERT_EQ(sorted.image.values()[i], alone.image.values()[i]);
  }
}

}  // namespace
}  // namespace hiac
