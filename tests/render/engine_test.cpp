#include "hiac/render/engine.hpp"

#include <cmath>
#include <cstring>
#include <random>

#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/base/parallel.hpp"
#include "hiac/mesh/cell_kind.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "hiac/scene/view_of.hpp"
#include "tests/benchmarks/cube_scene.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/reference.hpp"

namespace hiac {
namespace {

using test::Cut;

Scene scene_of(Projection projection, std::uint32_t width, std::uint32_t height) {
  Scene scene = cube_scene(width);
  scene.image.height = height;
  scene.camera.projection = projection;
  scene.render.tolerance = 1e-15;
  return scene;
}

OrderResult order_of_scene(const ZooMesh& mesh, const Scene& scene) {
  const View view = view_of(scene.camera);
  return exact_order(mesh, build_face_adjacency(mesh), view, scene.render.planarity);
}

RenderResult draw(const ZooMesh& mesh, const Scene& scene) {
  return render(mesh, order_of_scene(mesh, scene).order, scene, false);
}

// The largest difference of any channel from the brute-force reference.
double largest_error(const ZooMesh& mesh, const Scene& scene, const Image& image,
                     std::uint32_t step = 1) {
  double largest = 0;
  for (std::uint32_t y = 0; y < scene.image.height; y += step)
    for (std::uint32_t x = 0; x < scene.image.width; x += step) {
      const auto expected = test::reference_pixel(mesh, scene, x, y);
      for (std::size_t c = 0; c < 4; ++c)
        largest = std::max(largest, std::abs(expected[c] - image.at(x, y, c)));
    }
  return largest;
}

ZooMesh delaunay_with_fields(std::size_t points, std::uint64_t seed) {
  ZooMesh mesh = test::random_delaunay(points, seed);
  test::add_node_field(mesh, "f", test::smooth_field);
  test::add_node_field(
      mesh, "g", [](const test::Position& p) { return 0.5 * (p[0] * p[0] + p[1] * (1 - p[2])); });
  return mesh;
}

TEST(Engine, DelaunayAgreesWithBruteForce) {
  const ZooMesh mesh = delaunay_with_fields(60, 1);
  for (const Projection projection : {Projection::orthographic, Projection::perspective})
    for (const Glow glow : {Glow::chromaticity, Glow::emission})
      for (const bool separate : {false, true}) {
        Scene scene = scene_of(projection, 48, 40);
        scene.volume.glow = glow;
        if (separate) scene.volume.color->field = std::string("g");
        const RenderResult result = draw(mesh, scene);
        EXPECT_EQ(result.statistics.violations, 0U);
        EXPECT_GT(result.statistics.covered_pixels, 500U);
        EXPECT_LE(largest_error(mesh, scene, result.image), 1e-12)
            << "perspective " << (projection == Projection::perspective) << " emission "
            << (glow == Glow::emission) << " separate " << separate;
      }
}

TEST(Engine, EveryInstructionSetAgreesWithBruteForce) {
  const ZooMesh mesh = delaunay_with_fields(40, 2);
  test::for_each_instruction_set([&](const std::string& name) {
    for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
      const Scene scene = scene_of(projection, 60, 50);
      EXPECT_LE(largest_error(mesh, scene, draw(mesh, scene).image, 3), 1e-12) << name;
    }
  });
}

TEST(Engine, StepsInTransferFunctionsAgreeWithBruteForce) {
  const ZooMesh mesh = delaunay_with_fields(60, 2);
  Scene scene = scene_of(Projection::perspective, 40, 40);
  scene.volume.color->points = {
      {0.3, {1, 0, 0}}, {0.3, {0, 1, 0}}, {0.6, {0, 0, 1}}, {0.6, {1, 1, 0}}};
  scene.volume.extinction->points = {{0.2, {0}},  {0.2, {5}},  {0.4, {0}},
                                     {0.52, {0}}, {0.52, {9}}, {0.7, {1}}};
  EXPECT_LE(largest_error(mesh, scene, draw(mesh, scene).image), 1e-12);
}

TEST(Engine, OtherIntegrationsAgreeWithTheirDefinitions) {
  const ZooMesh mesh = delaunay_with_fields(40, 10);
  for (const Integration integration :
       {Integration::gauss5, Integration::approximate, Integration::approximate_unsliced})
    for (const Glow glow : {Glow::chromaticity, Glow::emission})
      for (const char* color : {"f", "g"}) {
        Scene scene = scene_of(Projection::perspective, 20, 18);
        scene.render.integration = integration;
        scene.volume.glow = glow;
        scene.volume.color->field = std::string(color);
        for (auto& point : scene.volume.extinction->points) point.value[0] *= 4;
        scene.isosurfaces.resize(1);
        scene.isosurfaces[0].field = std::string("g");
        scene.isosurfaces[0].value = 0.3;
        scene.isosurfaces[0].opacity = 0.3;
        EXPECT_LE(largest_error(mesh, scene, draw(mesh, scene).image), 1e-12)
            << static_cast<int>(integration) << " emission " << (glow == Glow::emission) << color;
        // cells beside the eye
        scene.camera.eye = {0.43, 0.52, 0.61};
        scene.camera.fov = 100;
        scene.image = {10, 9};
        EXPECT_LE(largest_error(mesh, scene, draw(mesh, scene).image), 1e-12)
            << static_cast<int>(integration) << " emission " << (glow == Glow::emission) << color;
      }
}

TEST(Engine, ClippingSlabAgreesWithBruteForce) {
  const ZooMesh mesh = delaunay_with_fields(60, 3);
  for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
    Scene scene = scene_of(projection, 40, 40);
    scene.camera.clip = {{3.3, 3.9}};
    const RenderResult result = draw(mesh, scene);
    EXPECT_GT(result.statistics.covered_pixels, 300U);
    EXPECT_LE(largest_error(mesh, scene, result.image), 1e-12);
  }
}

