#include "hiac/render/walk/walked_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "hiac/base/parallel.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/render/engine.hpp"
#include "hiac/scene/view_of.hpp"
#include "tests/benchmarks/cube_scene.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/reference.hpp"

namespace hiac {
namespace {

Scene walked_scene(Projection projection, std::uint32_t width, std::uint32_t height) {
  Scene scene = cube_scene(width);
  scene.image.height = height;
  scene.camera.projection = projection;
  scene.render.tolerance = 1e-15;
  return scene;
}

std::optional<RenderResult> walked(const ZooMesh& mesh, const Scene& scene,
                                   bool background = false) {
  const FaceAdjacency adjacency = build_face_adjacency(mesh);
  const auto walkable = WalkableMesh::of(mesh, adjacency);
  if (!walkable) return std::nullopt;
  const MeshEdges edges = scene.edges ? mesh_edges(mesh, *scene.edges) : MeshEdges{};
  return walked_picture(*walkable, scene, scene.edges ? &edges : nullptr, background);
}

RenderResult ordered(const ZooMesh& mesh, const Scene& scene, bool background = false) {
  const VisibilityOrder order =
      exact_order(mesh, build_face_adjacency(mesh), view_of(scene.camera), scene.render.planarity)
          .order;
  return render(mesh, order, scene, background);
}

double largest_difference(const Image& a, const Image& b) {
  double largest = 0;
  for (std::size_t k = 0; k < a.values().size(); ++k)
    largest = std::max(largest, std::abs(a.values()[k] - b.values()[k]));
  return largest;
}

// Pictures that differ by rounding, and what was counted.
void expect_same_picture(const ZooMesh& mesh, const Scene& scene, const std::string& what) {
  const auto rays = walked(mesh, scene);
  ASSERT_TRUE(rays.has_value()) << what;
  const RenderResult order = ordered(mesh, scene);
  EXPECT_LE(largest_difference(rays->image, order.image), 1e-12) << what;
  EXPECT_EQ(rays->statistics.violations, 0U) << what;
  EXPECT_EQ(rays->statistics.covered_pixels, order.statistics.covered_pixels) << what;
  EXPECT_EQ(rays->statistics.segments, order.statistics.segments) << what;
  EXPECT_NEAR(rays->statistics.mean_optical_depth, order.statistics.mean_optical_depth, 1e-12)
      << what;
  EXPECT_NEAR(rays->statistics.largest_optical_depth, order.statistics.largest_optical_depth, 1e-11)
      << what;
  EXPECT_GT(rays->statistics.covered_pixels, 100U) << what;
}

ZooMesh random_mesh(std::size_t points, std::uint64_t seed) {
  ZooMesh mesh = test::random_delaunay(points, seed);
  test::add_node_field(mesh, "f", test::smooth_field);
  return mesh;
}

ZooMesh lattice(std::size_t n) {
  ZooMesh mesh = test::structured(n, test::Cut::tetrahedra);
  test::add_node_field(mesh, "f", test::smooth_field);
  return mesh;
}

constexpr std::array kProjections{Projection::orthographic, Projection::perspective};

TEST(WalkedPicture, AgreesWithBruteForce) {
  const ZooMesh mesh = random_mesh(60, 1);
  for (const Projection projection : kProjections)
    for (const Glow glow : {Glow::chromaticity, Glow::emission}) {
      Scene scene = walked_scene(projection, 48, 40);
      scene.volume.glow = glow;
      const auto result = walked(mesh, scene);
      ASSERT_TRUE(result.has_value());
      for (std::uint32_t y = 0; y < scene.image.height; ++y)
        for (std::uint32_t x = 0; x < scene.image.width; ++x) {
          const auto expected = test::reference_pixel(mesh, scene, x, y);
          for (std::size_t c = 0; c < 4; ++c)
            ASSERT_NEAR(result->image.at(x, y, c), expected[c], 1e-12) << x << ' ' << y;
        }
      expect_same_picture(mesh, scene, "random tetrahedra");
    }
}

TEST(WalkedPicture, IsTheSameWithEveryInstructionSet) {
  const ZooMesh mesh = random_mesh(200, 2);
  test::for_each_instruction_set([&](const std::string& name) {
    for (const Projection projection : kProjections)
      expect_same_picture(mesh, walked_scene(projection, 90, 70), name);
  });
}

TEST(WalkedPicture, DoesNotDependOnTheNumberOfThreads) {
  const ZooMesh mesh = random_mesh(300, 3);
  const Scene scene = walked_scene(Projection::perspective, 200, 150);
  const ThreadLimit one(1);
  const auto alone = walked(mesh, scene, true);
  ASSERT_TRUE(alone.has_value());
  const ThreadLimit four(4);
  const auto together = walked(mesh, scene, true);
  EXPECT_TRUE(std::ranges::equal(alone->image.values(), together->image.values()));
  EXPECT_EQ(alone->statistics.segments, together->statistics.segments);
  EXPECT_LE(largest_difference(alone->image, ordered(mesh, scene, true).image), 1e-12);
}

// Rays through nodes and along edges and faces: pixels' centres on the lattice of the mesh.
TEST(WalkedPicture, RaysAlongFacesAndThroughNodesLoseNothing) {
  const ZooMesh mesh = lattice(8);
  for (const auto& [eye, up] :
       std::initializer_list<std::pair<std::array<double, 3>, std::array<double, 3>>>{
           {{0.5, 0.5, 5}, {0, 1, 0}},
           {{5, 0.5, 0.5}, {0, 0, 1}},
           {{0.5, -4, 0.5}, {1, 0, 0}},
           {{5, 5, 0.5}, {0, 0, 1}},
           {{4, 4, 4}, {0, 0, 1}}}) {
    for (const double height : {41.0 / 32, 41.0 / 16, 1.3}) {
      Scene scene = walked_scene(Projection::orthographic, 41, 41);
      scene.camera.eye = eye;
      scene.camera.look_at = {0.5, 0.5, 0.5};
      scene.camera.up = up;
      scene.camera.height = height;
      // constant extinction: transparency is that of the cube's thickness at the pixel
      scene.volume.extinction->points = {{0, {0.7}}};
      const auto rays = walked(mesh, scene);
      ASSERT_TRUE(rays.has_value());
      EXPECT_EQ(rays->statistics.violations, 0U);
      EXPECT_LE(largest_difference(rays->image, ordered(mesh, scene).image), 1e-12)
          << eye[0] << ' ' << eye[1] << ' ' << eye[2] << ", height " << height;
      EXPECT_GT(rays->statistics.covered_pixels, 100U);
    }
  }
}

// Diagonals through pixels' centres to within rounding: the sign of a rounded area is often wrong.
TEST(WalkedPicture, RaysThatRoundingPutsOnEdgesLoseNothing) {
  // the lattice turned so that the diagonals of its squares, of five pixels, meet in centres
  ZooMesh mesh =
      test::moved(test::structured(7, test::Cut::tetrahedra), [](const test::Position& p) {
        const double x = p[0] - 0.5, y = p[1] - 0.5;
        return test::Position{0.5 + 0.6 * x - 0.8 * y, 0.5 + 0.8 * x + 0.6 * y, p[2]};
      });
  test::add_node_field(mesh, "f", test::smooth_field);
  for (const double z : {5.0, -4.0})
    for (const double turned : {0.0, 1.0}) {
      Scene scene = walked_scene(Projection::orthographic, 41, 41);
      scene.camera.eye = {0.5, 0.5, z};
      scene.camera.look_at = {0.5, 0.5, 0.5};
      scene.camera.up = {turned, 1 - turned, 0};
      scene.camera.height = 41.0 / 35;
      const auto colored = walked(mesh, scene);
      ASSERT_TRUE(colored.has_value());
      EXPECT_EQ(colored->statistics.violations, 0U);
      EXPECT_LE(largest_difference(colored->image, ordered(mesh, scene).image), 1e-12);
      scene.volume.extinction->points = {{0, {0.7}}};
      const auto rays = walked(mesh, scene);
      ASSERT_TRUE(rays.has_value());
      EXPECT_NEAR(rays->image.at(20, 20, 3), 1 - std::exp(-0.7), 1e-14);
      EXPECT_NEAR(rays->image.at(23, 24, 3), 1 - std::exp(-0.7), 1e-14);
    }
}

// Hollow, in parts that touch in faces or do not, and one part behind another.
TEST(WalkedPicture, RaysThatEnterAMeshSeveralTimesTakeTheirWaysByDepth) {
  const auto with_field = [](ZooMesh mesh) {
    mesh.fields.clear();
    test::add_node_field(mesh, "f", test::smooth_field);
    return mesh;
  };
  const ZooMesh whole = random_mesh(150, 5);
  const ZooMesh hollow = test::keep_cells(whole, [](const test::Position& p, CellId cell) {
    const double x = p[0] - 0.5, y = p[1] - 0.5, z = p[2] - 0.5;
    return x * x + y * y + z * z > 0.09 && cell % 7 != 0;
  });
  const ZooMesh moved = test::moved(hollow, [](const test::Position& p) {
    return test::Position{p[0] - 0.2, p[1] + 1.25, p[2]};
  });
  const ZooMesh touching = test::moved(lattice(3), [](const test::Position& p) {
    return test::Position{p[0], p[1], p[2] + 1};
  });
  for (const Projection projection : kProjections) {
    Scene scene = walked_scene(projection, 80, 60);
    expect_same_picture(with_field(hollow), scene, "hollow");
    scene.camera.eye = {0.6, -6, 0.7};
    scene.camera.fov = 30;
    expect_same_picture(with_field(test::side_by_side(hollow, moved)), scene,
                        "one behind the other");
    expect_same_picture(with_field(test::side_by_side(touching, lattice(2))), scene, "touching");
  }
}

TEST(WalkedPicture, StepsAndManyBreakpointsAreCut) {
  const ZooMesh mesh = random_mesh(80, 6);
  Scene scene = walked_scene(Projection::perspective, 60, 50);
  scene.volume.color->points = {
      {0.3, {1, 0, 0}}, {0.3, {0, 1, 0}}, {0.6, {0, 0, 1}}, {0.6, {1, 1, 0}}};
  scene.volume.extinction->points = {{0.2, {0}},  {0.2, {5}},  {0.4, {0}},
                                     {0.52, {0}}, {0.52, {9}}, {0.7, {1}}};
  expect_same_picture(mesh, scene, "steps");
  scene.volume.extinction->points.clear();
  for (int k = 0; k <= 400; ++k)
    scene.volume.extinction->points.push_back({k / 400.0, {k % 2 == 0 ? 1.0 : 3.0}});
  expect_same_picture(mesh, scene, "many");
}

// Steps are continuous from the right.
TEST(WalkedPicture, AFieldOnAStepHasTheValueBehindIt) {
  ZooMesh mesh = test::random_delaunay(40, 11);
  test::add_node_field(mesh, "f", [](const test::Position&) { return 0.5; });
  Scene scene = walked_scene(Projection::orthographic, 30, 30);
  scene.volume.extinction->points = {{0.5, {0.1}}, {0.5, {3}}};
  expect_same_picture(mesh, scene, "on a step");
}

// Rays come to the step from both sides and go on along it.
TEST(WalkedPicture, APlateauOnAStepHasTheValueBehindIt) {
  const std::array<double (*)(const test::Position&), 4> fields{
      [](const test::Position& p) { return std::min(p[0], 0.5); },
      [](const test::Position& p) { return std::min(1 - p[0], 0.5); },
      [](const test::Position& p) { return std::max(p[0], 0.5); },
      [](const test::Position& p) { return std::max(1 - p[0], 0.5); }};
  for (std::size_t n = 0; n < fields.size(); ++n) {
    ZooMesh mesh = test::random_delaunay(300, 12);
    test::add_node_field(mesh, "f", fields[n]);
    Scene scene = walked_scene(Projection::orthographic, 30, 30);
    scene.volume.extinction->points = {{0.5, {0.1}}, {0.5, {3}}};
    expect_same_picture(mesh, scene, "plateau " + std::to_string(n));
  }
}

// Segments that pass a breakpoint between empty intervals are those of empty cells.
TEST(WalkedPicture, EmptySpaceOfSeveralIntervalsIsNotMet) {
  const ZooMesh mesh = random_mesh(300, 13);
  Scene scene = walked_scene(Projection::perspective, 50, 50);
  scene.volume.extinction->points = {{0, {0}},   {0.3, {0}}, {0.4, {0}}, {0.45, {0}},
                                     {0.5, {0}}, {0.5, {2}}, {0.7, {0}}, {0.8, {0}}};
  const auto rays = walked(mesh, scene);
  ASSERT_TRUE(rays.has_value());
  expect_same_picture(mesh, scene, "empty");
  scene.volume.extinction->points = {{0, {1}}};
  EXPECT_LT(rays->statistics.segments,
            0.8 * static_cast<double>(walked(mesh, scene)->statistics.segments));
}

// Where nothing more is seen, rays end: fewer segments, the same picture.
TEST(WalkedPicture, RaysEndInOpaqueMedia) {
  const ZooMesh mesh = random_mesh(400, 7);
  Scene scene = walked_scene(Projection::orthographic, 60, 60);
  const std::uint64_t all = walked(mesh, scene)->statistics.segments;
  for (auto& point : scene.volume.extinction->points) point.value[0] = 100;
  scene.render.tolerance = 1e-6;
  const auto rays = walked(mesh, scene);
  ASSERT_TRUE(rays.has_value());
  EXPECT_LE(largest_difference(rays->image, ordered(mesh, scene).image), 1e-6);
  EXPECT_LT(rays->statistics.segments, all / 2);
  EXPECT_GT(rays->statistics.segments, rays->statistics.covered_pixels);
}

TEST(WalkedPicture, FieldsFarFromZeroKeepTheirDigits) {
  ZooMesh mesh = test::random_delaunay(80, 8);
  test::add_node_field(mesh, "f",
                       [](const test::Position& p) { return 1e7 + test::smooth_field(p); });
  Scene scene = walked_scene(Projection::perspective, 50, 40);
  for (auto& point : scene.volume.color->points) point.scalar += 1e7;
  for (auto& point : scene.volume.extinction->points) point.scalar += 1e7;
  const auto rays = walked(mesh, scene);
  ASSERT_TRUE(rays.has_value());
  // an ulp of the field is 2e-9 of its range
  EXPECT_LE(largest_difference(rays->image, ordered(mesh, scene).image), 2e-8);
}

// On the faces of the boundary and inside, and beside the mesh.
TEST(WalkedPicture, EdgesLieWhereTheyLieInTheOrder) {
  ZooMesh hollow = test::keep_cells(random_mesh(60, 10), [](const test::Position& p, CellId) {
    return std::abs(p[0] - 0.5) > 0.15 || std::abs(p[1] - 0.5) > 0.15;
  });
  test::add_node_field(hollow, "f", test::smooth_field);
  for (const Projection projection : kProjections)
    for (const EdgeChoice show : {EdgeChoice::feature, EdgeChoice::boundary, EdgeChoice::all})
      for (const double opacity : {1.0, 0.4}) {
        Scene scene = walked_scene(projection, 90, 70);
        scene.edges =
            Edges{.show = show, .width = 2.5, .color = {0.1, 0.8, 0.3}, .opacity = opacity};
        expect_same_picture(hollow, scene, "edges");
      }
}

TEST(WalkedPicture, IsNotMadeOfWhatRaysCannotFollow) {
  ZooMesh mesh = random_mesh(40, 9);
  test::add_node_field(mesh, "g", [](const test::Position& p) { return p[0]; });
  Field of_cells{"c", "", FieldLocation::cell, 1, std::vector<double>(mesh.cell_count(), 0.5)};
  mesh.fields.push_back(of_cells);
  const Scene good = walked_scene(Projection::perspective, 20, 20);
  ASSERT_TRUE(walked(mesh, good).has_value());
  const auto refused = [&](const std::function<void(Scene&)>& change) {
    Scene scene = good;
    change(scene);
    return !walked(mesh, scene).has_value();
  };
  EXPECT_TRUE(refused([](Scene& s) { s.isosurfaces.push_back({.field = "f", .value = 0.5}); }));
  EXPECT_TRUE(refused([](Scene& s) { s.skin.emplace(); }));
  EXPECT_TRUE(refused([](Scene& s) { s.camera.clip = {{1.0, 2.0}}; }));
  EXPECT_TRUE(refused([](Scene& s) { s.render.splat_below = 2; }));
  EXPECT_TRUE(refused([](Scene& s) { s.render.integration = Integration::gauss5; }));
  EXPECT_TRUE(refused([](Scene& s) { s.volume.color->field = std::string("g"); }));
  EXPECT_TRUE(refused([](Scene& s) {
    s.volume.color->field = std::string("c");
    s.volume.extinction->field = std::string("c");
  }));
  EXPECT_TRUE(refused([](Scene& s) { s.camera.eye = {0.5, 0.5, 0.4}; }));
  // the same eye sees all nodes in parallel projection
  EXPECT_FALSE(refused([](Scene& s) {
    s.camera.eye = {0.5, 0.5, 0.4};
    s.camera.projection = Projection::orthographic;
  }));
}

}  // namespace
}  // namespace hiac
