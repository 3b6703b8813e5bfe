#include "hiac/frame/channels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/render/cells/segment_notes.hpp"
#include "hiac/render/engine.hpp"
#include "hiac/scene/view_of.hpp"
#include "tests/render/truth/general_meshes.hpp"
#include "tests/render/truth/polyhedron_reference.hpp"
#include "tests/support/reference.hpp"

namespace hiac {
namespace {

using test::cube_scene;
using test::Cut;

VisibilityOrder order_of(const ZooMesh& mesh, const Scene& scene) {
  return exact_order(mesh, build_face_adjacency(mesh), view_of(scene.camera),
                     scene.render.planarity)
      .order;
}

Image draw_with(const ZooMesh& mesh, const Scene& scene, std::vector<Channel> channels) {
  return render(mesh, order_of(mesh, scene), scene, false, nullptr, channels).image;
}

Isosurface surface_of(const std::string& field, double value, double opacity) {
  Isosurface surface;
  surface.field = field;
  surface.value = value;
  surface.color = {0.9, 0.6, 0.3};
  surface.opacity = opacity;
  return surface;
}

ZooMesh with_fields(ZooMesh mesh, std::uint64_t seed) {
  test::add_node_field(mesh, "f", test::smooth_field);
  test::add_random_field(mesh, "node", FieldLocation::node, seed + 1);
  test::add_random_field(mesh, "cell", FieldLocation::cell, seed + 2);
  test::add_random_field(mesh, "corner", FieldLocation::corner, seed + 3);
  return mesh;
}

// A scene of the unit cube with fields, functions, surfaces and a view at random.
Scene random_scene(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  Scene scene =
      cube_scene(unit(random) < 0.5 ? Projection::perspective : Projection::orthographic, 24, 20);
  for (double& x : scene.camera.eye) x = 0.5 + 4 * (unit(random) - 0.5);
  scene.camera.look_at = {unit(random), unit(random), unit(random)};
  scene.render.tolerance = 1e-9;
  if (unit(random) < 0.4) scene.volume.glow = Glow::emission;
  const std::array<std::string, 4> names{"f", "node", "cell", "corner"};
  const auto name = [&] { return names[static_cast<std::size_t>(4 * unit(random))]; };
  scene.volume.color->field = name();
  scene.volume.extinction->field = unit(random) < 0.5 ? scene.volume.color->field : name();
  const double strength = std::exp(6 * unit(random) - 3);
  for (auto& point : scene.volume.extinction->points) point.value[0] *= strength;
  if (unit(random) < 0.3) {  // steps
    scene.volume.color->points.insert(scene.volume.color->points.begin() + 1,
                                      {0.45, {0.6, 0.1, 0.4}});
    scene.volume.extinction->points.insert(scene.volume.extinction->points.begin() + 1,
                                           {0.6, {9 * unit(random)}});
  }
  if (unit(random) < 0.6)
    for (int k = 0; k < 3; ++k)
      scene.isosurfaces.push_back(surface_of(name(), 0.02 + 0.96 * unit(random), unit(random)));
  return scene;
}

TEST(ErrorChannel, IsNeverBelowTheErrorOfTetrahedra) {
  std::vector<double> bounds;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const ZooMesh mesh = with_fields(test::random_delaunay(12 + seed, seed), seed);
    const Scene scene = random_scene(seed);
    const Image image = draw_with(mesh, scene, {Channel::error});
    for (std::uint32_t y = 0; y < scene.image.height; ++y)
      for (std::uint32_t x = 0; x < scene.image.width; ++x) {
        const auto expected = test::reference_pixel(mesh, scene, x, y);
        for (std::size_t c = 0; c < 4; ++c)
          ASSERT_LE(std::abs(expected[c] - image.at(x, y, c)), image.at(x, y, 4))
              << seed << ' ' << x << ' ' << y << ' ' << c;
        // where a ray was ended early the bound says by how much at most
        if (image.at(x, y, 3) > 0 && image.at(x, y, 3) < 1 - 1e-8)
          bounds.push_back(image.at(x, y, 4));
      }
  }
  ASSERT_GT(bounds.size(), 4000U);
  std::ranges::sort(bounds);
  EXPECT_LT(bounds[bounds.size() / 2], 1e-11);
  EXPECT_LT(bounds[bounds.size() * 9 / 10], 1e-10);
}

TEST(ErrorChannel, HoldsTheEndOfRays) {
  const ZooMesh mesh = with_fields(test::random_delaunay(60, 3), 3);
  Scene scene = cube_scene(Projection::perspective, 24, 20);
  for (auto& point : scene.volume.extinction->points) point.value[0] *= 30;
  scene.render.tolerance = 1e-15;
  const Image exact = draw_with(mesh, scene, {});
  scene.render.tolerance = 1e-4;
  const Image ended = draw_with(mesh, scene, {Channel::error});
  double largest = 0;
  for (std::uint32_t y = 0; y < 20; ++y)
    for (std::uint32_t x = 0; x < 24; ++x)
      for (std::size_t c = 0; c < 4; ++c) {
        const double error = std::abs(exact.at(x, y, c) - ended.at(x, y, c));
        largest = std::max(largest, error);
        ASSERT_LE(error, ended.at(x, y, 4));
        ASSERT_LE(ended.at(x, y, 4), 2e-4);
      }
  EXPECT_GT(largest, 1e-8);
}

// Two panes of different fields in one place: rounding decides which is in front, and the picture
// is off by all that they differ by. A little apart, nothing is in doubt.
TEST(ErrorChannel, DoubtsTheOrderOfSurfacesInOnePlace) {
  for (const CellOrder cell_order : {CellOrder::linear, CellOrder::quadratic})
    for (const Cut cut : {Cut::tetrahedra, Cut::bricks, Cut::prisms})
      for (const double apart : {0.0, 1e-6}) {
        ZooMesh mesh = test::structured(2, cut);
        if (cell_order != CellOrder::linear) mesh = test::of_order(mesh, cell_order);
        test::add_node_field(mesh, "z", [](const test::Position& p) { return p[2]; });
        test::add_node_field(mesh, "twice", [](const test::Position& p) { return 2 * p[2]; });
        Scene scene = cube_scene(Projection::orthographic, 6, 6);
        scene.camera.eye = {0.51, 0.53, 4};
        scene.camera.look_at = {0.51, 0.53, 0};
        scene.camera.up = {0, 1, 0};
        scene.camera.height = 0.7;
        scene.volume = {};
        scene.render.tolerance = 1e-9;
        scene.isosurfaces = {surface_of("z", 0.4, 1), surface_of("twice", 0.8 + apart, 1)};
        scene.isosurfaces[0].color = {1, 0, 0};
        scene.isosurfaces[1].color = {0, 0, 1};
        const Image image = draw_with(mesh, scene, {Channel::error});
        for (std::uint32_t y = 0; y < 6; ++y)
          for (std::uint32_t x = 0; x < 6; ++x) {
            const double off = std::abs(image.at(x, y, 0) - image.at(x, y, 2));
            ASSERT_GT(off, 0.3);
            if (apart == 0)
              EXPECT_GE(image.at(x, y, 4), off) << static_cast<int>(cut);
            else
              EXPECT_LT(image.at(x, y, 4), 1e-7) << static_cast<int>(cut);
          }
      }
}

TEST(ErrorChannel, IsNotClaimedOfOtherIntegrations) {
  const ZooMesh mesh = with_fields(test::random_delaunay(20, 4), 4);
  Scene scene = cube_scene(Projection::perspective, 8, 8);
  scene.render.integration = Integration::approximate;
  EXPECT_THROW(draw_with(mesh, scene, {Channel::error}), UsageError);
  EXPECT_NO_THROW(draw_with(mesh, scene, {Channel::depth}));
}

TEST(ErrorChannel, IsNeverBelowTheErrorOfOtherKinds) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const ZooMesh mesh =
        with_fields(test::moved(test::mixed_columns(1), test::tapered), 100 + seed);
    Scene scene = random_scene(200 + seed);
    scene.image = {9, 8};
    // the reference knows where steps are to 1e-10 only
    scene.volume.color->points.resize(3);
    scene.volume.extinction->points.resize(2);
    const Image image = draw_with(mesh, scene, {Channel::error});
    for (std::uint32_t y = 0; y < scene.image.height; ++y)
      for (std::uint32_t x = 0; x < scene.image.width; ++x) {
        const auto expected = test::polyhedron_reference(mesh, scene, x + 0.5, y + 0.5);
        for (std::size_t c = 0; c < 4; ++c)
          ASSERT_LE(std::abs(expected[c] - image.at(x, y, c)), image.at(x, y, 4))
              << seed << ' ' << x << ' ' << y << ' ' << c;
      }
  }
}