TEST(Engine, CellAndCornerFieldsAgreeWithBruteForce) {
  ZooMesh mesh = delaunay_with_fields(40, 4);
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<double> by_cell(mesh.cell_count()), by_corner(mesh.nodes.size());
  for (double& v : by_cell) v = unit(random);
  for (double& v : by_corner) v = unit(random);
  mesh.fields.push_back({"c", "", FieldLocation::cell, 1, std::move(by_cell)});
  mesh.fields.push_back({"k", "", FieldLocation::corner, 1, std::move(by_corner)});
  Scene scene = scene_of(Projection::perspective, 40, 40);
  using Names = std::pair<std::string, std::string>;
  for (const auto& [color, extinction] :
       {Names("c", "c"), Names("k", "k"), Names("c", "k"), Names("f", "c"), Names("k", "f")}) {
    scene.volume.color->field = color;
    scene.volume.extinction->field = extinction;
    EXPECT_LE(largest_error(mesh, scene, draw(mesh, scene).image), 1e-12) << color << extinction;
  }
}

// Every ray along an axis lies in faces of the lattice or runs through its edges: still, each point
// of it belongs to exactly one cell.
TEST(Engine, RaysInFacesAndEdgesMissNothing) {
  ZooMesh mesh = test::structured(8, Cut::tetrahedra);
  test::add_node_field(mesh, "f", [](const test::Position&) { return 0.5; });
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0})
      for (const std::uint32_t pixels : {8U, 16U, 24U}) {
        Scene scene = scene_of(Projection::orthographic, pixels, pixels);
        scene.camera.look_at = {0.5, 0.5, 0.5};
        scene.camera.eye = scene.camera.look_at;
        scene.camera.eye[axis] += 3 * side;
        scene.camera.up = {0, 0, 0};
        scene.camera.up[(axis + 1) % 3] = 1;
        // pixel centres on the lattice's planes: the view is moved by half a pixel
        scene.camera.height = 1;
        const double half = 0.5 / pixels;
        for (const std::size_t other : {(axis + 1) % 3, (axis + 2) % 3}) {
          scene.camera.eye[other] -= half;
          scene.camera.look_at[other] -= half;
        }
        scene.volume.extinction->points = {{0, {2.5}}};
        scene.volume.color->points = {{0, {1, 1, 1}}};
        const RenderResult result = draw(mesh, scene);
        EXPECT_EQ(result.statistics.violations, 0U);
        const double expected = 1 - std::exp(-2.5);
        std::size_t covered = 0;
        for (std::uint32_t y = 0; y < pixels; ++y)
          for (std::uint32_t x = 0; x < pixels; ++x) {
            const double alpha = result.image.at(x, y, 3);
            if (alpha == 0) continue;  // beyond the side that does not own its boundary
            ++covered;
            ASSERT_NEAR(alpha, expected, 1e-14) << axis << ' ' << side << ' ' << x << ' ' << y;
            ASSERT_NEAR(result.image.at(x, y, 0), expected, 1e-14);
          }
        EXPECT_GE(covered, (pixels - 1) * (pixels - 1));
      }
}

