#include "hiac/render/cells/general_cells.hpp"

#include <cmath>
#include <mutex>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/base/parallel.hpp"
#include "hiac/frame/renderable.hpp"
#include "tests/render/truth/general_meshes.hpp"
#include "tests/render/truth/polyhedron_reference.hpp"
#include "tests/support/reference.hpp"

namespace hiac {
namespace {

using test::cube_scene;
using test::Cut;
using test::draw;

// The largest difference of any channel from a brute-force reference(x, y).
template <typename Reference>
double largest_error(const Image& image, const Scene& scene, const Reference& reference) {
  double largest = 0;
  std::mutex mutex;
  parallel_for(scene.image.height, 1, [&](IndexRange rows) {
    const auto y = static_cast<std::uint32_t>(rows.begin);
    double in_row = 0;
    for (std::uint32_t x = 0; x < scene.image.width; ++x) {
      const std::array<double, 4> expected = reference(x, y);
      for (std::size_t c = 0; c < 4; ++c)
        in_row = std::max(in_row, std::abs(expected[c] - image.at(x, y, c)));
    }
    const std::lock_guard lock(mutex);
    largest = std::max(largest, in_row);
  });
  return largest;
}

// Renders, and compares with the brute force for polyhedra.
double error_of(const ZooMesh& mesh, const Scene& scene, std::uint64_t least_covered = 14) {
  check_renderable(mesh, scene);
  const RenderResult result = draw(mesh, scene);
  EXPECT_EQ(result.statistics.violations, 0U);
  EXPECT_GE(result.statistics.covered_pixels, least_covered);
  return largest_error(result.image, scene, [&](std::uint32_t x, std::uint32_t y) {
    return test::polyhedron_reference(mesh, scene, x + 0.5, y + 0.5);
  });
}

struct NamedMesh {
  const char* name;
  ZooMesh mesh;
};

std::vector<NamedMesh> meshes() {
  return {{"bricks", test::structured(2, Cut::bricks)},
          {"prisms", test::structured(2, Cut::prisms)},
          {"pyramids", test::structured(1, Cut::pyramids)},
          {"wedges", test::two_wedges()},
          {"mixed", test::mixed_columns(2)}};
}

TEST(GeneralCells, AffineCellsAgreeWithBruteForce) {
  for (auto& [name, straight] : meshes()) {
    ZooMesh mesh = test::moved(straight, test::sheared);
    test::add_random_field(mesh, "f", FieldLocation::node, 3);
    for (const Projection projection : {Projection::orthographic, Projection::perspective})
      EXPECT_LE(error_of(mesh, cube_scene(projection, 9, 8)), 1e-11)
          << name << " perspective " << (projection == Projection::perspective);
  }
}

TEST(GeneralCells, CellsThatAreNotAffineAgreeWithBruteForce) {
  for (auto& [name, straight] : meshes()) {
    ZooMesh mesh = test::moved(straight, test::tapered);
    test::add_random_field(mesh, "f", FieldLocation::node, 4);
    for (const Projection projection : {Projection::orthographic, Projection::perspective})
      EXPECT_LE(error_of(mesh, cube_scene(projection, 9, 8)), 1e-11)
          << name << " perspective " << (projection == Projection::perspective);
  }
}

TEST(GeneralCells, FieldsOfEveryLocationAndSeparateFieldsAgreeWithBruteForce) {
  ZooMesh mesh = test::moved(test::mixed_columns(1), test::tapered);
  test::add_node_field(mesh, "linear", [](const test::Position& p) {
    return 0.4 + 0.5 * p[0] - 0.3 * p[1] + 0.2 * p[2];
  });
  test::add_random_field(mesh, "node", FieldLocation::node, 5);
  test::add_random_field(mesh, "cell", FieldLocation::cell, 6);
  test::add_random_field(mesh, "corner", FieldLocation::corner, 7);
  for (const Glow glow : {Glow::chromaticity, Glow::emission})
    for (const auto& [color, extinction] : {std::pair{"linear", "linear"},
                                            {"node", "corner"},
                                            {"cell", "node"},
                                            {"corner", "cell"}}) {
      Scene scene = cube_scene(Projection::perspective, 8, 8);
      scene.volume.glow = glow;
      scene.volume.color->field = color;
      scene.volume.extinction->field = extinction;
      EXPECT_LE(error_of(mesh, scene), 1e-11)
          << color << " " << extinction << " emission " << (glow == Glow::emission);
    }
}

TEST(GeneralCells, WithoutColorOrExtinctionAgreesWithBruteForce) {
  ZooMesh mesh = test::moved(test::two_wedges(), test::tapered);
  test::add_random_field(mesh, "f", FieldLocation::node, 8);
  Scene scene = cube_scene(Projection::perspective, 8, 8);
  scene.volume.color.reset();
  EXPECT_LE(error_of(mesh, scene), 1e-11);
  scene = cube_scene(Projection::perspective, 8, 8);
  scene.volume.extinction.reset();
  scene.volume.glow = Glow::emission;
  EXPECT_LE(error_of(mesh, scene), 1e-11);
}

TEST(GeneralCells, ClippingSlabAgreesWithBruteForce) {
  ZooMesh mesh = test::moved(test::mixed_columns(1), test::tapered);
  test::add_random_field(mesh, "f", FieldLocation::node, 9);
  for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
    Scene scene = cube_scene(projection, 9, 8);
    scene.camera.clip = {3.6, 4.1};
    EXPECT_LE(error_of(mesh, scene, 10), 1e-11);
  }
}

// What the methods are wrong by on a coarse mesh, and that they are not the exact one.
TEST(GeneralCells, OtherIntegrationsAreNearTheExactOne) {
  ZooMesh mesh = test::moved(test::mixed_columns(2), test::tapered);
  test::add_node_field(mesh, "f", test::smooth_field);
  for (const Glow glow : {Glow::chromaticity, Glow::emission})
    for (const auto& [integration, near] : {std::pair{Integration::gauss5, 1e-7},
                                            {Integration::approximate, 0.05},
                                            {Integration::approximate_unsliced, 0.1}}) {
      Scene scene = cube_scene(Projection::perspective, 16, 14);
      scene.volume.glow = glow;
      const Image exact = draw(mesh, scene).image;
      scene.render.integration = integration;
      check_renderable(mesh, scene);
      const Image other = draw(mesh, scene).image;
      double largest = 0;
      for (std::size_t i = 0; i < exact.values().size(); ++i)
        largest = std::max(largest, std::abs(exact.values()[i] - other.values()[i]));
      EXPECT_LE(largest, near) << static_cast<int>(integration);
      EXPECT_GT(largest, near * 1e-6) << static_cast<int>(integration);
    }
}

// The eye inside the mesh: cells beside and behind it.
TEST(GeneralCells, EyeInsideAgreesWithBruteForce) {
  for (auto& [name, straight] : meshes()) {
    ZooMesh mesh = test::moved(straight, test::tapered);
    test::add_random_field(mesh, "f", FieldLocation::node, 10);
    Scene scene = cube_scene(Projection::perspective, 9, 8);
    scene.camera.eye = test::tapered({0.31, 0.42, 0.37});
    scene.camera.look_at = {0.9, 0.3, 0.5};
    scene.camera.fov = 100;
    EXPECT_LE(error_of(mesh, scene, 72), 1e-11) << name;
  }
}

TEST(GeneralCells, EyeInsideDelaunayAgreesWithBruteForce) {
  ZooMesh mesh = test::random_delaunay(60, 1);
  test::add_node_field(mesh, "f", test::smooth_field);
  for (const double fov : {60.0, 140.0}) {
    Scene scene = cube_scene(Projection::perspective, 32, 24);
    scene.camera.eye = {0.43, 0.52, 0.61};
    scene.camera.look_at = {0.9, 0.1, 0.3};
    scene.camera.fov = fov;
    const RenderResult result = draw(mesh, scene);
    EXPECT_EQ(result.statistics.violations, 0U);
    EXPECT_LE(largest_error(result.image, scene,
                            [&](std::uint32_t x, std::uint32_t y) {
                              return test::reference_pixel(mesh, scene, x, y);
                            }),
              1e-12);
  }
}

// A brick of which an edge is a single node is a prism, and interpolated like one.
TEST(GeneralCells, BricksWithRepeatedNodesAreDrawn) {
  const std::vector<test::Position> positions{{0, 0, 0}, {1, 0, 0}, {0.2, 0.9, 0},
                                              {0, 0, 1}, {1, 0, 1}, {0.2, 0.9, 1}};
  ZooMesh brick = test::make_mesh(positions, {{CellKind::brick8, {0, 1, 2, 2, 3, 4, 5, 5}}});
  test::add_random_field(brick, "f", FieldLocation::node, 13);
  const Scene scene = cube_scene(Projection::perspective, 24, 20);
  check_renderable(brick, scene);
  const RenderResult result = draw(brick, scene);
  ZooMesh prism = test::make_mesh(positions, {{CellKind::prism6, {0, 2, 1, 3, 5, 4}}});
  prism.fields = brick.fields;
  EXPECT_LE(largest_error(result.image, scene,
                          [&](std::uint32_t x, std::uint32_t y) {
                            return test::polyhedron_reference(prism, scene, x + 0.5, y + 0.5);
                          }),
            1e-11);
}

// A cell without volume adds nothing.
TEST(GeneralCells, FlatCellsAddNothing) {
  const auto flat = [](const test::Position& p) { return test::Position{p[0], p[1], 0.5}; };
  for (const Cut cut : {Cut::bricks, Cut::prisms, Cut::pyramids}) {
    ZooMesh mesh = test::moved(test::structured(1, cut), flat);
    test::add_random_field(mesh, "f", FieldLocation::node, 14);
    for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
      const Scene scene = cube_scene(projection, 24, 20);
      EXPECT_LE(largest_error(draw(mesh, scene).image, scene,
                              [](std::uint32_t, std::uint32_t) { return std::array<double, 4>{}; }),
                1e-13);
    }
  }
}