const std::vector<Channel> kAll{Channel::depth, Channel::mean_depth, Channel::transparency,
                                Channel::cells, Channel::witness,    Channel::error};

TEST(Channels, AreNamedInAList) {
  EXPECT_EQ(parse_channels("depth,mean_depth,transparency,cells,witness,error"), kAll);
  EXPECT_EQ(parse_channels("error,cells"), (std::vector{Channel::error, Channel::cells}));
  EXPECT_TRUE(parse_channels("").empty());
  EXPECT_THROW(parse_channels("depht"), UsageError);
  EXPECT_THROW(parse_channels("depth,,cells"), UsageError);
  EXPECT_THROW(parse_channels("depth,cells,depth"), UsageError);
}

TEST(Channels, DoNotChangeThePicture) {
  ZooMesh mesh = with_fields(test::moved(test::mixed_columns(2), test::tapered), 5);
  Scene scene = cube_scene(Projection::perspective, 70, 40);
  scene.isosurfaces = {surface_of("node", 0.4, 0.5)};
  const Image plain = draw_with(mesh, scene, {}), more = draw_with(mesh, scene, kAll);
  ASSERT_EQ(more.channel_count(), 10U);
  EXPECT_EQ(more.channel_index("mean_depth"), 5U);
  for (std::uint32_t y = 0; y < 40; ++y)
    for (std::uint32_t x = 0; x < 70; ++x) {
      for (std::size_t c = 0; c < 4; ++c) ASSERT_EQ(plain.at(x, y, c), more.at(x, y, c));
      ASSERT_NEAR(more.at(x, y, 6), 1 - more.at(x, y, 3), 1e-16);
    }
}