// Looking along an axis from the middle, diagonal faces are seen edge-on and run through centres of
// pixels: such a ray stays on one side of a face's plane from front to back, and one that is hardly
// beside the plane crosses it once.
TEST(Engine, RaysInDiagonalFacesOrHardlyBesideThem) {
  for (const Cut cut : {Cut::tetrahedra, Cut::prisms})
    for (const auto& up : {test::Position{0, 1, 0}, {1, 1, 0}, {1, 3, 0}}) {
      ZooMesh mesh = test::structured(4, cut);
      test::add_node_field(mesh, "f", test::smooth_field);
      Scene scene = scene_of(Projection::perspective, 31, 31);
      scene.camera.eye = {0.5, 0.5, 3.5};
      scene.camera.up = up;
      const RenderResult edge_on = draw(mesh, scene);
      EXPECT_EQ(edge_on.statistics.violations, 0U);
      for (const double size : {1e-5, 1e-7, 1e-12, 1e-14})
        for (const double sign : {-1, 1}) {
          SCOPED_TRACE(sign * size);
          scene.camera.eye = {0.5 + sign * size, 0.5 + 0.3 * sign * size, 3.5};
          const RenderResult beside = draw(mesh, scene);
          EXPECT_EQ(beside.statistics.violations, 0U);
          for (std::uint32_t y = 0; y < 31; ++y)
            for (std::uint32_t x = 0; x < 31; ++x)
              for (std::size_t c = 0; c < 4; ++c)
                ASSERT_NEAR(edge_on.image.at(x, y, c), beside.image.at(x, y, c), 5 * size + 1e-11);
        }
    }
}

// A row of vectors must not depend on what other pixels share a vector or a tile with it, nor on
// who draws the tile.
TEST(Engine, ThreadsDoNotChangeABit) {
  const ZooMesh mesh = delaunay_with_fields(300, 5);
  const Scene scene = scene_of(Projection::perspective, 200, 150);
  std::vector<std::vector<double>> images;
  for (const unsigned threads : {1U, 2U, 7U}) {
    const ThreadLimit limit(threads);
    const RenderResult result = draw(mesh, scene);
    images.emplace_back(result.image.values().begin(), result.image.values().end());
  }
  EXPECT_EQ(std::memcmp(images[0].data(), images[1].data(), images[0].size() * sizeof(double)), 0);
  EXPECT_EQ(std::memcmp(images[0].data(), images[2].data(), images[0].size() * sizeof(double)), 0);
}

// Whatever the order inside a group, sorting its segments pixel by pixel puts it right.
TEST(Engine, GroupsAreOrderedPixelByPixel) {
  const ZooMesh mesh = delaunay_with_fields(60, 6);
  const Scene scene = scene_of(Projection::perspective, 48, 48);
  OrderResult sorted = order_of_scene(mesh, scene);
  ASSERT_TRUE(sorted.order.groups.empty());
  std::vector<CellId> cells(sorted.order.cells.begin(), sorted.order.cells.end());
  std::vector<CellGroup> groups;
  for (std::uint32_t first = 0; first + 40 < cells.size(); first += 55)
    groups.push_back({first, 40});
  for (const CellGroup& g : groups)
    std::reverse(cells.begin() + g.first, cells.begin() + g.first + g.count);
  const VisibilityOrder grouped{std::move(cells), std::move(groups), "exact"};
  const Image expected = render(mesh, sorted.order, scene, false).image;
  const RenderResult result = render(mesh, grouped, scene, false);
  EXPECT_EQ(result.statistics.violations, 0U);
  for (std::size_t i = 0; i < expected.values().size(); ++i)
    ASSERT_NEAR(result.image.values()[i], expected.values()[i], 1e-14);
}

