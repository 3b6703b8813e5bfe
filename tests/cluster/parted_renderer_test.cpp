#include "hiac/cluster/parted_renderer.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/cluster/solo_communicator.hpp"
#include "hiac/render/engine.hpp"
#include "tests/cluster/parts_of.hpp"
#include "tests/order/hard_meshes.hpp"
#include "tests/render/truth/general_meshes.hpp"
#include "tests/support/instrumented.hpp"
#include "tests/support/meshes.hpp"

namespace hiac {
namespace {

using test::Cut;
using test::Position;
using Assignment = std::vector<std::uint32_t>;

constexpr double kRounding = 1e-13;

Assignment at_random(const ZooMesh& mesh, std::uint32_t parts, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<std::uint32_t> part(0, parts - 1);
  Assignment result(mesh.cell_count());
  std::ranges::generate(result, [&] { return part(random); });
  return result;
}

Position centroid(const ZooMesh& mesh, CellId cell) {
  Position sum{};
  const auto nodes = mesh.cell_nodes(cell);
  for (const NodeId node : nodes)
    for (std::size_t c = 0; c < 3; ++c)
      sum[c] += mesh.position(node)[c] / static_cast<double>(nodes.size());
  return sum;
}

template <typename PartAt>
Assignment by_place(const ZooMesh& mesh, const PartAt& part_at) {
  Assignment result;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
    result.push_back(static_cast<std::uint32_t>(part_at(centroid(mesh, cell))));
  return result;
}

// Slabs across the view, and combs that reach into one another.
int slab(const Position& p) { return static_cast<int>(4 * p[0]); }
int comb(const Position& p) {
  const bool is_tooth = static_cast<int>(8 * p[2]) % 2 == 0;
  return p[0] < 0.2 || (p[0] < 0.8 && is_tooth) ? 0 : 1;
}

Scene scene_for(Projection projection, std::uint32_t side = 60) {
  Scene scene = test::cube_scene(projection, side, side - 7);
  scene.background.color = {0.25, 0.5, 0.125};
  return scene;
}

Skin skin_of(const Color& color, double opacity) {
  Skin skin;
  skin.color = color;
  skin.opacity = opacity;
  return skin;
}

Edges edges_of(EdgeChoice show, double width, double opacity) {
  Edges edges;
  edges.show = show;
  edges.width = width;
  edges.color = {0.9, 0.1, 0.3};
  edges.opacity = opacity;
  return edges;
}

RenderResult draw_parts(const test::Parts& parts, const Scene& scene,
                        std::span<const Channel> channels = {}, std::uint32_t ranks = 1,
                        bool reversed = false) {
  RenderResult result;
  test::run_ranks(ranks, [&](Communicator& all) {
    PartedRenderer renderer(all, parts.of_rank(all.rank(), ranks, reversed), scene, channels);
    RenderResult own = renderer.render(whole_picture(scene.image), true);
    if (all.rank() == 0) result = std::move(own);
  });
  return result;
}

double largest_difference(const Image& a, const Image& b) {
  EXPECT_EQ(a.values().size(), b.values().size());
  double most = 0;
  for (std::size_t k = 0; k < a.values().size(); ++k) {
    const double p = a.values()[k], q = b.values()[k];
    if (p != q) most = std::max(most, std::abs(p - q));
  }
  return most;
}

// The picture of the parts is that of the whole but for rounding, and the same for any ranks and
// whatever the order of the parts.
void expect_whole(const ZooMesh& mesh, const Assignment& part_of_cell, const Scene& scene) {
  const std::uint32_t count = *std::ranges::max_element(part_of_cell) + 1;
  const RenderResult whole = render(mesh, test::sorted(mesh, scene), scene, true);
  ASSERT_GT(whole.statistics.covered_pixels, 300U);
  const test::Parts parts(mesh, part_of_cell, count, scene);
  const RenderResult alone = draw_parts(parts, scene);
  EXPECT_LE(largest_difference(alone.image, whole.image), kRounding);
  EXPECT_EQ(alone.statistics.violations, 0U);
  EXPECT_EQ(alone.statistics.covered_pixels, whole.statistics.covered_pixels);
  for (const std::uint32_t ranks : test::tried(std::vector{3U, 2U, 8U}))
    EXPECT_TRUE(test::same_bits(alone.image, draw_parts(parts, scene, {}, ranks, ranks == 3).image))
        << ranks;
}

ZooMesh with_fields(ZooMesh mesh) {
  test::add_node_field(mesh, "f", test::smooth_field);
  test::add_node_field(mesh, "g",
                       [](const Position& p) { return 0.5 * (p[0] * p[0] + p[1] * (1 - p[2])); });
  return mesh;
}

TEST(PartedRenderer, AnyPartsOfTetrahedraMakeTheWhole) {
  const ZooMesh mesh = with_fields(test::random_delaunay(120, 5));
  for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
    const Scene scene = scene_for(projection);
    for (const std::uint32_t parts : {1U, 2U, 8U})
      expect_whole(mesh, at_random(mesh, parts, parts), scene);
    expect_whole(mesh, by_place(mesh, slab), scene);
    expect_whole(mesh, by_place(mesh, comb), scene);
  }
}

TEST(PartedRenderer, CellsOfEveryKind) {
  for (const CellKind kind : test::tried(test::all_kinds())) {
    SCOPED_TRACE(static_cast<int>(kind));
    const ZooMesh mesh = with_fields(test::straight_mesh(kind, 2));
    expect_whole(mesh, at_random(mesh, 3, 7), scene_for(Projection::perspective, 40));
    const ZooMesh curved = with_fields(test::curved_mesh(kind));
    expect_whole(curved, at_random(curved, 3, 8), scene_for(Projection::orthographic, 40));
  }
  const ZooMesh mixed = with_fields(test::mixed_columns(3));
  expect_whole(mixed, at_random(mixed, 5, 9), scene_for(Projection::perspective));
}

// Blocks of other cells on either side of a plane, with a gap beside it.
ZooMesh sliding_blocks() {
  const ZooMesh below = test::moved(test::structured(3, Cut::prisms), [](const Position& p) {
    return Position{p[0], p[1], p[2] / 2};
  });
  const ZooMesh above = test::moved(test::structured(4, Cut::bricks), [](const Position& p) {
    return Position{p[0], p[1], 0.5 + p[2] / 2 + (p[0] > 0.6 ? 0.01 : 0)};
  });
  return with_fields(test::side_by_side(below, above));
}

ZooMesh hollow_cube() {
  const ZooMesh cube = test::structured(6, Cut::tetrahedra);
  return with_fields(test::keep_cells(cube, [](const Position& p, CellId) {
    return std::hypot(p[0] - 0.5, p[1] - 0.5, p[2] - 0.5) > 0.3;
  }));
}

TEST(PartedRenderer, CavitiesSlidingInterfacesAndGaps) {
  const ZooMesh hollow = hollow_cube();
  expect_whole(hollow, at_random(hollow, 4, 3), scene_for(Projection::perspective));
  const ZooMesh contact = sliding_blocks();
  expect_whole(contact, at_random(contact, 6, 4), scene_for(Projection::orthographic));
  expect_whole(contact, by_place(contact, [](const Position& p) { return p[2] > 0.5; }),
               scene_for(Projection::perspective));
}

// Every stick is a part of its own: no order of the parts draws them.
TEST(PartedRenderer, CyclesAcrossParts) {
  for (const int sticks : {3, 5, 8}) {
    const ZooMesh mesh = with_fields(test::ring_of_sticks(sticks, 1));
    Scene scene = scene_for(Projection::perspective);
    scene.camera.eye = {0, 0, 12};
    scene.camera.look_at = {0, 0, 0};
    scene.camera.up = {0.137, 1, 0};
    scene.camera.fov = 12;
    scene.image = {120, 110};
    EXPECT_FALSE(test::sorted(mesh, scene).groups.empty());
    Assignment parts(mesh.cell_count());
    std::iota(parts.begin(), parts.end(), 0U);
    expect_whole(mesh, parts, scene);
  }
}

TEST(PartedRenderer, SeparateFieldsEmissionAndCellFields) {
  ZooMesh mesh = with_fields(test::random_delaunay(80, 6));
  test::add_random_field(mesh, "c", FieldLocation::cell, 1);
  test::add_random_field(mesh, "k", FieldLocation::corner, 2);
  for (const Glow glow : {Glow::chromaticity, Glow::emission})
    for (const char* color : {"g", "c", "k"}) {
      Scene scene = scene_for(Projection::perspective, 40);
      scene.volume.glow = glow;
      scene.volume.color->field = std::string(color);
      expect_whole(mesh, at_random(mesh, 4, 5), scene);
    }
}

TEST(PartedRenderer, Isosurfaces) {
  const ZooMesh mesh = with_fields(test::random_delaunay(100, 8));
  Scene scene = scene_for(Projection::perspective);
  scene.isosurfaces = {{.field = "f", .value = 0.5, .opacity = 0.4},
                       {.field = "g", .value = 0.3, .color = {1, 0, 0}, .opacity = 1}};
  expect_whole(mesh, at_random(mesh, 5, 2), scene);
}

// Surfaces in whole faces between parts: drawn once where the field passes the value, and not at
// all where it only touches it.
TEST(PartedRenderer, IsosurfacesInFacesBetweenParts) {
  ZooMesh mesh = test::structured(4, Cut::tetrahedra);
  test::add_node_field(mesh, "f", [](const Position& p) { return p[2]; });
  test::add_node_field(mesh, "roof", [](const Position& p) { return 0.5 - std::abs(p[2] - 0.5); });
  const Assignment halves = by_place(mesh, [](const Position& p) { return p[2] > 0.5; });
  for (const char* field : {"f", "roof"}) {
    Scene scene = scene_for(Projection::perspective);
    scene.isosurfaces = {{.field = field, .value = 0.5, .opacity = 0.5}};
    expect_whole(mesh, halves, scene);
    expect_whole(mesh, at_random(mesh, 4, 6), scene);
  }
}

// Faces between parts are not skin, whatever their shape; those of the boundary are, once.
TEST(PartedRenderer, SkinOfTetrahedra) {
  const ZooMesh mesh = with_fields(test::random_delaunay(120, 5));
  for (const double opacity : {0.3, 1.0}) {
    Scene scene = scene_for(Projection::perspective);
    scene.skin = skin_of({0.9, 0.5, 0.2}, opacity);
    for (const std::uint32_t parts : {1U, 2U, 8U})
      expect_whole(mesh, at_random(mesh, parts, parts), scene);
    scene.skin->color_by = scene.volume.color;
    expect_whole(mesh, by_place(mesh, slab), scene);
    expect_whole(mesh, by_place(mesh, comb), scene);
    scene.volume = {};  // the skin alone
    expect_whole(mesh, by_place(mesh, comb), scene);
    scene.isosurfaces = {{.field = "f", .value = 0.5, .opacity = 0.4}};
    expect_whole(mesh, at_random(mesh, 5, 1), scene);
  }
}

TEST(PartedRenderer, SkinOfEveryKind) {
  const auto with_skin = [](Scene scene) {
    scene.skin = skin_of({0.2, 0.5, 0.9}, 0.4);
    return scene;
  };
  for (const CellKind kind : test::tried(test::all_kinds())) {
    SCOPED_TRACE(static_cast<int>(kind));
    const ZooMesh mesh = with_fields(test::straight_mesh(kind, 2));
    expect_whole(mesh, at_random(mesh, 3, 7), with_skin(scene_for(Projection::perspective, 40)));
    const ZooMesh curved = with_fields(test::curved_mesh(kind));
    expect_whole(curved, at_random(curved, 3, 8),
                 with_skin(scene_for(Projection::orthographic, 40)));
  }
  const ZooMesh mixed = with_fields(test::mixed_columns(3));
  expect_whole(mixed, at_random(mixed, 5, 9), with_skin(scene_for(Projection::perspective)));
}

// Skin on both sides of contacts and gaps, in cavities, and in cycles across parts.
TEST(PartedRenderer, SkinOfSeveralBodies) {
  Scene scene = scene_for(Projection::perspective);
  scene.skin = skin_of({0.9, 0.5, 0.2}, 0.3);
  const ZooMesh contact = sliding_blocks();
  expect_whole(contact, at_random(contact, 6, 4), scene);
  expect_whole(contact, by_place(contact, [](const Position& p) { return p[2] > 0.5; }), scene);
  const ZooMesh hollow = hollow_cube();
  expect_whole(hollow, at_random(hollow, 4, 3), scene);
  const ZooMesh ring = with_fields(test::ring_of_sticks(5, 1));
  scene.camera.eye = {0, 0, 12};
  scene.camera.look_at = {0, 0, 0};
  scene.camera.up = {0.137, 1, 0};
  scene.camera.fov = 12;
  scene.image = {120, 110};
  Assignment parts(ring.cell_count());
  std::iota(parts.begin(), parts.end(), 0U);
  expect_whole(ring, parts, scene);
}

TEST(PartedRenderer, ChannelsAndStatisticsOfSkin) {
  constexpr std::array kChannels{Channel::depth, Channel::mean_depth, Channel::transparency,
                                 Channel::cells, Channel::witness};
  const ZooMesh mesh = with_fields(test::random_delaunay(100, 9));
  Scene scene = scene_for(Projection::perspective);
  scene.skin = skin_of({0.2, 0.5, 0.9}, 0.4);
  const RenderResult whole =
      render(mesh, test::sorted(mesh, scene), scene, true, nullptr, kChannels);
  const test::Parts parts(mesh, at_random(mesh, 5, 4), 5, scene);
  const RenderResult alone = draw_parts(parts, scene, kChannels);
  EXPECT_TRUE(test::same_bits(alone.image, draw_parts(parts, scene, kChannels, 3, true).image));
  EXPECT_NEAR(alone.statistics.mean_optical_depth, whole.statistics.mean_optical_depth, 1e-12);
  EXPECT_EQ(alone.statistics.depth_pixels, whole.statistics.depth_pixels);
  for (std::size_t y = 0; y < scene.image.height; ++y)
    for (std::size_t x = 0; x < scene.image.width; ++x) {
      const auto p = alone.image.pixel(x, y), q = whole.image.pixel(x, y);
      for (const std::size_t exact : {7, 8}) EXPECT_EQ(p[exact], q[exact]);
      for (const std::size_t depth : {4, 5}) {
        EXPECT_EQ(std::isfinite(p[depth]), std::isfinite(q[depth]));
        if (std::isfinite(q[depth])) {
          EXPECT_NEAR(p[depth], q[depth], 1e-11);
        }
      }
    }
}

// Edges have faces of several parts beside them, and cover pixels whose rays meet others.
TEST(PartedRenderer, EdgesOfTetrahedra) {
  const ZooMesh mesh = with_fields(test::random_delaunay(120, 5));
  for (const EdgeChoice show :
       test::tried(std::vector{EdgeChoice::all, EdgeChoice::feature, EdgeChoice::boundary})) {
    SCOPED_TRACE(static_cast<int>(show));
    Scene scene = scene_for(Projection::perspective);
    scene.edges = edges_of(show, 2.5, 0.7);
    expect_whole(mesh, at_random(mesh, 8, 3), scene);
    scene.skin = skin_of({0.9, 0.5, 0.2}, 0.4);
    expect_whole(mesh, by_place(mesh, comb), scene);
    expect_whole(mesh, at_random(mesh, 1, 3), scene);
    scene.volume = {};  // skin and edges alone
    expect_whole(mesh, at_random(mesh, 5, 3), scene);
    scene.skin.reset();
    expect_whole(mesh, by_place(mesh, slab), scene);
  }
}

TEST(PartedRenderer, EdgesOfEveryKind) {
  for (const CellKind kind : test::tried(test::all_kinds())) {
    SCOPED_TRACE(static_cast<int>(kind));
    Scene scene = scene_for(Projection::perspective, 40);
    scene.edges = edges_of(EdgeChoice::feature, 1.5, 0.8);
    scene.edges->angle = 10;
    scene.skin = skin_of({0.2, 0.5, 0.9}, 0.4);
    const ZooMesh mesh = with_fields(test::straight_mesh(kind, 2));
    expect_whole(mesh, at_random(mesh, 3, 7), scene);
    const ZooMesh curved = with_fields(test::curved_mesh(kind));
    expect_whole(curved, at_random(curved, 3, 8), scene);
  }
}

// Rays meet faces twice, and edges at one of the places.
TEST(PartedRenderer, EdgesOfFacesThatBendBack) {
  for (const CellKind kind :
       test::tried(std::vector{CellKind::brick20, CellKind::prism15, CellKind::brick32})) {
    SCOPED_TRACE(static_cast<int>(kind));
    const ZooMesh mesh = with_fields(test::arch(kind, 150, 2));
    Scene scene = scene_for(Projection::perspective, 90);
    scene.camera.eye = {-5.8, -0.8, 2.2};
    scene.camera.look_at = {0, 0.5, 0.7};
    scene.camera.fov = 30;
    scene.edges = edges_of(EdgeChoice::all, 1.6, 1);
    scene.skin = skin_of({0.9, 0.6, 0.1}, 1);
    expect_whole(mesh, at_random(mesh, 4, 5), scene);
    scene.skin->opacity = 0.3;
    scene.edges->opacity = 0.6;
    expect_whole(mesh, at_random(mesh, 3, 6), scene);
  }
}

TEST(PartedRenderer, EdgesOfSeveralBodies) {
  const ZooMesh contact = sliding_blocks();
  Scene scene = scene_for(Projection::perspective);
  scene.edges = edges_of(EdgeChoice::feature, 2, 0.5);
  expect_whole(contact, at_random(contact, 6, 4), scene);
  scene.skin = skin_of({0.7, 0.7, 0.7}, 0.3);
  expect_whole(contact, by_place(contact, [](const Position& p) { return p[2] > 0.5; }), scene);
  const ZooMesh mixed = with_fields(test::mixed_columns(3));
  expect_whole(mixed, at_random(mixed, 5, 9), scene);
}

TEST(PartedRenderer, ChannelsOfEdges) {
  constexpr std::array kChannels{Channel::depth, Channel::mean_depth, Channel::transparency,
                                 Channel::cells, Channel::witness};
  const ZooMesh mesh = with_fields(test::random_delaunay(100, 9));
  Scene scene = scene_for(Projection::perspective);
  scene.edges = edges_of(EdgeChoice::feature, 3, 0.5);
  const RenderResult whole =
      render(mesh, test::sorted(mesh, scene), scene, true, nullptr, kChannels);
  const test::Parts parts(mesh, at_random(mesh, 5, 4), 5, scene);
  const RenderResult alone = draw_parts(parts, scene, kChannels);
  EXPECT_TRUE(test::same_bits(alone.image, draw_parts(parts, scene, kChannels, 3, true).image));
  EXPECT_NEAR(alone.statistics.mean_optical_depth, whole.statistics.mean_optical_depth, 1e-12);
  EXPECT_LE(largest_difference(alone.image, whole.image), 1e-11);
}

TEST(PartedRenderer, Splats) {
  const ZooMesh mesh = with_fields(test::random_delaunay(900, 7));
  Scene scene = scene_for(Projection::perspective, 60);
  scene.render.splat_below = 5;
  const RenderResult whole = render(mesh, test::sorted(mesh, scene), scene, true);
  // cells of both kinds, beside and before one another
  ASSERT_GT(whole.statistics.splatted_cells, 1000U);
  ASSERT_LT(whole.statistics.splatted_cells, mesh.cell_count() - 1000U);
  const Assignment random = at_random(mesh, 4, 3);
  const test::Parts parts(mesh, random, 4, scene);
  const RenderResult alone = draw_parts(parts, scene);
  EXPECT_EQ(alone.statistics.splatted_cells, whole.statistics.splatted_cells);
  EXPECT_LE(largest_difference(alone.image, whole.image), kRounding);
  EXPECT_TRUE(test::same_bits(alone.image, draw_parts(parts, scene, {}, 3).image));
}

TEST(PartedRenderer, Channels) {
  constexpr std::array kChannels{Channel::depth, Channel::mean_depth, Channel::transparency,
                                 Channel::cells, Channel::witness,    Channel::error};
  const ZooMesh mesh = with_fields(test::random_delaunay(100, 9));
  const Scene scene = scene_for(Projection::perspective);
  const RenderResult whole =
      render(mesh, test::sorted(mesh, scene), scene, true, nullptr, kChannels);
  const test::Parts parts(mesh, at_random(mesh, 5, 4), 5, scene);
  const RenderResult alone = draw_parts(parts, scene, kChannels);
  EXPECT_TRUE(test::same_bits(alone.image, draw_parts(parts, scene, kChannels, 3, true).image));
  for (std::size_t y = 0; y < scene.image.height; ++y)
    for (std::size_t x = 0; x < scene.image.width; ++x) {
      const auto p = alone.image.pixel(x, y), q = whole.image.pixel(x, y);
      for (const std::size_t exact : {4, 7, 8}) EXPECT_EQ(p[exact], q[exact]);
      if (std::isfinite(q[5])) {
        EXPECT_NEAR(p[5], q[5], 1e-11);
      }
      EXPECT_EQ(std::isfinite(p[5]), std::isfinite(q[5]));
      // both bounds hold, and hold for the difference of the two pictures
      for (std::size_t c = 0; c < 4; ++c) EXPECT_LE(std::abs(p[c] - q[c]), p[9] + q[9]);
      EXPECT_LT(p[9], 1e-9);
      EXPECT_GE(p[9], 0.05 * q[9]);
    }
}

TEST(PartedRenderer, PartsOfThePicture) {
  const ZooMesh mesh = with_fields(test::random_delaunay(60, 3));
  const Scene scene = scene_for(Projection::perspective, 150);
  const test::Parts parts(mesh, at_random(mesh, 3, 4), 3, scene);
  const RenderResult all = draw_parts(parts, scene);
  SoloCommunicator alone;
  PartedRenderer renderer(alone, parts.of_rank(0, 1), scene);
  const PixelRect rect{50, 20, 71, 33};
  const Image some = renderer.render(rect, true).image;
  for (std::uint32_t y = 0; y < rect.height; ++y)
    for (std::uint32_t x = 0; x < rect.width; ++x)
      for (std::size_t c = 0; c < 4; ++c)
        EXPECT_EQ(some.at(x, y, c), all.image.at(x + rect.x, y + rect.y, c));
}

TEST(PartedRenderer, RefusesAMeshWithoutParts) {
  const Scene scene = scene_for(Projection::perspective);
  SoloCommunicator alone;
  EXPECT_THROW(PartedRenderer(alone, {}, scene), InputError);
}

TEST(PartedRenderer, RefusesTheErrorOfASkin) {
  const ZooMesh mesh = with_fields(test::structured(2, Cut::tetrahedra));
  Scene scene = scene_for(Projection::perspective);
  const test::Parts parts(mesh, at_random(mesh, 2, 1), 2, scene);
  constexpr std::array kError{Channel::error};
  SoloCommunicator alone;
  EXPECT_NO_THROW(PartedRenderer(alone, parts.of_rank(0, 1, false), scene, kError));
  scene.skin.emplace();
  EXPECT_THROW(PartedRenderer(alone, parts.of_rank(0, 1, false), scene, kError), UsageError);
}

}  // namespace
}  // namespace hiac