class ChannelsOfKinds : public testing::TestWithParam<CellKind> {};

INSTANTIATE_TEST_SUITE_P(Kinds, ChannelsOfKinds, testing::ValuesIn(test::all_kinds()),
                         [](const auto& instance) {
                           return std::string(kind_name(instance.param));
                         });

void expect_same_pixels(const ZooMesh& mesh, const Scene& scene, const std::string& what) {
  const Image plain = draw_with(mesh, scene, {});
  std::vector<std::vector<Channel>> wanted{kAll};
  for (const Channel channel : kAll) wanted.push_back({channel});
  double seen = 0;
  for (const auto& channels : wanted) {
    const Image more = draw_with(mesh, scene, channels);
    for (std::uint32_t y = 0; y < scene.image.height; ++y)
      for (std::uint32_t x = 0; x < scene.image.width; ++x) {
        for (std::size_t c = 0; c < 4; ++c)
          ASSERT_EQ(plain.at(x, y, c), more.at(x, y, c))
              << what << ' ' << x << ' ' << y << ' ' << c << ' ' << channels.size();
        seen += plain.at(x, y, 3);
      }
  }
  EXPECT_GT(seen, 0);
}

// Cells of every kind, straight and curved, in both projections; partly clipped, in groups whose
// order is found in each pixel, and crossed by surfaces.
TEST_P(ChannelsOfKinds, DoNotChangeThePicture) {
  for (const bool curved : {false, true})
    for (const Projection projection : {Projection::perspective, Projection::orthographic})
      for (const bool with_surfaces : {false, true}) {
        ZooMesh mesh = curved ? test::curved_mesh(GetParam()) : test::straight_mesh(GetParam());
        test::add_random_field(mesh, "f", FieldLocation::node, 15);
        test::add_random_field(mesh, "corner", FieldLocation::corner, 16);
        Scene scene = cube_scene(projection, 19, 9);
        scene.render.tolerance = 1e-9;
        if (with_surfaces) scene.isosurfaces = {surface_of("f", 0.5, 0.5)};
        if (curved == with_surfaces) {
          scene.volume.color->field = "corner";
          scene.camera.clip = {{3.3, 4.2}};
        }
        const std::string what = std::string(curved ? "curved" : "straight") +
                                 (projection == Projection::perspective ? " near" : " far") +
                                 (with_surfaces ? " cut" : "");
        expect_same_pixels(mesh, scene, what);
      }
}