// The witness sees an order that is wrong.
TEST(Engine, WrongOrderIsCounted) {
  const ZooMesh mesh = delaunay_with_fields(60, 7);
  const Scene scene = scene_of(Projection::orthographic, 48, 48);
  const OrderResult sorted = order_of_scene(mesh, scene);
  std::vector<CellId> cells(sorted.order.cells.begin(), sorted.order.cells.end());
  std::swap(cells.front(), cells.back());
  EXPECT_GT(render(mesh, {std::move(cells), {}, "wrong"}, scene, false).statistics.violations, 0U);
}

// Rays stop once what lies behind could not change the picture by more than the tolerance.
TEST(Engine, EarlyTerminationStaysWithinTheTolerance) {
  const ZooMesh mesh = delaunay_with_fields(200, 8);
  Scene scene = scene_of(Projection::perspective, 64, 64);
  for (auto& point : scene.volume.extinction->points) point.value[0] *= 40;
  const RenderResult full = draw(mesh, scene);
  scene.render.tolerance = 1e-6;
  const RenderResult stopped = draw(mesh, scene);
  EXPECT_LT(stopped.statistics.segments, full.statistics.segments);
  double largest = 0;
  for (std::size_t i = 0; i < full.image.values().size(); ++i)
    largest = std::max(largest, std::abs(full.image.values()[i] - stopped.image.values()[i]));
  EXPECT_GT(largest, 0);
  EXPECT_LE(largest, 1e-6);
}

// A plate so opaque that rays end in it, which leaves out one row or column of pixels of a tile,
// before `layers` bricks as large as the picture; a cell is one brick.
struct Plate {
  ZooMesh mesh;
  Scene scene;
};

Plate plate_before(std::size_t layers, std::size_t axis, bool leaves_last) {
  constexpr double kWidth = 64, kHeight = 32;  // of a tile, and of the picture in world units
  std::vector<test::Position> positions;
  std::vector<test::Cell> cells;
  const auto add_brick = [&](const test::Position& from, const test::Position& to) {
    test::Cell cell{CellKind::brick8, {}};
    for (const auto& corner : reference_nodes(CellKind::brick8)) {
      cell.nodes.push_back(static_cast<NodeId>(positions.size()));
      test::Position p;
      for (std::size_t c = 0; c < 3; ++c) p[c] = corner[c] > 0 ? to[c] : from[c];
      positions.push_back(p);
    }
    cells.push_back(cell);
  };
  test::Position from{-1, -1, 500}, to{kWidth + 1, kHeight + 1, 501};
  (leaves_last ? to : from)[axis] = leaves_last ? (axis == 0 ? kWidth : kHeight) - 1 : 1;
  add_brick(from, to);
  for (std::size_t k = 0; k < layers; ++k) {
    const auto z = static_cast<double>(k);
    add_brick({-1, -1, 400 - z}, {kWidth + 1, kHeight + 1, 400.5 - z});
  }
  Plate plate{test::make_mesh(positions, cells), {}};
  std::vector<double> extinction(cells.size(), 0.01);
  extinction[0] = 1000;
  plate.mesh.fields.push_back({"f", "", FieldLocation::cell, 1, std::move(extinction)});
  Scene& scene = plate.scene;
  scene.image = {64, 32};
  scene.camera.projection = Projection::orthographic;
  scene.camera.look_at = {kWidth / 2, kHeight / 2, 0};
  scene.camera.eye = {kWidth / 2, kHeight / 2, 1000};
  scene.camera.up = {0, 1, 0};
  scene.camera.height = kHeight;
  scene.volume.color = ColorTransfer{"f", {{0, {1, 1, 1}}}};
  scene.volume.extinction = ExtinctionTransfer{"f", {{0, {0}}, {1000, {1000}}}};
  return plate;
}