// As one group, in any order, the image is the same.
TEST(GeneralCells, GroupsGiveTheSameImage) {
  ZooMesh mesh = test::moved(test::mixed_columns(2), test::tapered);
  test::add_random_field(mesh, "f", FieldLocation::node, 11);
  const Scene scene = cube_scene(Projection::perspective, 40, 30);
  VisibilityOrder group;
  std::vector<CellId> cells(mesh.cell_count());
  std::iota(cells.rbegin(), cells.rend(), CellId{0});
  group.groups = std::vector<CellGroup>{{0, static_cast<std::uint32_t>(cells.size())}};
  group.cells = std::move(cells);
  const RenderResult sorted = draw(mesh, scene), grouped = render(mesh, group, scene, false);
  EXPECT_EQ(grouped.statistics.violations, 0U);
  EXPECT_EQ(grouped.statistics.segments, sorted.statistics.segments);
  EXPECT_LE(largest_error(grouped.image, scene,
                          [&](std::uint32_t x, std::uint32_t y) {
                            const auto p = sorted.image.pixel(x, y);
                            return std::array{p[0], p[1], p[2], p[3]};
                          }),
            1e-13);
}

TEST(GeneralCells, ThreadsDoNotMatter) {
  ZooMesh mesh = test::moved(test::mixed_columns(2), test::tapered);
  test::add_random_field(mesh, "f", FieldLocation::node, 12);
  const Scene scene = cube_scene(Projection::perspective, 100, 80);
  const RenderResult many = draw(mesh, scene);
  const ThreadLimit limit(1);
  const RenderResult one = draw(mesh, scene);
  EXPECT_EQ(largest_error(many.image, scene,
                          [&](std::uint32_t x, std::uint32_t y) {
                            const auto p = one.image.pixel(x, y);
                            return std::array{p[0], p[1], p[2], p[3]};
                          }),
            0);
}

}  // namespace
}  // namespace hiac