// The unit cube along an axis: two layers of cells, of which the first is empty, or nothing but an
// isosurface.
TEST(Channels, SayWhereThingsAre) {
  for (const Cut cut : {Cut::bricks, Cut::tetrahedra})
    for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
      ZooMesh mesh = test::structured(2, cut);
      test::add_node_field(mesh, "z", [](const test::Position& p) { return p[2]; });
      std::vector<double> filled;
      for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
        filled.push_back(cell < mesh.cell_count() / 2 ? 1 : 0);
      mesh.fields.push_back({"filled", "", FieldLocation::cell, 1, std::move(filled)});
      Scene scene;
      scene.image = {6, 6};
      scene.camera.projection = projection;
      scene.camera.eye = {0.5, 0.53, 4};
      scene.camera.look_at = {0.5, 0.53, 0};
      scene.camera.up = {0, 1, 0};
      scene.camera.height = 0.7;
      scene.camera.fov = 8;
      scene.volume.extinction = ExtinctionTransfer{"filled", {{0, {0}}, {1, {2}}}};
      const Image volume = draw_with(mesh, scene, kAll);
      scene.volume = {};
      scene.isosurfaces = {surface_of("z", 0.8, 0.5), surface_of("z", 0.7, 1)};
      const Image surfaces = draw_with(mesh, scene, kAll);
      for (std::uint32_t y = 0; y < 6; ++y)
        for (std::uint32_t x = 0; x < 6; ++x) {
          // the lower half absorbs: from z = 0.5 to 0
          ASSERT_NEAR(volume.at(x, y, 4), 3.5, 1e-12);
          ASSERT_NEAR(volume.at(x, y, 5), 3.75, cut == Cut::bricks ? 1e-12 : 0.2);
          ASSERT_GE(volume.at(x, y, 7), 1);
          ASSERT_EQ(volume.at(x, y, 8), 0);
          ASSERT_LT(volume.at(x, y, 9), 1e-10);
          ASSERT_NEAR(surfaces.at(x, y, 4), 3.2, 1e-12);
          ASSERT_NEAR(surfaces.at(x, y, 5), 3.25, 1e-3);  // half each
        }
    }
}