// A tile is given up once all of its pixels are opaque: not before, whichever are the last. More
// cells are behind than the engine takes at a time.
TEST(Engine, TilesGoOnUntilTheirLastPixelIsOpaque) {
  constexpr std::size_t kLayers = 700;
  const double behind = -std::expm1(-0.01 * 0.5 * kLayers);
  for (const std::size_t axis : {0, 1})
    for (const bool last : {true, false}) {
      const auto [mesh, scene] = plate_before(kLayers, axis, last);
      std::vector<CellId> cells(mesh.cell_count());
      for (std::size_t k = 0; k < cells.size(); ++k) cells[k] = static_cast<CellId>(k);
      const Image image = render(mesh, {std::move(cells), {}, "known"}, scene, false).image;
      std::size_t open = 0;
      for (std::uint32_t y = 0; y < 32; ++y)
        for (std::uint32_t x = 0; x < 64; ++x) {
          // y points upwards in the world
          const std::uint32_t at = axis == 0 ? x : 31 - y;
          const bool left_out = at == (last ? (axis == 0 ? 63U : 31U) : 0U);
          if (left_out) ++open;
          for (std::size_t c = 0; c < 4; ++c)
            ASSERT_NEAR(image.at(x, y, c), left_out ? behind : 1, 1e-12) << x << ' ' << y;
        }
      EXPECT_EQ(open, axis == 0 ? 32U : 64U);
    }
}

// Nothing is left to add where all pixels are opaque: the engine looks after so many cells.
TEST(Engine, OpaqueTilesAreGivenUp) {
  auto [mesh, scene] = plate_before(3000, 0, true);
  mesh.fields[0].values = std::vector<double>(mesh.cell_count(), 1000.0);
  const RenderResult result = render(mesh, order_of_scene(mesh, scene).order, scene, false);
  EXPECT_LT(result.statistics.segments, 64U * 32U * 300U);
}

// A ray that is ended leaves so much of the light behind that `error` says little more.
TEST(Engine, ErrorIsThatOfTheEndOfRays) {
  ZooMesh mesh = test::structured(40, Cut::tetrahedra);
  test::add_node_field(mesh, "f", [](const test::Position&) { return 0.5; });
  Scene scene = scene_of(Projection::orthographic, 16, 16);
  scene.volume.color->points = {{0, {0.5, 2, 1}}};
  scene.volume.extinction->points = {{0, {40}}};
  scene.render.tolerance = 1e-3;
  const std::array channels{Channel::error, Channel::transparency};
  std::size_t ended = 0;
  for (const bool ahead_of_white : {false, true}) {
    if (ahead_of_white) scene.background.color = {3, 3, 3};
    const Image image =
        render(mesh, order_of_scene(mesh, scene).order, scene, true, nullptr, channels).image;
    for (std::uint32_t y = 4; y < 12; ++y)
      for (std::uint32_t x = 4; x < 12; ++x) {
        const double left = image.at(x, y, 5);
        if (left < 1e-10) continue;
        ++ended;
        // what is behind absorbs all and shines with 2 at most, here; nothing shows of the white
        const double error = left * (ahead_of_white ? 2.5 : 2);
        const auto pixel = image.pixel(x, y);
        ASSERT_NEAR(std::abs(pixel[ahead_of_white ? 0 : 1] - (ahead_of_white ? 0.5 : 2)), error,
                    0.01 * error);
        ASSERT_GE(pixel[4], error * (1 - 1e-9));
        ASSERT_LE(pixel[4], left * (ahead_of_white ? 3 : 2) * 1.01 + 1e-10);
      }
  }
  EXPECT_GT(ended, 60U);
}

TEST(Engine, BackgroundIsCompositedBehind) {
  const ZooMesh mesh = delaunay_with_fields(40, 9);
  Scene scene = scene_of(Projection::perspective, 32, 32);
  scene.background.color = {0.25, 0.5, 0.75};
  const OrderResult sorted = order_of_scene(mesh, scene);
  const Image bare = render(mesh, sorted.order, scene, false).image;
  const Image whole = render(mesh, sorted.order, scene, true).image;
  for (std::uint32_t y = 0; y < 32; ++y)
    for (std::uint32_t x = 0; x < 32; ++x) {
      ASSERT_EQ(whole.at(x, y, 3), bare.at(x, y, 3));
      for (std::size_t c = 0; c < 3; ++c)
        ASSERT_NEAR(whole.at(x, y, c),
                    bare.at(x, y, c) + (1 - bare.at(x, y, 3)) * scene.background.color[c], 1e-15);
    }
}

}  // namespace
}  // namespace hiac