// A uniform medium with two surfaces in it, both seen face-on: what each part of the medium between
// cells and surfaces takes counts at its middle, what surfaces take where they are.
TEST(Channels, SayTheMeanDepthOfMediumAndSurfaces) {
  for (const CellOrder cell_order : {CellOrder::linear, CellOrder::quadratic})
    for (const bool grouped : {false, true}) {
      ZooMesh mesh = test::structured(2, Cut::bricks);
      if (cell_order != CellOrder::linear) mesh = test::of_order(mesh, cell_order);
      test::add_node_field(mesh, "z", [](const test::Position& p) { return p[2]; });
      Scene scene;
      scene.image = {6, 6};
      scene.camera.projection = Projection::orthographic;
      scene.camera.eye = {0.51, 0.53, 4};
      scene.camera.look_at = {0.51, 0.53, 0};
      scene.camera.up = {0, 1, 0};
      scene.camera.height = 0.7;
      scene.volume.extinction = ExtinctionTransfer{"z", {{0, {2}}}};
      scene.volume.color = ColorTransfer{"z", {{0, {1, 1, 1}}}};
      scene.isosurfaces = {surface_of("z", 0.3, 0.75), surface_of("z", 0.8, 0.5)};
      VisibilityOrder order = order_of(mesh, scene);
      if (grouped)
        order.groups = std::vector<CellGroup>{{0, static_cast<std::uint32_t>(order.cells.size())}};
      const Image image = render(mesh, order, scene, false, nullptr, kAll).image;
      double transparency = 1, weighted = 0;
      const auto take = [&](double depth, double through) {
        weighted += transparency * (1 - through) * depth;
        transparency *= through;
      };
      const auto medium = [&](double from, double to) {
        take((from + to) / 2, std::exp(-2 * (to - from)));
      };
      medium(3, 3.2);
      take(3.2, 0.5);
      medium(3.2, 3.5);
      medium(3.5, 3.7);
      take(3.7, 0.25);
      medium(3.7, 4);
      for (std::uint32_t y = 0; y < 6; ++y)
        for (std::uint32_t x = 0; x < 6; ++x) {
          EXPECT_NEAR(image.at(x, y, 4), 3, 1e-9);
          EXPECT_NEAR(image.at(x, y, 5), weighted / (1 - transparency), 1e-6);
          EXPECT_NEAR(image.at(x, y, 6), transparency, 1e-9);
        }
    }
}

// Parts of a segment front to back: each part's bounds count as far as it is seen.
TEST(SegmentNotes, AddUpThePartsOfASegment) {
  SegmentNotes notes;
  notes.begin(1, 5);
  EXPECT_EQ(notes.finish({}).mean, 3);
  notes.add_quadrature(1, {1e-3, 1e-4}, {{0.25, 0.5, 0.125}, 0.5});
  notes.add_quadrature(0.5, {2e-3, 4e-4}, {{8, 2, 4}, 0.5});
  notes.add_depth(2, 0.5);
  notes.add_depth(4, 0.25);
  SegmentDetails details = notes.finish({{1, 3, 2}, 0.25});
  EXPECT_EQ(details.front, 1);
  EXPECT_EQ(details.back, 5);
  EXPECT_EQ(details.first, 1);
  EXPECT_EQ(details.light, 3);
  EXPECT_EQ(details.transparency, 0.25);
  EXPECT_DOUBLE_EQ(details.mean, (2 * 0.5 + 4 * 0.25) / 0.75);
  EXPECT_DOUBLE_EQ(details.radiance_error, 1e-3 + 0.5 * 2e-3 + 1e-4 * 8);
  EXPECT_DOUBLE_EQ(details.transparency_error, 1e-4 + 0.5 * 4e-4);
  notes.add_apart(0.5, {{1, 2, 3}, 0.5}, {{1.25, 1.5, 3}, 0.375});
  EXPECT_DOUBLE_EQ(notes.finish({}).radiance_error, details.radiance_error + 0.5 * 0.5);
  EXPECT_DOUBLE_EQ(notes.finish({}).transparency_error, details.transparency_error + 0.5 * 0.125);
  notes.begin(7, 9);
  EXPECT_EQ(notes.finish({}).radiance_error, 0);
  EXPECT_EQ(notes.finish({}).mean, 8);
  EXPECT_EQ(notes.finish({}).first, 7);
}

TEST(Channels, NothingSeenIsInfinitelyFar) {
  const ZooMesh mesh = with_fields(test::random_delaunay(20, 6), 6);
  Scene scene = cube_scene(Projection::perspective, 8, 8);
  scene.camera.look_at = {9, 9, 9};
  const Image image = draw_with(mesh, scene, kAll);
  EXPECT_EQ(image.at(0, 0, 4), std::numeric_limits<double>::infinity());
  EXPECT_EQ(image.at(0, 0, 5), std::numeric_limits<double>::infinity());
  EXPECT_EQ(image.at(0, 0, 6), 1);
  EXPECT_EQ(image.at(0, 0, 7), 0);
}

TEST(Channels, AWrongOrderIsWitnessedWhereItIs) {
  const ZooMesh mesh = with_fields(test::random_delaunay(60, 7), 7);
  const Scene scene = cube_scene(Projection::orthographic, 30, 30);
  const VisibilityOrder right = order_of(mesh, scene);
  std::vector<CellId> cells(right.cells.begin(), right.cells.end());
  std::swap(cells.front(), cells.back());
  const std::array channel{Channel::witness};
  const RenderResult result =
      render(mesh, {std::move(cells), {}, "wrong"}, scene, false, nullptr, channel);
  double sum = 0;
  for (std::uint32_t y = 0; y < 30; ++y)
    for (std::uint32_t x = 0; x < 30; ++x) sum += result.image.at(x, y, 4);
  EXPECT_GT(sum, 0);
  EXPECT_EQ(sum, static_cast<double>(result.statistics.violations));
}

// A segment shorter than the tolerance may be rounding, and lie anywhere: the channel forgives it
// as the statistics do. A flat cell in front of a large one, drawn behind it.
TEST(Channels, TheWitnessForgivesWhatTheStatisticsForgive) {
  for (const CellOrder cell_order : {CellOrder::linear, CellOrder::quadratic, CellOrder::cubic})
    for (const double thickness : {1e-12, 1e-3}) {
      const ZooMesh linear = test::make_mesh(
          {{-2, -2, 0},
           {2, -2, 0},
           {0, 2, 0},
           {0, 0, 1},
           {-2, -2, 2},
           {2, -2, 2},
           {0, 2, 2},
           {0, 0, 2 + thickness}},
          {{CellKind::tetrahedron4, {0, 1, 2, 3}}, {CellKind::tetrahedron4, {4, 5, 6, 7}}});
      ZooMesh mesh = cell_order == CellOrder::linear ? linear : test::of_order(linear, cell_order);
      test::add_random_field(mesh, "f", FieldLocation::node, 15);
      Scene scene = cube_scene(Projection::orthographic, 12, 12);
      scene.camera.eye = {0, 0, 4};
      scene.camera.look_at = {0, 0, 0};
      scene.camera.up = {0, 1, 0};
      scene.camera.height = 3;
      const std::array channel{Channel::witness};
      const RenderResult result =
          render(mesh, {std::vector<CellId>{0, 1}, {}, "wrong"}, scene, false, nullptr, channel);
      double sum = 0;
      for (std::uint32_t y = 0; y < 12; ++y)
        for (std::uint32_t x = 0; x < 12; ++x) sum += result.image.at(x, y, 4);
      EXPECT_EQ(sum, static_cast<double>(result.statistics.violations));
      EXPECT_EQ(sum > 0, thickness > 1e-9);
    }
}

// As one group, in any order, the channels are the same.
TEST(Channels, GroupsSayTheSame) {
  const ZooMesh mesh = with_fields(test::random_delaunay(60, 8), 8);
  Scene scene = cube_scene(Projection::perspective, 24, 20);
  scene.isosurfaces = {surface_of("f", 0.4, 0.5)};
  VisibilityOrder order = order_of(mesh, scene);
  const Image single = render(mesh, order, scene, false, nullptr, kAll).image;
  order.groups = std::vector<CellGroup>{{0, static_cast<std::uint32_t>(order.cells.size())}};
  const Image grouped = render(mesh, order, scene, false, nullptr, kAll).image;
  for (std::uint32_t y = 0; y < 20; ++y)
    for (std::uint32_t x = 0; x < 24; ++x)
      for (std::size_t c = 4; c < 9; ++c) {
        if (std::isinf(single.at(x, y, c))) continue;
        ASSERT_NEAR(single.at(x, y, c), grouped.at(x, y, c), 1e-12) << c;
      }
}

}  // namespace
}  // namespace hiac
